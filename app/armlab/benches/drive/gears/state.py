"""The page of gears: a train of wheels, what drives it, and the ratio for a load that is accelerated."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from armlab.errors import InputError
from armlab.kin.drive.best_ratio import Best, Load, best_ratio
from armlab.kin.drive.train import LAYOUTS, STAGES, Train, train
from armlab.kin.drive.transfer import Transfer, transfer
from armlab.session.fields import FieldPart, Set, choice, number, own, setting, text
from armlab.session.state import Command, Json, PartType, State

CLIP_KEY = "gears"

SHOWN = {"train": "1 Train", "best": "2 Best ratio", "kinds": "3 Kinds"}

ADDED = 30
"""Number of teeth of a wheel that is added."""

USUAL_SPEED = 100.0 * math.pi
"""Speed of the motor at first, rad/s: 3000 turns a minute."""

STRONGEST = 1e6
"""Largest torque, N m, that can be typed."""


def _teeth(data: Json) -> tuple[int, ...]:
    return train(tuple(data)).teeth


@dataclass(frozen=True)
class Gears(FieldPart):
    """Numbers of the page, which do not depend on the arm.

    Attributes
    ----------
    teeth : tuple of int
        Of each wheel, from the motor to the load.
    layout : "row" or "compound"
    distance, second : float
        Centre distances of the first pair and of the second stage, metres.
    efficiency : float
        Of one mesh.
    speed, torque : float
        Of the motor, rad/s and N m.
    motor_inertia, load_inertia, acceleration, load_torque : float
        J_m and J_u in kg m², a in rad/s², and the constant torque of the load in N m.
    ratio : float
        The ratio n for which the torque of the motor is looked at; that of the train need not be the same.
    shown : "train", "best" or "kinds"
    kind : str
        Key of the kind of transmission of which more is said.
    example : str
        Key of the example in place; empty when something has been changed.
    """

    key: ClassVar[str] = "gears"
    clip: ClassVar[str] = CLIP_KEY
    looks: ClassVar[tuple[str, ...]] = ("shown", "kind")

    teeth: tuple[int, ...] = own("numbers of teeth", (18, 36), _teeth)
    layout: str = choice("arrangement of the wheels", "row", LAYOUTS)
    distance: float = number("a₁₂", "centre distance of the first pair", 0.054, 1e-3, 10.0, "m")
    second: float = number("a₃₄", "centre distance of the second stage", 0.054, 1e-3, 10.0, "m")
    efficiency: float = number("η", "efficiency of one mesh", 0.98, 0.0, 1.0, above=True)
    speed: float = number("θ̇ₘ", "speed of the motor", USUAL_SPEED, -1e5, 1e5, "rad/s")
    torque: float = number("τₘ", "torque of the motor", 0.2, -STRONGEST, STRONGEST, "N m")
    motor_inertia: float = number("Jₘ", "moment of inertia of the motor", 0.01, 0.0, 1e6, "kg m²", above=True)
    load_inertia: float = number("Jᵤ", "moment of inertia of the load", 4.0, 0.0, 1e9, "kg m²", above=True)
    acceleration: float = number("a", "acceleration of the load", 3.0, -1e6, 1e6, "rad/s²")
    load_torque: float = number("τ_L", "constant torque of the load", 0.0, -STRONGEST, STRONGEST, "N m")
    ratio: float = number("n", "ratio that is looked at", 10.0, 0.01, 1e5)
    shown: str = choice("what is shown of gears", "train", SHOWN)
    kind: str = text("kind of transmission", "spur")
    example: str = text("example", "pair")

    def check(self) -> None:
        """Refuse wheels that make no train."""
        train(self.teeth, self.layout)

    @cached_property
    def train(self) -> Train:
        """The wheels as a train."""
        return Train(self.teeth, self.layout)

    @property
    def distances(self) -> tuple[float, float]:
        """The centre distances, metres."""
        return self.distance, self.second

    @property
    def whole_efficiency(self) -> float:
        """The efficiency of all meshes, one after the other."""
        return float(self.efficiency ** len(self.train.meshes))

    @cached_property
    def transfer(self) -> Transfer:
        """Speeds, torques and powers on both sides."""
        return transfer(self.train.ratio, self.speed, self.torque, self.whole_efficiency)

    @property
    def load(self) -> Load:
        """The motor and its load, for the best ratio."""
        return Load(self.motor_inertia, self.load_inertia, self.acceleration, self.load_torque)

    @cached_property
    def best(self) -> Best:
        """The ratio with which the motor needs the least torque."""
        return best_ratio(self.load)


PART = PartType(Gears, order=133)


@dataclass(frozen=True)
class SetTeeth(Command):
    """Set the number of teeth of one wheel, 0-based."""

    wheel: int
    teeth: int
    label: ClassVar[str] = "number of teeth"

    def apply(self, state: State) -> State:
        """Return the state with the wheel changed."""
        teeth = list(state[Gears].teeth)
        if not 0 <= self.wheel < len(teeth):
            raise InputError(f"wheel: expected 1 to {len(teeth)}, got {self.wheel + 1}")
        teeth[self.wheel] = self.teeth
        return _with(state, teeth)


@dataclass(frozen=True)
class SetWheels(Command):
    """Set the numbers of teeth of all wheels, from the motor to the load, and their arrangement."""

    teeth: tuple[int, ...]
    layout: str = "row"
    label: ClassVar[str] = "wheels"

    def apply(self, state: State) -> State:
        """Return the state with these wheels."""
        return setting(state, Gears, {"teeth": self.teeth, "layout": self.layout})


@dataclass(frozen=True)
class AddWheel(Command):
    """Add a wheel at the end of the row."""

    label: ClassVar[str] = "wheel"

    def apply(self, state: State) -> State:
        """Return the state with one more wheel; `InputError` when there are as many as a train may have."""
        return _with(state, [*state[Gears].teeth, ADDED])


@dataclass(frozen=True)
class RemoveWheel(Command):
    """Remove the last wheel; what is left is a row."""

    label: ClassVar[str] = "wheel"

    def apply(self, state: State) -> State:
        """Return the state with one wheel less; `InputError` when there are only two."""
        return setting(state, Gears, {"teeth": state[Gears].teeth[:-1], "layout": "row"})


@dataclass(frozen=True)
class ArrangeWheels(Command):
    """Arrange the wheels in a row, or in two stages with wheels added where some are missing."""

    layout: str
    label: ClassVar[str] = "arrangement of the wheels"

    def apply(self, state: State) -> State:
        """Return the state with the wheels so arranged."""
        teeth = state[Gears].teeth
        missing = STAGES - len(teeth) if self.layout == "compound" else 0
        return setting(state, Gears, {"teeth": (*teeth, *teeth[:missing]), "layout": self.layout})


@dataclass(frozen=True)
class TakeRatio(Command):
    """Look at the ratio of the train, or at the best one."""

    of: str
    label: ClassVar[str] = "ratio that is looked at"

    def apply(self, state: State) -> State:
        """Return the state with this ratio; `InputError` when there is no best one within the range."""
        part = state[Gears]
        if self.of == "train":
            return Set(Gears, "ratio", abs(part.train.ratio)).apply(state)
        if self.of != "best":
            raise InputError(f"ratio of: expected train or best, got {self.of!r}")
        return Set(Gears, "ratio", part.best.ratio).apply(state)


def _with(state: State, teeth: Sequence[int]) -> State:
    return setting(state, Gears, {"teeth": tuple(teeth)})
