"""The target of the tool, the commands of its handle, and what the arm makes of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Literal, Self

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin import ik
from armlab.kin.ik.solve import come_closer, problem_of
from armlab.kin.ik.target import feasible
from armlab.kin.ik.verdict import free_joints
from armlab.kin.transforms import as_pose
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, Json, Part, PartType, State

Axes = Literal["world", "tool"]
Handle = Literal["move", "turn"]
AXES: tuple[Axes, ...] = ("world", "tool")
HANDLES: tuple[Handle, ...] = ("move", "turn")

DRAG_TRAVEL = 0.6
"""Largest change of a joint, in rad or length scales, for one event of a drag (20 a second): the arm follows fast but
never jumps, also beside a singularity; what is left follows with the next event."""

SEARCHES_TYPED = 30
"""Starts of a solve for a typed target: some 10 ms when none of them succeeds."""

OTHER_STARTS = 12
"""Random starts of the search for another branch."""

FARTHEST = 1e3
"""Targets farther than so many times the reach are refused as slips of the pen."""


@dataclass(frozen=True, eq=False)
class Target(Part):
    """Where the tool is wanted.

    Attributes
    ----------
    pose : ndarray, shape (4, 4), or None
        In the world; None while the target sits on the tool.
    catching_up : bool
        Whether the arm was held back by `DRAG_TRAVEL` and has to follow on.
    axes : "world" or "tool"
        Along which axes the handle moves.
    handle : "move" or "turn"
    method : str
        Key of the method of inverse kinematics.
    """

    key: ClassVar[str] = "target"

    pose: NDArray[np.float64] | None = None
    catching_up: bool = False
    axes: Axes = "world"
    handle: Handle = "move"
    method: str = "dls"

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return a target on the tool."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep axes and method; put the target on the tool of the new arm."""
        return replace(self, pose=None, catching_up=False, handle="move")

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the handle too when the arm still has that handle."""
        kept = self.for_robot(robot)
        return replace(kept, handle=self.handle) if robot.arm.task.rotation != "none" else kept

    def after(self, before: State, now: State) -> Self:
        """Put the target back on the tool when the joints were moved by anything but the target itself."""
        moved = now[Joints].q is not before[Joints].q
        if moved and self is before[Target] and self.pose is not None:
            return replace(self, pose=None, catching_up=False)
        return self

    def to_json(self) -> Json:
        """Write the target and how it is handled."""
        pose = None if self.pose is None else self.pose.tolist()
        return {"pose": pose, "axes": self.axes, "handle": self.handle, "method": self.method}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back."""
        pose = None if data["pose"] is None else as_pose(data["pose"], "target")
        axes = next(name for name in AXES if name == data["axes"])
        handle = next(name for name in HANDLES if name == data["handle"])
        return cls(pose, False, axes, handle, ik.method_named(data["method"]).key)


PART = PartType(Target, order=20)


def target_pose(state: State) -> NDArray[np.floating]:
    """Return where the tool is wanted, (4, 4): on the tool when nothing else is."""
    pose = state[Target].pose
    return state[Joints].tool_pose if pose is None else pose


def verdict(state: State) -> ik.Verdict:
    """Return what the present configuration is worth for the target."""
    joints = state[Joints]
    return ik.judge(joints.arm, target_pose(state), joints.q, joints.locked)


@dataclass(frozen=True, eq=False)
class DragTarget(Command):
    """Follow the handle: one event of a drag, or one more step of catching up when the hand rests.

    Parameters
    ----------
    pose : ndarray, shape (4, 4), or None
        Where the handle is, in the world; None goes on to the target there is.
    drag : object
        Which drag it belongs to; any object that stands for it alone. One drag is one step of undo.
    """

    pose: NDArray[np.floating] | None
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "drag"

    @property
    def stroke(self) -> object:
        """One drag is one step."""
        return DragTarget, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the arm closer to the handle, by at most `DRAG_TRAVEL` a joint."""
        return _followed(state, self.pose, DRAG_TRAVEL)


@dataclass(frozen=True, eq=False)
class EndDrag(Command):
    """Let go of the handle: the arm goes as close as it can."""

    pose: NDArray[np.floating]
    drag: object
    label: ClassVar[str] = "drag"

    @property
    def stroke(self) -> object:
        """The last event of the drag."""
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
        """Return the state with the arm at a solution, or at the closest configuration from where it is."""
        joints, target = state[Joints], state[Target]
        pose = _wanted(joints, self.pose)
        result = ik.solve(joints.arm, pose, joints.q, target.method, 0, joints.locked, searches=SEARCHES_TYPED)
        return _placed(state, pose, result.q, catching_up=False)


@dataclass(frozen=True)
class GoAnotherWay(Command):
    """Jump to another branch of the arm that reaches the target, if a search from random starts finds one."""

    label: ClassVar[str] = "jump to a solution"

    def apply(self, state: State) -> State:
        """Return the state in the configuration found; the target stays where it is.

        Raises
        ------
        InputError
            None was found, which does not prove that there is none.
        """
        joints, target = state[Joints], state[Target]
        pose = target_pose(state)
        found = ik.solve(joints.arm, pose, joints.q, target.method, 0, joints.locked, searches=OTHER_STARTS)
        if not found.success:
            raise InputError(f"no way to the target was found from {OTHER_STARTS} random starts")
        return state.replace(joints.moved_to(found.q), replace(target, catching_up=False))


@dataclass(frozen=True)
class TargetToTool(Command):
    """Put the target back on the tool."""

    label: ClassVar[str] = "target to tool"

    def apply(self, state: State) -> State:
        """Return the state with the target on the tool."""
        target = state[Target]
        return state if target.pose is None else state.replace(replace(target, pose=None, catching_up=False))


@dataclass(frozen=True)
class HandleBy(Command):
    """Choose along which axes the handle moves, what it does, or the method that follows it; None leaves as it is."""

    axes: Axes | None = None
    handle: Handle | None = None
    method: str | None = None
    label: ClassVar[str] = "choice"

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        target = state[Target]
        for name, value, options in (("axes", self.axes, AXES), ("handle", self.handle, HANDLES)):
            if value is not None and value not in options:
                raise UnknownName(name, value, options)
        if self.method is not None:
            ik.method_named(self.method)
        chosen = replace(
            target,
            axes=self.axes or target.axes,
            handle=self.handle or target.handle,
            method=self.method or target.method,
        )
        same = (chosen.axes, chosen.handle, chosen.method) == (target.axes, target.handle, target.method)
        return state if same else state.replace(chosen)


def _followed(state: State, handle: NDArray[np.floating] | None, travel: float) -> State:
    joints, target = state[Joints], state[Target]
    if handle is None:
        if target.pose is None or not target.catching_up:
            return state
        handle = target.pose
    pose = _wanted(joints, handle)
    problem = problem_of(joints.arm, ik.method_named(target.method))
    free = free_joints(joints.locked)
    q = np.array(come_closer(problem, problem.target(pose), joints.q, free, travel).q)
    scale = np.where(joints.arm.revolute, 1.0, joints.arm.length_scale)
    held_back = bool(np.any(np.abs(q - joints.q) > 0.999 * travel * scale)) if np.isfinite(travel) else False
    return _placed(state, pose, q, catching_up=held_back)


def _placed(state: State, pose: NDArray[np.float64], q: NDArray[np.float64], catching_up: bool) -> State:
    joints = state[Joints].moved_to(q)
    if joints.arm.task.rotation == "none":
        # The orientation is free: show the target as the tool will be there.
        pose = np.array(pose)
        pose[:3, :3] = joints.tool_pose[:3, :3]
    pose.setflags(write=False)
    return state.replace(joints, replace(state[Target], pose=pose, catching_up=catching_up))


def _wanted(joints: Joints, pose: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the pose with the components the arm does not control taken from its tool."""
    checked = as_pose(pose, "target")
    arm = joints.arm
    if np.linalg.norm(checked[:3, 3] - arm.base[:3, 3]) > FARTHEST * 2.0 * arm.length_scale:
        raise InputError(f"target: farther than {FARTHEST:g} times the reach of the arm")
    return feasible(arm, checked, joints.tool_pose)
