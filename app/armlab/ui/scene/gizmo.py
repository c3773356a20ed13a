"""The handle of the target: arrows and rings for exactly the coordinates of the arm's task."""

from __future__ import annotations

import asyncio

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import DragTarget, EndDrag, Target, aimed_arm, target_pose
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._handle import Handle, handle_for
from armlab.ui.scene._nodes import move, seen
from armlab.ui.scene.frames import SWITCH as FRAMES

CATCH_UP = 0.05
"""Time, seconds, between steps of an arm that follows a handle at rest."""


class Gizmo:
    """The handle of the target; the arm goes on after the handle has come to rest."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._handle = Handle(canvas, "/target", self._dragged, self._wait_no_longer)
        self._later: asyncio.TimerHandle | None = None
        self._name: viser.LabelHandle | None = None

    def show(self, state: State) -> None:
        """Put the handle on the target."""
        target = state[Target]
        self._handle.show(target_pose(state), handle_for(aimed_arm(state).task, target.handle), target.axes)
        self._show_name(state)
        if self._handle.held and target.catching_up:
            self._catch_up_later()

    def _show_name(self, state: State) -> None:
        """Name the handle at its tip while the frames have names too: mostly it stands where the tool's frame does."""
        named = FRAMES.on(state)
        if self._name is None and named:
            path = self._canvas.path("target_name")
            self._name = self._canvas.scene.add_label(path, "target", font_screen_scale=0.85, anchor="bottom-left")
        if self._name is not None:
            seen(self._name, named)
            if named:
                move(self._name, self._handle.tip)

    def _dragged(self, pose: NDArray[np.floating], drag: object, ends: bool) -> None:
        """Post one command for one event of the drag."""
        self._canvas.post(EndDrag(pose, drag) if ends else DragTarget(pose, drag))

    def _wait_no_longer(self) -> None:
        if self._later is not None:
            self._later.cancel()
            self._later = None

    def _catch_up_later(self) -> None:
        if self._later is None:
            self._later = asyncio.get_running_loop().call_later(CATCH_UP, self._catch_up)

    def _catch_up(self) -> None:
        """Ask for one more step of the arm; what is shown of it asks for the next one."""
        self._later = None
        self._canvas.post(DragTarget(None, self._handle.drag))


def build(canvas: LayerCanvas, state: State) -> Show:
    """Put the handle on the target."""
    gizmo = Gizmo(canvas)
    return gizmo.show


LAYER = Layer("gizmo", order=50, watches=(Joints, Target, Display), build=build, silent=True)
