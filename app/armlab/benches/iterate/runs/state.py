"""Inverse kinematics step by step: start, target, task vector and runs, and the film of what they give."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.iterate.runs.arms import Arms, Asked
from armlab.benches.iterate.runs.films import Film, Question
from armlab.benches.iterate.runs.worked import MOST_RUNS, Run, fitting, refitted, run_of
from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats
from armlab.kin.ik.iterate import TaskVector, task_vector
from armlab.kin.ik.iterate.record import Limits
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import FARTHEST, Target
from armlab.session.parts.timeline import Timeline, clips, with_clip
from armlab.session.run_targets import checked_target, first_target
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Command, Json, Part, PartType, State

CLIP_KEY = "iterations"

MOST_STEPS = 500
"""Of a run; the notes' examples need a tenth of it, the gradient beside a stretched arm all of it."""

STEPS = 60
"""Of a run until somebody asks for more."""


Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Iterations(Part):
    """A problem of inverse kinematics and up to four methods that set out to solve it.

    Attributes
    ----------
    start : tuple of float
        Where every run begins, rad or m.
    target : ndarray, shape (4, 4)
        Wanted pose of the tool in the world; it follows the target of the lab when that is moved.
    task : TaskVector or None
        Which components are driven to their wanted values; None for those of the arm's own task.
    runs : tuple of Run
    selected : int
        The run whose film is played.
    limits : "clamp" or "none"
        Whether each step ends at the joint limits. Flows never do.
    most : int
        Largest number of steps.
    example : str
        Key of the example that is in place as it was put there; empty when it is none.
    before : tuple of float or None
        Where the arm stood when the film was put on; None while it is not on.
    films : dict
        What the runs have given, by their colour; may be of a question that has passed. Not saved.
    arms : Arms or None
        The solutions of a task vector with joints in it, when they have been looked for. Not saved.
    """

    key: ClassVar[str] = "iterations"

    start: tuple[float, ...]
    target: Floats
    task: TaskVector | None = None
    runs: tuple[Run, ...] = ()
    selected: int = 0
    limits: Limits = "clamp"
    most: int = STEPS
    example: str = ""
    before: tuple[float, ...] | None = None
    films: Mapping[int, Film] = field(default_factory=dict)
    arms: Arms | None = None

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the first step of a lecture: from home to a target not far away, by Newton and by the gradient."""
        arm = robot.arm
        runs = (
            run_of("gauss_newton" if arm.n < arm.task.m else "newton"),
            fitting("gradient", arm, TaskVector(arm.task), colour=1),
        )
        return cls(tuple(map(float, robot.home)), first_target(robot), runs=runs)

    def for_robot(self, robot: Robot) -> Self:
        """Keep the runs and how they are made, but for step sizes: what suits one arm is wild with another."""
        runs = tuple(refitted(run, robot.arm) for run in self.runs)
        return replace(self.initial(robot), runs=runs, selected=self.selected, limits=self.limits, most=self.most)

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep target and start; the choice of a task vector falls with the joints it was made for."""
        q = np.array(robot.home, dtype=float)
        for i, was in enumerate(origin):
            if was is not None and was < len(self.start):
                q[i] = self.start[was]
        same = origin == tuple(range(len(self.start)))
        task = self.task if same else None
        # Films are of an arm; those of the edited one are made anew.
        return replace(self, start=tuple(q.tolist()), task=task, example="", before=None, films={}, arms=None)

    def after(self, before: State, now: State) -> Self:
        """Follow the target of the lab, and forget where the arm stood when the film is taken off.

        Another arm may come with a target of its own, as in a lesson: then start where it stands.
        """
        part, pose = self, now[Target].pose
        moved = pose is not None and pose is not before[Target].pose
        if moved and pose is not None and not np.array_equal(pose, self.target):
            if self is before[Iterations]:
                part = replace(part, target=pose, example="")
            elif np.array_equal(self.target, first_target(now[RobotPart].robot)):
                part = replace(part, target=pose, start=tuple(now[Joints].q.tolist()))
        if part.before is not None and now[Timeline].clip != CLIP_KEY:
            part = replace(part, before=None)
        return part

    def to_json(self) -> Json:
        """Write everything but what the runs have given."""
        return {
            "start": list(self.start),
            "target": self.target.tolist(),
            "task": _task_to_json(self.task),
            "runs": [run.to_json() for run in self.runs],
            "selected": self.selected,
            "limits": self.limits,
            "most": self.most,
            "example": self.example,
            "before": None if self.before is None else list(self.before),
        }

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; raises when it is not usable with this arm."""
        opened = cls.initial(robot)
        runs = tuple(run_of(*each) for each in data["runs"]) if "runs" in data else opened.runs
        colours = {run.colour for run in runs}
        selected, before = int(data.get("selected", 0)), data.get("before")
        if not 1 <= len(runs) == len(colours) <= MOST_RUNS or not 0 <= selected < len(runs):
            raise InputError(f"iterations: not usable: {data}")
        return cls(
            start=checked_start(robot.arm, data.get("start", opened.start)),
            target=checked_target(robot, data.get("target", opened.target)),
            task=_task_from_json(data.get("task"), robot),
            runs=runs,
            selected=selected,
            limits=checked_limits(data.get("limits", opened.limits)),
            most=checked_most(data.get("most", opened.most)),
            example=str(data.get("example", "")),
            before=None if before is None else checked_start(robot.arm, before),
        )

    @property
    def run(self) -> Run:
        """The selected run."""
        return self.runs[self.selected]

    @property
    def film(self) -> Film | None:
        """What the selected run has given, as far as it is known."""
        return self.films.get(self.run.colour)


PART = PartType(Iterations, order=97)


def vector_of(state: State) -> TaskVector:
    """Return the task vector the runs work with."""
    return state[Iterations].task or TaskVector(state[Joints].arm.task)


def questions(state: State) -> tuple[Question, ...]:
    """Return what each run has to answer."""
    part, joints = state[Iterations], state[Joints]
    start = np.where(joints.locked, joints.q, part.start)
    shared = (
        joints.arm,
        part.target.tobytes(),
        tuple(start.tolist()),
        joints.locked,
        part.task,
        part.limits,
        part.most,
    )
    return tuple(Question(*shared, run.method, run.parameters) for run in part.runs)


def arms_asked(state: State) -> Asked | None:
    """Return what is to be known of the arms of the task vector; None for one without joints in it."""
    part, joints = state[Iterations], state[Joints]
    if part.task is None or not part.task.joints:
        return None
    held = tuple(value if locked else None for value, locked in zip(joints.q.tolist(), joints.locked, strict=True))
    return Asked(joints.arm, part.target.tobytes(), part.task, held)


def arms_found(state: State) -> Floats:
    """Return the solutions of the task vector as far as they are known, (k, n)."""
    part = state[Iterations]
    known = part.arms is not None and part.arms.asked == state.derived(arms_asked)
    return part.arms.q if known and part.arms is not None else np.zeros((0, state[Joints].arm.n))


def checked_start(arm: Arm, q: ArrayLike) -> tuple[float, ...]:
    """Return a start; `InputError` when it is not one number for each joint that a joint can stand at."""
    values = finite_floats(q, "start", (arm.n,), f"{arm.n} finite joint values")
    most = np.where(arm.revolute, MOST_TURNED, FARTHEST * arm.length_scale)
    if np.any(np.abs(values) > most):
        raise InputError("start: a joint cannot stand there; expected at most ten turns")
    return tuple(values.tolist())


def checked_limits(limits: str) -> Limits:
    """Return whether limits are kept; `UnknownName` for another word."""
    if limits == "clamp":
        return "clamp"
    if limits == "none":
        return "none"
    raise UnknownName("limits", limits, ("clamp", "none"))


def checked_most(most: float) -> int:
    """Return a largest number of steps; `InputError` when it is none."""
    if not (math.isfinite(most) and most == int(most) and 1 <= most <= MOST_STEPS):
        raise InputError(f"most iterations: expected a whole number from 1 to {MOST_STEPS}, got {most:g}")
    return int(most)


def _task_to_json(task: TaskVector | None) -> Json:
    if task is None:
        return None
    return {"task": task.task.key, "joints": [list(each) for each in task.joints], "euler": task.euler}


def _task_from_json(data: Json, robot: Robot) -> TaskVector | None:
    if data is None:
        return None
    joints = {int(joint): float(value) for joint, value in data["joints"]}
    return task_vector(robot.arm, data["task"], joints=joints, euler=data["euler"])


# -- commands --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class StartIterations(Command):
    """Begin all runs at a configuration and put their film on, at its beginning.

    Parameters
    ----------
    q : tuple of float
        rad or m; outside the joint limits, too.
    """

    q: tuple[float, ...]
    label: ClassVar[str] = "start of the iterations"

    def apply(self, state: State) -> State:
        """Return the state with the start set and the film at its first picture."""
        start = checked_start(state[Joints].arm, self.q)
        # Without the films of another start the arm stands at this one until they are made.
        begun = replace(state[Iterations], start=start, example="", films={})
        return with_clip(state.replace(begun), CLIP_KEY)


def on_film(state: State) -> State:
    """Return the state with the arm where the film has it, if it is on."""
    timeline = state[Timeline]
    return clips()[CLIP_KEY].at(state, timeline.time) if timeline.clip == CLIP_KEY else state
