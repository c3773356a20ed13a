"""Coils in a magnetic field: the field, the current, the coils, and how the rotor turns."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from armlab.errors import InputError
from armlab.kin.drive.coils import MOST_COILS, STEP, Coil, Released, extremes, let_go, quickness
from armlab.session.fields import FieldPart, choice, flag, number, text, whole
from armlab.session.parts.timeline import Timeline
from armlab.session.state import PartType, State

CLIP_KEY = "coils"

MOTIONS = {"turned": "turned evenly", "free": "let go"}

TURN = 8.0
"""Duration of one turn that is made evenly, seconds."""

MOST_TURNS = 40.0
"""Largest number of turns of a rotor that is let go."""

MOST_STEPS = 2e4
"""Largest number of steps in which the motion of a rotor that is let go is found: a tenth of a second of work."""


@dataclass(frozen=True)
class Torque(FieldPart):
    """Numbers of the page, which do not depend on the arm.

    Attributes
    ----------
    B, current, length, radius : float
        T, A, m, m.
    turns, coils : int
        Turns of wire of a coil, and number of coils at equal angles.
    switched : bool
        Whether there is a commutator.
    motion : "turned" or "free"
    start : float
        Angle at which the rotor starts, radians.
    inertia, friction, duration : float
        Of a rotor that is let go: kg m², N m s/rad, s.
    example : str
        Key of the example it still is; empty when something has been changed.
    """

    key: ClassVar[str] = "coils"
    clip: ClassVar[str] = CLIP_KEY

    B: float = number("B", "flux density of the field", 0.5, 1e-4, 20.0, "T")
    current: float = number("I", "current of a coil", 2.0, -1e3, 1e3, "A")
    length: float = number("l", "length of a side of the coil", 0.05, 1e-3, 10.0, "m")
    radius: float = number("r", "distance of a side from the axis", 0.02, 1e-3, 10.0, "m")
    turns: int = whole("turns of wire of a coil", 50, 1, 10000)
    coils: int = whole("number of coils", 1, 1, MOST_COILS)
    switched: bool = flag("commutator", True)
    motion: str = choice("how the rotor turns", "turned", MOTIONS)
    start: float = number("θ_0", "angle at the start", math.pi / 6.0, -2.0 * math.pi, 2.0 * math.pi, "rad")
    inertia: float = number("J", "moment of inertia of the rotor", 5e-3, 1e-7, 1e3, "kg m²")
    friction: float = number("F", "viscous friction of the rotor", 4e-3, 0.0, 1e3, "N m s/rad")
    duration: float = number("T", "how long it is looked at", 10.0, 0.1, 120.0, "s")
    example: str = text("example", "one")

    @property
    def coil(self) -> Coil:
        """One of the coils."""
        return Coil(self.B, self.current, self.length, self.radius, self.turns)

    @property
    def torques(self) -> tuple[float, float, float]:
        """Least, largest and mean torque over a turn, N m, by the closed form; the mean is 0 without a commutator.

        With a current the other way round all are of the other sign, and the least is the one of the largest size.
        """
        least, largest, mean = (abs(self.coil.peak) * each for each in extremes(self.coils))
        if not self.switched:
            return -largest, largest, 0.0
        return (least, largest, mean) if self.coil.peak >= 0.0 else (-largest, 0.0 - least, -mean)

    @cached_property
    def released(self) -> Released:
        """The motion of the rotor that is let go."""
        return let_go(self.coil.peak, self.inertia, self.friction, self.start, self.duration, self.coils, self.switched)

    @property
    def end(self) -> float:
        """The duration of the film, seconds."""
        return TURN if self.motion == "turned" else self.duration

    def angle(self, time: float) -> float:
        """Return the angle of the rotor at a time of the film, radians."""
        if self.motion == "turned":
            return self.start + 2.0 * math.pi * time / TURN
        return float(np.interp(time, self.released.t, self.released.theta))

    def check(self) -> None:
        """Refuse a rotor that would turn too often, or swing or settle too quickly, to be followed."""
        if self.motion != "free":
            return
        self._check_steps()
        if self.switched and self.current != 0.0:
            self._check_turns()

    def _check_steps(self) -> None:
        steps = self.duration * quickness(self.coil.peak, self.inertia, self.friction, self.coils) / STEP
        if steps > MOST_STEPS:
            raise InputError(
                f"rotor let go: it swings or settles so quickly that {self.duration:g} s would take about {steps:.3g} "
                f"steps, expected at most {MOST_STEPS:g}; take a shorter time, or more inertia"
            )

    def _check_turns(self) -> None:
        mean = abs(self.torques[2])
        run_up = mean * self.duration**2 / (2.0 * self.inertia)
        steady = math.inf if self.friction == 0.0 else mean * self.duration / self.friction
        turns = min(run_up, steady) / (2.0 * math.pi)
        if turns > MOST_TURNS:
            raise InputError(
                f"rotor let go: it would turn about {turns:.3g} times in {self.duration:g} s, expected at most "
                f"{MOST_TURNS:g}; take a shorter time, or more inertia or friction"
            )


PART = PartType(Torque, order=131)


def present_time(state: State) -> float:
    """Return the seconds since the rotor began to turn, or 0 while its film is closed."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else 0.0


def present_angle(state: State) -> float:
    """Return the angle of the rotor now, radians."""
    return state[Torque].angle(present_time(state))
