"""Singular configurations that one joint reaches while the others stay: near the present one, or over its range."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike, NDArray

from armlab.kin.checks import finite_floats
from armlab.kin.conditioning import SINGULAR
from armlab.kin.control.scaled_task import ScaledTask

Floats = NDArray[np.float64]

STEPS = 12
"""Largest number of steps of Newton's method on one singular value; each step doubles the correct digits."""

TRUSTED, HALVES = 2, 0.5
"""Number of steps after which each further step must bring the singular value down to at most this fraction, else there
is no zero: at a zero that is only touched a step leaves a quarter."""

DIFFERENCE = 1e-5
"""Step of the central differences of the Jacobian, radians or length scales."""

FAR = 0.6
"""Distance, radians or length scales, beyond which a singular configuration is not near."""

BESIDE, PARTS, POINTS = 13, 12, 6
"""Samples of one joint from -FAR to FAR about its present value, or in an interval of the same length of its range;
parts into which the interval between two samples is divided, half a degree each; and samples per interpolating
polynomial."""

MOST_INTERVALS = 128
"""Largest number of intervals into which the range of a joint is divided; those of a longer range are longer."""

NEWTON = 2.0 * FAR / (BESIDE - 1) / PARTS
"""Largest correction of a start by Newton's method, radians or length scales."""

FALLS = 0.5
"""Ratio of a size to one of the next two below which there may be a zero between: beside a zero the ratio is at most
about a third, beside a minimum above zero almost one."""

ROUNDING = 1e-12
"""Size, relative to the largest along a joint, below which a value counts as zero."""

TRIED = 2.0 * FAR
"""Largest distance Newton's method may go: where the singular value curves, its first step is too long."""


class SingularPose(NamedTuple):
    """A singular configuration.

    Attributes
    ----------
    q : ndarray, shape (n,)
        rad or m.
    place : int
        Index, from 0, of the only joint in which q differs from the configuration where the search began.
    away : float
        Its value there minus its value before, rad or m.
    """

    q: Floats
    place: int
    away: float


def nearest_singular_pose(task: ScaledTask, q: ArrayLike) -> SingularPose | None:
    """Return the nearest singular configuration that one joint reaches; None when none is found near.

    The determinant of the task Jacobian (of J J^T where it is not square) is sampled along each joint. From where it
    seems to be zero, the nearest first, Newton's method goes on with the smallest singular value, whose derivative is
    u^T (dJ/dq_k) v. For an arm that never reaches all components of its task these are the sum of the squared minors of
    the usual rank, and the last singular value that is not zero everywhere. Distances are angles; one metre of a
    sliding joint counts as its share of the length scale. The configurations lie inside the limits of the joint. Two
    that are nearer than half a degree to each other may be found as one.

    Parameters
    ----------
    task : ScaledTask
    q : array_like, shape (n,)
        Radians and metres.

    References
    ----------
    Derivative of a singular value: Stewart and Sun, *Matrix Perturbation Theory*, 1990, section IV.2.
    """
    values = finite_floats(q, "q", (task.n,), f"{task.n} finite numbers")
    if task.usual_rank == 0:
        return None
    if _inverse_condition(task, values) <= SINGULAR:
        return SingularPose(values, 0, 0.0)
    best: SingularPose | None = None
    for away, k, at in _starts(task, values):
        if best is not None and away - NEWTON >= _distance(task, best):
            break
        pose = _along(task, _with(values, k, at), k)
        if pose is None:
            continue
        found = SingularPose(pose.q, k, float(pose.q[k] - values[k]))
        if _distance(task, found) <= FAR and (best is None or _distance(task, found) < _distance(task, best)):
            best = found
    return best


def _starts(task: ScaledTask, q: Floats) -> list[tuple[float, int, float]]:
    """Return starts of Newton's method for a zero near q: distance, joint, and its value there.

    The nearest first.
    """
    low, high = (np.clip(q + side * FAR * task.joint_units, *task.arm.limits.T) for side in (-1.0, 1.0))
    places = _seen_between(task, q, np.arange(task.n), low, high)
    return sorted((float(abs(at - q[k]) / task.joint_units[k]), k, at) for k, at in places)


def _seen_between(
    task: ScaledTask, q: Floats, joints: NDArray[np.intp], low: Floats, high: Floats
) -> list[tuple[int, float]]:
    """Return where a joint alone seems to meet a singularity in an interval: the joint, and its value there.

    There are r intervals, each with its joint, (r,), and its ends, (r,) rad or m.
    """
    sampled = np.tile(q, (len(joints), BESIDE, 1))
    sampled[np.arange(len(joints)), :, joints] = np.linspace(low, high, BESIDE, axis=1)
    volumes = _volumes(task, sampled.reshape(-1, task.n)).reshape(len(joints), BESIDE) @ _between().T
    return [(int(joints[r]), float(low[r] + part * (high[r] - low[r]))) for r, part in _zeros(volumes)]


def _volumes(task: ScaledTask, q: Floats) -> Floats:
    """Return a smooth function of configurations (k, n) that is zero only at singularities, shape (k,).

    The determinant of the scaled task Jacobian, or of J J^T or J^T J where it is not square. Where the rank is lower in
    every configuration, the sum of the squares of the minors of that rank.
    """
    poses = task.arm.fk(q) if task.arm.task.rotation == "approach" else np.empty((0, 4, 4))
    J = task.jacobians(q, np.asarray(poses))
    if task.usual_rank < min(task.m, task.n):
        return _squared_minors(J, task.usual_rank)
    if task.m != task.n:
        J_T = np.swapaxes(J, 1, 2)
        J = J @ J_T if task.m < task.n else J_T @ J
    return np.asarray(np.linalg.det(J))


def _squared_minors(J: Floats, rank: int) -> Floats:
    """Return the sums of the squared minors of a rank, (k,), of matrices (k, m, n)."""
    squares = np.linalg.svd(J, compute_uv=False) ** 2
    sums = np.zeros((len(J), rank + 1))
    sums[:, 0] = 1.0
    for square in squares.T:
        # By Cauchy and Binet they are the elementary symmetric polynomials of the squared singular values.
        sums[:, 1:] += square[:, None] * sums[:, :-1]
    return np.asarray(sums[:, rank])


@cache
def _between() -> Floats:
    """Return the matrix from BESIDE samples to values also between them, by polynomials through the nearest POINTS."""
    at = np.linspace(0.0, BESIDE - 1.0, (BESIDE - 1) * PARTS + 1)
    first = np.clip(np.floor(at).astype(int) - POINTS // 2 + 1, 0, BESIDE - POINTS)
    weights = np.zeros((len(at), BESIDE))
    for i in range(POINTS):
        others = np.delete(np.arange(POINTS), i)
        weights[np.arange(len(at)), first + i] = np.prod(((at - first)[:, None] - others) / (i - others), axis=1)
    return weights


def _zeros(volumes: Floats) -> list[tuple[int, float]]:
    """Return the zeros of values (n, s), crossed or touched, as (row, fraction of the way from start to end)."""
    sizes, cells = np.abs(volumes), volumes.shape[1] - 1
    signed = np.where(sizes <= ROUNDING * sizes.max(axis=1, keepdims=True), 0.0, volumes)
    crossed = np.pad(signed[:, :-1] * signed[:, 1:] < 0.0, ((0, 0), (1, 1)))
    found = []
    for k, i in np.argwhere(crossed[:, 1:-1]).tolist():
        found.append((k, (i + float(signed[k, i] / (signed[k, i] - signed[k, i + 1]))) / cells))
    around = sliding_window_view(np.pad(sizes, ((0, 0), (2, 2)), mode="edge"), 5, axis=1)
    dips = (sizes <= around[..., 1:4].min(axis=2)) & (sizes <= FALLS * around.max(axis=2))
    found += [(k, i / cells) for k, i in np.argwhere(dips & ~crossed[:, :-1] & ~crossed[:, 1:]).tolist()]
    return found


def singular_poses(task: ScaledTask, q: ArrayLike) -> tuple[SingularPose, ...]:
    """Return the singular configurations that each joint meets in its range while the others are as in q.

    In the order of the joints. A joint whose motion changes no singular value meets none. They are sought as the
    nearest one is, in intervals of the range. Two that are nearer than half a degree to each other may be found as one.

    Parameters
    ----------
    task : ScaledTask
    q : array_like, shape (n,)
        Radians and metres.
    """
    values = finite_floats(q, "q", (task.n,), f"{task.n} finite numbers")
    found: list[SingularPose] = []
    for k in range(task.n if task.usual_rank else 0):
        low, high = task.arm.limits[k]
        intervals = min(max(int(np.ceil((high - low) / (2.0 * FAR * task.joint_units[k]))), 1), MOST_INTERVALS)
        grid = np.linspace(low, high, 2 * intervals + 1)
        if max(_inverse_condition(task, _with(values, k, float(at))) for at in grid) <= SINGULAR:
            continue
        ends = grid[::2]
        same = NEWTON * float(task.joint_units[k])
        for _, at in sorted(_seen_between(task, values, np.full(intervals, k), ends[:-1], ends[1:])):
            pose = _along(task, _with(values, k, at), k)
            if pose is None or any(one.place == k and abs(one.q[k] - pose.q[k]) < same for one in found):
                continue
            found.append(SingularPose(pose.q, k, float(pose.q[k] - values[k])))
    return tuple(found)


def _along(task: ScaledTask, q: Floats, k: int) -> SingularPose | None:
    """Return the singular configuration near q that joint k alone reaches inside its limits; None without one."""
    low, high = task.arm.limits[k]
    at, last = q.copy(), np.inf
    for step in range(STEPS):
        U, sigma, V = _decomposed(task, at)
        smallest = float(sigma[task.usual_rank - 1])
        if smallest <= SINGULAR * sigma[0]:
            away = float(at[k] - q[k])
            return SingularPose(at, k, away) if abs(away) <= FAR * task.joint_units[k] else None
        slope = _slope(task, at, k, U, V)
        if abs(slope) * TRIED < smallest:
            return None
        if step > TRUSTED and smallest > HALVES * last:
            return None
        last = smallest
        before = float(at[k])
        after = before - smallest / slope * float(task.joint_units[k])
        at[k] = min(max(after, low), high)
        # A singularity may lie exactly at a limit, so a step beyond it goes on from there, once.
        stuck = at[k] == before and after != before
        if stuck or abs(at[k] - q[k]) > TRIED * task.joint_units[k]:
            return None
    return None


def _slope(task: ScaledTask, q: Floats, k: int, U: Floats, V: Floats) -> float:
    """Return the derivative of the smallest singular value with respect to the scaled value of joint k."""
    step = DIFFERENCE * float(task.joint_units[k])
    ahead, behind = (task.scaled(task.jacobian(_with(q, k, float(q[k]) + side * step))) for side in (1.0, -1.0))
    return float(U @ (ahead - behind) @ V) / (2.0 * DIFFERENCE)


def _decomposed(task: ScaledTask, q: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the singular vectors u (m,) and v (n,) of the smallest singular value, and all singular values.

    The smallest is the last that is not zero everywhere.
    """
    U, sigma, V_T = np.linalg.svd(task.scaled(task.jacobian(q)), full_matrices=False)
    last = task.usual_rank - 1
    return U[:, last], sigma, V_T[last]


def _inverse_condition(task: ScaledTask, q: Floats) -> float:
    sigma = np.linalg.svd(task.scaled(task.jacobian(q)), compute_uv=False)
    # The largest alone says nothing where it is the smallest as well: a task with one row.
    return float(sigma[task.usual_rank - 1] / max(sigma[0], task.size))


def _with(q: Floats, k: int, value: float) -> Floats:
    changed = q.copy()
    changed[k] = value
    return changed


def _distance(task: ScaledTask, pose: SingularPose) -> float:
    return abs(pose.away) / float(task.joint_units[pose.place])
