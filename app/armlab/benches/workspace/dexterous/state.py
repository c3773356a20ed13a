"""The study of orientations: its settings, and the results."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Self, cast

import numpy as np

from armlab.benches.workspace.dexterous.study import Method, Question, Study, methods
from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats
from armlab.kin.ik.solutions import wrapped_rows
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.planar import turns_fully
from armlab.session.fields import FieldPart, choice, number, own, text
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import PlaceTarget, brought_to
from armlab.session.state import Command, Json, PartType, State

COUNTS = (400_000, 2_000_000, 10_000_000)
"""Numbers of samples that can be chosen."""

SHARES = (0.25, 0.5, 0.75, 0.95, 1.0)
"""Shares of the directions that a body of points can be drawn for; the last is WS2."""

PLACE = "place of the slice"

DRAWINGS = {"slice": "Slice", "body": "Body"}


def _read_turned(data: Json) -> tuple[float, ...]:
    return tuple(finite_floats(data, "orientation", (9,), "nine finite numbers").tolist()) if len(data) else ()


@dataclass(frozen=True, eq=False)
class Dexterous(FieldPart):
    """The settings of the study of orientations, and its results.

    Attributes
    ----------
    arm : Arm
    method : str
        Key of a method; empty for the first that the arm has.
    s : float or None
        Which half plane, rad or m; None for that of the home pose.
    turned : tuple of 9 floats
        Orientation of the tool with which solutions are counted, by rows; empty for that of the home pose.
    count : int
        Samples.
    draw : str
        Key of `DRAWINGS`: what is shown of a spherical wrist's coverage.
    share : float
        Of the directions that the points of a body have at least.
    stopped : Question or None
        The request that the student has stopped.
    found : mapping of str to Study
        By method; not saved.
    """

    key: ClassVar[str] = "dexterous"
    kept_by_undo: ClassVar[bool] = True

    arm: Arm
    method: str = text("method", kept="edits")
    s: float | None = number("s", PLACE, None, kept="edits")
    turned: tuple[float, ...] = own("orientation", (), _read_turned, kept="edits")
    count: int = choice("samples", COUNTS[1], COUNTS)
    draw: str = choice("drawing", "slice", DRAWINGS)
    share: float = choice("least share of the directions", SHARES[-1], SHARES)
    stopped: Question | None = None
    found: Mapping[str, Study] = field(default_factory=dict)

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the initial settings."""
        return cls(robot.arm)

    def check(self) -> None:
        """Refuse a method that the arm does not have, and a plane beyond its reach."""
        # Which methods there are is worth knowing only to one who has chosen one: it takes a look at the structure.
        if self.method and self.method not in (known := methods(self.arm)):
            raise UnknownName("method", self.method, known)
        if self.s is not None and not self.arm.revolute[0] and abs(self.s) > self.arm.reach:
            most = self.arm.reach
            raise InputError(f"{PLACE}: expected at most {most:.3f} m from the base, got {self.s:g} m")

    def with_values(self, values: Mapping[str, Any]) -> Self:
        """Return the part with some fields set; a stopped request is made again."""
        return replace(super().with_values(values), stopped=None)

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the settings if the arm still has them; the place of the slice is dropped if it changes its unit."""
        kept = super().for_edited(robot, origin)
        return kept if robot.arm.revolute[0] == self.arm.revolute[0] else replace(kept, s=None)


PART = PartType(Dexterous, order=122)


def method_of(state: State) -> Method:
    """Return the method in use."""
    chosen = state[Dexterous].method
    return cast(Method, chosen) if chosen else methods(state[Joints].arm)[0]


def slice_of(state: State) -> float:
    """Return the place of the slice: rad in (-pi, pi], or m."""
    s = state[Dexterous].s
    robot = state[RobotPart].robot
    if s is None:
        return float(first_joint(robot.arm).split(robot.arm.position(robot.home))[2])
    turn = math.remainder(s, math.tau)
    return s if not robot.arm.revolute[0] else math.pi if turn == -math.pi else turn


def orientation_of(state: State) -> tuple[float, ...]:
    """Return the orientation with which solutions are counted, nine numbers by rows."""
    robot = state[RobotPart].robot
    return state[Dexterous].turned or tuple(robot.arm.fk(robot.home)[:3, :3].ravel().tolist())


def rings_alone(state: State) -> bool:
    """Return whether the closed form of a planar arm is the whole answer: no joint limit takes anything away."""
    return method_of(state) == "rings" and turns_fully(state[Joints].arm)


def question_of(state: State) -> Question | None:
    """Return the request, or None if the closed form is the whole answer."""
    arm, method, part = state[Joints].arm, method_of(state), state[Dexterous]
    if method == "rings" and state.derived(rings_alone):
        return None
    if method == "wrist":
        return Question(arm, "wrist")
    joint = first_joint(arm)
    # What joint 1 can carry all the way round is the same in every half plane.
    s = 0.0 if joint.planar or (joint.full and method != "count") else slice_of(state)
    if method == "count":
        return Question(arm, "count", s, turned=orientation_of(state))
    return Question(arm, "sampled", s, part.count)


def study_of(state: State) -> Study | None:
    """Return the results for the present settings, or None if they were found for others."""
    question = state.derived(question_of)
    found = None if question is None else state[Dexterous].found.get(question.method)
    return found if found is not None and found.question == question else None


# -- commands --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class LookThroughTool(Command):
    """Put the slice through the tool point, and count solutions with the tool's present orientation."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the slice there."""
        T = state[Joints].tool_pose
        s = float(first_joint(state[Joints].arm).split(T[:3, 3])[2])
        turned = tuple(np.asarray(T[:3, :3]).ravel().tolist())
        return state.replace(replace(state[Dexterous], s=s, turned=turned, stopped=None))


@dataclass(frozen=True)
class StopDexterous(Command):
    """Stop computing; the results so far stay."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state in which nothing is being computed."""
        return state.replace(replace(state[Dexterous], stopped=state.derived(question_of)))


@dataclass(frozen=True)
class ResumeDexterous(Command):
    """Restart what was stopped, from its beginning."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state in which it is requested again."""
        return state.replace(replace(state[Dexterous], stopped=None))


@dataclass(frozen=True)
class GoToSlice(Command):
    """Bring the tool to a point of the slice: by a sample that was there, else by inverse kinematics.

    Parameters
    ----------
    point : tuple of 3 floats
        In the world, metres.
    """

    point: tuple[float, float, float]
    label: ClassVar[str] = "jump into the slice"

    def apply(self, state: State) -> State:
        """Return the state with the arm there, or as near as possible."""
        joints, found = state[Joints], state.derived(study_of)
        point = np.array(self.point)
        if found is not None and found.map is not None and found.question.method == "sampled":
            cell = found.map.cell(point)
            q = np.full(joints.arm.n, np.nan) if cell is None else found.map.q[cell].astype(np.float64)
            if not np.isfinite(q).all():
                raise InputError("no sample has the tool there")
            if not first_joint(joints.arm).planar:
                q[0] += slice_of(state) - found.question.s
            return brought_to(state, np.asarray(joints.arm.clip(wrapped_rows(joints.arm, q[None])[0])))
        T = np.array(joints.tool_pose, dtype=np.float64)
        if method_of(state) == "count":
            T[:3, :3] = np.reshape(orientation_of(state), (3, 3))
        T[:3, 3] = point
        return PlaceTarget(T).apply(state)
