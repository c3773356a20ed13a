"""Two lines in space that the student moves, and their common normal: the meaning of a and alpha in the table."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, Literal, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.lines import CommonNormal, Line, Relation, common_normal
from armlab.kin.rotations import rotation_from_axis_angle
from armlab.registry import known_name
from armlab.session.counted import refuse_beyond
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, Json, Part, PartType, State

Handle = Literal["move", "turn"]
HANDLES: tuple[Handle, ...] = ("move", "turn")

SNAP_ANGLE = math.radians(2.0)
"""Angle to parallel, radians, below which lines become parallel at the end of a drag."""

SNAP_DISTANCE = 0.02
"""Distance, in reaches of the arm, below which lines meet at the end of a drag."""

FARTHEST = 20.0
"""Largest distance of a point from the base, in reaches of the arm."""

PLACE = np.array([0.12, -0.14, 0.0])
LOWEST, APART, ALONG, TILT = 0.24, 0.22, 0.08, math.radians(58.0)
"""Geometry of the first two lines: a point of the first one from the middle between base and tool, its least height
above the base, the distance of the lines and the offset of the second one along the first, all in reaches; and the
twist, radians, of lines that are not parallel."""


@dataclass(frozen=True, eq=False)
class Lines(Part):
    """Two lines.

    Attributes
    ----------
    first, second : Line
        In the world, metres.
    scale : float
        A length of the scene in metres: the reach of the arm.
    pair : int or None
        The lines are the axes of joints pair + 1 and pair + 2 (0-based ``pair``) and follow them; None once they are
        the student's own.
    handle : "move" or "turn"
        What dragging does.
    snapped : bool
        Whether the last drag was corrected to a special case.
    """

    key: ClassVar[str] = "lines"

    first: Line
    second: Line
    scale: float
    pair: int | None = None
    handle: Handle = "move"
    snapped: bool = False

    @cached_property
    def normal(self) -> CommonNormal:
        """The common normal, from the first line to the second."""
        return common_normal(self.first, self.second, scale=self.scale)

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return two skew lines beside the arm."""
        scale = 2.0 * robot.arm.length_scale
        return cls(*_preset("skew", robot), scale)

    def for_robot(self, robot: Robot) -> Self:
        """Return the first lines; only the choice of the handle is kept."""
        return replace(self.initial(robot), handle=self.handle)

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the lines, unless they are now too far away; `after` moves those on axes of the arm with the table."""
        pair = self.pair if self.pair is not None and self.pair + 1 < robot.arm.n else None
        kept = replace(self, scale=2.0 * robot.arm.length_scale, pair=pair)
        return kept if pair is not None else kept._near(robot)

    def _near(self, robot: Robot) -> Self:
        """Return the part, or the first lines where one of its own is farther away than lines can be dragged."""
        inside = all(_is_inside(line.point, robot.arm) for line in (self.first, self.second))
        return self if inside else self.for_robot(robot)

    def after(self, before: State, now: State) -> Self:
        """Follow the axes of the arm."""
        joints = now[Joints]
        if self.pair is None or (joints.q is before[Joints].q and joints.arm is before[Joints].arm):
            return self
        first, second = _axes(joints, self.pair)
        return replace(self, first=first, second=second)

    def to_json(self) -> Json:
        """Write the lines."""
        lines = [[line.point.tolist(), line.direction.tolist()] for line in (self.first, self.second)]
        return {"lines": lines, "pair": self.pair, "handle": self.handle}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read them back; lines too far away are the first ones again, as after an edit of the table."""
        scale = 2.0 * robot.arm.length_scale
        first, second = (Line(point, direction) for point, direction in data["lines"])
        pair = None if data["pair"] is None else int(data["pair"])
        if pair is not None and not 0 <= pair < robot.arm.n - 1:
            raise InputError(f"lines: joint {pair + 1} is the last one and has no next axis")
        part = cls(first, second, scale, pair, next(name for name in HANDLES if name == data["handle"]))
        return part._near(robot)


PART = PartType(Lines, order=40)


@dataclass(frozen=True, eq=False)
class DragLine(Command):
    """Move or turn one line; this is one event of a drag.

    Parameters
    ----------
    which : int
        0 or 1.
    point : ndarray, shape (3,)
        A point of it, metres in the world.
    direction : ndarray, shape (3,)
    drag : object
        Which drag it belongs to; any object that stands for it alone. One drag is one step of undo.
    """

    which: int
    point: NDArray[np.floating]
    direction: NDArray[np.floating]
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "drag of a line"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragLine, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the line there, or in the special case that it nearly is."""
        lines = state[Lines]
        refuse_beyond(self.which, 2, "line")
        moved = Line(_inside(self.point, state[Joints].arm), np.asarray(self.direction, dtype=np.float64))
        other = lines.second if self.which == 0 else lines.first
        snapped = snapped_to(other, moved, lines.scale)
        first, second = (snapped, other) if self.which == 0 else (other, snapped)
        return state.replace(replace(lines, first=first, second=second, pair=None, snapped=snapped is not moved))


@dataclass(frozen=True)
class PlaceLines(Command):
    """Place the lines in one of the four cases."""

    kind: str
    label: ClassVar[str] = "two lines"

    def apply(self, state: State) -> State:
        """Return the state with the lines of this case."""
        known_name("case", self.kind, _CASES)
        first, second = _preset(next(kind for kind in _CASES if kind == self.kind), state[RobotPart].robot)
        return state.replace(replace(state[Lines], first=first, second=second, pair=None, snapped=False))


@dataclass(frozen=True)
class TakeAxes(Command):
    """Put the lines on the axes of joints pair + 1 and pair + 2 of the arm (``pair`` is 0-based)."""

    pair: int
    label: ClassVar[str] = "axes of the arm"

    def apply(self, state: State) -> State:
        """Return the state with the lines on the axes."""
        joints = state[Joints]
        if not 0 <= self.pair < joints.arm.n - 1:
            raise InputError(f"joint: expected 1 to {joints.arm.n - 1}, got {self.pair + 1}")
        first, second = _axes(joints, self.pair)
        return state.replace(replace(state[Lines], first=first, second=second, pair=self.pair, snapped=False))


@dataclass(frozen=True)
class KeepLines(Command):
    """Keep the lines where they are, so that they follow the axes of the arm no longer."""

    label: ClassVar[str] = "lines of one's own"

    def apply(self, state: State) -> State:
        """Return the state with lines that belong to the student."""
        lines = state[Lines]
        return state if lines.pair is None else state.replace(replace(lines, pair=None))


@dataclass(frozen=True)
class HandleLines(Command):
    """Choose whether a drag moves or turns a line."""

    handle: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        known_name("handle", self.handle, HANDLES)
        lines = state[Lines]
        chosen = next(name for name in HANDLES if name == self.handle)
        return state if chosen == lines.handle else state.replace(replace(lines, handle=chosen))


def snapped_to(other: Line, moved: Line, scale: float) -> Line:
    """Return a line made parallel to another, or moved to meet it, if it nearly is; else the line itself.

    The line is turned about its point, then moved along the common normal.
    """
    z, cosine = moved.direction, float(moved.direction @ other.direction)
    sine = float(np.linalg.norm(np.cross(moved.direction, other.direction)))
    if 0.0 < sine < math.sin(SNAP_ANGLE):
        z = math.copysign(1.0, cosine) * other.direction
        moved = Line(moved.point, z)
    gap = common_normal(other, moved, scale=scale)
    if 0.0 < gap.a < SNAP_DISTANCE * scale:
        moved = Line(moved.point - gap.a * gap.normal, z)
    return moved


def table_entry(state: State) -> tuple[int, float, float] | None:
    """Return the 0-based row of the table with a and alpha of the chosen axes, and both; None without a row.

    The table's a may be negative and its alpha turned with it: its x points the other way.
    """
    lines, arm = state[Lines], state[RobotPart].robot.arm
    if lines.pair is None:
        return None
    row = lines.pair if arm.convention == "standard" else lines.pair + 1
    return row, arm.rows[row].a, arm.rows[row].alpha


_CASES: tuple[Relation, ...] = ("skew", "parallel", "intersecting", "coincident")


def _preset(kind: Relation, robot: Robot) -> tuple[Line, Line]:
    """Return lines of one case beside the arm, the first one tilted a little so that it is no axis of a frame."""
    arm = robot.arm
    scale, base = 2.0 * arm.length_scale, arm.base[:3, 3]
    across = np.array([-1.0, 0.0, 0.0])
    z1 = rotation_from_axis_angle([0.3, 1.0, 0.0], math.radians(8.0)) @ np.array([0.0, 0.0, 1.0])
    normal = across - (across @ z1) * z1
    normal /= np.linalg.norm(normal)
    turned = rotation_from_axis_angle(normal, TILT) @ z1
    point = 0.5 * (base + arm.position(robot.home)) + scale * PLACE
    point[2] = max(point[2], base[2] + scale * LOWEST)
    away, along = scale * APART * normal, scale * ALONG * z1
    places = {
        "skew": (point + away + along, turned),
        "parallel": (point + away + along, z1),
        "intersecting": (point + along, turned),
        "coincident": (point + along, z1),
    }
    return Line(point, z1), Line(*places[kind])


def _axes(joints: Joints, pair: int) -> tuple[Line, Line]:
    """Return the axes of two neighbouring joints: z of frames i-1 and i, or of i and i+1 in a modified table."""
    shift = 0 if joints.arm.convention == "standard" else 1
    frames = (joints.frames[pair + shift], joints.frames[pair + shift + 1])
    first, second = (Line(T[:3, 3], T[:3, 2]) for T in frames)
    return first, second


def _is_inside(point: NDArray[np.floating], arm: Arm) -> bool:
    return bool(np.linalg.norm(point - arm.base[:3, 3]) <= FARTHEST * 2.0 * arm.length_scale)


def _inside(point: ArrayLike, arm: Arm) -> NDArray[np.float64]:
    values = np.array(point, dtype=float)
    if values.shape != (3,) or not _is_inside(values, arm):
        most = FARTHEST * 2.0 * arm.length_scale
        raise InputError(f"line: expected a point within {most:.4g} m of the base, got {values.tolist()}")
    return values
