"""The film of a run for the panel, the plots and the scene, made once for each run and question."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import count
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.iterate.runs.worked import methods
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.iterate import Flow, TaskVector, iteration_method
from armlab.kin.ik.iterate.flow import flowing
from armlab.kin.ik.iterate.loop import march
from armlab.kin.ik.iterate.problem import Problem
from armlab.kin.ik.iterate.record import TOLERANCE, Limits, checked_vector, filmed, unfit
from armlab.kin.transforms import as_pose
from armlab.kin.work import Work, result_of

Floats = NDArray[np.float64]

PIECE, FLOW_PIECE = 2, 20
"""Number of steps between two rests: some 20 ms for coordinate descent on seven joints, less for most methods and for a
flow."""

MOST_SHOWN = 50
"""Largest number of instants of a flow that are shown as iterates."""


class Question(NamedTuple):
    """All arguments of a run; equal questions have equal answers.

    Attributes
    ----------
    arm : Arm
    target : bytes
        Of the pose (4, 4).
    start : tuple of float
    locked : tuple of bool
    task : TaskVector or None
    limits : "clamp" or "none"
    most : int
    method : str
    parameters : tuple of (str, float)
    """

    arm: Arm
    target: bytes
    start: tuple[float, ...]
    locked: tuple[bool, ...]
    task: TaskVector | None
    limits: Limits
    most: int
    method: str
    parameters: tuple[tuple[str, float], ...]


@dataclass(frozen=True, eq=False)
class Film:
    """A run with k + 1 iterates, or instants of a flow.

    Attributes
    ----------
    question : Question
    q : ndarray, shape (k + 1, n)
        rad or m; angles are not wrapped.
    way : ndarray, shape (k + 1, 3)
        The tool point in the world.
    position_error, rotation_error : ndarray, shape (k + 1,)
        Metres and radians, of what the task controls.
    components : ndarray, shape (k + 1, m)
        Error of each task component, `names` and `kinds` say of what.
    step : ndarray, shape (k, n)
        Joint changes.
    status, reason, scaling : str
        As of `Trace` and `Flow`; status ``"refused"`` when there is nothing to run.
    sigma_min, damping : ndarray, shapes (k + 1,) and (k,), or None
        None of a flow; damping also of methods that have none.
    sigma_unit : str
        Of singular values, ``"m"`` or none.
    t, V, V_dot : ndarray, shape (k + 1,), or None
        Seconds, Lyapunov function and its derivative in 1/s; None of a method that takes steps.
    """

    question: Question
    q: Floats
    way: Floats
    position_error: Floats
    rotation_error: Floats
    components: Floats
    names: tuple[str, ...]
    kinds: tuple[str, ...]
    step: Floats
    status: str
    reason: str
    scaling: str
    sigma_min: Floats | None = None
    damping: Floats | None = None
    sigma_unit: str = ""
    t: Floats | None = None
    V: Floats | None = None
    V_dot: Floats | None = None

    @cached_property
    def step_lengths(self) -> tuple[Floats, Floats]:
        """Lengths of the steps of revolute and of prismatic joints, rad and m, (k,)."""
        turns = self.question.arm.revolute
        return np.linalg.norm(self.step[:, turns], axis=1), np.linalg.norm(self.step[:, ~turns], axis=1)

    @property
    def last(self) -> int:
        """Number of the last iterate."""
        return len(self.q) - 1

    @property
    def success(self) -> bool:
        """Whether the target is reached."""
        return self.status == "converged"


def film_of(question: Question) -> Film:
    """Return the film of a run; a run that cannot begin has one picture, with the reason."""
    return result_of(making(question))


def making(question: Question) -> Work[Film]:
    """Make a film in pieces of some 30 ms at most, and return it at the end."""
    try:
        if methods()[question.method].flow:
            return (yield from _flow(question))
        return (yield from _steps(question))
    except InputError as refusal:
        return _refused(question, str(refusal))


def target_of(question: Question) -> Floats:
    """Return the target pose, (4, 4)."""
    return np.frombuffer(question.target).reshape(4, 4).copy()


def _steps(question: Question) -> Work[Film]:
    """Do the same as `armlab.kin.ik.iterate.iterate`, with rests."""
    arm, method = question.arm, iteration_method(question.method)
    vector, values = checked_vector(arm, question.task), method.values(dict(question.parameters))
    free = [i for i in range(arm.n) if not question.locked[i]]
    clamp, start = question.limits == "clamp", np.array(question.start)
    if clamp:
        start[free] = arm.clip(start)[free]
    problem = Problem(arm, as_pose(target_of(question), "target"), vector, free, None, clamp, method.chord)
    why_not = unfit(method, vector, len(free))
    stages = []
    for stage in march(problem, method, values, start[None], 0 if why_not else question.most, TOLERANCE):
        stages.append(stage)
        if len(stages) % PIECE == 0:
            yield
    trace = filmed(problem, method, values, stages, 0, why_not)
    return Film(
        question=question,
        q=trace.q,
        way=_way(arm, trace.q),
        position_error=trace.position_error,
        rotation_error=trace.rotation_error,
        components=trace.components,
        names=trace.names,
        kinds=trace.kinds,
        step=trace.step,
        sigma_min=trace.sigma_min,
        damping=trace.damping if np.any(trace.damping > 0.0) else None,
        status=trace.status,
        reason=trace.reason,
        scaling=trace.scaling,
        sigma_unit=problem.sigma_unit,
    )


def _flow(question: Question) -> Work[Film]:
    """Do the same as `armlab.kin.ik.iterate.transpose_flow`, with rests."""
    arm, parameters, vector = question.arm, dict(question.parameters), question.task or TaskVector(question.arm.task)
    work = flowing(
        arm,
        target_of(question),
        question.start,
        gain=parameters["gain"],
        duration=parameters["duration"],
        dt=parameters["dt"],
        locked=question.locked,
        task=question.task,
    )
    for step in count(1):
        try:
            next(work)
        except StopIteration as done:
            flow: Flow = done.value
            break
        if step % FLOW_PIECE == 0:
            yield
    pick = np.unique(np.linspace(0, len(flow.t) - 1, min(len(flow.t), MOST_SHOWN + 1)).round().astype(int))
    q = flow.q[pick]
    return Film(
        question=question,
        q=q,
        way=_way(arm, q),
        position_error=flow.position_error[pick],
        rotation_error=flow.rotation_error[pick],
        components=flow.components[pick],
        names=vector.names,
        kinds=vector.kinds(arm),
        step=np.diff(q, axis=0),
        t=flow.t[pick],
        V=flow.V[pick],
        V_dot=flow.V_dot[pick],
        status=flow.status,
        reason=flow.reason,
        scaling=flow.scaling,
    )


def _refused(question: Question, why: str) -> Film:
    q = np.array([question.start])
    vector, nothing = question.task or TaskVector(question.arm.task), np.full(1, np.nan)
    return Film(
        question=question,
        q=q,
        way=_way(question.arm, q),
        position_error=nothing,
        rotation_error=nothing,
        components=np.full((1, vector.m), np.nan),
        names=vector.names,
        kinds=vector.kinds(question.arm),
        step=np.zeros((0, question.arm.n)),
        status="refused",
        reason=why,
        scaling="",
    )


def _way(arm: Arm, q: Floats) -> Floats:
    return np.array(arm.position(q), dtype=np.float64).reshape(len(q), 3)
