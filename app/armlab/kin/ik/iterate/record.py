"""One iteration with its full record."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats, whole_number
from armlab.kin.ik.iterate.loop import Fate, Stage, march
from armlab.kin.ik.iterate.method import IterationMethod, Parameters, iteration_method
from armlab.kin.ik.iterate.problem import Floats, Point, Problem, joined
from armlab.kin.ik.iterate.reasons import jumps_of, plain_verdict, scaling, verdict
from armlab.kin.ik.iterate.task_vector import TaskVector, task_vector
from armlab.kin.ik.iterate.trace import Status, Trace
from armlab.kin.ik.verdict import checked_locks, joint_values
from armlab.kin.transforms import as_pose

Damping = Callable[[Floats], Floats]
Limits = Literal["clamp", "none"]

TOLERANCE = (1e-6, 1e-6)
"""Errors, in metres and radians, within which a target counts as reached everywhere in the lab."""


def iterate(
    arm: Arm,
    T: ArrayLike,
    q0: ArrayLike,
    method: str = "dls_error",
    *,
    parameters: Mapping[str, float] | None = None,
    tolerance: tuple[float, float] = TOLERANCE,
    most: int = 200,
    limits: Limits = "clamp",
    weights: ArrayLike | None = None,
    locked: Sequence[bool] | None = None,
    task: TaskVector | str | None = None,
) -> Trace:
    """Run an iterative method for a lesson, with every step unchanged, and record everything.

    Parameters
    ----------
    arm : Arm
    T : array_like, shape (4, 4)
        Wanted pose of the tool in the world; what the task vector does not contain is ignored.
    q0 : array_like, shape (n,)
        Start, rad or m; moved inside the limits first when these are kept.
    method : str
        Key of a method: see `iteration_methods`.
    parameters : mapping, optional
        Parameters of the method by key.
    tolerance : (float, float)
        Metres and radians; both errors must be within.
    most : int
        Largest number of steps.
    limits : "clamp" or "none"
        Whether each step is cut off at the joint limits.
    weights : array_like, shape (m,), optional
        Positive factors of the components of the scaled error (metres over the length scale and radians where both
        occur); one for all components of an orientation.
    locked : sequence of bool, optional
        Joints that keep their value.
    task : TaskVector or str, optional
        See `task_vector`; the arm's task when left out.

    Returns
    -------
    Trace
        Also of an iteration that fails: why is in ``reason``.

    Raises
    ------
    InputError
        ``T`` is no pose, an unknown name, or shapes or numbers are wrong.

    Examples
    --------
    >>> from armlab.kin.transforms import transform
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)])
    >>> trace = iterate(arm, transform(position=[0.9, 0.7, 0.0]), [0.2, 1.0], "newton")
    >>> trace.reason, trace.q[-1].round(6).tolist()
    ('converged in 4 steps', [-0.303141, 1.928367])
    """
    chosen, vector = iteration_method(method), checked_vector(arm, task)
    values, start = chosen.values(parameters), joint_values(arm, q0, "q0")
    pair, steps = checked_tolerance(tolerance), whole_number(most, "most", 0)
    held = checked_locks(arm, locked) or [False] * arm.n
    free = [i for i in range(arm.n) if not held[i]]
    clamp = keeps_limits(limits)
    problem = Problem(arm, as_pose(T, "T"), vector, free, weights, clamp, chosen.chord)
    if clamp:
        start[free] = arm.clip(start)[free]
    why_not = unfit(chosen, vector, len(free))
    stages = list(march(problem, chosen, values, start[None], 0 if why_not else steps, pair))
    return filmed(problem, chosen, values, stages, why_not=why_not)


def unfit(method: IterationMethod, vector: TaskVector, free: int) -> tuple[Status, str] | None:
    """Return the status and the reason why a method cannot start; None when it can."""
    if not free:
        return "locked", "all joints are locked"
    if free < vector.m and not method.tall:
        counts = f"{vector.m} task components, {free} free joint{'s' if free > 1 else ''}"
        return "unfit", f"{method.title} needs as many joints as task components ({counts}): Gauss–Newton does not"
    return None


def filmed(
    problem: Problem,
    method: IterationMethod,
    parameters: Parameters,
    stages: Sequence[Stage],
    row: int = 0,
    why_not: tuple[Status, str] | None = None,
) -> Trace:
    """Return the record of one of the starts of a march.

    Parameters
    ----------
    row : int
        Index of the start.
    why_not : tuple, optional
        Status and reason when the method could not begin.
    """
    at = [(stage, int(found[0])) for stage in stages if len(found := np.flatnonzero(stage.rows == row))]
    points = joined([stage.point.take(np.array([i])) for stage, i in at])
    fate = Fate(int(at[-1][0].fate[at[-1][1]]))
    cost, jumps = _cost(problem, points), jumps_of(problem, np.diff(points.q, axis=0))
    if why_not and fate != Fate.CONVERGED:
        status, reason = why_not
    else:
        status, reason = verdict(problem, method, parameters, fate, points, cost, jumps)
    objective = None if method.objective is None else method.objective(problem, points.q)
    damping = np.array([stage.damping[i] for stage, i in at[:-1]], dtype=float)
    return _trace(problem, method.key, parameters, points, damping, status, reason, objective)


def replayed(
    problem: Problem, key: str, parameters: Parameters, path: Floats, damping: Damping | None, converged: bool
) -> Trace:
    """Return the record of iterates (k + 1, n) that were computed elsewhere.

    Parameters
    ----------
    key, parameters
        What they were computed with.
    damping : callable, optional
        ``damping(e^T e (k,)) -> (k,)``.
    converged : bool
        Whether the last is a solution.
    """
    points = problem.at(path)
    cost, jumps = _cost(problem, points), jumps_of(problem, np.diff(path, axis=0))
    added = np.zeros(len(path) - 1) if damping is None else damping(2.0 * cost[:-1])
    status, reason = plain_verdict(problem, converged, points, cost, jumps)
    return _trace(problem, key, parameters, points, added, status, reason, None)


def _trace(
    problem: Problem,
    key: str,
    parameters: Parameters,
    points: Point,
    damping: Floats,
    status: Status,
    reason: str,
    objective: Floats | None,
) -> Trace:
    step = np.diff(points.q, axis=0)
    return Trace(
        method=key,
        parameters=dict(parameters),
        q=_settled(points.q),
        components=_settled(points.misfit.components),
        position_error=_settled(points.misfit.position),
        rotation_error=_settled(points.misfit.rotation),
        step=_settled(step),
        sigma_min=_settled(points.sigma_min),
        sigma_max=_settled(points.sigma_max),
        w=_settled(points.w),
        damping=_settled(damping),
        cost=_settled(_cost(problem, points)),
        objective=None if objective is None else _settled(objective),
        status=status,
        reason=reason,
        jumps=jumps_of(problem, step),
        names=problem.vector.names,
        kinds=problem.kinds,
        length=problem.length,
        scaling=scaling(problem),
    )


def _cost(problem: Problem, points: Point) -> Floats:
    # Targets at the end of the numbers have an infinite square, and that is what the record says.
    with np.errstate(all="ignore"):
        return problem.half_square(points.e)


def _settled(values: NDArray[np.float64]) -> NDArray[np.float64]:
    own = np.array(values)
    own.setflags(write=False)
    return own


def checked_vector(arm: Arm, task: TaskVector | str | None) -> TaskVector:
    """Return a task vector that fits the arm; `InputError` when it does not."""
    if not isinstance(task, TaskVector):
        return task_vector(arm, task)
    return task_vector(arm, task.task, joints=dict(task.joints), euler=task.euler, fixed=task.fixed)


def checked_tolerance(tolerance: tuple[float, float]) -> tuple[float, float]:
    """Return metres and radians, both positive; `InputError` otherwise."""
    metres, radians = finite_floats(tolerance, "tolerance", (2,), "two positive numbers, metres and radians").tolist()
    if metres <= 0.0 or radians <= 0.0:
        raise InputError(f"tolerance: expected two positive numbers, metres and radians, got {tolerance}")
    return metres, radians


def keeps_limits(limits: str) -> bool:
    """Return whether joint limits are kept; `UnknownName` for an unknown word."""
    if limits not in ("clamp", "none"):
        raise UnknownName("limits", limits, ("clamp", "none"))
    return limits == "clamp"
