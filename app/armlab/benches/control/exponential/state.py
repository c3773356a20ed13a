"""The exponential of a 2 x 2 matrix (notes 1.50-1.58): the matrix, time, start, and how many terms are summed."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.control.matrix_exponential import (
    Diagonalisation,
    as_printed,
    by_eigenvectors,
    by_scipy,
    diagonalised,
    flow,
    largest_difference,
    partial_sums,
    remainder_bound,
)
from armlab.session.state import Command, Json, Part, PartType, State

Array = NDArray[np.float64]
Pair = tuple[float, float]
Matrix = tuple[Pair, Pair]

LARGEST_ENTRY = 1000.0
LARGEST_GROWTH = 30.0
"""Of the real part of an eigenvalue times the end: beyond it nothing of the start would be seen in the plane. Of the
imaginary part, too: five turns are enough for the points of the curve."""

LARGEST_SIZE = 1e4
"""Of the sum of the moduli in a column of A t at the end: beyond it terms of the series are no numbers any more."""

LONGEST, SHORTEST = 100.0, 1e-3
"""Seconds of the curve."""

MOST_TERMS = 120
POINTS = 161


@dataclass(frozen=True)
class Exponential(Part):
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

    A: Matrix = ((0.0, 1.0), (-2.0, -3.0))
    t: float = 0.7
    end: float = 3.0
    x0: Pair = (1.0, 0.0)
    terms: int = 4
    example: str = "notes"

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the matrix on which the printed 1.58 was checked."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything: it has nothing to do with the arm."""
        return self

    @cached_property
    def found(self) -> Found:
        """The exponential in three ways."""
        return found(self)

    @property
    def curve(self) -> Curve:
        """The curve of the system in the plane."""
        return curve(self.A, self.x0, self.end)

    def to_json(self) -> Json:
        """Write everything."""
        rows = [list(row) for row in self.A]
        return {"A": rows, "t": self.t, "end": self.end, "x0": list(self.x0), "terms": self.terms, "ex": self.example}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; raises when nothing can be computed with it."""
        given = {**cls().to_json(), **data}
        first, second = (_pair(row) for row in given["A"])
        part = cls(
            (first, second),
            float(given["t"]),
            float(given["end"]),
            _pair(given["x0"]),
            int(given["terms"]),
            str(given["ex"]),
        )
        check(part)
        return part


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
    """Return a bound of what 1, 2, ... terms leave out, shape (MOST_TERMS,); infinite where none is known."""
    return np.array([remainder_bound(part.A, part.t, terms) for terms in range(1, MOST_TERMS + 1)])


@lru_cache(maxsize=64)
def curve(A: Matrix, x0: Pair, end: float) -> Curve:
    """Return the curve from 0 to the end: the same while t is moved."""
    t = np.linspace(0.0, end, POINTS)
    return Curve(t, flow(A, x0, t))


@dataclass(frozen=True)
class SetEntry(Command):
    """Set an entry of A (``"a11"`` to ``"a22"``), of x0 (``"x1"``, ``"x2"``), or the end of the curve (``"end"``)."""

    name: str
    value: float
    label: ClassVar[str] = "matrix"

    def apply(self, state: State) -> State:
        """Return the state with the number set."""
        part = state[Exponential]
        if self.name not in ENTRIES:
            raise UnknownName("matrix exponential", self.name, ENTRIES)
        value = _number(self.value, ENTRIES[self.name])
        changed: dict[str, Any]
        if self.name == "end":
            changed = {"end": value, "t": min(part.t, value)}
        elif self.name[0] == "x":
            changed = {"x0": _with(part.x0, int(self.name[1]) - 1, value)}
        else:
            i, j = int(self.name[1]) - 1, int(self.name[2]) - 1
            rows = list(part.A)
            rows[i] = _with(rows[i], j, value)
            changed = {"A": (rows[0], rows[1])}
        return with_exponential(state, replace(part, **changed, example=""))


ENTRIES = {"a11": "a₁₁", "a12": "a₁₂", "a21": "a₂₁", "a22": "a₂₂", "x1": "x₁(0)", "x2": "x₂(0)", "end": "end"}
"""What can be typed, by key, and its symbol."""


@dataclass(frozen=True)
class MoveTime(Command):
    """Take another time t: a slider in motion."""

    t: float
    snapshot: ClassVar[bool] = True
    rests: ClassVar[bool] = True
    label: ClassVar[str] = "time of the matrix exponential"

    @property
    def stroke(self) -> object:
        """A whole move of the slider."""
        return type(self)

    def apply(self, state: State) -> State:
        """Return the state with the time, moved inside 0 to the end."""
        part = state[Exponential]
        t = min(max(_number(self.t, "t"), 0.0), part.end)
        return with_exponential(state, replace(part, t=t))


@dataclass(frozen=True)
class SumTerms(Command):
    """Sum another number of terms: a slider in motion."""

    terms: int
    snapshot: ClassVar[bool] = True
    rests: ClassVar[bool] = True
    label: ClassVar[str] = "number of terms"

    @property
    def stroke(self) -> object:
        """A whole move of the slider."""
        return type(self)

    def apply(self, state: State) -> State:
        """Return the state with the number of terms."""
        return with_exponential(state, replace(state[Exponential], terms=int(self.terms)))


def with_exponential(state: State, part: Exponential) -> State:
    """Return the state with the system; refused when nothing can be computed with it."""
    check(part)
    return state if part == state[Exponential] else state.replace(part)


def check(part: Exponential) -> None:
    """Refuse a system that cannot be shown."""
    for value, where in zip((*part.A[0], *part.A[1], *part.x0), ENTRIES.values(), strict=False):
        if not abs(_number(value, where)) <= LARGEST_ENTRY:
            raise InputError(f"{where}: expected −{LARGEST_ENTRY:g} to {LARGEST_ENTRY:g}, got {value:g}")
    if not SHORTEST <= part.end <= LONGEST:
        raise InputError(f"end: expected {SHORTEST:g} to {LONGEST:g} s, got {part.end:g}")
    if not 0.0 <= part.t <= part.end:
        raise InputError(f"t: expected 0 to {part.end:g} s, got {part.t:g}")
    if not 1 <= part.terms <= MOST_TERMS:
        raise InputError(f"terms: expected 1 to {MOST_TERMS}, got {part.terms}")
    values = np.linalg.eigvals(np.array(part.A))
    growth = part.end * float(max(values.real.max(), np.abs(values.imag).max()))
    size = part.end * max(abs(part.A[0][j]) + abs(part.A[1][j]) for j in (0, 1))
    for what, found, largest in (
        ("an eigenvalue has a real or imaginary part of", growth, LARGEST_GROWTH),
        ("the moduli in a column add up to", size, LARGEST_SIZE),
    ):
        if found > largest * (1.0 + 1e-12):
            raise InputError(
                f"A t at the end: {what} {found:.4g}, expected at most {largest:g}; "
                f"take an end up to {largest * part.end / found:.3g} s"
            )


def _with(pair: Pair, place: int, value: float) -> Pair:
    return (value, pair[1]) if place == 0 else (pair[0], value)


def _pair(numbers: Any) -> Pair:
    one, other = numbers
    return float(one), float(other)


def _number(value: float, where: str) -> float:
    if not math.isfinite(value):
        raise InputError(f"{where}: expected a finite number, got {value}")
    return float(value) + 0.0
