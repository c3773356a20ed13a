"""A trajectory: a path with a timing law, q(t) = q(s(t)), and motions made of several."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import whole_number, wrong
from armlab.kin.field import positive
from armlab.kin.motion.breaks import ORDERS, SMOOTH, classes, jumps, merged, snapped, stopped
from armlab.kin.motion.law import Law
from armlab.kin.motion.path import Path
from armlab.kin.motion.series import roots_inside, series_of

Floats = NDArray[np.float64]

OUTSIDE = 1e-9
"""Distance of a law outside [0, 1] that is rounding."""

SAME_PLACE = 1e-13
"""Largest difference of two s that are the same place."""

MOST_SAMPLES = 1_000_000

HALVINGS = 60
"""Number of halvings of a time interval: to the last digit."""


@dataclass(frozen=True, eq=False)
class Samples:
    """A motion at many times.

    Attributes
    ----------
    t : ndarray, shape (N,)
    q, qdot, qddot, qdddot : ndarray, shape (N, m)
        Position and derivatives with respect to time.
    """

    t: Floats
    q: Floats
    qdot: Floats
    qddot: Floats
    qdddot: Floats


class Motion(ABC):
    """Coordinates as functions of time.

    Attributes
    ----------
    m : int
    duration : float
        Seconds.
    pieces : ndarray, shape (k,)
        Interior times between which every derivative is smooth.
    degree : int or None
        Degree of the polynomials between them, if the motion consists of these.
    remarks : tuple of str
    """

    m: int
    duration: float
    pieces: Floats
    degree: int | None = None
    remarks: tuple[str, ...] = ()

    @abstractmethod
    def derivatives(self, t: ArrayLike, orders: Sequence[int] = ORDERS) -> list[Floats]:
        """Return several derivatives with respect to time, each (..., m); outside of [0, T] it stands still.

        Parameters
        ----------
        t : array_like, shape (...)
            Seconds.
        orders : sequence of int
            0 to 3.
        """

    @abstractmethod
    def limits_at(self, t: Floats, before: bool) -> list[Floats]:
        """Return derivatives of all orders from the left or from the right at ends of pieces, each (k, m)."""

    def at(self, t: ArrayLike, order: int = 0) -> Floats:
        """Return the derivative of an order with respect to time, (..., m) from t of shape (...)."""
        return self.derivatives(t, (order,))[0]

    @property
    def edges(self) -> Floats:
        """Times 0, ends of pieces, T."""
        return np.concatenate([[0.0], self.pieces, [self.duration]])

    @cached_property
    def _sides(self) -> tuple[list[Floats], list[Floats], Floats]:
        """Derivatives from the left and the right at the edges, and the lengths of the shorter neighbouring pieces."""
        places = self.edges
        left, right = (stopped(self.limits_at(places, before), before) for before in (True, False))
        lengths = np.diff(places)
        return left, right, np.minimum(np.append(lengths, np.inf), np.append(np.inf, lengths))

    @cached_property
    def _classes(self) -> Floats:
        return classes(*self._sides)

    def jumps(self, order: int) -> list[tuple[int, float]]:
        """Return the joints (from 1) of which a derivative jumps, and when, standstill before and after included.

        Parameters
        ----------
        order : int
            1: velocity, 2: acceleration.
        """
        found = jumps(*self._sides)[order]
        return [(int(j) + 1, float(self.edges[k])) for k, j in np.argwhere(found)]

    @property
    def breaks(self) -> Floats:
        """Interior times where a derivative of order 1 to 3 jumps, shape (b,)."""
        return self.pieces[self._classes[1:-1] < SMOOTH]

    @property
    def continuity(self) -> float:
        """The class inside (0, T): 0 for C0, 1, 2, 3 for C3 or smoother."""
        return float(self._classes[1:-1].min(initial=SMOOTH))

    @property
    def continuity_from_rest(self) -> float:
        """The class with rest before and after: 0 if a velocity jumps at an end."""
        return float(self._classes.min())

    def sample(self, count: int | None = None, rate: float | None = None) -> Samples:
        """Return the motion at evenly spaced times, both ends included.

        Parameters
        ----------
        count : int, optional
            Number of samples, at least 2.
        rate : float, optional
            Samples a second, at least; one of the two is given.

        Raises
        ------
        InputError
            Both or none given, or more than a million samples.
        """
        if (count is None) == (rate is None):
            raise InputError("sample: give either the number of samples or the rate")
        if count is None:
            count = int(np.ceil(self.duration * positive(rate, "rate") * (1.0 - 1e-12))) + 1
        if whole_number(count, "count", 2) > MOST_SAMPLES:
            raise InputError(f"count: at most {MOST_SAMPLES} samples, got {count}")
        t = np.linspace(0.0, self.duration, count)
        return Samples(t, *self.derivatives(t))


class Trajectory(Motion):
    """A path run through by a law.

    Parameters
    ----------
    path : Path
    law : Law
        A law from 0 to 1.

    Raises
    ------
    InputError
        The law leaves [0, 1], or does not end in 1.

    References
    ----------
    Notes 6.1-6.4 and 6.18-6.19.
    """

    def __init__(self, path: Path, law: Law) -> None:
        low, high = law.span
        if low < -OUTSIDE or high > 1.0 + OUTSIDE:
            raise InputError(
                f"law: s must stay from 0 to 1 along a path, and goes from {round(low, 6):g} to {round(high, 6):g}"
            )
        if abs(law.distance - 1.0) > OUTSIDE:
            raise wrong("law", "one that ends at s = 1", law.distance)
        self.path, self.law, self.m, self.duration = path, law, path.m, law.duration
        self.degree = None if path.degree is None or law.degree is None else path.degree * law.degree
        self.remarks = (*path.remarks, *law.remarks)

    @cached_property
    def pieces(self) -> Floats:  # type: ignore[override]
        """Interior times of the law, and times at which s passes the end of a piece of the path."""
        return merged([self.law.pieces, times_at(self.law, self.path.pieces)], 0.0, self.duration)

    def derivatives(self, t: ArrayLike, orders: Sequence[int] = ORDERS) -> list[Floats]:
        """Return derivatives with respect to time by the chain rule; see `Motion.derivatives`."""
        if not set(orders) <= set(ORDERS):
            raise wrong("order", "0, 1, 2 or 3", orders)
        times = np.asarray(t, dtype=float)
        s = self.law.derivatives(times, range(max(orders, default=0) + 1))
        wanted = self._wanted(orders)
        q = dict(zip(wanted, self.path.derivatives(s[0], wanted), strict=True))
        return [in_time(q, s, order, (*times.shape, self.m)) for order in orders]

    def _wanted(self, orders: Sequence[int]) -> list[int]:
        """Return the orders of path derivatives that are needed: above the degree of a polynomial they are zero."""
        most = max(orders, default=0)
        flat = most if self.path.degree is None else min(most, self.path.degree)
        return [order for order in range(flat + 1) if order > 0 or 0 in orders]

    def limits_at(self, t: Floats, before: bool) -> list[Floats]:
        """Return derivatives from one side; see `Motion.limits_at`."""
        s = self.law.derivatives(t, before=before)
        place = snapped(s[0], self.path.edges, OUTSIDE)
        sides = [self.path.derivatives(place, before=side) for side in (False, True)]
        from_left = (s[1] < 0.0) != before
        q = {k: np.where(from_left[:, None], left, right) for k, (right, left) in enumerate(zip(*sides, strict=True))}
        return [in_time(q, s, order, (len(t), self.m)) for order in ORDERS]


def times_at(law: Law, places: Floats) -> Floats:
    """Return the times, sorted, at which a law passes places between 0 and 1, shape (k,)."""
    if len(places) == 0:
        return np.zeros(0)
    if law.monotone:
        low, high = np.zeros(len(places)), np.full(len(places), law.duration)
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            short = law.at(middle) < places
            low, high = np.where(short, middle, low), np.where(short, high, middle)
        return _snapped(law, places, high)
    series = series_of(lambda t: law.at(t)[:, None], law.edges, law.degree)
    found = []
    for (start, end), terms in zip(series.edges, series.coefficients[:, :, 0], strict=True):
        for place in places:
            shifted = terms.copy()
            shifted[0] -= place
            found.append(start + (end - start) * (0.5 + 0.5 * roots_inside(shifted)))
    return np.sort(np.concatenate(found))


def _snapped(law: Law, places: Floats, times: Floats) -> Floats:
    """Return times, with those near the end of a piece of the law moved there: where s rests it gives no time."""
    if len(law.pieces) == 0:
        return times
    passed = law.at(law.pieces)
    k = np.clip(np.searchsorted(passed, places), 1, max(len(passed) - 1, 1))
    before, after = np.minimum(k - 1, len(passed) - 1), np.minimum(k, len(passed) - 1)
    near = np.where(np.abs(passed[before] - places) < np.abs(passed[after] - places), before, after)
    return np.where(np.abs(passed[near] - places) <= SAME_PLACE, law.pieces[near], times)


def in_time(q: dict[int, Floats], s: Sequence[Floats], order: int, shape: tuple[int, ...]) -> Floats:
    """Return a derivative of q(s(t)) with respect to t.

    Parameters
    ----------
    q : dict of ndarray, shape (..., m)
        Derivatives with respect to s by order; those left out are zero.
    s : sequence of ndarray, shape (...)
        Derivatives of s with respect to t, from order 0.
    order : int
        0 to 3.
    shape : tuple of int
        Shape of the result.

    References
    ----------
    Notes 6.18-6.19; for the third: q''' s'^3 + 3 q'' s' s'' + q' s'''.
    """
    if order == 0:
        return q[0]
    total: Floats | None = None
    for k, factor in _factors(s, order, set(q)):
        # One coordinate after the other: long rows are several times as fast as many short ones.
        term = np.moveaxis(q[k], -1, 0) * factor
        total = term if total is None else np.add(total, term, out=total)
    return np.zeros(shape) if total is None else np.moveaxis(total, 0, -1)


def _factors(s: Sequence[Floats], order: int, known: set[int]) -> list[tuple[int, Floats]]:
    """Return the orders of path derivatives and the factors with which they enter, by the chain rule."""
    if order == 1:
        every = [(1, s[1])]
    elif order == 2:
        every = [(1, s[2])] + ([(2, s[1] ** 2)] if 2 in known else [])
    else:
        every = (
            [(1, s[3])] + ([(2, 3.0 * s[1] * s[2])] if 2 in known else []) + ([(3, s[1] ** 3)] if 3 in known else [])
        )
    return [(k, factor) for k, factor in every if k in known]
