"""Timing laws: s(t) from 0 to a distance in a duration, with derivatives with respect to t.

Before it begins and after it ends s stands still: outside of [0, T] derivatives are zero. Inside and at both ends they
are those of the law, so a law that starts with a jump of the acceleration shows it (notes 6.183: a cubic law is C1
only).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.checks import wrong
from armlab.kin.field import positive
from armlab.kin.motion.breaks import ORDERS, SMOOTH, classes, stopped
from armlab.kin.motion.extremes import Extremes, extremes
from armlab.kin.motion.piecewise import Piecewise

Floats = NDArray[np.float64]

BACKWARDS = 1e-9
"""Negative speed, relative to the peak speed, that is rounding."""


class Law(ABC):
    """A timing law.

    Attributes
    ----------
    duration : float
        T, seconds.
    pieces : ndarray, shape (k,)
        Interior times where one formula ends and the next begins.
    degree : int or None
        Degree of the polynomials between them, if the law consists of these.
    remarks : tuple of str
    """

    duration: float
    pieces: Floats
    degree: int | None = None
    remarks: tuple[str, ...] = ()

    @abstractmethod
    def _values(self, t: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        """Return derivatives (...) at t in [0, T]."""

    @abstractmethod
    def stretched(self, k: float) -> Law:
        """Return the same law slowed down by the factor k: r = k t (notes 6.156)."""

    def derivatives(self, t: ArrayLike, orders: Sequence[int] = ORDERS, *, before: bool = False) -> list[Floats]:
        """Return several derivatives with respect to t at once, each (...) like t.

        Parameters
        ----------
        t : array_like, shape (...)
            Seconds; outside of [0, T] s stands still.
        orders : sequence of int
            0 to 3.
        before : bool
            Whether to return the value before a jump of a derivative.

        Raises
        ------
        InputError
            A time that is not a number, or another order.
        """
        if not set(orders) <= set(ORDERS):
            raise wrong("order", "0, 1, 2 or 3", orders)
        times = np.asarray(t, dtype=float)
        if np.isnan(times).any():
            raise wrong("t", "numbers", t)
        inside = np.clip(times, 0.0, self.duration)
        found = self._values(inside, orders, before)
        still = inside != times
        if still.any():
            found = [np.where(still & (order > 0), 0.0, values) for order, values in zip(orders, found, strict=True)]
        return found

    def at(self, t: ArrayLike, order: int = 0) -> Floats:
        """Return the derivative of an order with respect to t, (...) from t of shape (...)."""
        return self.derivatives(t, (order,))[0]

    @cached_property
    def _classes(self) -> Floats:
        """Classes of continuity at 0, at the ends of pieces and at T."""
        places = self.edges
        left, right = (
            stopped([values[:, None] for values in self._values(places, ORDERS, before)], before)
            for before in (True, False)
        )
        lengths = np.diff(places)
        shorter = np.minimum(np.append(lengths, np.inf), np.append(np.inf, lengths))
        return classes(left, right, shorter)

    @property
    def edges(self) -> Floats:
        """Times 0, ends of pieces, T."""
        return np.concatenate([[0.0], self.pieces, [self.duration]])

    @property
    def breaks(self) -> Floats:
        """Interior times where a derivative of order 1 to 3 jumps, shape (b,)."""
        return self.pieces[self._classes[1:-1] < SMOOTH]

    @property
    def continuity(self) -> float:
        """The class inside (0, T): 1 for C1, 2 for C2, 3 for C3 or smoother."""
        return float(self._classes[1:-1].min(initial=SMOOTH))

    @property
    def continuity_from_rest(self) -> float:
        """The class of the whole motion with rest before and after it: 0 if the speed jumps at an end."""
        return self.continuity_with((False, False))

    def continuity_with(self, moving: tuple[bool, bool]) -> float:
        """Return the class of the motion with rest before and after it, without the ends at which it is to move.

        Parameters
        ----------
        moving : (bool, bool)
            Whether it begins, and whether it ends with a speed; what jumps at such an end does not count.
        """
        begin, end = (int(moves) for moves in moving)
        return float(self._classes[begin : len(self._classes) - end].min(initial=SMOOTH))

    def _extremes(self, order: int) -> Extremes:
        degree = None if self.degree is None else max(self.degree - order, 0)
        return extremes(lambda t: self._values(t, (order,), False)[0][:, None], self.edges, degree)

    @cached_property
    def _range(self) -> Extremes:
        return self._extremes(0)

    @cached_property
    def _speeds(self) -> Extremes:
        return self._extremes(1)

    @property
    def span(self) -> tuple[float, float]:
        """The smallest and the largest s."""
        return float(self._range.lowest[0]), float(self._range.highest[0])

    @property
    def distance(self) -> float:
        """The value of s at the end, 1 or a length."""
        return float(self.at(self.duration))

    @property
    def peak_speed(self) -> float:
        """The largest |s'|, exact."""
        return float(self._speeds.peak[0])

    @cached_property
    def peak_acceleration(self) -> float:
        """The largest |s''|, exact."""
        return float(self._extremes(2).peak[0])

    @cached_property
    def peak_jerk(self) -> float:
        """The largest |s'''| between jumps of the acceleration, exact."""
        return float(self._extremes(3).peak[0])

    @property
    def monotone(self) -> bool:
        """Whether s never decreases."""
        return float(self._speeds.lowest[0]) >= -BACKWARDS * self.peak_speed


class PolynomialLaw(Law):
    """A law of polynomials in t.

    Parameters
    ----------
    curve : Piecewise
        One component; its first knot is t = 0.
    remarks : sequence of str
    """

    def __init__(self, curve: Piecewise, remarks: Sequence[str] = ()) -> None:
        self.curve, self.remarks = curve, tuple(remarks)
        self.duration, self.pieces, self.degree = float(curve.knots[-1]), curve.knots[1:-1], curve.degree

    def _values(self, t: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        return [values[..., 0] for values in self.curve.at(t, orders, before)]

    def stretched(self, k: float) -> PolynomialLaw:
        """Return the same law slowed down by the factor k."""
        return PolynomialLaw(self.curve.local(positive(k, "k")), self.remarks)
