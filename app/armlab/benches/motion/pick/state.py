"""Boxes for pick and place: where they are before the motion, the place they are to be brought to, and their course."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.pick.course import Course, course
from armlab.benches.motion.pick.table import MOST_BOXES, Point, edge_of, table_of
from armlab.benches.motion.plan.commands import edited, with_plan
from armlab.benches.motion.plan.state import CLIP_KEY, Plan, last_planned
from armlab.errors import InputError
from armlab.kin.checks import finite_floats
from armlab.session.examples import with_clip_closed
from armlab.session.fields import FieldPart, own, put
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Json, PartType, State

GOAL = MOST_BOXES
"""Number that stands for the goal where boxes are counted from 0."""

FAR = 1e3
"""Largest coordinate of a place that is read, metres."""

AT_GOAL = 1.0
"""Distance from the goal, in edges of a box, up to which a box counts as placed."""


def _place(data: Json, where: str) -> Point:
    x, y, z = finite_floats(data, where, (3,), "three finite numbers, metres").tolist()
    if max(abs(x), abs(y), abs(z)) > FAR:
        raise InputError(f"{where}: expected coordinates of at most {FAR:g} m")
    return x, y, z


def _boxes(data: Json) -> tuple[Point, ...]:
    found = tuple(_place(each, f"box {k}") for k, each in enumerate(data, start=1))
    if len(found) > MOST_BOXES:
        raise InputError(f"boxes: expected at most {MOST_BOXES}, got {len(found)}")
    return found


def _goal(data: Json) -> Point | None:
    return None if data is None else _place(data, "goal")


def _selected(data: Json) -> int | None:
    if data is None or (isinstance(data, int) and 0 <= data <= GOAL):
        return data
    raise InputError(f"selected box: expected 0 to {GOAL}, got {data}")


@dataclass(frozen=True, eq=False)
class Pick(FieldPart):
    """Boxes and goal.

    Attributes
    ----------
    boxes : tuple of (float, float, float)
        Middles of the boxes before the motion, world, metres; at most `MOST_BOXES`.
    goal : (float, float, float) or None
        Where the middle of a box is to be brought.
    selected : int or None
        The box, from 0, or `GOAL`, that has a handle in the scene.
    """

    key: ClassVar[str] = "pick"
    looks: ClassVar[tuple[str, ...]] = ("selected",)

    boxes: tuple[Point, ...] = own("boxes", (), _boxes, kept="edits")
    goal: Point | None = own("goal", None, _goal, kept="edits")
    selected: int | None = own("selected box", None, _selected, kept="")

    def place(self, which: int) -> Point | None:
        """Return the place of a box, from 0, or of the goal; None if there is none."""
        if which == GOAL:
            return self.goal
        return self.boxes[which] if 0 <= which < len(self.boxes) else None

    def moved(self, which: int, place: Point) -> Pick:
        """Return the part with a box or the goal at a place."""
        if which == GOAL:
            return replace(self, goal=place)
        return replace(self, boxes=(*self.boxes[:which], place, *self.boxes[which + 1 :]))


PART = PartType(Pick, order=107)


def name_of(which: int) -> str:
    """Return what a box, from 0, or the goal is called.

    >>> name_of(0), name_of(GOAL)
    ('box 1', 'goal')
    """
    return "goal" if which == GOAL else f"box {which + 1}"


def course_of(state: State) -> Course:
    """Return the course of the boxes in the motion planned last."""
    arm = state[Joints].arm
    return course(arm, last_planned(state), state[Pick].boxes, edge_of(arm))


def time_of(state: State) -> float:
    """Return the time of the motion, seconds; 0 while it is not on."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else 0.0


def places_at(state: State, time: float) -> NDArray[np.float64]:
    """Return the middles of the boxes at a time of the motion, (k, 3), world, metres."""
    arm, planned, found = state[Joints].arm, last_planned(state), state.derived(course_of)
    motion = None if planned is None else planned.motion
    q = state[Joints].q if motion is None else arm.clip(motion.at(time))
    tool = np.asarray(arm.fk(q), dtype=np.float64)
    return np.array([found.pose(k, time, tool)[:3, 3] for k in range(len(found.spans))]).reshape(-1, 3)


def from_goal(state: State) -> Sequence[float]:
    """Return how far the middle of each box is from the goal at the end of the motion, metres; empty without a goal."""
    planned, goal = last_planned(state), state[Pick].goal
    if goal is None:
        return ()
    ends = places_at(state, 0.0 if planned is None else planned.duration)
    return tuple(np.linalg.norm(ends - np.array(goal), axis=1).tolist())


def placed(state: State) -> int:
    """Return how many boxes are at the goal, released, at the end of the motion."""
    planned = last_planned(state)
    end = 0.0 if planned is None else planned.duration
    most, held = AT_GOAL * edge_of(state[Joints].arm), state.derived(course_of).held(end)
    return sum(apart <= most and k != held for k, apart in enumerate(from_goal(state)))


@dataclass(frozen=True)
class PickAndPlace(Command):
    """Put boxes within reach of the arm, and the waypoints that bring the first one to the goal."""

    label: ClassVar[str] = "pick and place"

    def apply(self, state: State) -> State:
        """Return the state with boxes and plan, the arm at the first waypoint; `InputError` if the arm cannot."""
        table = table_of(state[RobotPart].robot)
        state = with_clip_closed(state)
        plan = edited(
            state[Plan], waypoints=table.waypoints, moves=table.moves, duration=None, selected=1, handled=False
        )
        state = with_plan(state, plan).replace(Pick(table.boxes, table.goal))
        moved = state[Joints].moved_to(np.array(table.waypoints[0].q))
        return state if moved is state[Joints] else state.replace(moved)


@dataclass(frozen=True)
class AddBox(Command):
    """Put one more box within reach of the arm."""

    label: ClassVar[str] = "one more box"

    def apply(self, state: State) -> State:
        """Return the state with the box at a free place, and a goal if there was none; `InputError` if none is free."""
        part, table = state[Pick], table_of(state[RobotPart].robot)
        if len(part.boxes) >= MOST_BOXES:
            raise InputError(f"boxes: at most {MOST_BOXES}")
        edge = edge_of(state[Joints].arm)
        place = next((each for each in table.boxes if _free(each, part.boxes, edge)), None)
        if place is None:
            raise InputError("boxes: no place within reach of the arm is free; move or remove a box first")
        return put(state, replace(part, boxes=(*part.boxes, place), goal=part.goal or table.goal))


@dataclass(frozen=True)
class RemoveBox(Command):
    """Take a box, counted from 0, off the table."""

    k: int
    label: ClassVar[str] = "removed box"

    def apply(self, state: State) -> State:
        """Return the state without the box; without any box there is no goal."""
        part = state[Pick]
        _refuse_missing(part, self.k)
        left = part.boxes[: self.k] + part.boxes[self.k + 1 :]
        return put(state, Pick(left, part.goal if left else None))


@dataclass(frozen=True)
class SelectBox(Command):
    """Give a box, counted from 0, or the goal a handle in the scene; None takes it away."""

    which: int | None
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        part = state[Pick]
        if self.which is not None:
            _refuse_missing(part, self.which)
        return state if part.selected == self.which else state.replace(replace(part, selected=self.which))


@dataclass(frozen=True)
class MoveBox(Command):
    """Put a box, counted from 0, or the goal at a place: one coordinate in the world, metres.

    Parameters
    ----------
    which : int
    axis : int
        0, 1 or 2 for x, y or z.
    value : float
    """

    which: int
    axis: int
    value: float
    label: ClassVar[str] = "place of a box"

    def apply(self, state: State) -> State:
        """Return the state with the box there; `InputError` absurdly far away."""
        place = list(_refuse_missing(state[Pick], self.which))
        place[self.axis] = self.value
        return put(state, state[Pick].moved(self.which, _place(place, name_of(self.which))))


@dataclass(frozen=True, eq=False)
class DragBox(Command):
    """Drag the handle of a box or of the goal; this is one event of a drag.

    Parameters
    ----------
    which : int
    place : ndarray, shape (3,)
        World.
    drag : object
        Which drag it belongs to.
    """

    which: int
    place: NDArray[np.floating]
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "drag of a box"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragBox, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the box there."""
        _refuse_missing(state[Pick], self.which)
        return state.replace(state[Pick].moved(self.which, _place(self.place.tolist(), name_of(self.which))))


def _free(place: Point, boxes: Sequence[Point], edge: float) -> bool:
    """Return whether a box at a place would not stand inside one of those that are there."""
    return all(np.abs(np.subtract(place, each)).max() >= edge for each in boxes)


def _refuse_missing(part: Pick, which: int) -> Point:
    """Return the place of a box or the goal; `InputError` if there is none."""
    place = part.place(which)
    if place is None:
        there = ", ".join(name_of(k) for k in range(GOAL + 1) if part.place(k) is not None)
        raise InputError(f"{name_of(which)}: it is not there; there are: {there or 'none'}")
    return place
