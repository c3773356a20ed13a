"""The velocity loop of one mass (notes 7.1.1): mass, gain, wanted velocity, and how long it is looked at."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.control.velocity_loop import ReferenceKind, SpeedReference, VelocityLoop
from armlab.kin.motion.field import Field
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Json, Part, PartType, State

CLIP_KEY = "loop"

KINDS: dict[ReferenceKind, str] = {"step": "Step", "sine": "Sine"}

MOST_PERIODS = 40
"""Of a sine that are shown: more could not be told apart in a plot."""

FIELDS: dict[str, Field] = {
    field.key: field
    for field in (
        Field("mass", "M", "mass", "number", 1.0, 1e-3, 1e4, unit="kg"),
        Field("gain", "K", "gain of the controller", "number", 10.0, 1e-3, 1e6, unit="N s/m"),
        Field("amplitude", "v_d", "wanted velocity, of a sine its amplitude", "number", 1.0, -100.0, 100.0, unit="m/s"),
        Field("omega", "ω", "angular frequency of the sine", "number", 2.0, 1e-3, 1e4, unit="rad/s"),
        Field("v0", "v_0", "velocity at the start", "number", 0.0, -100.0, 100.0, unit="m/s"),
        Field("end", "T", "how long it is looked at", "number", 6.0, 1e-3, 600.0, unit="s"),
    )
}
"""By key."""


@dataclass(frozen=True)
class Loop(Part):
    """One loop and what it is asked to do.

    Attributes
    ----------
    mass, gain : float
        kg and N s/m.
    kind : "step" or "sine"
    amplitude, omega, v0, end : float
        m/s, rad/s, m/s, s.
    example : str
        Key of the example it still is; empty when something has been changed.
    """

    key: ClassVar[str] = "loop"

    mass: float = 1.0
    gain: float = 10.0
    kind: ReferenceKind = "sine"
    amplitude: float = 1.0
    omega: float = 2.0
    v0: float = 0.0
    end: float = 6.0
    example: str = "omega_2"

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the first sine of the notes."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything: it has nothing to do with the arm."""
        return self

    @cached_property
    def loop(self) -> VelocityLoop:
        """Mass and controller."""
        return VelocityLoop(self.mass, self.gain)

    @cached_property
    def reference(self) -> SpeedReference:
        """The wanted velocity."""
        return SpeedReference(self.kind, self.amplitude, self.omega)

    @cached_property
    def times(self) -> NDArray[np.float64]:
        """Times of the curves, denser at the start, where a fast loop does everything."""
        even = np.linspace(0.0, self.end, 401)
        early = np.linspace(0.0, min(self.end, 6.0 * self.loop.time_constant), 90)
        return np.unique(np.concatenate([even, early]))

    @property
    def fields(self) -> tuple[Field, ...]:
        """What can be set: a step has no frequency."""
        return tuple(field for field in FIELDS.values() if field.key != "omega" or self.kind == "sine")

    @property
    def values(self) -> dict[str, float]:
        """The numbers by key."""
        return {key: getattr(self, key) for key in FIELDS}

    def to_json(self) -> Json:
        """Write everything."""
        return {**self.values, "kind": self.kind, "example": self.example}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; raises when nothing can be computed with it."""
        given = {**cls().to_json(), **data}
        numbers = {key: field.checked(given[key]) for key, field in FIELDS.items()}
        part = cls(**numbers, kind=given["kind"], example=str(given["example"]))
        check(part)
        return part


PART = PartType(Loop, order=98)


@dataclass(frozen=True)
class SetLoop(Command):
    """Set one number of the loop, by its key in `FIELDS`."""

    name: str
    value: Any
    label: ClassVar[str] = "velocity loop"

    def apply(self, state: State) -> State:
        """Return the state with the number set."""
        if self.name not in FIELDS:
            raise UnknownName("velocity loop", self.name, FIELDS)
        number = FIELDS[self.name].checked(self.value)
        return with_loop(state, replace(state[Loop], **{self.name: number}, example=""))


@dataclass(frozen=True)
class ChooseLoopReference(Command):
    """Ask for a step or for a sine."""

    kind: str
    label: ClassVar[str] = "wanted velocity"

    def apply(self, state: State) -> State:
        """Return the state with the other reference."""
        kind = next((known for known in KINDS if known == self.kind), None)
        if kind is None:
            raise UnknownName("wanted velocity", self.kind, KINDS)
        part = state[Loop]
        return state if kind == part.kind else with_loop(state, replace(part, kind=kind, example=""))


def with_loop(state: State, part: Loop) -> State:
    """Return the state with the loop, and its film, if it is on, at its beginning; refused when it cannot be."""
    check(part)
    if part == state[Loop]:
        return state
    timeline = state[Timeline]
    rewound = replace(timeline, time=0.0, playing=False) if timeline.clip == CLIP_KEY else timeline
    return state.replace(part, rewound)


def check(part: Loop) -> None:
    """Refuse a loop that cannot be shown."""
    if part.kind not in KINDS:
        raise UnknownName("wanted velocity", part.kind, KINDS)
    part.loop, part.reference  # noqa: B018  raise when they cannot be
    periods = part.omega * part.end / (2.0 * math.pi)
    if part.kind == "sine" and periods > MOST_PERIODS:
        longest = 2.0 * math.pi * MOST_PERIODS / part.omega
        raise InputError(
            f"T: {part.end:g} s are {periods:.0f} periods of the sine, at most {MOST_PERIODS} can be shown: "
            f"expected up to {longest:.3g} s"
        )


def present_time(state: State) -> float:
    """Return the seconds since the loop began; 0 while its film is not on."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else 0.0
