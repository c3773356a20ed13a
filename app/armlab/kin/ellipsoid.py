"""Velocity ellipsoids and the measures of manipulability that go with them.

Joint speeds of unit length, as one vector, are carried by a block of the Jacobian to an ellipsoid of velocities (notes
5.140-5.142). Its rows must have one unit: either linear velocities (m/s) or angular ones (rad/s), never both. Joints
that turn and joints that slide are made comparable by a scale, such as their speed limits.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, wrong

Array = NDArray[np.float64]

RANK_TOLERANCE = 1e-9
"""A singular value not above this times the largest counts as zero (notes 5.126 divides by it all the same)."""

EQUAL_COMPONENTS = 1e-9
"""Components of a unit vector this close count as equal: the first of them then decides its sign."""


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

    All measures are of the first k half axes, so that w is that of `Arm.manipulability` also for fewer joints than
    rows, where sqrt(det(J J^T)) of 5.144 is always 0.
    """

    axes: Array
    sigma: Array
    joint_directions: Array

    @property
    def rank(self) -> int:
        """Number of half axes above `RANK_TOLERANCE` times the longest."""
        return int(np.sum(self.sigma > RANK_TOLERANCE * self.sigma[0]))

    @property
    def w(self) -> float:
        """Yoshikawa's manipulability: the product of the half axes. Notes 5.144."""
        return float(np.prod(self._measured))

    @property
    def sigma_min(self) -> float:
        """The shortest half axis: the speed that is reached in every direction."""
        return float(self._measured[-1])

    @property
    def inverse_condition(self) -> float:
        """sigma_min / sigma_1: 1 where the ellipsoid is a sphere, 0 at singularities."""
        return self.sigma_min / float(self.sigma[0]) if self.rank == len(self._measured) else 0.0

    @property
    def condition(self) -> float:
        """sigma_1 / sigma_min; infinite at singularities."""
        return float(self.sigma[0]) / self.sigma_min if self.rank == len(self._measured) else math.inf

    @property
    def _measured(self) -> Array:
        return self.sigma[: self.joint_directions.shape[1]]


class Measures(NamedTuple):
    """Measures of many Jacobians, each of shape (...)."""

    w: Array
    inverse_condition: Array
    sigma_min: Array


def velocity_ellipsoid(J: ArrayLike, scale: ArrayLike | None = None) -> Ellipsoid:
    """Return the ellipsoid of velocities of one Jacobian block.

    The half axes are the singular values, the roots of the eigenvalues of J J^T (5.143, 5.152; the text after 5.152
    calls sigma_i itself the eigenvalue), the principal axes its eigenvectors.

    Parameters
    ----------
    J : array_like, shape (m, n)
        One to three rows of one unit.
    scale : array_like, shape (n,), optional
        Speed of each joint (rad/s or m/s) that counts as 1; without it every joint's unit does.

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
    return Ellipsoid(_settled(u * signs), _settled(sigma), _settled(v_T[:k].T * signs[:k]))


def measures(J: ArrayLike, scale: ArrayLike | None = None) -> Measures:
    """Return w, inverse condition and shortest half axis of many Jacobian blocks.

    Parameters
    ----------
    J : array_like, shape (..., m, n)
        One to three rows of one unit; a matrix that is not finite gives nan.
    scale : array_like, shape (n,), optional
        As in `velocity_ellipsoid`.

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
    full = smallest > RANK_TOLERANCE * largest
    inverse = np.where(full, smallest / np.where(full, largest, 1.0), 0.0)
    return Measures(*(np.where(given, value, np.nan) for value in (sigma.prod(axis=-1), inverse, smallest)))


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
