"""The waypoints of the plan: numbered points that can be clicked, and the handle of the selected one."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.motion.plan.points import DragWaypoint, SelectWaypoint
from armlab.benches.motion.plan.state import CLIP_KEY, Plan
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui import adapter
from armlab.ui.colours import BLUE, GREY
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._handle import Handle, handle_for
from armlab.ui.scene._nodes import add_triad, move, put, seen, write
from armlab.ui.scene._strokes import add_name

POINT = 0.014
"""Radius of a waypoint, in sizes of the arm."""

FRAME = 0.55
"""Size of the frame at the selected waypoint, relative to other frames."""

NOTHING = -1
"""Number in place of that of the selected waypoint, when none has the handle."""

TOGETHER = 0.03
"""Distance of waypoints, in sizes of the arm, below which they share one label."""

Floats = NDArray[np.float64]


class _Points:
    """All waypoints; points are rebuilt only if their number changes."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._points: list[tuple[viser.IcosphereHandle, viser.LabelHandle]] = []
        self._frame = add_triad(canvas.scene, canvas.path("waypoints/frame"), FRAME * canvas.size)
        self._handle = Handle(canvas, canvas.path("waypoints/handle"), self._dragged)

    def show(self, state: State) -> None:
        """Show the waypoints of a state."""
        part, arm = state[Plan], self._canvas.drawn.figure.anatomy.arm
        if part.recorded is not None or len(part.waypoints[0].q) != arm.n:
            self._hide()
            return
        poses = np.array([point.wanted(arm) for point in part.waypoints])
        names = names_of(poses[:, :3, 3], TOGETHER * self._canvas.size)
        for k, pose in enumerate(poses):
            ball_, label = self._point(k)
            move(ball_, pose[:3, 3])
            write(label, names[k])
            seen(ball_, True)
            seen(label, bool(names[k]))
        for ball_, label in self._points[len(poses) :]:
            seen(ball_, False)
            seen(label, False)
        put(self._frame, poses[part.selected])
        self._show_handle(state, poses[part.selected])

    def _hide(self) -> None:
        for ball_, label in self._points:
            seen(ball_, False)
            seen(label, False)
        seen(self._frame, False)
        self._handle.remove()

    def _show_handle(self, state: State, pose: Floats) -> None:
        part, target, runs = state[Plan], state[Target], state[Timeline].clip == CLIP_KEY
        seen(self._frame, not part.handled and not runs)
        shown = part.handled and not runs
        handle = handle_for(state[Joints].arm.task, target.handle)
        there = partial(self._handle.show, pose, handle, target.axes)
        self._handle.at(part.selected if shown else NOTHING, there if shown else None)

    def _dragged(self, pose: NDArray[np.floating], drag: object, ends: bool) -> None:
        self._canvas.post(DragWaypoint(int(self._handle.what), pose, drag))

    def _point(self, k: int) -> tuple[viser.IcosphereHandle, viser.LabelHandle]:
        while len(self._points) <= k:
            path = self._canvas.path(f"waypoints/{len(self._points)}")
            colour = BLUE if len(self._points) else GREY
            radius = POINT * self._canvas.size
            node = self._canvas.scene.add_icosphere(
                path, radius, colour, subdivisions=2, cast_shadow=False, receive_shadow=False
            )
            adapter.on_event(node, "on_click", self._chooser(len(self._points)))
            label = add_name(self._canvas.scene, f"{path}/name", "", np.zeros(3), "bottom-center")
            self._points.append((node, label))
        return self._points[k]

    def _chooser(self, k: int) -> Callable[[object], None]:
        return lambda _: self._canvas.post(SelectWaypoint(k))


def names_of(places: Floats, near: float) -> list[str]:
    """Return a label for each waypoint, empty for one that shares the label of another one nearby.

    >>> names_of(np.array([[0.0, 0, 0], [1, 0, 0], [0, 0, 0]]), 0.1)
    ['1, 3', '2', '']
    """
    names = [""] * len(places)
    first: list[int] = []
    for k, place in enumerate(places):
        host = next((i for i in first if np.linalg.norm(places[i] - place) < near), None)
        if host is None:
            first.append(k)
            names[k] = str(k + 1)
        else:
            names[host] += f", {k + 1}"
    return names


def build(canvas: LayerCanvas, state: State) -> Show:
    """Show the waypoints while a page of the motion is open."""
    return _Points(canvas).show


PANELS = ("motion", "motion_pick", "motion_plots")

LAYER = Layer("motion_waypoints", 88, (Plan, Target, Timeline), build, panel=PANELS, silent=True)
