"""Inverse kinematics step by step: start, target, task vector and runs, and the films of the runs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.iterate.runs.arms import Arms, Asked
from armlab.benches.iterate.runs.films import Film, Question
from armlab.benches.iterate.runs.worked import MOST_RUNS, Run, fitting, refitted, run_of
from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats
from armlab.kin.ik.iterate import TaskVector, task_vector
from armlab.kin.ik.iterate.record import Limits
from armlab.kin.task import task_named
from armlab.kin.transforms import as_pose
from armlab.session.fields import EXAMPLE, FieldPart, choice, own, text, vector, whole
from armlab.session.parts.joints import Joints, of_its_kind
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import FARTHEST, Target
from armlab.session.parts.timeline import Timeline, clips, with_clip
from armlab.session.run_targets import checked_target, first_start, first_target, newton_for
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Command, Json, PartType, State

CLIP_KEY = "iterations"

MOST_STEPS = 500
"""Largest number of steps of a run: the notes' examples need a tenth of it, the gradient near a stretched arm all of
it."""

STEPS = 60
"""Initial largest number of steps of a run."""


Floats = NDArray[np.float64]


def _read_q(data: Json) -> tuple[float, ...] | None:
    return None if data is None else tuple(map(float, data))


def _read_runs(data: Json) -> tuple[Run, ...]:
    return tuple(each if isinstance(each, Run) else run_of(*each) for each in data)


def _read_task(data: Json) -> TaskVector | None:
    if data is None or isinstance(data, TaskVector):
        return data
    return TaskVector(task_named(data["task"]), tuple((int(i), float(q)) for i, q in data["joints"]), data["euler"])


def _written(task: TaskVector | None) -> Json:
    if task is None:
        return None
    return {"task": task.task.key, "joints": [list(each) for each in task.joints], "euler": task.euler}


@dataclass(frozen=True, eq=False)
class Iterations(FieldPart):
    """A problem of inverse kinematics and up to four methods for its solution.

    Attributes
    ----------
    robot : Robot
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
        Whether each step is stopped at the joint limits. Flows never do.
    most : int
        Largest number of steps.
    example : str
        Key of the loaded example; empty if it has been changed or there is none.
    before : tuple of float or None
        Where the arm stood when the film was put on; None while it is not on.
    films : dict
        What the runs have given, by their colour; may be of a question that has passed. Not saved.
    arms : Arms or None
        The solutions of a task vector with joints in it, when they have been looked for. Not saved.
    """

    key: ClassVar[str] = "iterations"
    leave_example: ClassVar[tuple[str, ...]] = (EXAMPLE, "selected")

    robot: Robot
    start: tuple[float, ...] = vector("q_0", "start", kept="joints")
    target: Floats = own("target", None, lambda pose: as_pose(pose, "target"), kept="edits")
    task: TaskVector | None = own("task vector", None, _read_task, _written, kept="")
    runs: tuple[Run, ...] = own("runs", (), _read_runs, lambda runs: [run.to_json() for run in runs])
    selected: int = whole("selected run", 0, 0)
    limits: Limits = choice("joint limits", "clamp", ("clamp", "none"))
    most: int = whole("largest number of steps", STEPS, 1, MOST_STEPS)
    example: str = text("example", kept="")
    before: tuple[float, ...] | None = own("where the arm stood", None, _read_q, kept="")
    films: Mapping[int, Film] = field(default_factory=dict)
    arms: Arms | None = None

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the first example of a lecture: to a near target, by Newton's method and by the gradient."""
        arm = robot.arm
        runs = (
            run_of(newton_for(arm)),
            fitting("gradient", arm, TaskVector(arm.task), colour=1),
        )
        return cls(robot, tuple(map(float, first_start(robot))), first_target(robot), runs=runs)

    def check(self) -> None:
        """Refuse values that are impossible for this arm, and runs that cannot be told apart."""
        for q in (self.start,) if self.before is None else (self.start, self.before):
            checked_start(self.robot.arm, q)
        checked_target(self.robot, self.target)
        if self.task is not None:
            fitted(self.robot.arm, self.task)
        if not 1 <= len(self.runs) == len({run.colour for run in self.runs}) <= MOST_RUNS:
            raise InputError(f"runs: expected 1 to {MOST_RUNS}, each with a colour of its own, got {len(self.runs)}")
        if self.selected >= len(self.runs):
            raise InputError(f"selected: expected 0 to {len(self.runs) - 1}, got {self.selected}")

    def for_robot(self, robot: Robot) -> Self:
        """Keep the runs and their parameters, except step sizes: one that suits an arm may diverge with another."""
        return replace(super().for_robot(robot), runs=tuple(refitted(run, robot.arm) for run in self.runs))

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep target and start; a chosen task vector is dropped with the joints it was made for."""
        kept = super().for_edited(robot, origin)
        if kept is self:
            return self
        kept = replace(kept, start=of_its_kind(kept.start, self.robot.arm, robot, origin))
        same = origin == tuple(range(len(self.start))) and np.array_equal(robot.arm.revolute, self.robot.arm.revolute)
        return replace(kept, task=self.task) if same else kept

    def after(self, before: State, now: State) -> Self:
        """Follow the target of the lab, and forget the earlier configuration when the film is closed.

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

    @property
    def run(self) -> Run:
        """The selected run."""
        return self.runs[self.selected]

    @property
    def film(self) -> Film | None:
        """Film of the selected run, as far as it is known."""
        return self.films.get(self.run.colour)


PART = PartType(Iterations, order=97)


def vector_of(state: State) -> TaskVector:
    """Return the task vector of the runs."""
    return state[Iterations].task or TaskVector(state[Joints].arm.task)


def questions(state: State) -> tuple[Question, ...]:
    """Return the question of each run."""
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
    """Return the request for the arms of the task vector, or None for one without joints in it."""
    part, joints = state[Iterations], state[Joints]
    if part.task is None or not part.task.joints:
        return None
    held = tuple(value if locked else None for value, locked in zip(joints.q.tolist(), joints.locked, strict=True))
    return Asked(joints.arm, part.target.tobytes(), part.task, held)


def arms_found(state: State) -> Floats:
    """Return the known solutions of the task vector, (k, n)."""
    part = state[Iterations]
    known = part.arms is not None and part.arms.asked == state.derived(arms_asked)
    return part.arms.q if known and part.arms is not None else np.zeros((0, state[Joints].arm.n))


def checked_start(arm: Arm, q: ArrayLike) -> tuple[float, ...]:
    """Return a start; `InputError` unless it is one number for each joint, inside its possible values."""
    values = finite_floats(q, "start", (arm.n,), f"{arm.n} finite joint values")
    most = np.where(arm.revolute, MOST_TURNED, FARTHEST * arm.length_scale)
    if np.any(np.abs(values) > most):
        raise InputError("start: a joint cannot take this value; expected at most ten turns")
    return tuple(values.tolist())


def fitted(arm: Arm, task: TaskVector) -> TaskVector:
    """Return a task vector for an arm; `InputError` if the arm cannot have it."""
    return task_vector(arm, task.task, joints=dict(task.joints), euler=task.euler, fixed=task.fixed)


# -- commands --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class StartIterations(Command):
    """Begin all runs at a configuration and open their film at its start.

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
    """Return the state with the arm at its place in the film, if the film is open."""
    timeline = state[Timeline]
    return clips()[CLIP_KEY].at(state, timeline.time) if timeline.clip == CLIP_KEY else state
