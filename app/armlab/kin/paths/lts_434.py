"""Lift-off, travel, set-down: polynomials of degree 4, 3, 4 for pick and place."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.motion.knots import TIMES, knot_times
from armlab.kin.motion.path import PolynomialPath, timed
from armlab.kin.motion.path_types import PathType
from armlab.kin.motion.piecewise import Piecewise

Floats = NDArray[np.float64]

DEGREES = (4, 3, 4)
FIRST = (0, 5, 9)
"""Index of the first coefficient of each polynomial among the 14."""


class Lts(PolynomialPath):
    """The three polynomials, with the equations they come from.

    Attributes
    ----------
    matrix : ndarray, shape (14, 14)
        Matrix of the coefficients, in rising powers of the local time of each polynomial, one after the other.
    right : ndarray, shape (14, m)
    names : tuple of str
        Description of each equation.
    """

    def __init__(
        self, curve: Piecewise, duration: float, matrix: Floats, right: Floats, names: tuple[str, ...]
    ) -> None:
        super().__init__(curve, duration)
        self.matrix, self.right, self.names = matrix, right, names


def make(knots: Floats, options: dict[str, Any]) -> Lts:
    """Return the path through four waypoints, from rest to rest with zero acceleration at both ends.

    Six conditions of position and rest at the ends, four of passing the inner waypoints, four of continuity up to
    acceleration: 14 equations for 5 + 4 + 5 coefficients.

    References
    ----------
    Notes 6.75-6.85. Equations 6.79-6.80 print a higher derivative at the end; both velocity and acceleration vanish
    there.
    """
    times = knot_times(knots, options)
    h = np.diff(times)
    rows: list[tuple[str, Floats, Floats]] = []
    zero = np.zeros(knots.shape[1])

    def add(name: str, row: Floats, right: Floats) -> None:
        rows.append((name, row, right))

    for order, symbol in enumerate(("q", "q̇", "q̈")):
        add(f"{symbol}(t_i)", _row(0, 0.0, order), knots[0] if order == 0 else zero)
    for k in (0, 1):
        add(f"q(t_{k + 1}⁻)", _row(k, h[k], 0), knots[k + 1])
        add(f"q(t_{k + 1}⁺)", _row(k + 1, 0.0, 0), knots[k + 1])
        for order, symbol in ((1, "q̇"), (2, "q̈")):
            add(f"{symbol} continuous at t_{k + 1}", _row(k, h[k], order) - _row(k + 1, 0.0, order), zero)
    for order, symbol in enumerate(("q", "q̇", "q̈")):
        add(f"{symbol}(t_f)", _row(2, h[2], order), knots[3] if order == 0 else zero)
    matrix, right = np.array([row for _, row, _ in rows]), np.array([value for _, _, value in rows])
    found = np.linalg.solve(matrix, right)
    coefficients = np.zeros((3, 5, knots.shape[1]))
    for piece, (first, degree) in enumerate(zip(FIRST, DEGREES, strict=True)):
        coefficients[piece, : degree + 1] = found[first : first + degree + 1]
    path = timed(Piecewise(times, coefficients))
    return Lts(path.curve, float(times[-1] - times[0]), matrix, right, tuple(name for name, _, _ in rows))


def _row(piece: int, t: float, order: int) -> Floats:
    """Return the row of a derivative of one polynomial at its local time."""
    row = np.zeros(14)
    for power in range(order, DEGREES[piece] + 1):
        row[FIRST[piece] + power] = math.perm(power, order) * t ** (power - order)
    return row


PATH = PathType(
    "lts_434",
    "Lift-off, travel, set-down (4-3-4)",
    9,
    make,
    least=4,
    most=4,
    fields=TIMES,
    apart=False,
    formula=r"X_j(s)=\sum_{k=0}^{n_j}a_{jk}(s-s_j)^k",
    says="Degrees 4, 3, 4: lift-off, travel, set-down.",
)
