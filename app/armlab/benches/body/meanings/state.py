"""The page of the three meanings of a rotation matrix: which one is shown, and the vector."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.state import Triple
from armlab.errors import InputError
from armlab.session.fields import FieldPart, Set, choice, vector
from armlab.session.state import Command, PartType, State

SHOWN = {"orientation": "1 Orientation", "coordinates": "2 Coordinates", "operator": "3 Operator"}

MATRIX = "meanings"
"""Key by which the scene knows a selection in R."""

MOST = 1.5
"""Largest component of the vector; the outermost gimbal ring has radius 1."""


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
    p: Triple = vector("p", "vector", (0.8, 0.5, 0.6), -MOST, MOST)


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
        if not 0 <= self.index < 3:
            raise InputError(f"component: expected 1 to 3, got {self.index + 1}")
        values, R = np.array(state[Meanings].p), state.derived(forms_of).R
        if self.in_base:
            values = R @ values
        values[self.index] = self.value
        return Set(Meanings, "p", (R.T @ values if self.in_base else values).tolist()).apply(state)


def image_of(state: State) -> np.ndarray:
    """Return R p, shape (3,): the same vector in the base frame, or the rotated vector."""
    return np.asarray(state.derived(forms_of).R @ np.array(state[Meanings].p))
