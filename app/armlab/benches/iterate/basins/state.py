"""Basins of attraction: the settings of the map, the request that is being computed, and the map so far.

Target and task vector are those of the film of iterations: a film begun at a point of the map answers the same
question.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from armlab.benches.iterate.basins.maps import Map, Question
from armlab.benches.iterate.runs.commands import ChooseTask
from armlab.benches.iterate.runs.state import (
    MOST_STEPS,
    Iterations,
    StartIterations,
    checked_start,
    vector_of,
)
from armlab.benches.iterate.runs.worked import Run, fitting, refitted, run_of
from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.iterate import TaskVector, iteration_method, task_vector
from armlab.kin.ik.iterate.record import Limits
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.task import Task
from armlab.session.fields import FieldPart, choice, own, setting, vector
from armlab.session.parts.joints import Joints, of_its_kind
from armlab.session.state import Command, Json, PartType, State

POINTS = (64, 128, 256)
"""Numbers of starts along a side of a map that can be chosen."""

STEPS = (50, 100, 200, MOST_STEPS)
"""Largest numbers of steps that can be chosen; a film has as many at most."""


def _read_run(data: Json) -> Run:
    """Return a run as it is, or read from JSON."""
    method, parameters, *_ = data.to_json() if isinstance(data, Run) else data
    iteration_method(method)  # a flow has no steps to be counted
    return run_of(method, parameters)


def _read_pair(data: Json) -> tuple[int, int]:
    across, up = data
    return int(across), int(up)


@dataclass(frozen=True, eq=False)
class Basins(FieldPart):
    """The settings of the next map, the map that is being computed, and the present one.

    Attributes
    ----------
    arm : Arm
    run : Run
        Method and parameters; its colour does not matter.
    joints : (int, int)
        0-based; the joints that vary across and up.
    rest : tuple of float
        Start values of the others, rad or m; one number for each joint.
    points, most : int
        Starts along either side, and largest number of steps.
    limits : "clamp" or "none"
    drawing : Question or None
        What is being computed.
    map : Map or None
        The last one, as far as it came; not saved.
    """

    key: ClassVar[str] = "basins"
    kept_by_undo: ClassVar[bool] = True

    arm: Arm
    run: Run = own("method", None, _read_run, Run.to_json, kept="edits")
    joints: tuple[int, int] = own("joints across and up", (), _read_pair, kept="")
    rest: tuple[float, ...] = vector("q", "start values", kept="joints")
    points: int = choice("starts along either side", POINTS[1], POINTS)
    most: int = choice("largest number of steps", STEPS[2], STEPS)
    limits: Limits = choice("joint limits", "none", ("clamp", "none"))
    drawing: Question | None = None
    map: Map | None = None

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return Newton's method over the first two joints that do more than turn the whole arm."""
        return cls(robot.arm, run_of("newton"), _first_joints(robot.arm), tuple(map(float, robot.home)))

    def check(self) -> None:
        """Refuse joints that the arm does not have, and start values that a joint cannot take."""
        _check_joints(self.arm, *self.joints)
        checked_start(self.arm, self.rest)

    def for_robot(self, robot: Robot) -> Self:
        """Keep the method, with a step size that suits the arm, and the resolution of the map."""
        return replace(super().for_robot(robot), run=refitted(self.run, robot.arm))

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep also joints and start values of joints that are still there; the map of the earlier arm is dropped."""
        kept = super().for_edited(robot, origin)
        if kept is self:
            return self
        kept = replace(kept, rest=of_its_kind(kept.rest, self.arm, robot, origin))
        across, up = (origin.index(joint) if joint in origin else -1 for joint in self.joints)
        # An arm of one joint has but one for both axes.
        return replace(kept, joints=(across, up)) if min(across, up) >= 0 and across != up else kept

    @property
    def finished(self) -> Map | None:
        """The map, if every start has been tried."""
        return self.map if self.map is not None and self.map.finished else None


PART = PartType(Basins, order=98)

ONE_JOINT = "a map needs two joints that move, and this arm has only one"


def question_of(state: State) -> Question:
    """Return the request for a map with the present settings; locked joints keep their present values."""
    part, joints, problem = state[Basins], state[Joints], state[Iterations]
    rest = np.where(joints.locked, joints.q, part.rest)
    return Question(
        joints.arm,
        problem.target.tobytes(),
        vector_of(state),
        part.run,
        part.joints,
        tuple(rest.tolist()),
        joints.locked,
        part.limits,
        part.most,
        part.points,
    )


def refusal(state: State) -> str:
    """Return why there can be no map with the present settings, or an empty text."""
    locked = state[Joints].locked
    if len(locked) < 2:
        return ONE_JOINT
    if not has_joints_to_spare(state) and not any(locked[joint] for joint in state[Basins].joints):
        return ""
    try:
        question_of(state).pieces()
    except InputError as why:
        return str(why)
    return ""


def has_joints_to_spare(state: State) -> bool:
    """Return whether the arm has more joints that move than the task has components."""
    return state[Joints].locked.count(False) > vector_of(state).m


def belongs_elsewhere(state: State) -> bool:
    """Return whether target or task vector have changed since the map was requested."""
    found = state[Basins].map
    if found is None:
        return False
    return found.question.target != state[Iterations].target.tobytes() or found.question.task != vector_of(state)


# -- commands --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class DrawBasins(Command):
    """Request the map with the present settings; a map that is being computed is given up."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state in which a map is being computed.

        Raises
        ------
        InputError
            The arm has joints to spare, or one of the two joints is locked.
        """
        question = question_of(state)
        question.pieces()  # refuses at once what cannot be mapped
        return state.replace(replace(state[Basins], drawing=question))


@dataclass(frozen=True)
class CancelBasins(Command):
    """Stop computing; the rows so far stay."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state in which nothing is being computed."""
        part = state[Basins]
        return state if part.drawing is None else state.replace(replace(part, drawing=None))


@dataclass(frozen=True)
class MapMethod(Command):
    """Choose the method, or one of its parameters.

    Parameters
    ----------
    method : str
        Another method gets its parameters at their defaults.
    key : str
        Of the parameter; empty for none.
    value : float
    """

    method: str
    key: str = ""
    value: float = 0.0
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        part = state[Basins]
        run = part.run
        if run.method != self.method:
            iteration_method(self.method)  # a flow has no steps to be counted
            run = fitting(self.method, state[Joints].arm, vector_of(state))
        run = run.with_parameter(self.key, self.value) if self.key else run
        return setting(state, Basins, {"run": run})


@dataclass(frozen=True)
class MapJoints(Command):
    """Choose the joints across and up (0-based); if both are the same the two are exchanged."""

    across: int
    up: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the joints chosen."""
        joints, before = (self.across, self.up), state[Basins].joints
        swapped = self.across == self.up and self.across in before
        return setting(state, Basins, {"joints": before[::-1] if swapped else joints})


@dataclass(frozen=True)
class MapRest(Command):
    """Set the start value of one joint (0-based), rad or m; None sets all of them to the present values."""

    joint: int | None = None
    value: float = 0.0
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the start values set."""
        part, joints = state[Basins], state[Joints]
        rest = list(part.rest) if self.joint is not None else joints.q.tolist()
        if self.joint is not None:
            if not 0 <= self.joint < joints.arm.n:
                raise InputError(f"joint: expected 1 to {joints.arm.n}, got {self.joint + 1}")
            rest[self.joint] = self.value
        return setting(state, Basins, {"rest": rest})


@dataclass(frozen=True)
class TakeJoint(Command):
    """Make position and one joint (1-based) the task vector, with a joint value for which the target can be reached."""

    joint: int
    label: ClassVar[str] = "task vector"

    def apply(self, state: State) -> State:
        """Return the state with the task vector chosen; the present joint value is wanted if no better one is known."""
        arm = state[Joints].arm
        if not 1 <= self.joint <= arm.n:
            raise InputError(f"joint: expected 1 to {arm.n}, got {self.joint}")
        i, here = self.joint - 1, float(state[Joints].q[self.joint - 1])
        ends = solve_all(arm, state[Iterations].target).q[:, i].tolist()
        wanted = min(ends, key=lambda value: abs(value - state[Basins].rest[i]), default=here)
        place = Task(arm.task.position, "none")
        return ChooseTask(task_vector(arm, place, joints={self.joint: wanted})).apply(state)


@dataclass(frozen=True)
class StartInMap(Command):
    """Begin the film of iterations at a place of the map, with all arguments of the map.

    Parameters
    ----------
    x, y : float
        In parts of the sides of the map, from its lower left corner.
    """

    x: float
    y: float
    label: ClassVar[str] = "start of the iterations"

    def apply(self, state: State) -> State:
        """Return the state with the film at its first picture; `InputError` as in `start_in_map`."""
        start, asked = start_in_map(state, self.x, self.y)
        part = state[Iterations]
        target = np.frombuffer(asked.target).reshape(4, 4).copy()
        target.setflags(write=False)
        same = asked.task == TaskVector(state[Joints].arm.task)
        begun = replace(
            _with_selected(part, asked.run),
            target=target,
            task=None if same else asked.task,
            limits=asked.limits,
            most=asked.most,
        )
        return StartIterations(start).apply(state.replace(begun))


def start_in_map(state: State, x: float, y: float) -> tuple[tuple[float, ...], Question]:
    """Return the start at a place of the map, 0 to 1 from its lower left corner, and the request of the map.

    Raises
    ------
    InputError
        There is no map, the place is not in it, or other joints are locked than were.
    """
    found, joints = state[Basins].map, state[Joints]
    if found is None:
        raise InputError("there is no map yet: draw one first")
    start, asked = found.start(x, y), found.question
    held = np.array(asked.locked)
    if joints.locked != asked.locked or not np.allclose(joints.q[held], np.array(asked.rest)[held], atol=1e-9):
        raise InputError("the held joints have changed since the map was drawn: draw it again")
    return start, asked


def _with_selected(part: Iterations, run: Run) -> Iterations:
    """Return the part with this run selected: an equal one, or else the selected one replaced by it."""
    for i, one in enumerate(part.runs):
        if replace(one, colour=run.colour) == run:
            return replace(part, selected=i)
    runs = list(part.runs)
    runs[part.selected] = replace(run, colour=part.run.colour)
    return replace(part, runs=tuple(runs))


def _first_joints(arm: Arm) -> tuple[int, int]:
    """Return the two joints of a 2R, else joints 2 and 3, because the first one only turns the whole arm."""
    return (0, min(1, arm.n - 1)) if arm.n < 3 or arm.task.rotation == "phi" else (1, 2)


def _check_joints(arm: Arm, across: int, up: int) -> None:
    if not (0 <= across < arm.n and 0 <= up < arm.n) or (across == up and arm.n > 1):
        raise InputError(f"joints: expected two different joints of 1 to {arm.n}, got {across + 1} and {up + 1}")
