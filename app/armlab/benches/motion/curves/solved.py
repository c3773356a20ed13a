"""The computation of a curve: systems of equations, velocities at the knots, coefficients; and the normalised forms."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.curves.made import Made
from armlab.kin.motion.path import Path, PolynomialPath
from armlab.kin.motion.piecewise import Piecewise
from armlab.kin.paths.lts_434 import Lts
from armlab.kin.paths.polynomial import Rules, check_rules, rest_coefficients
from armlab.kin.paths.spline import Spline

Floats = NDArray[np.float64]

MOST_COEFFICIENTS = 8
"""Largest number of coefficients of a polynomial in a table."""

NEAR = 1e-9
"""Difference of a coefficient from a whole number, relative to the largest, up to which it is one."""


@dataclass(frozen=True, eq=False)
class SplineSolved:
    """The tridiagonal system of a spline (notes 6.93-6.95) and its solution.

    Attributes
    ----------
    matrix : ndarray, shape (n, n)
        A(h), seconds; without a unit in the first and last row of a natural spline.
    right : ndarray, shape (n,)
        b, in the unit of the coordinate.
    first : int
        Number (from 1) of the knot whose velocity is the first unknown.
    times, positions, velocities : ndarray, shape (K,)
        At all knots, with the virtual ones.
    virtual : tuple of int
        Numbers (from 1) of the virtual knots.
    conditions : tuple of (int, str)
        How many equations say what; they sum up to ``unknowns``.
    unknowns : int
        Coefficients.
    """

    matrix: Floats
    right: Floats
    first: int
    times: Floats
    positions: Floats
    velocities: Floats
    virtual: tuple[int, ...]
    conditions: tuple[tuple[int, str], ...]
    unknowns: int


@dataclass(frozen=True, eq=False)
class LtsSolved:
    """The 14 equations of lift-off, travel, set-down (notes 6.75-6.85).

    Attributes
    ----------
    names : tuple of str
    matrix : ndarray, shape (14, 14)
    right : ndarray, shape (14,)
    """

    names: tuple[str, ...]
    matrix: Floats
    right: Floats


@dataclass(frozen=True, eq=False)
class OnePolynomial:
    """One polynomial between two knots.

    Attributes
    ----------
    change : float
        Delta q = q_f - q_i.
    normalised : ndarray, shape (d+1,)
        a, b, c, ..., highest power of tau first, of (q - q_i) / Delta q (notes 6.164-6.182).
    in_tau : ndarray, shape (d+1,)
        Highest power first, of q itself.
    in_time : ndarray, shape (d+1,) or None
        Highest power of t (since the first knot) first; None where a law runs through the path.
    rules : Rules
        Of the normalised coefficients (list after 6.74).
    """

    change: float
    normalised: Floats
    in_tau: Floats
    in_time: Floats | None
    rules: Rules


@dataclass(frozen=True, eq=False)
class Pieces:
    """Polynomials piece by piece.

    Attributes
    ----------
    edges : ndarray, shape (k+1,)
        Seconds, or s where ``timed`` is false.
    coefficients : ndarray, shape (k, d+1)
        Rising powers of the argument since the beginning of the piece (notes 6.97).
    timed : bool
    """

    edges: Floats
    coefficients: Floats
    timed: bool


def spline_solved(path: Path) -> SplineSolved | None:
    """Return the system of a spline; None for another path."""
    if not isinstance(path, Spline):
        return None
    system, count = path.system, len(path.times)
    given = count - len(path.virtual)
    ends = 4 if path.virtual else 2
    conditions = (
        (given, "q at the knots"),
        (3 * (count - 2), "q, q̇, q̈ alike on both sides of inner knots"),
        (ends, "q̇ and q̈ at the ends" if path.virtual else "q̈ at the ends" if system.first == 1 else "q̇ at the ends"),
    )
    return SplineSolved(
        system.matrix,
        system.right[:, 0],
        system.first,
        path.times,
        path.positions[:, 0],
        path.velocities[:, 0],
        path.virtual,
        conditions,
        path.equations,
    )


def lts_solved(path: Path) -> LtsSolved | None:
    """Return the equations of lift-off, travel, set-down, or None for another path."""
    return LtsSolved(path.names, path.matrix, path.right[:, 0]) if isinstance(path, Lts) else None


def one_polynomial(made: Made) -> OnePolynomial | None:
    """Return the forms of a single polynomial between two knots, or None for another path, or a constant one."""
    path = made.trajectory.path
    change = made.knots[-1][1] - made.knots[0][1]
    if not isinstance(path, PolynomialPath) or len(path.pieces) or len(made.knots) != 2 or change == 0.0:
        return None
    rising = path.curve.coefficients[0, :, 0].copy()
    rising[0] -= made.knots[0][1]
    normalised = _cleaned(rising[::-1] / change)
    seconds = path.curve.local(made.trajectory.duration).coefficients[0, ::-1, 0]
    return OnePolynomial(
        change,
        normalised,
        path.curve.coefficients[0, ::-1, 0],
        _cleaned(seconds) if made.drawn.law.key == "constant" else None,
        check_rules(normalised, NEAR * max(1.0, float(np.abs(normalised).max()))),
    )


def pieces(made: Made) -> Pieces | None:
    """Return the polynomials of a path of pieces, or None for a path that is not made of short polynomials."""
    path = made.trajectory.path
    if not isinstance(path, PolynomialPath) or path.curve.degree >= MOST_COEFFICIENTS:
        return None
    timed = made.drawn.law.key == "constant"
    curve: Piecewise = path.curve.local(made.trajectory.duration) if timed else path.curve
    start = made.start if timed else 0.0
    return Pieces(start + curve.knots, np.stack([_cleaned(row) for row in curve.coefficients[:, :, 0]]), timed)


def _cleaned(values: Floats) -> Floats:
    """Return coefficients with the rounding errors of zeros removed."""
    return np.where(np.abs(values) < 1e-13 * np.abs(values).max(initial=0.0), 0.0, values) + 0.0


@dataclass(frozen=True)
class Normalised:
    """The doubly normalised polynomial from rest to rest of an odd degree.

    Attributes
    ----------
    coefficients : tuple of int
        Highest power first.
    rules : Rules
    peak_speed : float
        Largest derivative, of Delta q / T.
    """

    coefficients: tuple[int, ...]
    rules: Rules
    peak_speed: float


def normalised(degree: int) -> Normalised:
    """Return the normalised polynomial of a degree, whose speed is largest in the middle."""
    coefficients = rest_coefficients(degree)
    speed = np.polyval(np.polyder(np.array(coefficients, dtype=float)), 0.5)
    return Normalised(coefficients, check_rules(coefficients), float(speed))
