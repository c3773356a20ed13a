"""The continuous Jacobian-transpose scheme and its Lyapunov function.

    dq/dt = J^T K e,    V = e^T K e / 2,    dV/dt = -|J^T K e|^2

V never rises, so the scheme is stable; but it comes to rest wherever J^T K e = 0, which need not be a solution.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats, finite_floats, wrong
from armlab.kin.ik.iterate.loop import FARTHEST, FLAT, within
from armlab.kin.ik.iterate.problem import Floats, Point, Problem
from armlab.kin.ik.iterate.reasons import scaling
from armlab.kin.ik.iterate.record import TOLERANCE, checked_tolerance, checked_vector
from armlab.kin.ik.iterate.task_vector import TaskVector
from armlab.kin.ik.verdict import checked_locks, joint_values
from armlab.kin.transforms import as_pose
from armlab.kin.work import Work, result_of

MOST_STEPS = 20_000
"""Largest number of steps of the integration."""

STABLE = 2.785
"""Largest dt K sigma_max^2 at which RK4 is stable for a decaying linear equation."""

FlowStatus = Literal["converged", "stuck", "going", "unstable", "locked"]


@dataclass(frozen=True, eq=False)
class Flow:
    """A run of the continuous scheme with s + 1 instants.

    Attributes
    ----------
    t : ndarray, shape (s + 1,)
        Seconds.
    q : ndarray, shape (s + 1, n)
        rad or m.
    components : ndarray, shape (s + 1, m)
        Error of each task component, m or rad.
    position_error, rotation_error : ndarray, shape (s + 1,)
        Metres and radians.
    V, V_dot : ndarray, shape (s + 1,)
        Lyapunov function of the scaled error, and its derivative by the formula, 1/s.
    status, reason : str
    scaling : str
        The units combined in V, in words.
    """

    t: Floats
    q: Floats
    components: Floats
    position_error: Floats
    rotation_error: Floats
    V: Floats
    V_dot: Floats
    status: FlowStatus
    reason: str
    scaling: str


def transpose_flow(
    arm: Arm,
    T: ArrayLike,
    q0: ArrayLike,
    *,
    gain: ArrayLike = 1.0,
    duration: float = 10.0,
    dt: float = 0.01,
    tolerance: tuple[float, float] = TOLERANCE,
    locked: Sequence[bool] | None = None,
    task: TaskVector | str | None = None,
) -> Flow:
    """Integrate dq/dt = J^T K e with the classical Runge-Kutta method of fourth order.

    Parameters
    ----------
    arm : Arm
    T : array_like, shape (4, 4)
        Target in the world.
    q0 : array_like, shape (n,)
        Start; joint limits are not kept.
    gain : float or array_like of shape (m,)
        Positive entries of the diagonal of K, 1/s. The components of one rotation vector share one gain.
    duration, dt : float
        Seconds, at most 20 000 steps.
    tolerance : (float, float)
        Metres and radians at which the run ends.
    locked : sequence of bool, optional
    task : TaskVector or str, optional

    Raises
    ------
    InputError
        ``T`` is no pose, or shapes or numbers are wrong.

    References
    ----------
    Notes 4.127-4.129. In 4.127 q(t + dt) should be q(t), and with a gain matrix V has K in it, too. That V falls does
    not mean that e goes to zero: the stretched 2R pulled along its own line stays where it is.
    """
    return result_of(
        flowing(arm, T, q0, gain=gain, duration=duration, dt=dt, tolerance=tolerance, locked=locked, task=task)
    )


def flowing(
    arm: Arm,
    T: ArrayLike,
    q0: ArrayLike,
    *,
    gain: ArrayLike = 1.0,
    duration: float = 10.0,
    dt: float = 0.01,
    tolerance: tuple[float, float] = TOLERANCE,
    locked: Sequence[bool] | None = None,
    task: TaskVector | str | None = None,
) -> Work[Flow]:
    """Do the same as `transpose_flow`, with a rest after each step; arguments, result and errors are its own."""
    vector = checked_vector(arm, task)
    start, pair = joint_values(arm, q0, "q0"), checked_tolerance(tolerance)
    held = checked_locks(arm, locked) or [False] * arm.n
    problem = Problem(arm, as_pose(T, "T"), vector, [i for i in range(arm.n) if not held[i]], clamp=False)
    K, steps = _gains(gain, vector), _steps(duration, dt)
    points, status = [problem.at(start[None])], "going"
    for _ in range(steps):
        after, status = _stepped(problem, points[-1], K, dt, pair)
        if after is None:
            break
        points.append(after)
        yield
    with np.errstate(all="ignore"):
        return _flow(problem, points, K, dt, status if status != "going" else _status(problem, points[-1], K, pair))


def _stepped(
    problem: Problem, point: Point, K: Floats, dt: float, tolerance: tuple[float, float]
) -> tuple[Point | None, str]:
    """Return the task after one step and ``"going"``, or None and why the run ends before it."""
    # A run that is not stable grows beyond all numbers, which its status says.
    with np.errstate(all="ignore"):
        status = _status(problem, point, K, tolerance)
        if status != "going":
            return None, status
        after = _runge_kutta(problem, point.q, K, dt)
        if not np.isfinite(after).all() or np.max(np.abs(after)) > FARTHEST:
            return None, "unstable"
        return problem.at(after), status


def _runge_kutta(problem: Problem, q: Floats, K: Floats, dt: float) -> Floats:
    def rate(at: Floats) -> Floats:
        return _rate(problem.at(at), K)

    k1 = rate(q)
    k2 = rate(problem.land(q, 0.5 * dt * k1))
    k3 = rate(problem.land(q, 0.5 * dt * k2))
    k4 = rate(problem.land(q, dt * k3))
    return problem.land(q, dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4))


def _rate(point: Point, K: Floats) -> Floats:
    """Return J^T K e, (1, k), in scaled joints."""
    return np.asarray(np.einsum("bmk,bm->bk", point.J, K * point.e))


def _status(problem: Problem, point: Point, K: Floats, tolerance: tuple[float, float]) -> str:
    if within(problem, point, tolerance)[0]:
        return "converged"
    if not len(problem.free):
        return "locked"
    pull = np.linalg.norm(K * point.e)
    return "stuck" if np.linalg.norm(_rate(point, K)) <= FLAT * point.sigma_max[0] * pull else "going"


def _flow(problem: Problem, points: list[Point], K: Floats, dt: float, status: str) -> Flow:
    t: Floats = dt * np.arange(float(len(points)))
    e = np.concatenate([point.e for point in points])
    V = 0.5 * np.sum(K * e**2, axis=-1)
    V_dot = -np.array([float(np.sum(_rate(point, K) ** 2)) for point in points])
    largest = float(K.max()) * max(float(point.sigma_max[0]) for point in points) ** 2
    fast = dt * largest > STABLE
    if status in ("going", "unstable") and fast:
        status = "unstable"
    words: dict[str, tuple[FlowStatus, str]] = {
        "converged": ("converged", f"at the target after {t[-1]:.2f} s"),
        "locked": ("locked", "all joints are locked"),
        "stuck": ("stuck", "at rest, but not at the target: JᵀKe = 0"),
        "unstable": (
            "unstable",
            f"the time step is too long for this gain: dt K σ_max² = {dt * largest:.3g}, above {STABLE}",
        ),
        "going": ("going", f"not at the target after {t[-1]:.2f} s"),
    }
    final, reason = words[status]
    if problem.beyond and final in ("stuck", "going"):
        reason = "out of reach: farther than the fully stretched arm"
    return Flow(
        t=t,
        q=np.concatenate([point.q for point in points]),
        components=np.concatenate([point.misfit.components for point in points]),
        position_error=np.concatenate([point.misfit.position for point in points]),
        rotation_error=np.concatenate([point.misfit.rotation for point in points]),
        V=V,
        V_dot=V_dot,
        status=final,
        reason=reason,
        scaling=scaling(problem),
    )


def _gains(gain: ArrayLike, vector: TaskVector) -> Floats:
    values = as_floats(gain, "gain", f"a positive number or {vector.m} of them")
    if values.shape not in ((), (vector.m,)) or not np.all(np.isfinite(values) & (values > 0.0)):
        raise wrong("gain", f"a positive number or {vector.m} of them", gain)
    return vector.factors(np.broadcast_to(values, (vector.m,)), "gain")


def _steps(duration: float, dt: float) -> int:
    total, one = (float(finite_floats(v, w, (), "seconds")) for v, w in ((duration, "duration"), (dt, "dt")))
    if total < 0.0 or one <= 0.0 or total / one > MOST_STEPS:
        raise InputError(
            f"duration, dt: expected at most {MOST_STEPS} steps of positive length, got {total} s, {one} s"
        )
    return math.ceil(total / one - 1e-9)
