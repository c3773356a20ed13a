"""The target of the tool, the commands of its handle, and the reaction of the arm."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Literal, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.conditioning import NEAR
from armlab.kin.ik.search import problem_of
from armlab.kin.ik.solve import come_closer
from armlab.kin.ik.target import feasible
from armlab.kin.ik.verdict import free_joints
from armlab.kin.transforms import as_pose
from armlab.session.asked import ASKED, ASKS, FAVOURS, asked_arm, turned_like, weights_of
from armlab.session.branch_words import STILL_NEAR, Branch, branch_of, crossed, followed, near_singularity
from armlab.session.fields import FieldPart, choice, own
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, Json, PartType, State
from armlab.session.way_to_solution import another_way

Axes = Literal["world", "tool"]
Handle = Literal["move", "turn"]
AXES: tuple[Axes, ...] = ("world", "tool")
HANDLES: tuple[Handle, ...] = ("move", "turn")

DRAG_TRAVEL = 0.6
"""Largest change of a joint, rad or length scales, in one event of a drag (20 a second): the arm follows fast but does
not jump, even beside a singularity; the rest follows with the next event."""

SAME = 1e-6
"""Difference, rad or m, within which a held joint is where a configuration has it."""

SEARCHES_TYPED = 30
"""Number of starts in solving for a typed target: some 10 ms if none succeeds."""

LINGER = 2.0
"""Time, seconds, for which a sentence on a drag stays after it has ceased to be true."""

FARTHEST = 1e3
"""Largest distance of a target, relative to the reach: beyond it the number is refused as a typing mistake."""


class Said(NamedTuple):
    """A sentence on a drag, and when it was last true, in seconds of the session's clock."""

    text: str
    at: float


@dataclass(frozen=True)
class Judged(ik.Verdict):
    """A verdict, and further sentences on a drag."""

    notes: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Target(FieldPart):
    """The wanted pose of the tool.

    Attributes
    ----------
    pose : ndarray, shape (4, 4), or None
        Pose in the world; None while the target is at the tool.
    catching_up : bool
        Whether the arm was held back by `DRAG_TRAVEL` and has to follow on.
    axes : "world" or "tool"
        Along which axes the handle moves.
    handle : "move" or "turn"
    method : str
        Key of the method of inverse kinematics.
    asks, favours : str
        Keys of `armlab.session.asked`: which part of the target counts, and which error is kept smaller out of reach.
    branch : tuple of str
        Branch of the arm when it last followed the target; empty before.
    crossing, near : Said or None
        Sentences on the branch to which it has changed, and on the singularity it is near.
    jumps : int
        How often the arm has jumped to another solution; a jump is shown as a move of half a second.
    """

    key: ClassVar[str] = "target"
    called: ClassVar[str] = "the target"

    pose: NDArray[np.float64] | None = own(
        "target", None, lambda T: None if T is None else as_pose(T, "target"), kept=""
    )
    catching_up: bool = False
    axes: Axes = choice("axes of the handle", "world", AXES)
    handle: Handle = choice("what dragging does", "move", HANDLES, kept="edits")
    method: str = own("method", "dls", lambda key: ik.method_named(key).key)
    asks: str = choice("part of the target that counts", "", ASKS, kept="edits")
    favours: str = choice("which error is kept smaller", "", FAVOURS, kept="edits")
    branch: Branch = ()
    crossing: Said | None = None
    near: Said | None = None
    jumps: int = 0

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Return the part with the handle if the edited arm can still use it."""
        kept = super().for_edited(robot, origin)
        return replace(kept, handle="move") if robot.arm.task.rotation == "none" else kept

    def to_json(self) -> Json:
        """Return the fields as JSON; of what counts only where it is less than all."""
        return {key: value for key, value in super().to_json().items() if value or key not in ("asks", "favours")}

    def after(self, before: State, now: State) -> Self:
        """Put the target back on the tool when the joints were moved by anything but the target itself.

        Where it was the target that moved them, notice what there is to say.
        """
        if now[Joints].q is before[Joints].q or self.pose is None:
            return self
        if self is before[Target]:
            return self.on_tool()
        return self._noticing(before[Joints], now) if now[Joints].arm is before[Joints].arm else self

    def on_tool(self) -> Self:
        """Return the part with the target at the tool, and without sentences."""
        return replace(self, pose=None, catching_up=False, branch=(), crossing=None, near=None)

    def jumped(self, joints: Joints) -> Self:
        """Return the part after a jump to another solution: no sentence on a change of branch, as it was wanted."""
        return replace(self, catching_up=False, branch=branch_of(joints.arm, joints.q), crossing=None, near=None)

    def _noticing(self, before: Joints, now: State) -> Self:
        arm, q = before.arm, now[Joints].q
        was = self.branch or branch_of(arm, before.q)
        branch = followed(was, branch_of(arm, q))
        change = crossed(was, branch)
        crossing = Said(change, now.at) if change else _lasting(self.crossing, now.at)
        near = _lasting(self.near, now.at)
        text = near_singularity(arm, q, NEAR if near is None else STILL_NEAR)
        return replace(self, branch=branch, crossing=crossing, near=Said(text, now.at) if text else near)


PART = PartType(Target, order=20)


def target_pose(state: State) -> NDArray[np.floating]:
    """Return the wanted pose of the tool, (4, 4): the present one when there is no other."""
    pose = state[Target].pose
    return state[Joints].tool_pose if pose is None else pose


def aimed_arm(state: State) -> Arm:
    """Return the arm with the task that its target asks for."""
    return asked_arm(state[Joints].arm, state[Target].asks)


def verdict(state: State) -> Judged:
    """Return the verdict on the present configuration for what counts of the target, with sentences on the way."""
    joints, target, arm = state[Joints], state[Target], aimed_arm(state)
    found = ik.judge(arm, target_pose(state), joints.q, joints.locked, weights_of(arm, target.favours))
    notes = tuple(said.text for said in (target.crossing, target.near) if said is not None)
    if arm is not joints.arm:
        notes = (ASKED[target.asks], *notes)
    return Judged(found.status, found.position_error, found.rotation_error, found.limits, notes)


def _lasting(said: Said | None, at: float) -> Said | None:
    """Return a sentence that is still to be shown, or None."""
    return said if said is not None and at - said.at < LINGER else None


@dataclass(frozen=True, eq=False)
class DragTarget(Command):
    """Follow the handle: one event of a drag, or one more step of catching up when the hand rests.

    Parameters
    ----------
    pose : ndarray, shape (4, 4), or None
        Pose of the handle, in the world; None to go on to the present target.
    drag : object
        Key of the drag; any object that belongs to it alone. One drag is one step of undo.
    """

    pose: NDArray[np.floating] | None
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "drag"

    @property
    def stroke(self) -> object:
        """The drag: one drag is one step of undo."""
        return DragTarget, self.drag

    def instead_of(self, waiting: Command) -> Command:
        """Return the newer one, unless that only goes on: a pose of the hand that waits says more."""
        return waiting if self.pose is None else self

    def apply(self, state: State) -> State:
        """Return the state with the arm closer to the handle, each joint moved by at most `DRAG_TRAVEL`."""
        return _followed(state, self.pose, DRAG_TRAVEL)


@dataclass(frozen=True, eq=False)
class EndDrag(Command):
    """Release the handle: the arm moves as close to it as it can."""

    pose: NDArray[np.floating]
    drag: object
    label: ClassVar[str] = "drag"

    @property
    def stroke(self) -> object:
        """The drag, of which this is the last event."""
        return DragTarget, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the arm at the closest configuration downhill."""
        return _followed(state, self.pose, np.inf)


@dataclass(frozen=True, eq=False)
class PlaceTarget(Command):
    """Put the target at a typed pose and solve for it, also on other branches."""

    pose: NDArray[np.floating]
    label: ClassVar[str] = "target"

    def apply(self, state: State) -> State:
        """Return the state with the arm at a solution, or at the closest configuration found from where it is."""
        joints, target, arm = state[Joints], state[Target], aimed_arm(state)
        pose, weights = _wanted(arm, joints, self.pose), weights_of(arm, target.favours)
        # The list of all solutions has its last word on the arm's own task only: of less there are whole families.
        own = arm is joints.arm
        result = ik.solve(
            arm, pose, joints.q, target.method, weights, locked=joints.locked, searches=SEARCHES_TYPED, complete=own
        )
        return _placed(state, pose, result.q, catching_up=False)


@dataclass(frozen=True)
class AskFor(Command):
    """Choose what counts of the target, and which error is kept smaller out of reach; the arm then goes there anew.

    Parameters
    ----------
    asks, favours : str, optional
        Keys of `armlab.session.asked`; None leaves a choice unchanged.
    """

    asks: str | None = None
    favours: str | None = None
    label: ClassVar[str] = "part of the target that counts"

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        given = {"asks": self.asks, "favours": self.favours}
        target = state[Target].with_values({name: key for name, key in given.items() if key is not None})
        changed = state.replace(target)
        return changed if target.pose is None else PlaceTarget(target.pose).apply(changed)


def brought_to(state: State, q: NDArray[np.float64]) -> State:
    """Return the state with the arm at a configuration; held joints stay, and the tool comes there as near as it can.

    Parameters
    ----------
    state : State
    q : ndarray, shape (n,)
        Joint values inside the limits, rad and m.
    """
    joints = state[Joints]
    if np.any(np.abs(joints.q - q)[np.array(joints.locked)] > SAME):
        return PlaceTarget(np.array(joints.arm.fk(q), dtype=np.float64)).apply(state)
    return state.replace(joints.moved_to(q))


@dataclass(frozen=True)
class GoAnotherWay(Command):
    """Jump to the nearest other solution inside the limits."""

    label: ClassVar[str] = "jump to a solution"

    def apply(self, state: State) -> State:
        """Return the state in the configuration found; the target stays where it is.

        Raises
        ------
        InputError
            There is none, or none was found; the text says why.
        """
        joints, target = state[Joints], state[Target]
        q = another_way(joints.arm, target_pose(state), joints.q, joints.locked, target.method)
        return jumped_to(state, q)


@dataclass(frozen=True)
class TargetToTool(Command):
    """Put the target back to the tool."""

    label: ClassVar[str] = "target to tool"

    def apply(self, state: State) -> State:
        """Return the state with the target at the tool."""
        target = state[Target]
        return state if target.pose is None else state.replace(target.on_tool())


def _followed(state: State, handle: NDArray[np.floating] | None, travel: float) -> State:
    joints, target = state[Joints], state[Target]
    if handle is None:
        if target.pose is None or not target.catching_up:
            return state
        handle = target.pose
    arm = aimed_arm(state)
    pose = _wanted(arm, joints, handle)
    problem = problem_of(arm, ik.method_named(target.method), weights_of(arm, target.favours))
    free = free_joints(joints.locked)
    q = np.array(come_closer(problem, problem.target(pose), joints.q, free, travel).q)
    scale = np.where(joints.arm.revolute, 1.0, joints.arm.length_scale)
    held_back = bool(np.any(np.abs(q - joints.q) > 0.999 * travel * scale)) if np.isfinite(travel) else False
    return _placed(state, pose, q, catching_up=held_back)


def _placed(state: State, pose: NDArray[np.float64], q: NDArray[np.float64], catching_up: bool) -> State:
    joints, arm = state[Joints].moved_to(q), aimed_arm(state)
    if arm.task.rotation == "none":
        pose = _with_rotation(pose, joints)
    elif arm is not joints.arm:
        pose = turned_like(pose, joints.tool_pose)
    pose.setflags(write=False)
    return state.replace(joints, replace(state[Target], pose=pose, catching_up=catching_up))


def jumped_to(state: State, q: NDArray[np.float64], jumps: int = 1) -> State:
    """Return the state with the arm at another solution for the same target.

    Parameters
    ----------
    state : State
    q : ndarray, shape (n,)
    jumps : int
        1 for a jump, which is shown as a move; 0 for one picture of a hand that moves it all the way.
    """
    joints = state[Joints].moved_to(q)
    target = replace(state[Target].jumped(joints), jumps=state[Target].jumps + jumps)
    if target.pose is not None and aimed_arm(state).task.rotation == "none":
        target = replace(target, pose=_with_rotation(target.pose, joints))
    return state.replace(joints, target)


def _with_rotation(pose: NDArray[np.float64], joints: Joints) -> NDArray[np.float64]:
    """Return a pose with its free orientation as the tool will have it there."""
    turned = np.array(pose)
    turned[:3, :3] = joints.tool_pose[:3, :3]
    turned.setflags(write=False)
    return turned


def _wanted(arm: Arm, joints: Joints, pose: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the pose with the components that do not count taken from the tool."""
    checked = as_pose(pose, "target")
    if np.linalg.norm(checked[:3, 3] - arm.base[:3, 3]) > FARTHEST * 2.0 * arm.length_scale:
        raise InputError(f"target: farther than {FARTHEST:g} times the reach of the arm")
    return feasible(arm, checked, joints.tool_pose)
