"""Motions in sequence, side by side, slowed down, and none at all for a while."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.field import positive
from armlab.kin.motion.breaks import ORDERS, merged, snapped
from armlab.kin.motion.law import Law
from armlab.kin.motion.trajectory import Motion, in_time

Floats = NDArray[np.float64]

GAP = 1e-9
"""Largest difference, rad or m, between the end of a motion and the beginning of the next."""


class Sequential(Motion):
    """Motions one after the other, such as the sides of a square with a stop at each corner.

    Parameters
    ----------
    motions : sequence of Motion
        Each begins where the one before ends.

    Raises
    ------
    InputError
        None, different numbers of coordinates, or a gap; the text counts the motions from 1.
    """

    def __init__(self, motions: Sequence[Motion]) -> None:
        if not motions:
            raise InputError("motions: expected at least one")
        self.motions, self.m = tuple(motions), motions[0].m
        for k, motion in enumerate(motions[1:]):
            if motion.m != self.m:
                raise InputError(f"motion {k + 2}: expected {self.m} coordinates as in motion 1, got {motion.m}")
            gap = float(np.abs(motion.at(0.0) - motions[k].at(motions[k].duration)).max())
            if gap > GAP:
                raise InputError(f"motion {k + 2}: begins {gap:.3g} from where motion {k + 1} ends")
        self.starts = np.concatenate([[0.0], np.cumsum([motion.duration for motion in motions])])
        self.duration = float(self.starts[-1])
        degrees = [motion.degree for motion in motions]
        self.degree = None if None in degrees else max(degree for degree in degrees if degree is not None)
        self.remarks = tuple(dict.fromkeys(remark for motion in motions for remark in motion.remarks))

    @cached_property
    def pieces(self) -> Floats:  # type: ignore[override]
        """Interior times of all motions, and the times between two motions."""
        inner = [start + motion.pieces for start, motion in zip(self.starts, self.motions, strict=False)]
        return merged([*inner, self.starts[1:-1]], 0.0, self.duration)

    def derivatives(self, t: ArrayLike, orders: Sequence[int] = ORDERS) -> list[Floats]:
        """Return derivatives of the motion that runs at each time; see `Motion.derivatives`."""
        times = np.asarray(t, dtype=float)
        flat = times.reshape(-1)
        index = np.searchsorted(self.starts[1:-1], flat, side="right")
        found = [np.empty((flat.size, self.m)) for _ in orders]
        for k in np.unique(index):
            at, motion = index == k, self.motions[k]
            local = _until_end(motion, flat[at] - self.starts[k], flat[at] <= self.duration)
            for out, values in zip(found, motion.derivatives(local, orders), strict=True):
                out[at] = values
        return [values.reshape(*times.shape, self.m) for values in found]

    def limits_at(self, t: Floats, before: bool) -> list[Floats]:
        """Return derivatives from one side; see `Motion.limits_at`."""
        # Rounding must not decide in which of two motions their common end is.
        nudge = -GAP if before else GAP
        index = np.searchsorted(self.starts[1:-1], t + nudge * self.duration, side="right")
        found = [np.empty((len(t), self.m)) for _ in ORDERS]
        for k in np.unique(index):
            at, motion = index == k, self.motions[k]
            local = snapped(t[at] - self.starts[k], motion.edges, GAP * self.duration)
            for out, values in zip(found, motion.limits_at(local, before), strict=True):
                out[at] = values
        return found


class Hold(Motion):
    """Rest at one place for a while, such as a wait between two motions in sequence.

    Parameters
    ----------
    q : array_like, shape (m,)
        The coordinates.
    duration : float
        Seconds, more than 0.
    """

    degree = 0

    def __init__(self, q: ArrayLike, duration: float) -> None:
        self.q, self.duration = np.array(q, dtype=float), positive(duration, "duration")
        self.m, self.pieces = len(self.q), np.zeros(0)

    def derivatives(self, t: ArrayLike, orders: Sequence[int] = ORDERS) -> list[Floats]:
        """Return the place, and zeros for its derivatives; see `Motion.derivatives`."""
        shape = (*np.shape(t), self.m)
        return [np.broadcast_to(self.q, shape).copy() if order == 0 else np.zeros(shape) for order in orders]

    def limits_at(self, t: Floats, before: bool) -> list[Floats]:
        """Return the same from either side; see `Motion.limits_at`."""
        return self.derivatives(t)


class Separate(Motion):
    """Each coordinate with its own law from one value to another; those that are there first wait.

    Parameters
    ----------
    start, end : ndarray, shape (m,)
    laws : sequence of m laws from 0 to 1, or None for a coordinate that does not move
    """

    def __init__(self, start: Floats, end: Floats, laws: Sequence[Law | None]) -> None:
        self.start, self.change, self.laws = start, end - start, tuple(laws)
        self.m = len(start)
        moving = [law for law in laws if law is not None]
        if not moving:
            raise InputError("end: the same as the start, nothing moves")
        self.duration = max(law.duration for law in moving)
        degrees = [law.degree for law in moving]
        self.degree = None if None in degrees else max(degree for degree in degrees if degree is not None)

    @cached_property
    def pieces(self) -> Floats:  # type: ignore[override]
        """Interior times of all laws, and the times at which one ends."""
        return merged([law.edges for law in self.laws if law is not None], 0.0, self.duration)

    def derivatives(self, t: ArrayLike, orders: Sequence[int] = ORDERS) -> list[Floats]:
        """Return derivatives of all coordinates; see `Motion.derivatives`."""
        times = np.asarray(t, dtype=float)
        return self._assembled(
            times, orders, [None if law is None else law.derivatives(times, orders) for law in self.laws]
        )

    def limits_at(self, t: Floats, before: bool) -> list[Floats]:
        """Return derivatives from one side; see `Motion.limits_at`."""
        return self._assembled(t, ORDERS, [None if law is None else self._sided(law, t, before) for law in self.laws])

    def _sided(self, law: Law, t: Floats, before: bool) -> list[Floats]:
        slack = GAP * self.duration
        values = law.derivatives(snapped(t, law.edges, slack), before=before)
        # A law that ends earlier: at its end it still moves from the left, and stands still from the right.
        over = (t > law.duration + slack) if before else (t > law.duration - slack)
        over &= law.duration < self.duration - slack
        return [np.where(over & (order > 0), 0.0, value) for order, value in enumerate(values)]

    def _assembled(self, times: Floats, orders: Sequence[int], columns: Sequence[list[Floats] | None]) -> list[Floats]:
        found = [np.zeros((*times.shape, self.m)) for _ in orders]
        for j, column in enumerate(columns):
            for k, order in enumerate(orders):
                moved = self.change[j] * column[k] if column is not None else 0.0
                found[k][..., j] = moved + self.start[j] if order == 0 else moved
        return found


class Slowed(Motion):
    """The same motion slowed down by the factor k: r = k t.

    References
    ----------
    Notes 6.156-6.160. The last prints the velocity for the acceleration: the acceleration is divided by k^2.
    """

    def __init__(self, motion: Motion, k: float) -> None:
        self.motion, self.k = motion, positive(k, "k")
        self.m, self.duration, self.degree = motion.m, motion.duration * self.k, motion.degree
        self.remarks = motion.remarks

    @property
    def pieces(self) -> Floats:  # type: ignore[override]
        """Interior times of the motion, multiplied by k."""
        return self.motion.pieces * self.k

    def derivatives(self, t: ArrayLike, orders: Sequence[int] = ORDERS) -> list[Floats]:
        """Return derivatives, those of order i divided by k^i; see `Motion.derivatives`."""
        times = np.asarray(t, dtype=float)
        found = self.motion.derivatives(_until_end(self.motion, times / self.k, times <= self.duration), orders)
        return [values / self.k**order for order, values in zip(orders, found, strict=True)]

    def limits_at(self, t: Floats, before: bool) -> list[Floats]:
        """Return derivatives from one side; see `Motion.limits_at`."""
        local = snapped(t / self.k, self.motion.edges, GAP * self.motion.duration)
        found = self.motion.limits_at(local, before)
        return [values / self.k**order for order, values in enumerate(found)]


def _until_end(motion: Motion, t: Floats, within: NDArray[np.bool_]) -> Floats:
    """Return times of a motion with rounding beyond its end removed where they are within the whole."""
    return np.where(within, np.minimum(t, motion.duration), t)


def chained(q: Sequence[Floats], s: Sequence[Floats]) -> list[Floats]:
    """Return derivatives of orders 0 to 3 of q(s(x)) from those of q (..., m) and of s (...)."""
    every = dict(enumerate(q))
    return [in_time(every, s, order, q[0].shape) for order in ORDERS]
