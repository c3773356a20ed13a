"""Geometric paths: a curve q(s) or p(s) over s in [0, 1], with derivatives with respect to s.

A path has no time. Together with a timing law s(t) it is a trajectory (notes 6.1-6.4; `armlab.kin.motion.trajectory`).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.checks import wrong
from armlab.kin.motion.breaks import ORDERS, SMOOTH, classes
from armlab.kin.motion.piecewise import Piecewise

Floats = NDArray[np.float64]

OUTSIDE = 1e-9
"""Distance of s outside [0, 1] that is rounding."""


class Path(ABC):
    """A curve over s in [0, 1].

    Attributes
    ----------
    m : int
        Number of coordinates: joints, or 2 or 3 in space.
    pieces : ndarray, shape (k,)
        Interior s where one formula ends and the next begins.
    degree : int or None
        Degree of the polynomials between them, if the path consists of these.
    duration : float or None
        Seconds the path was made for, where its waypoints have times: with s = t / duration it meets them.
    remarks : tuple of str
        Remarks for students on this path.
    """

    m: int
    pieces: Floats
    degree: int | None = None
    duration: float | None = None
    remarks: tuple[str, ...] = ()

    def remarks_in(self, unit: str, size: float) -> tuple[str, ...]:
        """Return the remarks where the unit of all coordinates is known.

        Parameters
        ----------
        unit : str
            Such as ``"mm"``.
        size : float
            Size of the unit in units of the coordinates.
        """
        return self.remarks

    @abstractmethod
    def _values(self, s: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        """Return derivatives (..., m) at s in [0, 1]; with ``before`` from the left at the ends of pieces."""

    def derivatives(self, s: ArrayLike, orders: Sequence[int] = ORDERS, *, before: bool = False) -> list[Floats]:
        """Return several derivatives with respect to s at once, each (..., m).

        Parameters
        ----------
        s : array_like, shape (...)
            Parameters in [0, 1].
        orders : sequence of int
            0 to 3.
        before : bool
            Whether to return the value before a jump of a derivative, instead of the one after it.

        Raises
        ------
        InputError
            An s outside of [0, 1], or not a number; another order.
        """
        if not set(orders) <= set(ORDERS):
            raise wrong("order", "0, 1, 2 or 3", orders)
        values = np.asarray(s, dtype=float)
        if values.size and not (values.min() >= -OUTSIDE and values.max() <= 1.0 + OUTSIDE):
            raise wrong("s", "numbers from 0 to 1", s)
        return self._values(np.clip(values, 0.0, 1.0), orders, before)

    def at(self, s: ArrayLike, order: int = 0) -> Floats:
        """Return the derivative of an order with respect to s, (..., m) from s of shape (...)."""
        return self.derivatives(s, (order,))[0]

    @cached_property
    def _classes(self) -> Floats:
        if len(self.pieces) == 0:
            return np.zeros(0)
        left = self._values(self.pieces, ORDERS, True)
        right = self._values(self.pieces, ORDERS, False)
        lengths = np.diff(np.concatenate([[0.0], self.pieces, [1.0]]))
        return classes(left, right, np.minimum(lengths[:-1], lengths[1:]))

    @property
    def breaks(self) -> Floats:
        """Interior s where a derivative of order 1 to 3 jumps, shape (b,)."""
        return self.pieces[self._classes < SMOOTH]

    @property
    def corners(self) -> Floats:
        """Interior s at which the first derivative jumps, shape (c,)."""
        return self.pieces[self._classes < 1.0]

    @property
    def continuity(self) -> float:
        """The class of the whole path: 0 for C0, 1 for C1, 2 for C2, 3 for C3 or smoother."""
        return float(self._classes.min(initial=SMOOTH))

    @property
    def edges(self) -> Floats:
        """Parameters 0, ends of pieces, 1."""
        return np.concatenate([[0.0], self.pieces, [1.0]])


class PolynomialPath(Path):
    """A path of polynomials in s.

    Parameters
    ----------
    curve : Piecewise
        Its first knot is s = 0 and its last s = 1.
    duration : float, optional
    remarks : sequence of str
    """

    def __init__(self, curve: Piecewise, duration: float | None = None, remarks: Sequence[str] = ()) -> None:
        self.curve, self.duration, self.remarks = curve, duration, tuple(remarks)
        self.m, self.degree = curve.coefficients.shape[2], curve.degree
        self.pieces = curve.knots[1:-1]

    def _values(self, s: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        return self.curve.at(s, orders, before)

    @property
    def in_time(self) -> Piecewise:
        """The same polynomials over t in [0, duration], or over s without a duration: the a_ki of the notes 6.97."""
        return self.curve.local(self.duration or 1.0)


def timed(curve: Piecewise, remarks: Sequence[str] = ()) -> PolynomialPath:
    """Return the path of a function of time between its first and last knot: s = (t - t_1) / T."""
    duration = float(curve.knots[-1] - curve.knots[0])
    knots = (curve.knots - curve.knots[0]) / duration
    knots[-1] = 1.0
    scales = duration ** np.arange(curve.degree + 1.0)
    return PolynomialPath(Piecewise(knots, curve.coefficients * scales[:, None]), duration, remarks)
