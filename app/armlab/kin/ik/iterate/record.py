"""One iteration with its full record."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats, whole_number
from armlab.kin.ik.iterate.loop import Fate, Stage, march
from armlab.kin.ik.iterate.method import IterationMethod, Parameters, iteration_method
from armlab.kin.ik.iterate.problem import Floats, Point, Problem
from armlab.kin.ik.iterate.reasons import jumps_of, scaling, verdict
from armlab.kin.ik.iterate.task_vector import TaskVector, task_vector
from armlab.kin.ik.iterate.trace import Status, Trace
from armlab.kin.ik.verdict import checked_locks, joint_values
from armlab.kin.transforms import as_pose

Limits = Literal["clamp", "none"]

TOLERANCE = (1e-6, 1e-6)
"""Metres and radians within which a target counts as reached, as everywhere in the lab."""


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
    """Run an iterative method as a lesson shows it, every step as it comes, and record everything.

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
        Positive factors of the components of the error.
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
    unfit = _unfit(chosen, vector, len(free))
    film = _Film()
    for stage in march(problem, chosen, values, start[None], 0 if unfit else steps, pair):
        film.add(stage)
    return film.trace(problem, chosen, values, unfit)


def _unfit(method: IterationMethod, vector: TaskVector, free: int) -> tuple[Status, str] | None:
    """Return why a method cannot begin; None when it can."""
    if not free:
        return "locked", "all joints are locked"
    if free < vector.m and not method.tall:
        counts = f"{vector.m} task components, {free} free joint{'s' if free > 1 else ''}"
        return "unfit", f"{method.title} needs as many joints as task components ({counts}): Gauss–Newton does not"
    return None


class _Row(NamedTuple):
    point: Point
    landed: Floats
    damping: float


class _Film:
    """The stages of one iteration."""

    def __init__(self) -> None:
        self.rows: list[_Row] = []
        self.fate = Fate.MOST

    def add(self, stage: Stage) -> None:
        """Take one more iterate."""
        self.rows.append(_Row(stage.point, stage.landed[0], float(stage.damping[0])))
        self.fate = Fate(int(stage.fate[0]))

    def trace(
        self,
        problem: Problem,
        method: IterationMethod,
        parameters: Parameters,
        unfit: tuple[Status, str] | None,
    ) -> Trace:
        """Return the record."""
        points = [row.point for row in self.rows]
        q = np.concatenate([point.q for point in points])
        step, sigma_max = np.diff(q, axis=0), np.concatenate([point.sigma_max for point in points])
        cost = np.concatenate([problem.half_square(point.e) for point in points])
        jumps = jumps_of(problem, step)
        if unfit and self.fate != Fate.CONVERGED:
            status, reason = unfit
        else:
            status, reason = verdict(problem, method, parameters, self.fate, points[-1], sigma_max, cost, jumps)
        return Trace(
            method=method.key,
            parameters=dict(parameters),
            q=_settled(q),
            components=_settled(np.concatenate([point.misfit.components for point in points])),
            position_error=_settled(np.concatenate([point.misfit.position for point in points])),
            rotation_error=_settled(np.concatenate([point.misfit.rotation for point in points])),
            step=_settled(step),
            sigma_min=_settled(np.concatenate([point.sigma_min for point in points])),
            sigma_max=_settled(sigma_max),
            w=_settled(np.concatenate([_volume(point) for point in points])),
            damping=_settled(np.array([row.damping for row in self.rows[:-1]])),
            cost=_settled(cost),
            objective=None if method.objective is None else _settled(method.objective(problem, q)),
            status=status,
            reason=reason,
            jumps=jumps,
            names=problem.vector.names,
            kinds=problem.kinds,
            length=problem.length,
            scaling=scaling(problem),
        )


def _volume(point: Point) -> Floats:
    """Return the product of the singular values (1,); 0 without any."""
    return np.asarray(np.prod(point.sigma, axis=-1) if point.sigma.shape[1] else np.zeros(len(point.q)))


def _settled(values: NDArray[np.float64]) -> NDArray[np.float64]:
    values.setflags(write=False)
    return values


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
    """Return whether joint limits are kept; `UnknownName` for another word."""
    if limits not in ("clamp", "none"):
        raise UnknownName("limits", limits, ("clamp", "none"))
    return limits == "clamp"
