"""The geometry of a curve, independent of its parameter: length, direction, curvature, torsion, the Frenet frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.motion.extremes import extremes_of_series
from armlab.kin.motion.path import Path
from armlab.kin.motion.sequence import chained
from armlab.kin.motion.series import roots_inside, series_of

Floats = NDArray[np.float64]

STANDS = 1e-9
"""Size of p', relative to its largest value on the path, below which it counts as zero."""

STRAIGHT = 1e-9
"""Curvature, relative to 1 / length of the path, below which it counts as zero: the normal would be rounding."""

ZERO_SQUARE = 1e-14
"""Value of |p'|^2, relative to the largest, below which it is zero within the accuracy of its series."""

ALONG = 1e-9
"""Part of p'' across p', relative to p'', below which it counts as zero: the direction of p' is no more accurate."""

NOISE = 1e-13
"""Rounding of p' and p'' relative to the largest p, p' and p'' of the path: some hundred times that of one number,
since derivatives are sums with cancellation."""

STEPS = 60
"""Largest number of steps of Newton's method for the inverse of the arc length; four are usual."""

ROUNDING = 1e-15

TABLE = 8
"""Number of points on a piece from which these steps start."""


def curvature(first: ArrayLike, second: ArrayLike) -> Floats:
    """Return the curvature from p' and p'', (...) from (..., m), in any number of coordinates.

    The part of p'' across p', divided by |p'|^2: the same as sqrt(|p'|^2 |p''|^2 - (p'.p'')^2) / |p'|^3 without its
    cancellation. Zero where p' is zero, where there is no curvature.

    References
    ----------
    Notes 6.11 and 6.140, whose cross product exists in three coordinates only.

    Examples
    --------
    >>> float(curvature([0.0, 2.0], [-4.0, 0.0]))  # a circle of radius 1 at double speed
    1.0
    """
    d1, d2 = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    square = np.sum(d1 * d1, axis=-1, keepdims=True)
    safe = np.where(square > 0.0, square, 1.0)
    across = d2 - d1 * (np.sum(d1 * d2, axis=-1, keepdims=True) / safe)
    bend = np.linalg.norm(across, axis=-1) / safe[..., 0]
    return np.asarray(np.where(square[..., 0] > 0.0, bend, 0.0))


def torsion(first: ArrayLike, second: ArrayLike, third: ArrayLike) -> Floats:
    """Return the torsion p'.(p'' x p''') / |p' x p''|^2, (...) from (..., 3); zero where p' x p'' is.

    Notes 6.141.
    """
    d1, d2, d3 = (np.asarray(values, dtype=float) for values in (first, second, third))
    cross = np.cross(d1, d2)
    square = np.sum(cross * cross, axis=-1)
    safe = np.where(square > 0.0, square, 1.0)
    return np.asarray(np.where(square > 0.0, np.sum(cross * d3, axis=-1) / safe, 0.0))


@dataclass(frozen=True, eq=False)
class Frenet:
    """The moving trihedron along a path.

    Attributes
    ----------
    position : ndarray, shape (..., m)
    tangent, normal, binormal : ndarray, shape (..., m)
        Unit vectors; zero where not defined. The binormal only in three coordinates, otherwise zero.
    curvature, torsion : ndarray, shape (...)
        Curvature and torsion, in 1/m for a path in space; torsion is zero in fewer than three coordinates or where
        undefined.
    moves : ndarray of bool, shape (...)
        Places where p' is not zero: there is a tangent (the regularity condition, notes 6.12).
    bends : ndarray of bool, shape (...)
        Places where, in addition, the curvature is not zero: there are a normal and a binormal.
    """

    position: Floats
    tangent: Floats
    normal: Floats
    binormal: Floats
    curvature: Floats
    torsion: Floats
    moves: NDArray[np.bool_]
    bends: NDArray[np.bool_]

    @property
    def remark(self) -> str:
        """Sentence on where a quantity is not defined and why, or ""."""
        if not self.moves.all():
            return "Where p' = 0 the path has no direction: no tangent, no normal."
        if not self.bends.all():
            return (
                "Where the curvature is zero every normal is as good as another: the Frenet frame is not defined there."
            )
        return ""


def frenet(path: Path, s: ArrayLike) -> Frenet:
    """Return the Frenet frame of a path, which need not be parametrised by its length.

    Parameters
    ----------
    path : Path
    s : array_like, shape (...)
        Parameters in [0, 1].

    References
    ----------
    Notes 6.136-6.149; 6.145 multiplies the position by the norm where p' must be divided by it.
    """
    p, d1, d2, d3 = path.derivatives(s)
    scales = _scales(path)
    speed = np.linalg.norm(d1, axis=-1)
    moves = speed > STANDS * scales[1]
    safe = np.where(moves, speed, 1.0)
    tangent = np.where(moves[..., None], d1 / safe[..., None], 0.0)
    across = d2 - tangent * np.sum(tangent * d2, axis=-1, keepdims=True)
    size, whole = np.linalg.norm(across, axis=-1), np.linalg.norm(d2, axis=-1)
    # Near a standstill the direction of p' is rounding, and p'' divided by the square of a small speed is large.
    known = ALONG * whole + NOISE * (sum(scales[:2]) * whole / safe + sum(scales))
    bends = moves & (size > known) & (size > safe**2 * (STRAIGHT / scales[1]))
    kappa = np.where(bends, size / safe**2, 0.0)
    normal = np.where(bends[..., None], across / np.where(bends, size, 1.0)[..., None], 0.0)
    if path.m == 3:
        binormal = np.cross(tangent, normal)
        tau = np.where(bends, torsion(d1, d2, d3), 0.0)
    else:
        binormal, tau = np.zeros_like(tangent), np.zeros_like(kappa)
    return Frenet(p, tangent, normal, binormal, kappa, tau, moves, bends)


def _scales(path: Path) -> list[float]:
    """Return the largest |p|, |p'| and |p''| on a coarse grid, as scales for what counts as small."""
    grid = np.append(np.linspace(0.0, 1.0, 33), path.pieces[:1000])
    return [float(np.linalg.norm(values, axis=-1).max()) for values in path.derivatives(grid)[:3]]


def standstills(path: Path) -> Floats:
    """Return the s where p'(s) = 0, shape (k,); none for a regular path.

    References
    ----------
    Notes 6.12. A bounded curvature does not imply it: (s^3, s^3) about s = 0 is straight and stands still.
    """

    def square(s: Floats) -> Floats:
        return np.asarray(np.sum(path.at(s, 1) ** 2, axis=-1))

    degree = None if path.degree is None else 2 * max(path.degree - 1, 0)
    series = series_of(lambda s: square(s)[:, None], path.edges, degree)
    least = ZERO_SQUARE * float(extremes_of_series(series).highest[0])
    ends = np.unique(series.edges)
    low, high = series.edges[:, 0], series.edges[:, 1]
    inner = [
        a + (b - a) * (0.5 + 0.5 * roots_inside(chebyshev.chebder(terms)))
        for a, b, terms in zip(low, high, series.coefficients[:, :, 0], strict=True)
    ]
    found: list[float] = []
    # Ends first: beside a flat zero rounding makes more of them, which are the same one.
    for place in np.concatenate([ends, *inner]):
        known = any(square(np.array(0.5 * (place + other))) <= least for other in found)
        if square(np.array(place)) <= least and not known:
            found.append(float(place))
    return np.sort(np.array(found))


class ArcLength:
    """The arc length of a path and its inverse: sigma(s), s(sigma).

    Notes 6.13-6.17. |p'| is written as Chebyshev series between the ends of pieces and integrated exactly.

    Attributes
    ----------
    length : float
        L.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        speed = series_of(lambda s: np.linalg.norm(path.at(s, 1), axis=1)[:, None], path.edges)
        self._series = speed.integral()
        self.length = float(self._series.at(np.ones(1))[0, 0])
        grid = np.unique(self._series.grid(TABLE))
        self._table = grid, np.maximum.accumulate(self._series.at(grid)[:, 0])

    def sigma(self, s: ArrayLike) -> Floats:
        """Return the distance from s = 0, (...) like s."""
        places = np.asarray(s, dtype=float)
        return np.asarray(self._series.at(places.reshape(-1))[:, 0].reshape(places.shape))

    def s(self, sigma: ArrayLike) -> Floats:
        """Return the parameter at a distance, (...) like sigma; 0 and 1 beyond the ends."""
        goal = np.asarray(sigma, dtype=float)
        flat = goal.reshape(-1)
        index = np.clip(np.searchsorted(self._table[1], flat), 1, len(self._table[0]) - 1)
        low, high = self._table[0][index - 1], self._table[0][index]
        place = np.interp(flat, self._table[1], self._table[0])
        for _ in range(STEPS):
            missing = flat - self.sigma(place)
            low, high = np.where(missing > 0.0, place, low), np.where(missing > 0.0, high, place)
            speed = np.linalg.norm(self.path.at(place, 1), axis=-1)
            tried = place + missing / np.where(speed > 0.0, speed, np.inf)
            # Where the path nearly stands still a step may lead out; halving does not.
            step = np.where((tried >= low) & (tried <= high), tried, 0.5 * (low + high))
            still = float(np.abs(step - place).max(initial=0.0)) < ROUNDING
            place = step
            if still:
                break
        found = np.where(flat <= 0.0, 0.0, np.where(flat >= self.length, 1.0, np.clip(place, 0.0, 1.0)))
        return np.asarray(found.reshape(goal.shape))


class ByLength(Path):
    """The same curve with s proportional to the arc length: |p'| = L everywhere.

    With a law of distance L instead of 1 its first derivative is the speed along the path (notes 6.134).

    Raises
    ------
    InputError
        The path stands still somewhere.
    """

    def __init__(self, path: Path) -> None:
        stands = standstills(path)
        if len(stands):
            raise InputError(f"path: p' = 0 at s = {stands[0]:.4g}; a curve that stands still has no such parameter")
        self.path, self.arc = path, ArcLength(path)
        self.m, self.pieces = path.m, self.arc.sigma(path.pieces) / self.arc.length
        self.remarks = path.remarks

    def _values(self, s: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        length = self.arc.length
        place = self._snapped(self.arc.s(s * length))
        p = self.path.derivatives(place, before=before)
        g = np.linalg.norm(p[1], axis=-1)
        g1 = np.sum(p[1] * p[2], axis=-1) / g
        g2 = (np.sum(p[2] * p[2] + p[1] * p[3], axis=-1) - g1 * g1) / g
        # The derivatives of the inverse function of sigma(s) / L.
        inverse = [place, length / g, -(length**2) * g1 / g**3, length**3 * (3.0 * g1 * g1 - g * g2) / g**5]
        found = chained(p, inverse)
        return [found[order] for order in orders]

    def _snapped(self, place: Floats) -> Floats:
        """Return the places, with those within rounding of the end of a piece moved there."""
        edges = self.path.edges
        near = np.clip(np.searchsorted(edges, place), 1, len(edges) - 1)
        nearest = np.where(place - edges[near - 1] < edges[near] - place, edges[near - 1], edges[near])
        return np.where(np.abs(nearest - place) < STANDS, nearest, place)
