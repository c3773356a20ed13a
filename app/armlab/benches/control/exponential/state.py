"""The exponential of a 2 x 2 matrix (notes 1.50-1.58): the matrix, time, start, and number of terms in the sum."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.control.matrix_exponential import (
    Diagonalisation,
    as_printed,
    by_eigenvectors,
    by_scipy,
    diagonalised,
    largest_difference,
    partial_sums,
    remainder_bounds,
)
from armlab.registry import known_name
from armlab.session.fields import FieldPart, number, setting, table, text, vector, whole
from armlab.session.state import Command, PartType, State

Array = NDArray[np.float64]
Pair = tuple[float, float]
Matrix = tuple[Pair, Pair]

LARGEST_ENTRY = 1000.0
LARGEST_GROWTH = 30.0
"""Largest entry, and largest real part of an eigenvalue times the end: beyond it the start would be invisible in the
plane. The bound holds for the imaginary part, too: five turns are enough for the points of the curve."""

LARGEST_SIZE = 1e4
"""Largest sum of the moduli in a column of A t at the end, beyond which terms of the series overflow."""

LONGEST, SHORTEST = 100.0, 1e-3
"""Largest and least duration of the curve, seconds."""

MOST_TERMS = 120
POINTS = 161


@dataclass(frozen=True)
class Exponential(FieldPart):
    """A linear system xdot = A x in the plane.

    Attributes
    ----------
    A : tuple of two rows of two numbers
        1/s.
    t : float
        Seconds, 0 to ``end``.
    end : float
        Seconds of the curve.
    x0 : (float, float)
        The start.
    terms : int
        Of the series, the identity counted.
    example : str
        Key of the example it still is; empty when something but t and the number of terms has been changed.
    """

    key: ClassVar[str] = "exponential"

    leave_example: ClassVar[tuple[str, ...]] = ("example", "t", "terms")

    A: Matrix = table("matrix A", ((0.0, 1.0), (-2.0, -3.0)), -LARGEST_ENTRY, LARGEST_ENTRY)
    t: float = number("t", "time of the matrix exponential", 0.7, 0.0, LONGEST, "s")
    end: float = number("", "end of the curve", 3.0, SHORTEST, LONGEST, "s")
    x0: Pair = vector("x(0)", "start", (1.0, 0.0), -LARGEST_ENTRY, LARGEST_ENTRY)
    terms: int = whole("terms of the series", 4, 1, MOST_TERMS)
    example: str = text("example", "notes", under="ex")

    @cached_property
    def found(self) -> Found:
        """The exponential in three ways."""
        return found(self)

    @property
    def curve(self) -> Curve:
        """The solution of the system as a curve in the plane."""
        return curve(self.A, self.x0, self.end)

    def check(self) -> None:
        """Refuse a system that cannot be shown."""
        if self.t > self.end:
            raise InputError(f"t: expected 0 to {self.end:g} s, got {self.t:g}")
        values = np.linalg.eigvals(np.array(self.A))
        growth = self.end * float(max(values.real.max(), np.abs(values.imag).max()))
        size = self.end * max(abs(self.A[0][j]) + abs(self.A[1][j]) for j in (0, 1))
        for what, found, largest in (
            ("an eigenvalue has a real or imaginary part of", growth, LARGEST_GROWTH),
            ("the moduli in a column add up to", size, LARGEST_SIZE),
        ):
            if found > largest * (1.0 + 1e-12):
                raise InputError(
                    f"A t at the end: {what} {found:.4g}, expected at most {largest:g}; "
                    f"take an end up to {largest * self.end / found:.3g} s"
                )


PART = PartType(Exponential, order=98)


class Found(NamedTuple):
    """e^(A t) in three ways.

    Attributes
    ----------
    whole : ndarray, shape (2, 2)
        By SciPy.
    sums : ndarray, shape (MOST_TERMS, 2, 2)
        Of 1, 2, ... terms of the series.
    product : ndarray, shape (2, 2), or None
        By eigenvectors, where they are a basis.
    printed : float or None
        Largest difference of what notes 1.58 print from the exponential.
    basis : Diagonalisation
    """

    whole: Array
    sums: Array
    product: Array | None
    printed: float | None
    basis: Diagonalisation

    @property
    def errors(self) -> Array:
        """Largest difference of each sum from SciPy's result, shape (MOST_TERMS,)."""
        return np.asarray(np.abs(self.sums - self.whole).max(axis=(1, 2)))


class Curve(NamedTuple):
    """x(t) in the plane: times (N,), and points (N, 2)."""

    t: Array
    x: Array


def found(part: Exponential) -> Found:
    """Return the exponential in three ways."""
    printed, whole = as_printed(part.A, part.t), by_scipy(part.A, part.t)
    return Found(
        whole,
        partial_sums(part.A, part.t, MOST_TERMS),
        by_eigenvectors(part.A, part.t),
        None if printed is None else largest_difference(printed, whole),
        diagonalised(part.A),
    )


def bounds(part: Exponential) -> Array:
    """Return bounds of the errors of 1, 2, ... terms, shape (MOST_TERMS,); infinite if none is known."""
    return remainder_bounds(part.A, part.t, MOST_TERMS)


@lru_cache(maxsize=64)
def curve(A: Matrix, x0: Pair, end: float) -> Curve:
    """Return the curve from 0 to the end, which stays the same while t is moved."""
    t = np.linspace(0.0, end, POINTS)
    return Curve(t, np.asarray(exponentials(A, end) @ np.array(x0)))


@lru_cache(maxsize=64)
def exponentials(A: Matrix, end: float) -> Array:
    """Return e^(A t) along the curve, shape (POINTS, 2, 2), which stays the same while the start is moved."""
    return by_scipy(A, np.linspace(0.0, end, POINTS))


@dataclass(frozen=True)
class SetEntry(Command):
    """Set an entry of A (``"a11"`` to ``"a22"``), of x0 (``"x1"``, ``"x2"``), or the end of the curve (``"end"``)."""

    name: str
    value: float
    label: ClassVar[str] = "matrix"

    def apply(self, state: State) -> State:
        """Return the state with the number set."""
        part = state[Exponential]
        known_name("matrix exponential", self.name, ENTRIES)
        if self.name == "end":
            return setting(state, Exponential, {"end": self.value, "t": min(part.t, self.value)})
        if self.name[0] == "x":
            return setting(state, Exponential, {"x0": _with(part.x0, int(self.name[1]) - 1, self.value)})
        i, j = int(self.name[1]) - 1, int(self.name[2]) - 1
        return setting(
            state, Exponential, {"A": [_with(row, j, self.value) if k == i else row for k, row in enumerate(part.A)]}
        )


ENTRIES = {"a11": "a₁₁", "a12": "a₁₂", "a21": "a₂₁", "a22": "a₂₂", "x1": "x₁(0)", "x2": "x₂(0)", "end": "end"}
"""Symbols of the numbers that can be typed, by key."""


@dataclass(frozen=True)
class MoveTime(Command):
    """Choose another time t; sent by a slider in motion."""

    t: float
    snapshot: ClassVar[bool] = True
    rests: ClassVar[bool] = True
    label: ClassVar[str] = "time of the matrix exponential"

    def apply(self, state: State) -> State:
        """Return the state with the time, clipped to 0 and the end."""
        return setting(state, Exponential, {"t": min(max(self.t, 0.0), state[Exponential].end)})


@dataclass(frozen=True)
class SumTerms(Command):
    """Sum another number of terms; sent by a slider in motion."""

    terms: int
    snapshot: ClassVar[bool] = True
    rests: ClassVar[bool] = True
    label: ClassVar[str] = "number of terms"

    def apply(self, state: State) -> State:
        """Return the state with the number of terms."""
        return setting(state, Exponential, {"terms": self.terms})


def _with(pair: Pair, place: int, value: float) -> Pair:
    return (value, pair[1]) if place == 0 else (pair[0], value)
