"""Theoretical decay of errors, in closed form: to compare with a run, and to see where the notes differ.

References
----------
Notes 1.46-1.49, 7.16-7.18, 7.21-7.24.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats
from armlab.kin.control.decomposed import decomposed
from armlab.kin.control.scaled_task import ScaledTask

Floats = NDArray[np.float64]

SMALL = 0.02
"""Largest entry of M for which four terms of the series give exp(M) to seven digits, and much faster."""


def error_decay(K: ArrayLike, e0: ArrayLike, t: ArrayLike) -> Floats:
    """Return e(t) = e0 exp(-K t) component by component, (..., n) from t of shape (...).

    Parameters
    ----------
    K : array_like, shape (n,)
        Gains, 1/s: each component has its own; (7.18) prints one k for all.
    e0 : array_like, shape (n,)
        Errors at t = 0.
    t : array_like, shape (...)
        Seconds.
    """
    times = np.asarray(t, dtype=float)[..., None]
    return np.asarray(np.asarray(e0, dtype=float) * np.exp(-np.asarray(K, dtype=float) * times))


def space_error_rate(arm: Arm, q: ArrayLike, q_d: ArrayLike, qdot_d: ArrayLike, K: ArrayLike) -> Floats:
    """Return the rate of the position error under joint tracking, (3,), m/s, world axes.

    e_p' = J(q_d) qdot_d - J(q) qdot_d - J(q) K e; the notes print the last term without K in 7.23, and in the text
    after it the limit J(q) e, which should be -J(q) K e.

    Parameters
    ----------
    arm : Arm
    q, q_d, qdot_d : array_like, shape (n,)
        Present and wanted joint values, and the rates of these.
    K : array_like, shape (n,)
        Gains, 1/s.
    """
    present, goal, rates = (np.asarray(values, dtype=float) for values in (q, q_d, qdot_d))
    here, there = arm.jacobian(present)[:3], arm.jacobian(goal)[:3]
    return np.asarray(there @ rates - here @ rates - here @ (np.asarray(K, dtype=float) * (goal - present)))


def predicted_error(arm: Arm, t: Floats, q: Floats, K: Floats, e0: Floats) -> Floats:
    """Return the task error that e_p' = -J K J# e_p predicts along a run, (N, m), metres and radians.

    Parameters
    ----------
    arm : Arm
    t : ndarray, shape (N,)
        Seconds, rising.
    q : ndarray, shape (N, n)
        Joint values of the run, in which J is taken.
    K : ndarray, shape (n,)
        Gains of the joints, 1/s.
    e0 : ndarray, shape (m,)
        Task error at the beginning.

    Raises
    ------
    InputError
        There is no time, or another argument has another shape.

    References
    ----------
    Notes 7.24. It is exact where all gains are equal and J is constant.
    """
    task = ScaledTask(arm)
    t = _of_shape("t", t, (max(1, np.size(t)),))
    q, K, e0 = _of_shape("q", q, (len(t), arm.n)), _of_shape("K", K, (arm.n,)), _of_shape("e0", e0, (task.m,))
    scaled = np.empty((len(t), task.m))
    scaled[0] = e0 * task.row_units
    poses = np.asarray(arm.fk(q), dtype=np.float64)
    jacobians = task.jacobians(q, poses)
    for k in range(len(t) - 1):
        found = decomposed(jacobians[k])
        large = found.sigma > 1e-9 * found.sigma[0] if len(found.sigma) else found.sigma > 0.0
        inverse = (found.Vt.T * np.where(large, 1.0 / np.where(large, found.sigma, 1.0), 0.0)) @ found.U.T
        scaled[k + 1] = _carried(-(t[k + 1] - t[k]) * (jacobians[k] * K) @ inverse, scaled[k])
    return scaled / task.row_units


def _of_shape(name: str, values: ArrayLike, shape: tuple[int, ...]) -> Floats:
    array = as_floats(values, name, f"numbers of shape {shape}")
    if array.shape != shape:
        raise InputError(f"{name}: expected numbers of shape {shape}, got shape {array.shape}")
    return array


def _carried(M: Floats, e: Floats) -> Floats:
    """Return exp(M) e."""
    if np.abs(M).max(initial=0.0) > SMALL:
        from scipy.linalg import expm  # type: ignore[import-untyped]

        return np.asarray(expm(M) @ e)
    first = M @ e
    second = M @ first
    return np.asarray(e + first + second / 2.0 + M @ second / 6.0)
