"""The four subspaces of a Jacobian: velocities that are reached and lost, joint speeds that count and that do nothing.

Rows that are metres per second and rows that are radians per second have no common size, and neither have joints that
turn and joints that slide. Ranks and singular values are therefore those of a matrix without units,
``diag(1 / lengths) J diag(speeds)``: where translation and rotation are mixed, rows of translation are divided by a
characteristic length, and where turning and sliding joints are mixed, columns are multiplied by the speed that counts
as 1. The rank depends on neither; directions that are called shortest or perpendicular do.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats, finite_floats, wrong
from armlab.kin.ellipsoid import RANK_TOLERANCE
from armlab.kin.joint_scale import jacobian_size, joint_scale
from armlab.kin.spare import task_jacobian

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Subspaces:
    """The singular value decomposition of a Jacobian and what follows from it.

    With ``D = diag(lengths)`` and ``S = diag(speeds)`` it is ``D^-1 J S = U diag(sigma) V^T``. Columns below are in
    the units of J: where nothing is scaled they are orthonormal.

    Attributes
    ----------
    U : ndarray, shape (m, m)
    sigma : ndarray, shape (min(m, n),)
        Descending.
    V : ndarray, shape (n, n)
    rank : int
        Number of singular values above the tolerance times the largest, or times the size that a Jacobian of the arm
        has elsewhere where that is larger: one that is zero but for rounding has rank 0.
    range : ndarray, shape (m, rank)
        ``D u_i``: basis of R(J), the velocities that are reached.
    lost : ndarray, shape (m, m - rank)
        ``D^-1 u_i``: basis of N(J^T). ``lost.T @ J`` is zero: no joint speed has a component along these.
    row : ndarray, shape (n, rank)
        ``S^-1 v_i``: basis of R(J^T).
    null : ndarray, shape (n, n - rank)
        ``S v_i``: basis of N(J), the joint speeds that leave the tool where it is.
    lengths, speeds : ndarray, shapes (m,) and (n,)
    tolerance : float
    """

    U: Array
    sigma: Array
    V: Array
    rank: int
    range: Array
    lost: Array
    row: Array
    null: Array
    lengths: Array
    speeds: Array
    tolerance: float

    @property
    def sigma_min(self) -> float:
        """The smallest singular value, as computed."""
        return float(self.sigma[-1])

    @property
    def inverse(self) -> Array:
        """The pseudo-inverse ``S V diag(1 / sigma) U^T D^-1``, shape (n, m).

        Singular values that count as zero are not inverted (the notes' 5.126 and 5.128 divide by all of them).
        """
        r = self.rank
        scaled = (self.V[:, :r] / self.sigma[:r]) @ self.U[:, :r].T
        return np.asarray(self.speeds[:, None] * scaled / self.lengths)


def subspaces(
    J: ArrayLike,
    length: ArrayLike | None = None,
    speeds: ArrayLike | None = None,
    tolerance: float = RANK_TOLERANCE,
    size: float = 0.0,
) -> Subspaces:
    """Return range, null space, row space and left null space of a Jacobian.

    Parameters
    ----------
    J : array_like, shape (m, n)
    length : float or array_like of shape (m,), optional
        Characteristic length in metres. One number needs six rows, of which the first three are divided by it; else
        what each row is divided by. Left out where all rows have one unit.
    speeds : array_like, shape (n,), optional
        Speed of each joint, rad/s or m/s, that counts as 1.
    tolerance : float
        A singular value not above this times the largest counts as zero.
    size : float
        Singular value, scaled, of the same matrix where it is large, as of `task_size`: one not above the tolerance
        times this counts as zero, too. 0 where nothing is known of the matrix.

    Raises
    ------
    InputError
        Not a finite matrix, or scales that do not fit or are not positive.

    References
    ----------
    Notes, definition 9 and 5.72-5.78, in velocities (5.74 has positions); definition 11 and 5.125-5.128 with U of
    shape (m, m) and V of shape (n, n) (printed the other way). The notes call N(J) the dual space of R(J^T): it is its
    orthogonal complement. Forbidden is every velocity that is not in R(J), not only those in N(J^T).

    Examples
    --------
    >>> found = subspaces([[-2.0, -1.0], [0.0, 0.0]])
    >>> found.rank, np.abs(found.lost).tolist()
    (1, [[0.0], [1.0]])
    """
    matrix = _matrix(J)
    m, n = matrix.shape
    lengths = _lengths(length, m)
    scale = np.ones(n) if speeds is None else as_floats(speeds, "speeds", f"{n} numbers")
    if scale.shape != (n,) or not np.isfinite(scale).all() or (scale <= 0.0).any():
        raise wrong("speeds", f"{n} positive numbers", speeds)
    U, sigma, V_T = np.linalg.svd(matrix * scale / lengths[:, None])
    rank = int(np.sum(sigma > tolerance * max(float(sigma[0]), size)))
    signs = _signs(V_T)
    V = V_T.T * signs
    k = len(sigma)
    U = U * np.concatenate([signs[:k], np.ones(m - k)])
    return Subspaces(
        U,
        sigma,
        V,
        rank,
        lengths[:, None] * U[:, :rank],
        U[:, rank:] / lengths[:, None],
        V[:, :rank] / scale[:, None],
        scale[:, None] * V[:, rank:],
        lengths,
        scale,
        tolerance,
    )


def task_matrix(arm: Arm, q: ArrayLike) -> Array:
    """Return the Jacobian of the task, shape (m, n): m/s and rad/s, in axes of frame 0; see `task_axes`."""
    scale = np.ones(arm.task.m)
    scale[: len(arm.task.position)] = arm.length_scale
    return task_jacobian(arm, finite_floats(q, "q", (arm.n,), f"{arm.n} finite numbers")) * scale[:, None]


def task_axes(arm: Arm, q: ArrayLike) -> Array:
    """Return the directions of the components of the task: unit vectors in the world, shape (m, 3)."""
    base = arm.base[:3, :3]
    position = base.T[arm.task.coordinates]
    if arm.task.rotation == "none":
        return np.asarray(position)
    turns = {"phi": base.T[2:], "full": base.T}.get(arm.task.rotation)
    if turns is None:
        turns = np.asarray(arm.fk(q)[:3, :2].T, dtype=np.float64)
    return np.vstack([position, turns])


def task_lengths(arm: Arm) -> Array:
    """Return the divisors of the rows of the task Jacobian, (m,): the length scale where units are mixed."""
    task = arm.task
    lengths = np.ones(task.m)
    if task.position and task.rotation != "none":
        lengths[: len(task.position)] = arm.length_scale
    return lengths


def task_size(arm: Arm) -> float:
    """Return the size of the task Jacobian of an arm, scaled where units are mixed; see `jacobian_size`."""
    return jacobian_size(arm, joint_scale(arm))


def task_subspaces(arm: Arm, q: ArrayLike, tolerance: float = RANK_TOLERANCE) -> Subspaces:
    """Return the subspaces of the task Jacobian of an arm, scaled where units are mixed."""
    return matrix_subspaces(arm, task_matrix(arm, q), tolerance)


def matrix_subspaces(arm: Arm, J: ArrayLike, tolerance: float = RANK_TOLERANCE) -> Subspaces:
    """Return the same as `task_subspaces` from the task Jacobian, as `task_matrix` has it."""
    return subspaces(J, task_lengths(arm), joint_scale(arm), tolerance, task_size(arm))


def _matrix(J: ArrayLike) -> Array:
    matrix = as_floats(J, "J", "numbers of shape (m, n)")
    if matrix.ndim != 2 or 0 in matrix.shape:
        raise InputError(f"J: expected shape (m, n), got {matrix.shape}")
    if not np.isfinite(matrix).all():
        raise wrong("J", "finite numbers", J)
    return matrix


def _lengths(length: ArrayLike | None, m: int) -> Array:
    if length is None:
        return np.ones(m)
    given = as_floats(length, "length", f"one number or {m} numbers")
    if not np.isfinite(given).all() or (given <= 0.0).any():
        raise wrong("length", "positive numbers of metres", length)
    if given.ndim == 0:
        if m != 6:
            raise InputError(f"length: one number is for six rows, linear then angular; J has {m}: give {m} numbers")
        return np.concatenate([np.full(3, float(given)), np.ones(3)])
    if given.shape != (m,):
        raise InputError(f"length: expected one number or {m} numbers, got shape {given.shape}")
    return given


def _signs(rows: Array) -> Array:
    """Return the sign of the largest component of each row, so that the decomposition is continuous between poses."""
    largest = np.argmax(np.abs(rows) > np.abs(rows).max(axis=1, keepdims=True) - 1e-9, axis=1)
    return np.asarray(np.where(rows[np.arange(len(rows)), largest] < 0.0, -1.0, 1.0))
