"""Static forces: what torques an arm at rest needs to exert a wrench, and which wrenches need none.

A wrench ``F = (f; m)`` is a force f (N) and the moment m (N m) about a stated point, both exerted BY the robot ON the
environment (notes, section 5.4); the environment pushes back with -F. Rows as those of the geometric Jacobian: linear,
then angular. (The text after 5.155 gives a free link three coordinates; it has six. The constraints of the joints leave
n of the 6 n all the same.)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, finite_floats, together, wrong
from armlab.kin.velocity.subspaces import subspaces

Array = NDArray[np.float64]


def joint_torques(J: ArrayLike, wrench: ArrayLike) -> Array:
    """Return the joint torques with which the robot exerts a wrench on the environment: ``tau = J^T F``.

    Parameters
    ----------
    J : array_like, shape (..., m, n)
        Geometric Jacobian at the point of the wrench, or some of its rows.
    wrench : array_like, shape (..., m)
        Wrench in the axes of the rows: N along linear rows, N m along angular ones.

    Returns
    -------
    ndarray, shape (..., n)
        Torques of revolute joints in N m, forces of prismatic ones in N; they balance the wrench alone, no weight.

    Raises
    ------
    InputError
        The shapes do not fit.

    References
    ----------
    Notes 5.156-5.163, by the principle of virtual work.

    Examples
    --------
    >>> joint_torques([[0.0, 0.0], [2.0, 1.0]], [5.0, 3.0]).tolist()
    [6.0, 3.0]
    """
    rows, F = _matrix(J), as_floats(wrench, "wrench", "numbers of shape (..., m)")
    if F.shape[-1:] != rows.shape[-2:-1]:
        raise InputError(f"wrench: expected {rows.shape[-2]} numbers, one for each row of J, got shape {F.shape}")
    together(J=rows.shape[:-2], wrench=F.shape[:-1])
    return np.asarray((np.swapaxes(rows, -1, -2) @ F[..., None])[..., 0])


def wrench_at(wrench: ArrayLike, r: ArrayLike) -> Array:
    """Return the same wrench about another point: ``(f; m - r x f)``.

    Parameters
    ----------
    wrench : array_like, shape (..., 6)
        (f; m) with m about the point P.
    r : array_like, shape (..., 3)
        Vector from P to the other point, metres, in the axes of the wrench.

    Returns
    -------
    ndarray, shape (..., 6)
        With it goes the twist of the other point, ``(v + omega x r; omega)``: the power is the same.

    Raises
    ------
    InputError
        The shapes do not fit.

    Examples
    --------
    >>> wrench_at([0.0, 5.0, 0.0, 0.0, 0.0, 0.0], [2.0, 0.0, 0.0]).tolist()
    [0.0, 5.0, 0.0, 0.0, 0.0, -10.0]
    """
    F, arm = as_floats(wrench, "wrench", "numbers of shape (..., 6)"), as_floats(r, "r", "numbers of shape (..., 3)")
    if F.shape[-1:] != (6,) or arm.shape[-1:] != (3,):
        raise InputError(f"wrench and r: expected shapes (..., 6) and (..., 3), got {F.shape} and {arm.shape}")
    together(wrench=F.shape[:-1], r=arm.shape[:-1])
    force = F[..., :3]
    moment = F[..., 3:] - np.cross(arm, force)
    force = np.broadcast_to(force, moment.shape)
    return np.asarray(np.concatenate([force, moment], axis=-1) + 0.0)


class VirtualWork(NamedTuple):
    """Both sides of 5.160, in J.

    Attributes
    ----------
    tool : float or ndarray
        ``F . J dq``, the work of the wrench on the environment.
    joints : float or ndarray
        ``tau . dq``, the work of the joints. They are equal: the arm itself stores nothing.
    """

    tool: Array
    joints: Array


def virtual_work(J: ArrayLike, wrench: ArrayLike, displacement: ArrayLike) -> VirtualWork:
    """Return the work of tool and joints over a virtual displacement.

    Parameters
    ----------
    J : array_like, shape (..., m, n)
    wrench : array_like, shape (..., m)
    displacement : array_like, shape (..., n)
        dq, rad or m.

    Raises
    ------
    InputError
        The shapes do not fit.

    References
    ----------
    Notes 5.156-5.161; there the work of the tool is that done on it, ``-F . J dq``, and the sum is zero.
    """
    rows = _matrix(J)
    dq = as_floats(displacement, "displacement", "numbers of shape (..., n)")
    if dq.shape[-1:] != rows.shape[-1:]:
        raise InputError(f"displacement: expected {rows.shape[-1]} numbers, one a joint, got shape {dq.shape}")
    tau = joint_torques(rows, wrench)
    F = np.asarray(wrench, dtype=float)
    together(J=rows.shape[:-2], wrench=F.shape[:-1], displacement=dq.shape[:-1])
    moved = (rows @ dq[..., None])[..., 0]
    return VirtualWork(np.sum(F * moved, axis=-1), np.sum(tau * dq, axis=-1))


@dataclass(frozen=True, eq=False)
class Duality:
    """The four subspaces of J, which J^T has the other way round (notes, the block after 5.163).

    Attributes
    ----------
    rank : int
    singular_values : ndarray, shape (min(m, n),)
        Singular values of the Jacobian made comparable; see `duality`.
    wrenches : ndarray, shape (m, m - rank)
        N(J^T): columns span the wrenches that need no torque, N and N m. Unit vectors where all rows have one unit;
        else of length 1 in (length f; m).
    torques : ndarray, shape (n, rank)
        R(J^T): columns span the torques that some wrench balances, N m and N.
    motions : ndarray, shape (n, n - rank)
        N(J): columns span the joint speeds that leave these rows at rest, rad/s and m/s.
    velocities : ndarray, shape (m, rank)
        R(J): columns span the velocities that joints can give, m/s and rad/s.
    """

    rank: int
    singular_values: Array
    wrenches: Array
    torques: Array
    motions: Array
    velocities: Array


def duality(J: ArrayLike, length: float | None = None, speeds: ArrayLike | None = None, size: float = 0.0) -> Duality:
    """Return the subspaces of velocities and of forces of one Jacobian.

    Metres are never added to radians: with six rows the linear ones are divided by a characteristic length, and joints
    that slide and joints that turn are measured by speeds that count as 1. The subspaces do not depend on the choice;
    what counts as zero does; see `armlab.kin.velocity.subspaces`.

    Parameters
    ----------
    J : array_like, shape (m, n)
        One to three rows of one unit, or all six.
    length : float, optional
        Metres that count as much as a radian, such as `Arm.length_scale`; needed with six rows, for no others.
    speeds : array_like, shape (n,), optional
        rad/s or m/s, positive; 1 when left out.
    size : float
        Singular value, scaled, of the same rows where they are large; see `armlab.kin.velocity.subspaces`.

    Raises
    ------
    InputError
        Not such a matrix, or length or speeds that do not fit.

    References
    ----------
    Notes 5.72-5.78 and the block after 5.163.
    """
    rows = _matrix(J)
    if rows.ndim != 2 or not np.isfinite(rows).all() or rows.shape[0] not in (1, 2, 3, 6):
        raise wrong("J", "a finite matrix of one to three rows of one unit, or of six", J)
    _refuse_length(len(rows), length)
    found = subspaces(rows, length, speeds, size=size)
    return Duality(
        found.rank,
        found.sigma,
        wrenches=_settled(found.lost),
        torques=_settled(found.row),
        motions=_settled(found.null),
        velocities=_settled(found.range),
    )


def torque_free(J: ArrayLike, length: float | None = None, speeds: ArrayLike | None = None, size: float = 0.0) -> Array:
    """Return a basis of the wrenches that need no torque, shape (m, k): the left null space N(J^T); see `duality`.

    Examples
    --------
    >>> torque_free([[0.0, 0.0], [2.0, 1.0]]).tolist()
    [[1.0], [0.0]]
    """
    return duality(J, length, speeds, size).wrenches


def _refuse_length(m: int, length: float | None) -> None:
    if m != 6 and length is not None:
        raise InputError(f"length: only all six rows have two units, got {m} rows")
    metres = "metres that count as much as a radian, for rows of two units"
    if m == 6 and finite_floats(length, "length", (), metres) <= 0.0:
        raise wrong("length", metres, length)


def _matrix(J: ArrayLike) -> Array:
    rows = as_floats(J, "J", "numbers of shape (..., m, n)")
    if rows.ndim < 2 or 0 in rows.shape[-2:]:
        raise InputError(f"J: expected shape (..., m, n), got {rows.shape}")
    return rows


def _settled(columns: Array) -> Array:
    """Return read-only columns with positive largest components and without negative zeros."""
    largest = np.abs(columns).argmax(axis=0) if columns.size else np.zeros(columns.shape[1], dtype=int)
    signs = np.sign(columns[largest, np.arange(columns.shape[1])])
    settled = columns * np.where(signs == 0.0, 1.0, signs) + 0.0
    settled.setflags(write=False)
    return settled
