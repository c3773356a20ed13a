"""The handle of the target: arrows and rings for exactly what the arm's task controls."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.rotations import quaternion_from_rotation, rotation_from_quaternion
from armlab.kin.transforms import transform
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import DragTarget, EndDrag, Target, target_pose
from armlab.session.state import State
from armlab.ui import adapter
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show

SCALE = 0.14
"""Length of the arrows, in sizes of the arm."""

CATCH_UP = 0.05
"""Seconds between steps of an arm that has fallen behind a resting hand."""


class Gizmo:
    """One or two transform controls that act as one handle."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._made_for: tuple[str, str, str] | None = None
        self._controls: list[viser.TransformControlsHandle] = []
        self._state: State | None = None
        self._held: viser.TransformControlsHandle | None = None
        self._drag: object = None
        self._start: tuple[NDArray[np.floating], NDArray[np.floating]] = (np.eye(3), np.eye(3))
        self._later: asyncio.TimerHandle | None = None

    def show(self, state: State) -> None:
        """Put the handle on the target; never while and where a hand holds it."""
        self._state = state
        arm, target = self._canvas.drawn.figure.anatomy.arm, state[Target]
        wanted = (arm.task.key, target.handle, target.axes)
        if self._made_for != wanted and self._held is None:
            self._make(arm, target)
            self._made_for = wanted
        pose = target_pose(state)
        axes = pose[:3, :3] if self._along_tool(arm, target) else arm.base[:3, :3]
        for control in self._controls:
            if control is not self._held:
                _place(control, axes, pose[:3, 3])
        if self._held is not None and target.catching_up:
            self._catch_up_later()

    def _along_tool(self, arm: Arm, target: Target) -> bool:
        """Whether the handle has the tool's axes; controls of part of the axes keep those of frame 0."""
        if target.handle == "turn" and arm.task.rotation == "approach":
            return True
        whole = arm.task.position == "xyz" or arm.description.axes_parallel
        return target.axes == "tool" and whole

    def _make(self, arm: Arm, target: Target) -> None:
        for control in self._controls:
            control.remove()
        self._controls = [self._control(i, options) for i, options in enumerate(handles_of(arm, target.handle))]

    def _control(self, i: int, options: dict[str, Any]) -> viser.TransformControlsHandle:
        control = self._canvas.scene.add_transform_controls(
            f"/target{i}" if i else "/target",
            scale=SCALE * self._canvas.size,
            line_width=3.0,
            depth_test=False,
            **options,
        )
        adapter.on_event(control, "on_update", lambda event: self._moved(control, event.phase))
        # Written even where it is viser's default: the page would keep the pose of an earlier handle of this name.
        adapter.set_wxyz(control, (1.0, 0.0, 0.0, 0.0))
        adapter.set_position(control, (0.0, 0.0, 0.0))
        return control

    def _moved(self, control: viser.TransformControlsHandle, phase: str) -> None:
        """Turn one event of the hand into one command."""
        if self._later is not None:
            self._later.cancel()
            self._later = None
        assert self._state is not None
        if phase == "start":
            self._held, self._drag, self._pulled = control, object(), False
            self._start = rotation_from_quaternion(control.wxyz), target_pose(self._state)[:3, :3]
            return
        if phase == "end" and not self._pulled:
            self._held = None  # a mere click
            return
        self._pulled = True
        turned, began = self._start
        R = rotation_from_quaternion(control.wxyz) @ turned.T @ began
        pose = transform(R, control.position)
        if phase == "end":
            self._held = None
            self._canvas.post(EndDrag(pose, self._drag))
        else:
            self._canvas.post(DragTarget(pose, self._drag))

    def _catch_up_later(self) -> None:
        if self._later is None:
            step: Callable[[], None] = lambda: self._canvas.post(DragTarget(None, self._drag))  # noqa: E731
            self._later = asyncio.get_running_loop().call_later(CATCH_UP, step)


def handles_of(arm: Arm, handle: str) -> list[dict[str, Any]]:
    """Return the options of the transform controls that offer just what the task controls.

    A control has an arrow for each active axis, a square for each pair of them and a ring about each axis whose two
    neighbours are active, so single rings need single controls.
    """
    task = arm.task
    if handle == "turn":
        rings = {"none": (), "phi": ("z",), "approach": ("x", "y"), "full": ("xyz",)}[task.rotation]
        return [_ring(ring) for ring in rings]
    axes = tuple(letter in task.position for letter in "xyz")
    in_plane = sum(axes) == 2
    return [{"active_axes": axes, "disable_rotations": True, "disable_sliders": not in_plane}] if any(axes) else []


def _ring(about: str) -> dict[str, Any]:
    neighbours = tuple(about == "xyz" or letter != about for letter in "xyz")
    return {"active_axes": neighbours, "disable_axes": True, "disable_sliders": True}


def _place(control: viser.TransformControlsHandle, axes: NDArray[np.floating], position: NDArray[np.floating]) -> None:
    wxyz = quaternion_from_rotation(axes)
    if not np.array_equal(wxyz, control.wxyz):
        w, x, y, z = wxyz.tolist()
        adapter.set_wxyz(control, (w, x, y, z))
    if not np.array_equal(position, control.position):
        px, py, pz = position.tolist()
        adapter.set_position(control, (px, py, pz))


def build(canvas: LayerCanvas, state: State) -> Show:
    """Put the handle on the target."""
    gizmo = Gizmo(canvas)
    return gizmo.show


LAYER = Layer("gizmo", order=50, watches=(Joints, Target), build=build, silent=True)
