"""The page of skew matrices and dyads: a matrix, the vectors it works on, and what is shown of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.state import Triple
from armlab.errors import InputError
from armlab.registry import known_name
from armlab.session.counted import refuse_beyond
from armlab.session.fields import FieldPart, Set, Table, choice, table, vector, whole
from armlab.session.state import Command, PartType, State

SHOWN = {"split": "1 Two parts", "cross": "2 S(v) u", "dyads": "3 Dyads"}

MOST = 1e3
"""Largest entry and component."""

VECTORS = ("x", "v", "u")


@dataclass(frozen=True)
class Skew(FieldPart):
    """A matrix and vectors.

    Attributes
    ----------
    shown : "split", "cross" or "dyads"
    A : tuple of tuple of float
        A matrix, row by row; for dyads its columns are b1, b2, b3.
    x : (float, float, float)
        A vector: of the quadratic form, or the one that dyads take apart.
    v, u : (float, float, float)
        Of S(v) u.
    first, second : int
        Columns of the dyad that is looked at, 1 to 3.
    """

    key: ClassVar[str] = "skew"
    looks: ClassVar[tuple[str, ...]] = ("shown",)

    shown: str = choice("what is shown of a matrix", "split", SHOWN)
    A: Table = table("matrix A", ((1.0, 2.0, 0.0), (-1.0, 1.0, 1.5), (1.0, -0.5, 1.0)), -MOST, MOST)
    x: Triple = vector("x", "vector x", (1.0, 0.5, 0.5), -MOST, MOST)
    v: Triple = vector("v", "vector v", (0.4, 0.2, 1.0), -MOST, MOST)
    u: Triple = vector("u", "vector u", (1.0, 0.3, 0.0), -MOST, MOST)
    first: int = whole("first column of a dyad", 1, 1, 3)
    second: int = whole("second column of a dyad", 2, 1, 3)


PART = PartType(Skew, order=38)


@dataclass(frozen=True)
class SetSkewMatrix(Command):
    """Set the nine numbers of the matrix, row by row."""

    values: tuple[float, ...]
    label: ClassVar[str] = "matrix A"

    def apply(self, state: State) -> State:
        """Return the state with the matrix."""
        if len(self.values) != 9:
            raise InputError(f"A: expected 9 numbers, row by row, got {len(self.values)}")
        return Set(Skew, "A", np.reshape(np.array(self.values, dtype=float), (3, 3)).tolist()).apply(state)


@dataclass(frozen=True)
class SetSkewEntry(Command):
    """Set one entry of the matrix, 0-based."""

    row: int
    column: int
    value: float
    label: ClassVar[str] = "matrix A"

    def apply(self, state: State) -> State:
        """Return the state with this entry."""
        for name, index in (("row", self.row), ("column", self.column)):
            refuse_beyond(index, 3, name)
        values = np.array(state[Skew].A)
        values[self.row, self.column] = self.value
        return SetSkewMatrix(tuple(values.ravel().tolist())).apply(state)


@dataclass(frozen=True)
class SetSkewVector(Command):
    """Set one component, 0-based, of the vector x, v or u."""

    name: str
    index: int
    value: float
    label: ClassVar[str] = "component of a vector"

    def apply(self, state: State) -> State:
        """Return the state with this component."""
        known_name("vector", self.name, VECTORS)
        refuse_beyond(self.index, 3, self.name)
        values = list(getattr(state[Skew], self.name))
        values[self.index] = self.value
        return Set(Skew, self.name, values).apply(state)


@dataclass(frozen=True)
class TakeBodyMatrix(Command):
    """Take the rotation of the body as the matrix."""

    label: ClassVar[str] = "matrix A"

    def apply(self, state: State) -> State:
        """Return the state with the rotation."""
        return SetSkewMatrix(tuple(state.derived(forms_of).R.ravel().tolist())).apply(state)
