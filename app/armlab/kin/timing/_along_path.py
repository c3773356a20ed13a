"""The limits of joints along a path, as bounds on the squared speed of s on a grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.kin.motion.limits import Limits
from armlab.kin.motion.path import Path
from armlab.kin.timing._phase_plane import Bands, tops

Floats = NDArray[np.float64]

LOOKED = 5
"""Number of Chebyshev points in a step at which limits are examined, ends and middle included."""

KEPT = (0, LOOKED // 2, LOOKED - 1)
"""Indices of the points at which limits are enforced: both ends and the middle. Up to the third power of the step, an
acceleration is a parabola through these."""

BESIDE = 2.0
"""Factor from the deviation from that parabola at the points to the largest one between them; for a cubic it is 1.1."""

LEAST_STEPS = 4
"""Least number of steps on each piece of the path."""

HALVED = 8
"""Largest number of times that a step beside a place of rest is halved, so that a ramp much shorter than a step costs
no more than its own time; together these are at most as many as all other steps."""

STANDS = 1e-12
"""Value of dq/ds, relative to the largest, below which it is rounding."""


@dataclass(frozen=True, eq=False)
class Grid:
    """A path on a grid.

    Attributes
    ----------
    s : ndarray, shape (N+1,)
    h : ndarray, shape (N,)
        Steps.
    places : ndarray, shape (LOOKED,)
        Parts of a step at which it is looked at.
    first, second : ndarray, shape (N, LOOKED, m)
        dq/ds in parts of the limit of velocity, and of that of acceleration; see ``bend``.
    bend : ndarray, shape (N, LOOKED, m)
        d²q/ds² in parts of the limit of acceleration.
    stops : ndarray of bool, shape (N+1,)
        Grid points at which s must stand still.
    still : (bool, bool)
        Whether dq/ds is zero at the start and at the end, so that any speed of s is rest there.
    """

    s: Floats
    h: Floats
    places: Floats
    first: Floats
    second: Floats
    bend: Floats
    stops: NDArray[np.bool_]
    still: tuple[bool, bool]

    def bands(self, tight: Floats) -> Bands:
        """Return the limits as bands, tightened by a factor for each step, (N,)."""
        t, h = self.places[list(KEPT)][:, None], 2.0 * self.h[:, None, None]
        kept = np.array(KEPT)
        push, bend = self.second[:, kept] / h, self.bend[:, kept]
        # The acceleration at t of a step: push (y - x) + bend ((1 - t) x + t y).
        of_x, of_y = bend * (1.0 - t) - push, bend * t + push
        fast = (self.first[:, kept] ** 2).max(axis=2)
        N = len(self.h)
        A = np.concatenate([of_x.reshape(N, -1), fast * (1.0 - t[:, 0])], axis=1) * tight[:, None]
        B = np.concatenate([of_y.reshape(N, -1), fast * t[:, 0]], axis=1) * tight[:, None]
        return Bands(A, B)

    def most_at_end(self, bands: Bands) -> float:
        """Return the largest squared speed allowed at the end."""
        return float(tops(Bands(bands.B[-1:], bands.A[-1:]))[0][0])

    def used(self, x: Floats) -> Floats:
        """Return the largest used fraction of a limit in each step, (N,): of acceleration, or of squared velocity."""
        u = (np.diff(x) / (2.0 * self.h))[:, None, None]
        between = x[:-1, None] + np.diff(x)[:, None] * self.places
        acceleration = self.second * u + self.bend * between[:, :, None]
        square = self.first**2 * between[:, :, None]
        return np.asarray(np.maximum(_largest(acceleration, self.places), _largest(square, self.places)))


def _largest(values: Floats, places: Floats) -> Floats:
    """Return the largest absolute value of (N, LOOKED, m) over each step, (N,), also between the points."""
    start, middle, end = (values[:, k] for k in KEPT)
    slope, bend = 4.0 * middle - 3.0 * start - end, 2.0 * (start + end) - 4.0 * middle
    t = places[:, None]
    beside = np.abs(values - (start[:, None] + t * slope[:, None] + t * t * bend[:, None])).max(axis=1)
    turns = np.abs(slope + bend) < np.abs(bend)
    top = np.where(turns, start - slope * slope / (4.0 * np.where(turns, bend, 1.0)), start)
    most = np.maximum(np.maximum(np.abs(start), np.abs(end)), np.abs(top))
    return np.asarray((most + BESIDE * beside).max(axis=1))


def _finer_beside(s: Floats, rests: Floats) -> Floats:
    """Return grid points with more of them, the nearer the denser, in the steps beside places of rest."""
    count = min(HALVED, len(s) // (2 * max(len(rests), 1)))
    at, steps, parts = np.flatnonzero(np.isin(s, rests)), np.diff(s), 0.5 ** np.arange(1.0, count + 1.0)
    before = [s[k] - steps[k - 1] * parts for k in at if k > 0]
    after = [s[k] + steps[k] * parts for k in at if k < len(steps)]
    return np.unique(np.concatenate([s, *before, *after]))


def grid_of(path: Path, limits: Limits, steps: int) -> Grid:
    """Return a path on a grid of about ``steps`` even steps and finer ones beside places of rest.

    The ends of its pieces are among the grid points.
    """
    edges = path.edges
    lengths = np.diff(edges)
    least = LEAST_STEPS if LEAST_STEPS * len(lengths) <= 2 * steps else 2
    counts = np.maximum(np.ceil(steps * lengths).astype(int), least)
    parts = [a + (b - a) * np.arange(n) / n for a, b, n in zip(edges[:-1], edges[1:], counts, strict=True)]
    even = np.append(np.concatenate(parts), 1.0)
    slopes = np.abs(path.at(even, 1)).max(axis=1)
    still = slopes[[0, -1]] <= STANDS * slopes.max()
    s = _finer_beside(even, np.concatenate([np.array([0.0, 1.0])[~still], path.corners]))
    h = np.diff(s)
    places = 0.5 - 0.5 * np.cos(np.pi * np.arange(LOOKED) / (LOOKED - 1))
    at = s[:-1, None] + h[:, None] * places
    at[:, -1] = s[1:]
    first, second = (np.array(values) for values in path.derivatives(at, (1, 2)))
    for values, end in zip((first, second), path.derivatives(s[1:], (1, 2), before=True), strict=True):
        values[:, -1] = end
    return Grid(
        s,
        h,
        places,
        first / limits.velocity,
        first / limits.acceleration,
        second / limits.acceleration,
        np.isin(s, path.corners),
        (bool(still[0]), bool(still[1])),
    )
