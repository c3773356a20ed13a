"""Commands of the table task: the table, the object and the tool above it are moved, and the arm is sent there."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.benches.frames.table.state import FARTHEST, TableTask, corner_of, task_of
from armlab.errors import InputError
from armlab.kin.transforms import inverse
from armlab.session.fields import put
from armlab.session.parts.target import DragTarget, PlaceTarget
from armlab.session.state import Command, State

Pose = NDArray[np.floating]


def _changed(state: State, drag: object = None, **values: Any) -> State:
    """Return the state with fields of the part set, and the arm above the object if it follows.

    ``drag`` is the drag it belongs to; None for what was typed.
    """
    part = state[TableTask]
    state = put(state, part.with_values(values).without_example())
    return followed(state, drag) if part.follows else state


def followed(state: State, drag: object = None) -> State:
    """Return the state with the target, and the arm as near as it comes to it, above the object."""
    pose = task_of(state).T_we
    return (PlaceTarget(pose) if drag is None else DragTarget(pose, drag)).apply(state)


@dataclass(frozen=True)
class SetTable(Command):
    """Set x (0), y (1) or z (2) of the frame of the table in the world, metres."""

    axis: int
    value: float
    label: ClassVar[str] = "place of the table"

    def apply(self, state: State) -> State:
        """Return the state with the table there."""
        corner = list(corner_of(state))
        if not 0 <= self.axis < len(corner):
            raise InputError(f"axis: expected 0 to 2 for x, y and z, got {self.axis}")
        corner[self.axis] = self.value
        return _changed(state, corner=corner)


@dataclass(frozen=True)
class TurnTable(Command):
    """Set the angle of the table about the vertical, radians."""

    value: float
    label: ClassVar[str] = "angle of the table"

    def apply(self, state: State) -> State:
        """Return the state with the table turned so."""
        return _changed(state, corner=corner_of(state), turn=self.value)


@dataclass(frozen=True)
class SetObject(Command):
    """Set x (0) or y (1) of the object in the frame of the table, metres."""

    axis: int
    value: float
    label: ClassVar[str] = "place of the object"

    def apply(self, state: State) -> State:
        """Return the state with the object there."""
        place = list(state[TableTask].place)
        if not 0 <= self.axis < len(place):
            raise InputError(f"axis: expected 0 or 1 for x and y, got {self.axis}: the object lies on the table")
        place[self.axis] = self.value
        return _changed(state, corner=corner_of(state), place=place)


@dataclass(frozen=True)
class SetHeight(Command):
    """Set the height of the tool above the object, metres."""

    value: float
    label: ClassVar[str] = "height above the object"

    def apply(self, state: State) -> State:
        """Return the state with the height."""
        return _changed(state, corner=corner_of(state), height=self.value)


@dataclass(frozen=True)
class SpinTool(Command):
    """Set the angle of the tool about its own z axis, radians."""

    value: float
    label: ClassVar[str] = "angle of the tool"

    def apply(self, state: State) -> State:
        """Return the state with the tool turned so."""
        return _changed(state, spin=self.value)


@dataclass(frozen=True, eq=False)
class DragTable(Command):
    """Drag the handle of the table to a pose (4, 4) in the world, of which the angle about z counts.

    This is one event of a drag, which is one step of undo.
    """

    pose: Pose
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "drag of the table"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragTable, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the table there."""
        before = state[TableTask].turn
        turn = math.atan2(float(self.pose[1, 0]), float(self.pose[0, 0])) - before
        corner = np.clip(self.pose[:3, 3], -FARTHEST, FARTHEST).tolist()
        return _changed(state, self.drag, corner=corner, turn=before + math.remainder(turn, 2.0 * math.pi))


@dataclass(frozen=True, eq=False)
class DragObject(Command):
    """Drag the handle of the object to a place (3,) in the world, of which the part in the table counts.

    This is one event of a drag, which is one step of undo.
    """

    place: Pose
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "drag of the object"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragObject, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the object there."""
        on_table = inverse(task_of(state).T_wt) @ [*self.place.tolist(), 1.0]
        place = np.clip(on_table[:2], -FARTHEST, FARTHEST).tolist()
        return _changed(state, self.drag, corner=corner_of(state), place=place)


@dataclass(frozen=True)
class GoAboveObject(Command):
    """Put the target of the arm above the object, pointing down; the arm goes there as near as it can."""

    label: ClassVar[str] = "target above the object"

    def apply(self, state: State) -> State:
        """Return the state with the target there."""
        return followed(state)


@dataclass(frozen=True)
class FollowObject(Command):
    """Let the arm follow as table, object and height are changed, or let it stay."""

    on: bool
    label: ClassVar[str] = "arm above the object"

    def apply(self, state: State) -> State:
        """Return the state with the choice made, and the arm there if it follows."""
        state = put(state, state[TableTask].with_values({"follows": self.on}))
        return followed(state) if self.on else state
