"""Null-space motion of redundant joints besides the task: qdot = J# v + (I - J# J) xi.

With N an orthonormal basis of the null space I - J# J = N N^T. So of a wish xi that is the slope of an objective only
the slopes along the columns of N are needed. An arm without joints to spare has none, but for a singular J.

References
----------
Notes 5.132-5.138; Liegeois 1977 (middle of the ranges), Yoshikawa 1984 (manipulability).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from armlab.kin.control.decomposed import decomposed, null_directions
from armlab.kin.control.rate_inverse import CUTOFF
from armlab.kin.control.scaled_task import ScaledTask
from armlab.registry import known_name

Floats = NDArray[np.float64]

Slopes = Callable[[ScaledTask, Floats, Floats], Floats]
"""``slopes(task, q (n,), N (n, k)) -> (k,)``: derivatives of an objective along k directions of scaled joints."""

DIFFERENCE = 1e-5
"""Half the step of the central differences of w, in scaled joints; their error is about its square."""

TITLES = {"none": "none", "middle": "towards mid-range", "manipulability": "up the manipulability"}


def middle_slopes(task: ScaledTask, q: Floats, N: Floats) -> Floats:
    """Return slopes (k,) of -(1/2n) sum ((q_i - middle_i) / (q_i,max - q_i,min))^2; only joints with a range count."""
    low, high = task.arm.limits.T
    ranges = np.where(high > low, high - low, np.inf)
    return np.asarray((-(q - 0.5 * (low + high)) / ranges**2 / task.n * task.joint_units) @ N)


def manipulability_slopes(task: ScaledTask, q: Floats, N: Floats) -> Floats:
    """Return slopes (k,) of w, the product of the singular values of the scaled task Jacobian, along N (n, k)."""

    def w(at: Floats) -> float:
        return float(np.prod(decomposed(task.scaled(task.jacobian(at))).sigma))

    steps = (DIFFERENCE * N * task.joint_units[:, None]).T
    return np.array([(w(q + step) - w(q - step)) / (2.0 * DIFFERENCE) for step in steps])


WISHES: dict[str, Slopes] = {"middle": middle_slopes, "manipulability": manipulability_slopes}


def checked_wish(key: str) -> str:
    """Return the key of a null-space term; `UnknownName` when there is none."""
    return known_name("null-space term", key, TITLES)


def self_motion(key: str, task: ScaledTask, q: Floats, J: Floats) -> Floats:
    """Return (I - J# J) xi at gain 1, (n,), scaled joint speeds.

    Parameters
    ----------
    key : str
        Key of the term: ``"middle"`` or ``"manipulability"``.
    task : ScaledTask
    q : ndarray, shape (n,)
    J : ndarray, shape (m, n)
        Scaled task Jacobian; singular values below `CUTOFF` of the largest span the null space, too.
    """
    N = null_directions(J, CUTOFF)
    return np.asarray(N @ WISHES[key](task, q, N)) if N.shape[1] else np.zeros(task.n)


def projected(J: Floats, wish: Floats) -> Floats:
    """Return (I - J# J) wish, (n,), for a scaled J (m, n) and any scaled joint speeds."""
    N = null_directions(J, CUTOFF)
    return np.asarray(N @ (wish @ N))
