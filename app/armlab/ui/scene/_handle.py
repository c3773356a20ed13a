"""A handle to drag, made of one or two transform controls that act as one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.rotations import quaternion_from_rotation, rotation_from_quaternion
from armlab.kin.task import Task
from armlab.kin.transforms import transform
from armlab.ui import adapter
from armlab.ui.camera import HANDLE
from armlab.ui.drawing import LayerCanvas

Floats = NDArray[np.floating]

ALONG = 1e-6
"""Sine of the angle within which an axis of the tool lies along those of the task."""


class Handle:
    """Arrows and rings for exactly what the task of an arm controls.

    Parameters
    ----------
    canvas : LayerCanvas
    path : str
        Name of its node; a second control has a 1 behind it.
    on_drag : callable
        ``on_drag(pose, drag, ends)`` with the pose (4, 4) in the world the hand asks for, an object that stands for the
        drag, and whether the hand has let go. A mere click is no drag.
    on_start : callable
        Called when a hand takes hold.
    scale : float
        Length of the arrows in sizes of the arm.

    Attributes
    ----------
    what : str or int
        What the handle is of, where several things share it; see `at`.
    """

    def __init__(
        self,
        canvas: LayerCanvas,
        path: str,
        on_drag: Callable[[Floats, object, bool], None],
        on_start: Callable[[], None] = lambda: None,
        scale: float = HANDLE,
    ) -> None:
        self._canvas, self._path, self._on_drag, self._on_start = canvas, path, on_drag, on_start
        self._scale = scale
        self.what: str | int = ""
        self._then: tuple[str | int, Callable[[], None] | None] | None = None
        self._made_for: tuple[str, str, str] | None = None
        self._controls: list[viser.TransformControlsHandle] = []
        self._held: viser.TransformControlsHandle | None = None
        self._drag: object = None
        self._pulled = False
        self._pose: Floats = np.eye(4)
        self._axes: Floats = np.eye(3)
        self._start: tuple[Floats, Floats] = (np.eye(3), np.eye(3))

    @property
    def held(self) -> bool:
        """Whether a person holds the handle."""
        return self._held is not None

    @property
    def tip(self) -> Floats:
        """The end of the first arrow of the handle where it was shown last, (3,) in the world."""
        arm = self._canvas.drawn.figure.anatomy.arm
        axis = min("xyz".index(letter) for letter in arm.task.position or "x")
        return np.asarray(self._pose[:3, 3] + self._scale * self._canvas.size * self._axes[:, axis])

    @property
    def drag(self) -> object:
        """Key of the present drag, or of the last one."""
        return self._drag

    def at(self, what: str | int, show: Callable[[], None] | None) -> None:
        """Let several things share the handle: a hand keeps the one it holds, whatever is selected elsewhere meanwhile.

        Parameters
        ----------
        what : str or int
            The one that has the handle now, or as soon as the hand lets go of another.
        show : callable or None
            Puts the handle there, by one of the methods below; None for nothing that has a handle.
        """
        self._then = None
        if self._held is not None and what != self.what:
            self._then = what, show
            return
        self.what = what
        if show is not None:
            show()
        elif self._held is None:
            self.remove()

    def show(self, pose: Floats, handle: str, axes: str) -> None:
        """Put the handle to a pose (4, 4) in the world; never while and where a hand holds it.

        ``handle`` is ``"move"`` or ``"turn"``, ``axes`` is ``"world"`` or ``"tool"``.
        """
        arm = self._canvas.drawn.figure.anatomy.arm
        self._show(pose, axes_of(arm, handle, axes, pose), (arm.task.key, handle, axes), handles_of(arm, handle))

    def show_rings(self, pose: Floats, axes: Floats) -> None:
        """Put rings that turn something freely, whatever the task of the arm, about axes (3, 3) at a pose (4, 4)."""
        self._show(pose, axes, ("", "turn", ""), [_ring("xyz")])

    def show_arrows(self, pose: Floats, axes: Floats, letters: str = "xyz", ring: str = "") -> None:
        """Put arrows that move something, whatever the task of the arm, along some of the axes (3, 3) at a pose (4, 4).

        ``ring`` is the letter of an axis about which it can be turned, too.
        """
        controls = [_arrows(letters), *([_ring(ring)] if ring else [])]
        self._show(pose, axes, ("", letters, ring), controls)

    def _show(self, pose: Floats, axes: Floats, wanted: tuple[str, str, str], controls: list[dict[str, Any]]) -> None:
        self._pose, self._axes = pose, axes
        if self._made_for != wanted and self._held is None:
            self.remove()
            self._controls = [self._control(i, options) for i, options in enumerate(controls)]
            self._made_for = wanted
        for control in self._controls:
            if control is not self._held:
                _place(control, axes, pose[:3, 3])

    def remove(self) -> None:
        """Remove the handle from the scene."""
        for control in self._controls:
            control.remove()
        self._controls, self._made_for, self._held = [], None, None

    def _control(self, i: int, options: dict[str, Any]) -> viser.TransformControlsHandle:
        control = self._canvas.scene.add_transform_controls(
            f"{self._path}{i}" if i else self._path,
            scale=self._scale * self._canvas.size,
            line_width=3.0,
            depth_test=False,
            **options,
        )
        adapter.on_event(control, "on_update", lambda event: self._moved(control, event.phase))
        adapter.of_one_page(control)
        # Written even where it is viser's default: the page would keep the pose of an earlier handle of this name.
        adapter.set_wxyz(control, (1.0, 0.0, 0.0, 0.0))
        adapter.set_position(control, (0.0, 0.0, 0.0))
        return control

    def _moved(self, control: viser.TransformControlsHandle, phase: str) -> None:
        self._on_start()
        if phase == "start":
            self._held, self._drag, self._pulled = control, object(), False
            self._start = rotation_from_quaternion(control.wxyz), self._pose[:3, :3]
            return
        ends = phase == "end"
        if ends:
            self._held = None
        if self._pulled or not ends:  # else a mere click
            self._pulled = True
            turned, began = self._start
            R = rotation_from_quaternion(control.wxyz) @ turned.T @ began
            self._on_drag(transform(R, control.position), self._drag, ends)
        if ends and self._then is not None:
            self.at(*self._then)


def axes_of(arm: Arm, handle: str, axes: str, pose: Floats) -> Floats:
    """Return the axes (3, 3) of a handle at a pose (4, 4): the tool's, or those of frame 0.

    The tool's serve where the task controls everything that is offered along them or about them. Parallel joint axes
    keep the turn of the tool against the plane of the task, so that a drag never changes the axes under the hand.
    """
    base, tool = arm.base[:3, :3], pose[:3, :3]
    if handle == "turn" and arm.task.rotation == "approach":
        return tool
    offered = _offered(arm.task, handle)
    others = [k for k in range(3) if k not in offered]
    leaks = (base.T @ tool)[np.ix_(others, offered)]
    whole = not others or (arm.description.axes_parallel and bool(np.all(np.abs(leaks) < ALONG)))
    return tool if axes == "tool" and whole else base


def _offered(task: Task, handle: str) -> list[int]:
    """Return the indices of the axes along which a handle moves, or about which it turns."""
    if handle == "move":
        return task.coordinates
    return [2] if task.rotation == "phi" else [0, 1, 2]


def handle_for(task: Task, wanted: str) -> str:
    """Return whether a handle moves or turns: as is wanted, if the task has both a position and an orientation."""
    if task.rotation == "none":
        return "move"
    return wanted if task.position else "turn"


def handles_of(arm: Arm, handle: str) -> list[dict[str, Any]]:
    """Return the options of the transform controls that offer just what the task controls.

    A control has an arrow for each active axis, a square for each pair of them and a ring about each axis whose two
    neighbours are active, so single rings need single controls.
    """
    task = arm.task
    if handle == "turn":
        rings = {"none": (), "phi": ("z",), "approach": ("x", "y"), "full": ("xyz",)}[task.rotation]
        return [_ring(ring) for ring in rings]
    return [_arrows(task.position)] if task.position else []


def _arrows(letters: str) -> dict[str, Any]:
    axes = tuple(letter in letters for letter in "xyz")
    return {"active_axes": axes, "disable_rotations": True, "disable_sliders": sum(axes) != 2}


def _ring(about: str) -> dict[str, Any]:
    neighbours = tuple(about == "xyz" or letter != about for letter in "xyz")
    return {"active_axes": neighbours, "disable_axes": True, "disable_sliders": True}


def _place(control: viser.TransformControlsHandle, axes: Floats, position: Floats) -> None:
    wxyz = quaternion_from_rotation(axes)
    if not np.array_equal(wxyz, control.wxyz):
        w, x, y, z = wxyz.tolist()
        adapter.set_wxyz(control, (w, x, y, z))
    if not np.array_equal(position, control.position):
        px, py, pz = position.tolist()
        adapter.set_position(control, (px, py, pz))
