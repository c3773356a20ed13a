"""Commands for the waypoints of a plan."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.chosen import Value
from armlab.benches.motion.plan.commands import PlanCommand, checked_index, edited, refitted, with_plan
from armlab.benches.motion.plan.moves import (
    AT_WAYPOINT,
    MOST_WAYPOINTS,
    Move,
    Waypoint,
    checked_joint,
    checked_q,
    flat_pose,
)
from armlab.benches.motion.plan.state import Plan
from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.ik.target import feasible
from armlab.kin.transforms import as_pose
from armlab.registry import known_name
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import FARTHEST
from armlab.session.state import Command, State

SEARCHES = 8
"""Number of random starts of the inverse kinematics for a typed waypoint, after its present configuration."""

DRAG_TRAVEL = 0.5
"""Largest motion of a joint of a dragged waypoint in one event, radians or length scales."""


def refuse_more(part: Plan) -> None:
    """Raise `InputError` if a plan has as many waypoints as it can have."""
    if len(part.waypoints) >= MOST_WAYPOINTS:
        raise InputError(f"waypoints: at most {MOST_WAYPOINTS}; a longer motion can be read from a file")


@dataclass(frozen=True)
class AddWaypoint(PlanCommand):
    """Add the present configuration after the selected waypoint."""

    label: ClassVar[str] = "new waypoint"

    def apply(self, state: State) -> State:
        """Return the state with one more waypoint, which is selected; its move equals the previous one."""
        part, joints = state[Plan], state[Joints]
        refuse_more(part)
        point, k = Waypoint(tuple(joints.q.tolist())), part.selected + 1
        like = part.moves[max(k - 2, 0)].through() if part.moves else Move()
        changed = edited(
            part,
            waypoints=(*part.waypoints[:k], point, *part.waypoints[k:]),
            moves=(*part.moves[: k - 1], like, *part.moves[k - 1 :]),
            selected=k,
            handled=False,
        )
        return with_plan(state, refitted(joints.arm, changed))


@dataclass(frozen=True)
class CopyWaypoint(PlanCommand):
    """Put a copy of a waypoint behind it, with its handle, to be dragged or shifted to where it is wanted."""

    k: int
    label: ClassVar[str] = "copy of a waypoint"

    def apply(self, state: State) -> State:
        """Return the state with the copy selected; its move equals that to the waypoint.

        As long as the two are in the same place, the plan says so: a motion needs a way.
        """
        part = state[Plan]
        k = checked_index(part, self.k)
        refuse_more(part)
        like = part.moves[max(k - 1, 0)].through() if part.moves else Move()
        changed = edited(
            part,
            waypoints=(*part.waypoints[: k + 1], *part.waypoints[k:]),
            moves=(*part.moves[:k], like, *part.moves[k:]),
            selected=k + 1,
            handled=True,
        )
        return state.replace(refitted(state[Joints].arm, changed))


@dataclass(frozen=True)
class RemoveWaypoint(PlanCommand):
    """Remove a waypoint, with the move to it."""

    k: int
    label: ClassVar[str] = "removed waypoint"

    def apply(self, state: State) -> State:
        """Return the state without the waypoint; one waypoint always stays."""
        part = state[Plan]
        k = checked_index(part, self.k)
        if len(part.waypoints) == 1:
            raise InputError("waypoints: at least one is needed; add another first")
        gone = max(k - 1, 0)
        changed = edited(
            part,
            waypoints=part.waypoints[:k] + part.waypoints[k + 1 :],
            moves=part.moves[:gone] + part.moves[gone + 1 :],
            selected=min(part.selected - (k < part.selected), len(part.waypoints) - 2),
        )
        return with_plan(state, refitted(state[Joints].arm, changed))


@dataclass(frozen=True)
class ShiftWaypoint(PlanCommand):
    """Exchange a waypoint with the previous or the next one."""

    k: int
    by: Literal[-1, 1]
    label: ClassVar[str] = "order of waypoints"

    def apply(self, state: State) -> State:
        """Return the state with the two exchanged; the moves stay in their places."""
        part = state[Plan]
        k, other = checked_index(part, self.k), self.k + self.by
        if not 0 <= other < len(part.waypoints):
            return state
        points = list(part.waypoints)
        points[k], points[other] = points[other], points[k]
        return with_plan(state, refitted(state[Joints].arm, edited(part, waypoints=tuple(points), selected=other)))


@dataclass(frozen=True)
class SelectWaypoint(Command):
    """Show the values of a waypoint, and of the move to it; the handle in the scene belongs to it, or to the arm.

    Parameters
    ----------
    k : int
        From 0.
    handled : bool
        Whether it can be dragged.
    """

    k: int
    handled: bool = True
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the waypoint selected."""
        part = state[Plan]
        if (part.selected, part.handled) == (self.k, self.handled):
            return state
        return state.replace(replace(part, selected=checked_index(part, self.k), handled=self.handled))


@dataclass(frozen=True)
class TakePresent(PlanCommand):
    """Set a waypoint to the present configuration."""

    k: int
    label: ClassVar[str] = "waypoint"

    def apply(self, state: State) -> State:
        """Return the state with the waypoint at the present configuration."""
        part = state[Plan]
        return with_plan(state, _with_point(part, self.k, Waypoint(tuple(state[Joints].q.tolist()))))


@dataclass(frozen=True)
class GoToWaypoint(Command):
    """Move the arm to a waypoint."""

    k: int
    label: ClassVar[str] = "move"

    def apply(self, state: State) -> State:
        """Return the state with the arm at the waypoint."""
        part, joints = state[Plan], state[Joints]
        moved = joints.moved_to(np.array(part.waypoints[checked_index(part, self.k)].q))
        return state if moved is joints else state.replace(moved)


@dataclass(frozen=True)
class SetWaypointJoint(PlanCommand):
    """Type one joint value of a waypoint, rad or m."""

    k: int
    joint: int
    value: float
    label: ClassVar[str] = "waypoint"

    def apply(self, state: State) -> State:
        """Return the state with the value; `InputError` outside the limits."""
        part, arm = state[Plan], state[Joints].arm
        q = list(part.waypoints[checked_index(part, self.k)].q)
        low, high = arm.limits[checked_joint(arm, self.joint)]
        if not low - 1e-9 <= self.value <= high + 1e-9:
            least, most = (_size(float(limit), bool(arm.revolute[self.joint])) for limit in (low, high))
            raise InputError(f"waypoint {self.k + 1}: joint {self.joint + 1} goes from {least} to {most}")
        q[self.joint] = self.value
        return with_plan(state, _with_point(part, self.k, Waypoint(checked_q(arm, q))))


@dataclass(frozen=True)
class SetAtWaypoint(PlanCommand):
    """Set what is done at a waypoint; None restores what comes by itself.

    Parameters
    ----------
    k : int
        From 0.
    name : str
        One of `AT_WAYPOINT`.
    value : object
    """

    k: int
    name: str
    value: Value
    label: ClassVar[str] = "gripper and wait"

    def apply(self, state: State) -> State:
        """Return the state with the waypoint selected; `InputError` outside the range."""
        part = state[Plan]
        point = part.waypoints[checked_index(part, self.k)]
        field = AT_WAYPOINT[known_name("at a waypoint", self.name, AT_WAYPOINT)]
        value = field.default if self.value is None else field.checked(self.value)
        if value == getattr(point, self.name):
            return state
        points = list(part.waypoints)
        points[self.k] = replace(point, **{self.name: value})
        return with_plan(state, refitted(state[Joints].arm, edited(part, waypoints=tuple(points), selected=self.k)))


@dataclass(frozen=True, eq=False)
class SetWaypointPose(PlanCommand):
    """Type the tool pose of a waypoint, (4, 4) in the world."""

    k: int
    pose: NDArray[np.floating]
    label: ClassVar[str] = "waypoint"

    def apply(self, state: State) -> State:
        """Return the state with the waypoint there, on its branch if possible; `InputError` out of reach."""
        part, arm = state[Plan], state[Joints].arm
        near = part.waypoints[checked_index(part, self.k)].q
        pose = _wanted(arm, self.pose, np.array(near))
        found = ik.solve(arm, pose, near, searches=SEARCHES)
        if not found.success:
            raise InputError(f"waypoint {self.k + 1}: {found.reason}")
        point = Waypoint(checked_q(arm, found.q), flat_pose(pose))
        return with_plan(state, _with_point(part, self.k, point))


@dataclass(frozen=True, eq=False)
class DragWaypoint(PlanCommand):
    """Drag the handle of a waypoint in the scene; this is one event of a drag.

    Parameters
    ----------
    k : int
    pose : ndarray, shape (4, 4)
        World.
    drag : object
        Which drag it belongs to.
    """

    k: int
    pose: NDArray[np.floating]
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "drag of a waypoint"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragWaypoint, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the waypoint there; out of reach it keeps the pose, and the plan reports it."""
        part, arm = state[Plan], state[Joints].arm
        near = np.array(part.waypoints[checked_index(part, self.k)].q)
        pose = _wanted(arm, self.pose, near)
        found = ik.solve(arm, pose, near, searches=1, complete=False)
        near_by = np.abs((found.q - near) / np.where(arm.revolute, 1.0, arm.length_scale)).max() <= DRAG_TRAVEL
        q = found.q if found.success or near_by else near
        point = Waypoint(checked_q(arm, q), flat_pose(pose))
        return state.replace(_with_point(part, self.k, point))


def _size(value: float, turns: bool) -> str:
    return (f"{np.degrees(value):.4g}°" if turns else f"{value:.4g} m").replace("-", "−")


def _with_point(part: Plan, k: int, point: Waypoint) -> Plan:
    """Return the plan with a waypoint elsewhere, where the same is done as before."""
    point = point.doing(part.waypoints[checked_index(part, k)])
    return edited(part, waypoints=(*part.waypoints[:k], point, *part.waypoints[k + 1 :]), selected=k)


def _wanted(arm: Arm, pose: NDArray[np.floating], q: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a pose whose components outside the arm's task are taken from its tool."""
    checked = np.array(as_pose(pose, "waypoint"), dtype=np.float64)
    if np.linalg.norm(checked[:3, 3] - arm.base[:3, 3]) > FARTHEST * 2.0 * arm.length_scale:
        raise InputError(f"waypoint: farther than {FARTHEST:g} times the reach of the arm")
    return np.asarray(feasible(arm, checked, np.asarray(arm.fk(q))), dtype=np.float64)
