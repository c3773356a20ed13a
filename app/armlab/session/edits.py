"""Edits of the table on screen: each makes an arm of the student's own, or says why it cannot."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import reduce
from typing import Any, ClassVar, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.content.lesson_lines import located
from armlab.content.robots import OWN, catalogue, own_robot, parse_robot
from armlab.content.tables import joined_notes, parse_table
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import DEFAULT_STROKE, MAX_JOINTS, Arm
from armlab.kin.convert import converted, remainders
from armlab.kin.dh import CONVENTIONS, Convention, Kind, Row, link_transform
from armlab.kin.task_choice import default_task
from armlab.registry import known_name
from armlab.session.parts.robot import RobotPart
from armlab.session.sizes import ANGLES, LENGTHS, LONGEST, check_cell, check_limits, check_size, check_sizes
from armlab.session.state import Command, State

EXACT = 1e-12
"""Difference of an entry of a rotation from 0 or ±1 within which it is taken as exact: quarter turns stay exact."""

PASTED = "Pasted arm"
MOST_TEXT = 50_000
"""Longest pasted table or file, in characters."""

LONGEST_NAME = 60
"""Longest name of a new arm, in characters."""

FILE = re.compile(r"^[ \t]*(\[\[[ \t]*joints[ \t]*\]\]|joints[ \t]*=|convention[ \t]*=)", re.MULTILINE)
"""Pattern that distinguishes a robot file from a table."""

Limits = tuple[float, float]


def default_limits(kind: Kind) -> Limits:
    """Return the default limits of a joint."""
    return (-np.pi, np.pi) if kind == "R" else DEFAULT_STROKE


@dataclass(frozen=True)
class SetCell(Command):
    """Write one cell of the table.

    Parameters
    ----------
    row : int
        0-based.
    field : "a", "alpha", "d" or "theta"
    value : float
        Metres or radians; of the joint variable it is the offset.
    """

    row: int
    field: str
    value: float
    label: ClassVar[str] = "cell of the table"

    def apply(self, state: State) -> State:
        """Return the state with the edited arm."""
        known_name("cell", self.field, LENGTHS + ANGLES)
        arm = _arm(state)
        row = _row(arm, self.row)
        if getattr(row, self.field) == self.value:
            return state
        # Kept from becoming part of an arm before anything is computed with it.
        check_cell(self.row, self.field, self.value)
        rows = _replaced(arm.rows, self.row, replace(row, **cast(Any, {self.field: self.value})))
        return _edited(state, _changed(arm, rows=rows), _same(arm))


@dataclass(frozen=True)
class SetKind(Command):
    """Make a joint revolute or prismatic; it gets the default limits of its kind."""

    row: int
    kind: Kind
    label: ClassVar[str] = "type of a joint"

    def apply(self, state: State) -> State:
        """Return the state with the edited arm."""
        arm = _arm(state)
        row = _row(arm, self.row)
        if self.kind == row.kind:
            return state
        if self.kind not in ("R", "P"):
            raise UnknownName("joint type", self.kind, ("R", "P"))
        return _rebuilt(state, _replaced(arm.rows, self.row, replace(row, kind=self.kind)), _same(arm))


@dataclass(frozen=True)
class SetLimits(Command):
    """Set the limits of a joint, in rad or m."""

    row: int
    low: float
    high: float
    label: ClassVar[str] = "limits of a joint"

    def apply(self, state: State) -> State:
        """Return the state with the edited arm."""
        arm = _arm(state)
        row = _row(arm, self.row)
        if tuple(arm.limits[self.row]) == (self.low, self.high):
            return state
        check_limits(self.row, row, self.low, self.high)
        limits = np.array(arm.limits)
        limits[self.row] = self.low, self.high
        return _edited(state, _changed(arm, limits=limits), _same(arm))


@dataclass(frozen=True)
class AddJoint(Command):
    """Add a revolute joint with a parallel axis after a row; ``after=-1`` puts it first."""

    after: int
    label: ClassVar[str] = "added joint"

    def apply(self, state: State) -> State:
        """Return the state with one joint more."""
        arm = _arm(state)
        if arm.n >= MAX_JOINTS:
            raise InputError(f"an arm has at most {MAX_JOINTS} joints")
        if not -1 <= self.after < arm.n:
            raise InputError(f"row: expected 0 to {arm.n}, got {self.after + 1}")
        at = self.after + 1
        row = Row("R", a=round(min(max(arm.reach / (arm.n + 1), 0.01), LONGEST), 2))
        rows = (*arm.rows[:at], row, *arm.rows[at:])
        return _rebuilt(state, rows, (*range(at), None, *range(at, arm.n)))


@dataclass(frozen=True)
class RemoveJoint(Command):
    """Remove a row."""

    row: int
    label: ClassVar[str] = "removed joint"

    def apply(self, state: State) -> State:
        """Return the state with one joint less."""
        arm = _arm(state)
        _row(arm, self.row)
        if arm.n == 1:
            raise InputError("an arm has at least one joint")
        kept = tuple(i for i in range(arm.n) if i != self.row)
        return _rebuilt(state, tuple(arm.rows[i] for i in kept), kept)


@dataclass(frozen=True)
class ReorderJoint(Command):
    """Move a row up or down the table."""

    row: int
    to: int
    label: ClassVar[str] = "order of joints"

    def apply(self, state: State) -> State:
        """Return the state with the row in its new place; at the ends of the table nothing changes."""
        arm = _arm(state)
        _row(arm, self.row)
        if not 0 <= self.to < arm.n or self.to == self.row:
            return state
        order = [i for i in range(arm.n) if i != self.row]
        order.insert(self.to, self.row)
        return _rebuilt(state, tuple(arm.rows[i] for i in order), tuple(order))


@dataclass(frozen=True, eq=False)
class SetEnd(Command):
    """Set the pose (4, 4) of frame 0 in the world ("base") or of the tool in frame n ("tool")."""

    end: str
    pose: NDArray[np.floating]
    label: ClassVar[str] = "base or tool"

    def apply(self, state: State) -> State:
        """Return the state with the edited arm."""
        if self.end not in ("base", "tool"):
            raise UnknownName("end of the arm", self.end, ("base", "tool"))
        arm = _arm(state)
        pose = _exact(self.pose)
        if np.array_equal(pose, getattr(arm, self.end)):
            return state
        for axis, value in zip("xyz", pose[:3, 3].tolist(), strict=True):
            check_size(f"{self.end}, {axis}", value)
        return _edited(state, _changed(arm, **{self.end: pose}), _same(arm))


@dataclass(frozen=True)
class Convert(Command):
    """Write the same arm in the other convention."""

    convention: str
    label: ClassVar[str] = "convention"

    def apply(self, state: State) -> State:
        """Return the state with the same arm, another table, and the rest of the conversion in base and tool."""
        arm = _arm(state)
        other = converted(arm, known_name("convention", self.convention, CONVENTIONS))
        if other is arm:
            return state
        after = _edited(state, other, _same(arm))
        return after.replace(replace(after[RobotPart], moved=remainders(arm, other)))


@dataclass(frozen=True)
class PasteTable(Command):
    """Take a table from text: CSV, Markdown, LaTeX, or a robot file in TOML.

    Parameters
    ----------
    text : str
    file : str, optional
        Name of the robot file in messages.
    convention : "standard" or "modified", optional
        That of a table which does not tell its own; see `parse_table`.
    """

    text: str
    file: str = "pasted file"
    convention: str = ""
    label: ClassVar[str] = "pasted table"

    def apply(self, state: State) -> State:
        """Return the state with the arm of the text, in its home pose.

        Conclusions that were not written in the table become the summary of the arm.
        """
        if len(self.text) > MOST_TEXT:
            raise InputError(f"table: expected at most {MOST_TEXT} characters, got {len(self.text)}")
        if not self.text.strip():
            raise InputError("table: expected a table in CSV, Markdown, LaTeX or TOML, got nothing")
        if re.search(r"[\ud800-\udfff]", self.text):
            raise InputError("table: expected text that can be written in UTF-8, got broken characters")
        if FILE.search(self.text):
            with located(self.file, "", self.text, 1):
                robot = parse_robot(OWN, self.text, self.file, proven=False)
        else:
            pasted = parse_table(self.text, self.convention)
            tool = _tool_of(pasted.flange, pasted.convention)
            robot = own_robot(Arm.from_dh(pasted.rows, pasted.convention, tool=tool, name=PASTED), PASTED, None)
            robot = replace(robot, summary=joined_notes(pasted.notes) or robot.summary)
        check_sizes(robot.arm)
        return state.with_robot(robot)


@dataclass(frozen=True)
class NewArm(Command):
    """Put an arm on the table that is made of nothing but its rows: limits are those of its kinds, and no base.

    Parameters
    ----------
    rows : tuple of Row
    convention : "standard" or "modified"
    name : str
        "My arm" when empty.
    flange : tuple of Row
        Constant rows after those of the joints, in the same convention: they are the tool.
    """

    rows: tuple[Row, ...]
    convention: str
    name: str = ""
    flange: tuple[Row, ...] = ()
    label: ClassVar[str] = "new arm"

    def apply(self, state: State) -> State:
        """Return the state with the arm, in its home pose."""
        if len(self.name) > LONGEST_NAME:
            raise InputError(f"name: expected at most {LONGEST_NAME} characters, got {len(self.name)}")
        convention = known_name("convention", self.convention, CONVENTIONS)
        arm = Arm.from_dh(self.rows, convention, tool=_tool_of(self.flange, convention))
        check_sizes(arm)
        return state.with_robot(own_robot(arm, self.name))


@dataclass(frozen=True)
class RestoreTable(Command):
    """Restore the table of the robot file from which the student's own began."""

    label: ClassVar[str] = "original table"

    def apply(self, state: State) -> State:
        """Return the state with the arm of the file."""
        part = state[RobotPart]
        if not part.own or not part.origin:
            raise InputError("this table does not come from a robot file; choose an arm from the list")
        robot = catalogue()[part.origin]
        same = np.array_equal(robot.arm.revolute, part.robot.arm.revolute)
        return state.with_edited(robot, _same(robot.arm)) if same else state.with_robot(robot)


def _exact(given: ArrayLike) -> NDArray[np.float64]:
    """Return a pose in which quarter turns are exact."""
    pose = np.array(given, dtype=np.float64)
    nearest = np.round(pose)
    near = np.abs(pose - nearest) < EXACT
    pose[:3, :3] = np.where(near, nearest, pose)[:3, :3] + 0.0  # no minus zeros
    return pose


def _tool_of(flange: Sequence[Row], convention: Convention) -> NDArray[np.float64]:
    """Return the tool that constant rows after those of the joints give."""
    links = (link_transform(row.a, row.alpha, row.d, row.theta, convention) for row in flange)
    return _exact(reduce(np.matmul, links, np.eye(4)))


def _arm(state: State) -> Arm:
    return state[RobotPart].robot.arm


def _row(arm: Arm, i: int) -> Row:
    if not 0 <= i < arm.n:
        raise InputError(f"row: expected 1 to {arm.n}, got {i + 1}")
    return arm.rows[i]


def _replaced(rows: tuple[Row, ...], i: int, row: Row) -> tuple[Row, ...]:
    return (*rows[:i], row, *rows[i + 1 :])


def _same(arm: Arm) -> tuple[int, ...]:
    """Return the origin of joints when all are the same as before."""
    return tuple(range(arm.n))


def _rebuilt(state: State, rows: tuple[Row, ...], origin: tuple[int | None, ...]) -> State:
    """Return the state with other joints; unchanged joints keep limits and bounds."""
    arm = _arm(state)
    limits, speeds, accelerations = [], [], []
    for row, i in zip(rows, origin, strict=True):
        same = i is not None and arm.rows[i].kind == row.kind
        limits.append(tuple(arm.limits[i]) if same else default_limits(row.kind))
        speeds.append(arm.speed_limits[i] if same else np.inf)
        accelerations.append(arm.acceleration_limits[i] if same else np.inf)
    changed = _changed(arm, rows=rows, limits=limits, speed_limits=speeds, acceleration_limits=accelerations)
    return _edited(state, changed, origin)


def _changed(arm: Arm, **fields: object) -> Arm:
    """Return a new arm with some of its fields replaced.

    The task is chosen anew for the geometry, unless it was given against that choice and the joints are the same.
    """
    names = ("rows", "convention", "base", "tool", "limits", "speed_limits", "acceleration_limits", "name")
    values = {name: fields.get(name, getattr(arm, name)) for name in names}
    changed = Arm.from_dh(**values)  # type: ignore[arg-type]
    if not np.array_equal(changed.revolute, arm.revolute) or changed.task == arm.task:
        return changed
    given = arm.task != default_task(arm.rows, arm.convention, arm.tool)
    return replace(changed, task=arm.task) if given else changed


def _edited(state: State, arm: Arm, origin: Sequence[int | None]) -> State:
    check_sizes(arm)
    present = state[RobotPart].robot
    return state.with_edited(own_robot(arm, present.name, present), tuple(origin))
