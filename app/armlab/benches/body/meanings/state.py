"""The page of the three meanings of a rotation matrix: which one is shown, and the vector."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from armlab.benches.body.forms.commands import SetBodyTurn, SetWholeAxis
from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.state import Triple
from armlab.errors import InputError
from armlab.registry import known_name
from armlab.session.counted import refuse_beyond
from armlab.session.fields import FieldPart, Set, choice, vector
from armlab.session.state import Command, PartType, State

SHOWN = {"orientation": "1 Orientation", "coordinates": "2 Coordinates", "operator": "3 Operator"}

MATRIX = "meanings"
"""Key by which the scene knows a selection in R."""

AXES = "xyz"

FIRST_TURN = math.radians(50.0)
"""Angle of an elementary rotation of a body that is not turned, radians."""

SAME = 1e-9
"""Difference of the axis of a rotation from one of the base up to which it is that one."""

LONGEST = 2.6
"""Largest length of the vector, the same in whichever frame it is written; the outermost gimbal ring has radius 1."""


@dataclass(frozen=True)
class Meanings(FieldPart):
    """Choices of the page; the rotation is that of the body.

    Attributes
    ----------
    shown : "orientation", "coordinates" or "operator"
    p : (float, float, float)
        A vector: in the body's frame as long as the coordinates are shown, in the base frame before it is rotated.
    """

    key: ClassVar[str] = "meanings"
    looks: ClassVar[tuple[str, ...]] = ("shown",)

    shown: str = choice("meaning of R", "orientation", SHOWN)
    p: Triple = vector("p", "vector", (0.8, 0.5, 0.6))

    def check(self) -> None:
        """Refuse a vector that is too long."""
        length = math.hypot(*self.p)
        if length > LONGEST:
            raise InputError(f"p: expected a length of at most {LONGEST:g}, got {length:.4g}")


PART = PartType(Meanings, order=30)


@dataclass(frozen=True)
class SetVector(Command):
    """Set one component of the vector, 0-based, in the body's frame or, with ``in_base``, in the base frame."""

    index: int
    value: float
    in_base: bool = False
    label: ClassVar[str] = "vector"

    def apply(self, state: State) -> State:
        """Return the state with the vector."""
        refuse_beyond(self.index, 3, "component")
        values, R = np.array(state[Meanings].p), state.derived(forms_of).R
        if self.in_base:
            values = R @ values
        values[self.index] = self.value
        return Set(Meanings, "p", (R.T @ values if self.in_base else values).tolist()).apply(state)


def image_of(state: State) -> np.ndarray:
    """Return R p, shape (3,): the same vector in the base frame, or the rotated vector."""
    return np.asarray(state.derived(forms_of).R @ np.array(state[Meanings].p))


@dataclass(frozen=True)
class TurnElementary(Command):
    """Turn the body about x, y or z by its present angle: an elementary rotation."""

    axis: str
    label: ClassVar[str] = "elementary rotation"

    def apply(self, state: State) -> State:
        """Return the state with the rotation about this axis; one without an angle takes that at first."""
        known_name("axis", self.axis, AXES)
        angle = abs(state.derived(forms_of).angle) or FIRST_TURN
        x, y, z = (float(self.axis == each) for each in AXES)
        return SetBodyTurn(angle).apply(SetWholeAxis((x, y, z)).apply(state))


@dataclass(frozen=True)
class Elementary:
    """An elementary rotation and the vector, in the plane across its axis.

    Attributes
    ----------
    axis : str
        x, y or z.
    plane : str
        The two axes of the plane, in the order in which a positive rotation leads from one to the other.
    radius : float
        Length of the vector in the plane.
    alpha, theta : float
        Angle of the vector from the first of the two axes, and angle of the rotation, radians.
    along : float
        Component along the axis, which stays.
    """

    axis: str
    plane: str
    radius: float
    alpha: float
    theta: float
    along: float


def elementary_of(state: State) -> Elementary | None:
    """Return the elementary rotation that the body makes, or None if its axis is none of the base."""
    found = state.derived(forms_of)
    k = int(np.argmax(np.abs(found.axis)))
    if abs(found.axis[k]) < 1.0 - SAME:
        return None
    i, j = (k + 1) % 3, (k + 2) % 3
    p = state[Meanings].p
    theta = float(found.angle * np.sign(found.axis[k]))
    return Elementary(AXES[k], AXES[i] + AXES[j], math.hypot(p[i], p[j]), math.atan2(p[j], p[i]), theta, p[k])
