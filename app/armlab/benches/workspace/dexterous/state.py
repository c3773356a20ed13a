"""Where the tool can have which orientations: how this is looked at, and what has been found."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar, Self, cast

import numpy as np

from armlab.benches.workspace.dexterous.study import Method, Question, Study, methods
from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.ik.solutions import wrapped_rows
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.planar import turns_fully
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import PlaceTarget, brought_to
from armlab.session.state import Command, Json, Part, PartType, State

COUNTS = (400_000, 2_000_000, 10_000_000)
"""Numbers of samples to choose from."""

SHARES = (0.25, 0.5, 0.75, 0.95, 1.0)
"""Of the directions: bodies of points that have at least so many; the last is WS2."""

DRAWINGS = {"slice": "Slice", "body": "Body"}


@dataclass(frozen=True, eq=False)
class Dexterous(Part):
    """How orientations are looked at.

    Attributes
    ----------
    method : str
        Key of a method; empty for the first that the arm has.
    s : float or None
        Which half plane, rad or m; None for that of the home pose.
    turns : bool
        Whether that is an angle.
    turned : tuple of 9 floats
        Orientation of the tool with which solutions are counted, by rows; empty for that of the home pose.
    count : int
        Samples.
    draw : str
        Key of `DRAWINGS`: what is shown of a spherical wrist's coverage.
    share : float
        Of the directions that the points of a body have at least.
    stopped : Question or None
        What a person has stopped.
    found : mapping of str to Study
        By method; not saved.
    """

    key: ClassVar[str] = "dexterous"
    kept_by_undo: ClassVar[bool] = True

    method: str = ""
    s: float | None = None
    turns: bool = True
    turned: tuple[float, ...] = ()
    count: int = COUNTS[1]
    draw: str = "slice"
    share: float = SHARES[-1]
    stopped: Question | None = None
    found: Mapping[str, Study] = field(default_factory=dict)

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the first look."""
        return cls(turns=bool(robot.arm.revolute[0]))

    def for_robot(self, robot: Robot) -> Self:
        """Keep how finely it is looked at."""
        return replace(self.initial(robot), count=self.count, draw=self.draw, share=self.share)

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep also what is looked at, if the arm still has it."""
        # Which methods there are is worth knowing only to one who has chosen one: it takes a look at the structure.
        method = self.method if self.method and self.method in methods(robot.arm) else ""
        s = self.s if self.turns is bool(robot.arm.revolute[0]) else None
        return replace(self.for_robot(robot), method=method, s=s, turned=self.turned)

    def to_json(self) -> Json:
        """Write the settings; what was found is found anew."""
        return {
            "method": self.method,
            "s": self.s,
            "turned": list(self.turned),
            "count": self.count,
            "draw": self.draw,
            "share": self.share,
        }

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read them back; raises when they are not usable with this arm."""
        s = None if data["s"] is None else float(data["s"])
        turned = tuple(float(value) for value in data["turned"])
        part = replace(
            cls.initial(robot),
            method=str(data["method"]),
            s=s,
            turned=turned,
            count=int(data["count"]),
            draw=str(data["draw"]),
            share=float(data["share"]),
        )
        _check(part, robot)
        return part if s is None else replace(part, s=_place(s, robot.arm))


PART = PartType(Dexterous, order=122)


def _check(part: Dexterous, robot: Robot) -> None:
    """Raise `InputError` where a setting is none."""
    if part.method != "" and part.method not in (known := methods(robot.arm)):
        raise UnknownName("method", part.method, known)
    if part.draw not in DRAWINGS:
        raise UnknownName("drawing", part.draw, DRAWINGS)
    if part.count not in COUNTS:
        raise UnknownName("samples", part.count, [str(count) for count in COUNTS])
    if part.share not in SHARES:
        raise UnknownName("share", part.share, [str(share) for share in SHARES])
    if part.s is not None and not math.isfinite(part.s):
        raise InputError(f"place of the slice: expected a number, got {part.s}")
    if part.turned and (len(part.turned) != 9 or not all(map(math.isfinite, part.turned))):
        raise InputError("orientation: expected nine numbers")


def method_of(state: State) -> Method:
    """Return the method in use."""
    chosen = state[Dexterous].method
    return cast(Method, chosen) if chosen else methods(state[Joints].arm)[0]


def slice_of(state: State) -> float:
    """Return which half plane is looked at, rad or m."""
    s = state[Dexterous].s
    robot = state[RobotPart].robot
    return float(first_joint(robot.arm).split(robot.arm.position(robot.home))[2]) if s is None else s


def orientation_of(state: State) -> tuple[float, ...]:
    """Return the orientation with which solutions are counted, nine numbers by rows."""
    robot = state[RobotPart].robot
    return state[Dexterous].turned or tuple(robot.arm.fk(robot.home)[:3, :3].ravel().tolist())


def rings_alone(state: State) -> bool:
    """Return whether the closed form of a planar arm says all: no joint limit takes anything away."""
    return method_of(state) == "rings" and turns_fully(state[Joints].arm)


def question_of(state: State) -> Question | None:
    """Return what is to be computed; None where the closed form says all."""
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
    """Return what has been found of what is looked at; what was found for other settings is none."""
    question = state.derived(question_of)
    found = None if question is None else state[Dexterous].found.get(question.method)
    return found if found is not None and found.question == question else None


# -- commands --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class LookAtDexterous(Command):
    """Change how it is looked at; None leaves a setting as it is."""

    method: str | None = None
    s: float | None = None
    count: int | None = None
    draw: str | None = None
    share: float | None = None
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the settings; `InputError` where one is none."""
        given = {name: value for name, value in vars(self).items() if value is not None}
        part = replace(state[Dexterous], **given, stopped=None)
        _check(part, state[RobotPart].robot)
        if self.s is not None:
            part = replace(part, s=_place(self.s, state[Joints].arm))
        return state.replace(part)


def _place(s: float, arm: Arm) -> float:
    """Return the place of a slice, an angle in (-pi, pi]; `InputError` for a plane beyond the reach."""
    if arm.revolute[0]:
        turn = math.remainder(s, math.tau)
        return math.pi if turn == -math.pi else turn
    if abs(s) > arm.reach:
        raise InputError(f"place of the slice: expected at most {arm.reach:.3f} m from the base, got {s:g} m")
    return s


@dataclass(frozen=True)
class LookThroughTool(Command):
    """Put the slice through the tool point, and count solutions with the tool as it is turned."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the slice there."""
        T = state[Joints].tool_pose
        s = float(first_joint(state[Joints].arm).split(T[:3, 3])[2])
        turned = tuple(np.asarray(T[:3, :3]).ravel().tolist())
        return state.replace(replace(state[Dexterous], s=s, turned=turned, stopped=None))


@dataclass(frozen=True)
class StopDexterous(Command):
    """Stop computing; what there is stays."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state in which nothing is being computed."""
        return state.replace(replace(state[Dexterous], stopped=state.derived(question_of)))


@dataclass(frozen=True)
class ResumeDexterous(Command):
    """Compute what was stopped, from its beginning."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state in which it is wanted."""
        return state.replace(replace(state[Dexterous], stopped=None))


@dataclass(frozen=True)
class GoToSlice(Command):
    """Bring the tool to a point of the slice: as a sample had it there, else by inverse kinematics.

    Parameters
    ----------
    point : tuple of 3 floats
        In the world, metres.
    """

    point: tuple[float, float, float]
    label: ClassVar[str] = "jump into the slice"

    def apply(self, state: State) -> State:
        """Return the state with the arm there, or as near as it comes."""
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
