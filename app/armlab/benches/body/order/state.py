"""The page of two rotations in both orders: their axes and angles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.body.forms.film import time_of, with_film_at
from armlab.benches.body.forms.state import Triple
from armlab.benches.body.forms.timing import ends_of
from armlab.errors import InputError
from armlab.session.counted import refuse_beyond
from armlab.session.fields import FieldPart, Set, choice, vector
from armlab.session.state import Command, PartType, State

CLIP_KEY = "order"

ENDS = ends_of(2)
"""Ends of both rotations in the film, seconds."""

NAMES = ("a", "b")

MOST = 1e6
"""Largest component of an axis."""

MOST_TURNED = 2.0 * math.pi
"""Largest angle, radians."""

ROUNDED = 1e-5
"""Relative error of a number with the digits of a field, such as ten times the 0.62832 rad of a tenth of a turn."""

LEAST = 1e-9
"""Smallest angle to which both are divided, radians: any smaller one would be lost in a matrix."""

ABOUT = {"base": "base axes", "body": "body axes"}


@dataclass(frozen=True)
class Order(FieldPart):
    """Two rotations.

    Attributes
    ----------
    a, b : (float, float, float)
        Their axes, which need not be of unit length.
    angles : (float, float)
        Radians.
    about : "base" or "body"
        Whether the axes stay where they are, or are carried along by the body.
    """

    key: ClassVar[str] = "order"
    clip: ClassVar[str] = CLIP_KEY

    a: Triple = vector("a", "axis of the first rotation", (1.0, 0.0, 0.0), -MOST, MOST)
    b: Triple = vector("b", "axis of the second rotation", (0.0, 0.0, 1.0), -MOST, MOST)
    angles: tuple[float, float] = vector(
        "θ", "angles of two rotations", (0.5 * math.pi, 0.5 * math.pi), -MOST_TURNED, MOST_TURNED, "rad"
    )
    about: str = choice("axes of two rotations", "base", ABOUT)

    def check(self) -> None:
        """Refuse an axis that is zero."""
        for name, axis in zip(NAMES, (self.a, self.b), strict=True):
            if math.hypot(*axis) == 0.0:
                raise InputError(f"{name}: expected an axis that is not zero: zero has no direction")


PART = PartType(Order, order=34)


@dataclass(frozen=True)
class SetOrderAxis(Command):
    """Set one component of the axis of a rotation; rotation and component are 0-based."""

    which: int
    index: int
    value: float
    label: ClassVar[str] = "axis of a rotation"

    def apply(self, state: State) -> State:
        """Return the state with this component."""
        name = _name(self.which)
        refuse_beyond(self.index, 3, name)
        values = list(getattr(state[Order], name))
        values[self.index] = self.value
        return Set(Order, name, values).apply(state)


@dataclass(frozen=True)
class SetOrderAngle(Command):
    """Set the angle (rad) of a rotation, 0-based."""

    which: int
    value: float
    label: ClassVar[str] = "angle of a rotation"

    def apply(self, state: State) -> State:
        """Return the state with this angle."""
        _name(self.which)
        angles = [self.value if k == self.which else angle for k, angle in enumerate(state[Order].angles)]
        return Set(Order, "angles", angles).apply(state)


@dataclass(frozen=True)
class ScaleAngles(Command):
    """Multiply both angles by a factor."""

    factor: float
    label: ClassVar[str] = "size of two rotations"

    def apply(self, state: State) -> State:
        """Return the state with both angles scaled; `InputError` when they become too large or too small."""
        angles = [self.factor * angle for angle in state[Order].angles]
        largest = max(map(abs, angles))
        if not math.isfinite(self.factor) or self.factor <= 0.0 or largest > MOST_TURNED * (1.0 + ROUNDED):
            raise InputError(f"size: expected angles up to a whole turn, got {math.degrees(largest):.6g}°")
        if 0.0 < largest < LEAST:
            raise InputError(f"size: expected an angle of at least {LEAST:g} rad, got {largest:.3g} rad")
        turned = [min(max(angle, -MOST_TURNED), MOST_TURNED) for angle in angles]
        return Set(Order, "angles", turned).apply(state)


@dataclass(frozen=True)
class ShowRotation(Command):
    """Show the film where this many rotations, 0 to 2, have been made."""

    made: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the film open there, paused."""
        return with_film_at(state, CLIP_KEY, self.made, "rotations", ENDS)


def _name(which: int) -> str:
    refuse_beyond(which, len(NAMES), "rotation")
    return NAMES[which]


def film_time(state: State) -> float:
    """Return the time of the film in seconds; its end while it is closed."""
    return time_of(state, CLIP_KEY, ENDS[-1])
