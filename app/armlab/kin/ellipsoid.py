"""Velocity ellipsoids and the measures of manipulability that go with them.

Joint speeds of unit length, as one vector, are carried by a block of the Jacobian to an ellipsoid of velocities (notes
5.140-5.142). Its rows must have one unit: either linear velocities (m/s) or angular ones (rad/s), never both. Joints
that turn and joints that slide are made comparable by a scale, such as their speed limits.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, wrong

Array = NDArray[np.float64]

RANK_TOLERANCE = 1e-9
"""Singular values, relative to the largest, up to this count as zero (notes 5.126 divides by them nevertheless)."""

EQUAL_COMPONENTS = 1e-9
"""Difference below which two components of a unit vector count as equal: the first of them then decides its sign."""

SINGULAR = 1e-5
"""Largest inverse condition at a minimum that counts as a singularity; the refinement leaves less than 1e-6 at one."""

COARSE, REFINEMENTS, MOST_REFINED = 121, 4, 128
"""First samples of a motion; how often the intervals that may hold a singularity are halved; and the most that are."""

ZOOMS, ZOOM_POINTS = 4, 33
"""Rounds in which a minimum is narrowed down, and points in each round."""

MOST_PLACES = 24
"""Largest number of minima that are narrowed down."""

SAME_PLACE = 1e-6
"""Distance, as a fraction of the motion, below which two minima are one."""

STEEPER = 1.05
"""Factor by which the Jacobian may change faster between two samples than from one to the other, at most."""


@dataclass(frozen=True, eq=False)
class Ellipsoid:
    """The velocities that joint speeds of unit length give.

    Parameters
    ----------
    axes : ndarray, shape (m, m)
        Columns u_i: unit vectors of the principal axes, in the axes of the rows of J. The largest component of each,
        the first of equals, is positive.
    sigma : ndarray, shape (m,)
        Half axes, descending; unit of the rows of J per unit of the scaled joint speeds. With fewer joints than rows
        the last m - n are 0: the ellipsoid is flat.
    joint_directions : ndarray, shape (n, k), k = min(m, n)
        Columns v_i: unit vectors of scaled joint speeds with J diag(scale) v_i = sigma_i u_i.
    size : float
        See `velocity_ellipsoid`.

    All measures are of the first k half axes: with fewer joints than rows w is sqrt(det(J^T J)), because
    sqrt(det(J J^T)) of 5.144 is always 0. w is that of `Arm.manipulability` only where the rows are all of the arm's
    task, which then has one unit, and no scale is given.
    """

    axes: Array
    sigma: Array
    joint_directions: Array
    size: float = 0.0

    @property
    def rank(self) -> int:
        """Number of half axes above `RANK_TOLERANCE` times the longest, or times the size if that is larger."""
        return int(np.sum(self.sigma > RANK_TOLERANCE * max(float(self.sigma[0]), self.size)))

    @property
    def w(self) -> float:
        """Yoshikawa's manipulability: the product of the half axes. Notes 5.144."""
        return float(np.prod(self._measured))

    @property
    def sigma_min(self) -> float:
        """The shortest half axis: the speed that is possible in every direction."""
        return float(self._measured[-1])

    @property
    def inverse_condition(self) -> float:
        """sigma_min / sigma_1: 1 where the ellipsoid is a sphere, 0 at a singularity."""
        return self.sigma_min / float(self.sigma[0]) if self.rank == len(self._measured) else 0.0

    @property
    def condition(self) -> float:
        """sigma_1 / sigma_min; infinite at a singularity."""
        return float(self.sigma[0]) / self.sigma_min if self.rank == len(self._measured) else math.inf

    @property
    def _measured(self) -> Array:
        return self.sigma[: self.joint_directions.shape[1]]


class Measures(NamedTuple):
    """Measures of many Jacobians, each of shape (...)."""

    w: Array
    inverse_condition: Array
    sigma_min: Array


def velocity_ellipsoid(J: ArrayLike, scale: ArrayLike | None = None, size: float = 0.0) -> Ellipsoid:
    """Return the ellipsoid of velocities of one Jacobian block.

    The half axes are the singular values, the roots of the eigenvalues of J J^T (5.143, 5.152; the text after 5.152
    calls sigma_i itself the eigenvalue), the principal axes its eigenvectors.

    Parameters
    ----------
    J : array_like, shape (m, n)
        One to three rows of one unit.
    scale : array_like, shape (n,), optional
        Speed of each joint (rad/s or m/s) that counts as 1; without it every joint's unit does.
    size : float
        Half axis, scaled, of the same block where it is large, as of `armlab.kin.joint_scale.linear_size`: a block that
        is zero but for rounding then has rank 0. 0 where nothing is known of the block.

    Raises
    ------
    InputError
        Not a finite matrix of one to three rows, or a scale that does not fit or is negative.

    References
    ----------
    Yoshikawa, *Manipulability of Robotic Mechanisms*, 1985; notes 5.139-5.152. 5.141 is right as v^T (J#)^T J# v = 1.

    Examples
    --------
    >>> found = velocity_ellipsoid([[0.0, -2.0], [1.0, 0.0]])
    >>> found.sigma.tolist(), found.axes.tolist(), found.w
    ([2.0, 1.0], [[1.0, 0.0], [0.0, 1.0]], 2.0)
    """
    block = _scaled(J, scale)
    if block.ndim != 2:
        raise InputError(f"J: expected shape (m, n), got {block.shape}")
    if not np.isfinite(block).all():
        raise wrong("J", "finite numbers", J)
    m, n = block.shape
    u, values, v_T = np.linalg.svd(block, full_matrices=True)
    signs = np.array([_sign(u[:, i]) for i in range(m)])
    k = min(m, n)
    sigma = np.zeros(m)
    sigma[:k] = values
    return Ellipsoid(_settled(u * signs), _settled(sigma), _settled(v_T[:k].T * signs[:k]), size)


def measures(J: ArrayLike, scale: ArrayLike | None = None, size: float = 0.0) -> Measures:
    """Return w, inverse condition and shortest half axis of many Jacobian blocks.

    Parameters
    ----------
    J : array_like, shape (..., m, n)
        One to three rows of one unit; a matrix that is not finite gives nan.
    scale : array_like, shape (n,), optional
    size : float
        Both as in `velocity_ellipsoid`.

    Returns
    -------
    Measures
        As the properties of `Ellipsoid`, each of shape (...).

    Raises
    ------
    InputError
        Not one to three rows, or a scale that does not fit.
    """
    blocks = _scaled(J, scale)
    finite = np.asarray(np.isfinite(blocks).all(axis=(-2, -1), keepdims=True))
    usable: Array = np.where(finite, blocks, 0.0)
    sigma = np.linalg.svd(usable, compute_uv=False)
    given = finite[..., 0, 0]
    largest, smallest = sigma[..., 0], sigma[..., -1]
    full = smallest > RANK_TOLERANCE * np.maximum(largest, size)
    inverse = np.where(full, smallest / np.where(full, largest, 1.0), 0.0)
    return Measures(*(np.where(given, value, np.nan) for value in (sigma.prod(axis=-1), inverse, smallest)))


class SingularPlaces(NamedTuple):
    """Singular places of a motion.

    Attributes
    ----------
    places : tuple of float
        Rising; empty where the motion is singular everywhere.
    everywhere : bool
    samples : int
        Number of places examined before the minima were narrowed down: finding none is no proof that there is none.
    """

    places: tuple[float, ...]
    everywhere: bool
    samples: int


def singular_places(jacobian: Callable[[Array], Array], low: float, high: float, size: float = 0.0) -> SingularPlaces:
    """Return where, from one value of a joint to another, the velocity in some direction is lost.

    A singular value changes no faster than the matrix: between two samples whose shortest half axes are long enough
    there is no singularity; the other intervals are halved, then the minima left over are narrowed down. Two places
    closer than a 2000th of the motion may be found as one.

    Parameters
    ----------
    jacobian : callable
        Blocks of shape (N, m, n), one to three rows of one unit, scaled if need be, of values of shape (N,).
    low, high : float
        Both are looked at too.
    size : float
        As in `velocity_ellipsoid`.

    References
    ----------
    Weyl's inequality for singular values: Horn and Johnson, *Topics in Matrix Analysis*, 1991, theorem 3.3.16.
    """
    values = np.linspace(low, high, COARSE if high > low else 1)
    blocks = jacobian(values)
    smallest = _smallest(blocks)
    doubtful = float(smallest.max()) <= 1e-6 * max(float(np.abs(blocks).max()), size)
    if doubtful and not measures(blocks, size=size).inverse_condition.any():
        return SingularPlaces((), True, len(values))
    if len(values) == 1:
        return SingularPlaces((), False, 1)
    change = np.linalg.norm(np.diff(blocks, axis=0), axis=(-2, -1)) / np.diff(values)
    steepest = STEEPER * float(change.max())
    values, smallest = _refined(jacobian, values, smallest, steepest)
    low_ends, high_ends = _minima(values, smallest, steepest)
    places = _narrowed(jacobian, low_ends, high_ends, SAME_PLACE * (high - low), size)
    return SingularPlaces(places, False, len(values))


def _smallest(blocks: Array) -> Array:
    """Return the shortest half axes, accurate to 1e-8 of the longest, faster than by singular values."""
    turned = np.swapaxes(blocks, -1, -2)
    products = blocks @ turned if blocks.shape[-2] <= blocks.shape[-1] else turned @ blocks
    return np.asarray(np.sqrt(np.maximum(np.linalg.eigvalsh(products)[..., 0], 0.0)))


def _refined(
    jacobian: Callable[[Array], Array], values: Array, smallest: Array, steepest: float
) -> tuple[Array, Array]:
    """Return the samples with more of them where there may be a zero."""
    for _ in range(REFINEMENTS):
        room = steepest * np.diff(values) - (smallest[:-1] + smallest[1:])
        open_ones = np.flatnonzero(room >= 0.0)
        if len(open_ones) == 0:
            break
        if len(open_ones) > MOST_REFINED:
            open_ones = np.sort(open_ones[np.argsort(-room[open_ones], kind="stable")[:MOST_REFINED]])
        between = 0.5 * (values[open_ones] + values[open_ones + 1])
        values = np.insert(values, open_ones + 1, between)
        at = open_ones + np.arange(1, len(open_ones) + 1)
        more = np.empty(len(values))
        more[at] = _smallest(jacobian(between))
        more[np.delete(np.arange(len(values)), at)] = smallest
        smallest = more
    return values, smallest


def _minima(values: Array, smallest: Array, steepest: float) -> tuple[Array, Array]:
    """Return both ends of the intervals around minima among the samples that are near enough to a zero."""
    walled = np.concatenate([[np.inf], smallest, [np.inf]])
    below, above = np.concatenate([values[:1], values[:-1]]), np.concatenate([values[1:], values[-1:]])
    near = smallest <= steepest * np.maximum(values - below, above - values)
    dips = np.flatnonzero((smallest <= walled[:-2]) & (smallest <= walled[2:]) & near)
    dips = dips[np.argsort(smallest[dips], kind="stable")[:MOST_PLACES]]
    return below[dips], above[dips]


def _narrowed(
    jacobian: Callable[[Array], Array], low: Array, high: Array, same: float, size: float
) -> tuple[float, ...]:
    """Return the places in these intervals at which the inverse condition falls to zero, or all half axes do."""
    if len(low) == 0:
        return ()
    each = np.arange(len(low))
    for _ in range(ZOOMS):
        values = np.linspace(low, high, ZOOM_POINTS, axis=1)
        inverse = _nearness(jacobian(values.ravel()), size).reshape(values.shape)
        best = np.argmin(inverse, axis=1)
        low, high = values[each, np.maximum(best - 1, 0)], values[each, np.minimum(best + 1, ZOOM_POINTS - 1)]
    found: list[float] = []
    for value in np.sort(values[each, best][inverse[each, best] < SINGULAR]).tolist():
        if not found or value - found[-1] > same:
            found.append(value)
    return tuple(found)


def _nearness(blocks: Array, size: float) -> Array:
    """Return the inverse conditions, or the shortest half axes relative to the size where these are less.

    The inverse condition of one row is 1 also close to its zeros.
    """
    found = measures(blocks, size=size)
    return np.minimum(found.inverse_condition, found.sigma_min / size) if size else found.inverse_condition


def _scaled(J: ArrayLike, scale: ArrayLike | None) -> Array:
    """Return J diag(scale) as floats, checked."""
    blocks = as_floats(J, "J", "numbers of shape (..., m, n)")
    if blocks.ndim < 2 or not 1 <= blocks.shape[-2] <= 3 or blocks.shape[-1] == 0:
        raise InputError(f"J: expected one to three rows of one unit, shape (..., m, n), got {blocks.shape}")
    if scale is None:
        return blocks
    n = blocks.shape[-1]
    speeds = as_floats(scale, "scale", f"{n} numbers")
    if speeds.shape != (n,) or not np.isfinite(speeds).all() or (speeds < 0.0).any():
        raise wrong("scale", f"{n} finite numbers, none negative", scale)
    return blocks * speeds


def _sign(u: Array) -> float:
    """Return the sign of the largest component, the first of those that are equal within rounding."""
    size = np.abs(u)
    return float(np.sign(u[int(np.argmax(size >= size.max() - EQUAL_COMPONENTS))]))


def _settled(values: Array) -> Array:
    """Return a read-only copy without negative zeros."""
    settled = values + 0.0
    settled.setflags(write=False)
    return settled
