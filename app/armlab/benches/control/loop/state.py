"""The velocity loop of one mass (notes 7.1.1): mass, gain, wanted velocity, and the time that is shown."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.control.velocity_loop import ReferenceKind, SpeedReference, VelocityLoop
from armlab.kin.field import Field
from armlab.session.fields import FieldPart, choice, fields_of, number, text
from armlab.session.parts.timeline import Timeline
from armlab.session.state import PartType, State

CLIP_KEY = "loop"

KINDS: dict[str, str] = {"step": "Step", "sine": "Sine"}

MOST_PERIODS = 40
"""Largest number of periods of a sine that are shown: more could not be told apart in a plot."""


@dataclass(frozen=True)
class Loop(FieldPart):
    """One loop and its reference, which do not depend on the arm.

    Attributes
    ----------
    mass, gain : float
        kg and N s/m.
    amplitude, omega, v0, end : float
        m/s, rad/s, m/s, s.
    kind : "step" or "sine"
    example : str
        Key of the example it still is; empty when something has been changed.
    """

    key: ClassVar[str] = "loop"
    clip: ClassVar[str] = CLIP_KEY

    mass: float = number("M", "mass", 1.0, 1e-3, 1e4, "kg")
    gain: float = number("K", "gain of the controller", 10.0, 1e-3, 1e6, "N s/m")
    amplitude: float = number("v_d", "wanted velocity, of a sine its amplitude", 1.0, -100.0, 100.0, "m/s")
    omega: float = number("ω", "angular frequency of the sine", 2.0, 1e-3, 1e4, "rad/s")
    v0: float = number("v_0", "velocity at the start", 0.0, -100.0, 100.0, "m/s")
    end: float = number("T", "how long it is looked at", 6.0, 1e-3, 600.0, "s")
    kind: ReferenceKind = choice("wanted velocity", "sine", KINDS)
    example: str = text("example", "omega_2")

    @cached_property
    def loop(self) -> VelocityLoop:
        """The loop: mass and controller."""
        return VelocityLoop(self.mass, self.gain)

    @cached_property
    def reference(self) -> SpeedReference:
        """The wanted velocity."""
        return SpeedReference(self.kind, self.amplitude, self.omega)

    @cached_property
    def times(self) -> NDArray[np.float64]:
        """Times of the curves, denser at the start, where a fast loop settles."""
        even = np.linspace(0.0, self.end, 401)
        early = np.linspace(0.0, min(self.end, 6.0 * self.loop.time_constant), 90)
        return np.unique(np.concatenate([even, early]))

    @property
    def fields(self) -> tuple[Field, ...]:
        """The numbers that can be set: a step has no frequency."""
        numbers = (field for field in fields_of(Loop).values() if field.kind == "number")
        return tuple(field for field in numbers if field.key != "omega" or self.kind == "sine")

    @property
    def values(self) -> dict[str, float]:
        """The numbers by key."""
        return {field.key: getattr(self, field.key) for field in self.fields}

    def check(self) -> None:
        """Refuse a loop that cannot be shown."""
        self.loop, self.reference  # noqa: B018  raise when they cannot be
        periods = self.omega * self.end / (2.0 * math.pi)
        if self.kind == "sine" and periods > MOST_PERIODS:
            longest = 2.0 * math.pi * MOST_PERIODS / self.omega
            raise InputError(
                f"T: {self.end:g} s are {periods:.0f} periods of the sine, at most {MOST_PERIODS} can be shown: "
                f"expected up to {longest:.3g} s"
            )


PART = PartType(Loop, order=98)


def present_time(state: State) -> float:
    """Return the seconds since the loop began, or 0 while its film is closed."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else 0.0
