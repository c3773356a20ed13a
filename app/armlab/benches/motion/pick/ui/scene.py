"""The boxes, the goal place, and two fingers at the tool that close on a box and carry it."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.motion.pick.state import GOAL, DragBox, Pick, SelectBox, course_of, name_of, time_of
from armlab.benches.motion.pick.table import MOST_BOXES, edge_of
from armlab.benches.motion.plan.state import CLIP_KEY, Plan
from armlab.kin.transforms import transform
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui import adapter
from armlab.ui.colours import GREEN, ORANGE, PURPLE, SKY, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.solids import along
from armlab.ui.format import capitalised
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._handle import Handle
from armlab.ui.scene._nodes import move, put, seen
from armlab.ui.scene._strokes import add_name

COLOURS: tuple[Rgb, ...] = (ORANGE, SKY, PURPLE)
"""Colours of the boxes, which also have their names."""

FINGER: Rgb = (118, 127, 140)
"""Colour of the fingers."""

FINGERS = (0.12, 0.5, 1.4)
"""Thickness, width and length of a finger, in edges of a box."""

BEYOND = 0.4
"""Length of the fingers beyond the tool point, in edges."""

OPEN, HELD, SHUT = 1.7, 1.13, 0.14
"""Distance between the middles of the fingers, in edges: open, at a box, and closed on nothing."""

PAD = 0.06, 2.2
"""Height of the plate of the goal, and its width, in edges."""

NOTHING = -1
"""Number in place of that of the selected box, when none has the handle."""

Floats = NDArray[np.float64]


class _Boxes:
    """Boxes, goal and fingers; they are made when there are boxes for the first time."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._edge = edge_of(canvas.drawn.figure.anatomy.arm)
        self._boxes: list[tuple[viser.BoxHandle, viser.LabelHandle]] = []
        self._goal: tuple[viser.BoxHandle, viser.LabelHandle] | None = None
        self._fingers: list[viser.BoxHandle] = []
        self._handle = Handle(canvas, canvas.path("pick/handle"), self._dragged)

    def draw(self, state: State, q: Floats) -> None:
        """Draw a state with the arm in a configuration."""
        part, arm = state[Pick], self._canvas.drawn.figure.anatomy.arm
        if len(q) != arm.n:
            return
        tool = np.asarray(arm.fk(q), dtype=np.float64)
        time, found = time_of(state), state.derived(course_of)
        for k in range(MOST_BOXES):
            there = k < len(part.boxes)
            if there or k < len(self._boxes):
                self._show_box(k, found.pose(k, time, tool) if there else None)
        self._show_goal(part)
        self._show_fingers(bool(part.boxes), tool, found.closed(time), found.held(time) is not None)
        self._show_handle(state)

    def _show_box(self, k: int, pose: Floats | None) -> None:
        while len(self._boxes) <= k:
            self._boxes.append(self._made(len(self._boxes)))
        box, label = self._boxes[k]
        seen(box, pose is not None)
        seen(label, pose is not None)
        if pose is not None:
            put(box, pose)

    def _made(self, k: int) -> tuple[viser.BoxHandle, viser.LabelHandle]:
        path, edge = self._canvas.path(f"pick/box{k}"), self._edge
        box = self._canvas.scene.add_box(path, COLOURS[k], (edge, edge, edge))
        adapter.on_event(box, "on_click", self._chooser(k))
        return box, add_name(
            self._canvas.scene, f"{path}/name", str(k + 1), np.array([0.0, 0.0, 0.6 * edge]), "bottom-center"
        )

    def _chooser(self, which: int) -> Callable[[object], None]:
        return lambda _: self._canvas.post(SelectBox(which))

    def _show_goal(self, part: Pick) -> None:
        there = part.goal is not None and bool(part.boxes)
        if self._goal is None and there:
            path, (height, width) = self._canvas.path("pick/goal"), (self._edge * share for share in PAD)
            plate = self._canvas.scene.add_box(path, GREEN, (width, width, height), opacity=0.55, cast_shadow=False)
            adapter.on_event(plate, "on_click", self._chooser(GOAL))
            at = np.array([0.5 * width, 0.0, 0.0])
            self._goal = (
                plate,
                add_name(self._canvas.scene, f"{path}/name", capitalised(name_of(GOAL)), at, "top-center"),
            )
        if self._goal is None:
            return
        plate, label = self._goal
        seen(plate, there)
        seen(label, there)
        if part.goal is not None:
            move(plate, np.array(part.goal) - [0.0, 0.0, 0.5 * self._edge])

    def _show_fingers(self, there: bool, tool: Floats, closed: float, held: bool) -> None:
        if not self._fingers and there:
            thick, wide, long = (share * self._edge for share in FINGERS)
            names = (self._canvas.path(f"pick/finger{k}") for k in range(2))
            self._fingers = [self._canvas.scene.add_box(name, FINGER, (thick, wide, long)) for name in names]
        for finger in self._fingers:
            seen(finger, there)
        if not there:
            return
        frame = tool @ self._on_tool()
        gap = 0.5 * self._edge * (OPEN + closed * ((HELD if held else SHUT) - OPEN))
        back = self._edge * (BEYOND - 0.5 * FINGERS[2])
        for finger, side in zip(self._fingers, (gap, -gap), strict=True):
            put(finger, frame @ transform(np.eye(3), np.array([side, 0.0, back])))

    def _on_tool(self) -> Floats:
        """Return the frame of the hand in that of the tool: its z axis points where the hand does."""
        anatomy = self._canvas.drawn.figure.anatomy
        on_last, end = anatomy.tool_on_last(), anatomy.bodies[-1].end
        ahead = on_last[:3, 3] - end[:3, 3]
        if np.linalg.norm(ahead) <= float(anatomy.radius[-1]):
            leg = end[:3, 3]
            ahead = leg if np.linalg.norm(leg) > float(anatomy.radius[-1]) else on_last[:3, 2]
        return np.asarray(along(on_last[:3, :3].T @ ahead))

    def _show_handle(self, state: State) -> None:
        part, runs = state[Pick], state[Timeline].clip == CLIP_KEY
        which = part.selected
        place = None if which is None else part.place(which)
        if which is None or place is None or runs:
            self._handle.at(NOTHING, None)
            return
        there = transform(np.eye(3), np.array(place))
        self._handle.at(which, partial(self._handle.show, there, "move", "world"))

    def _dragged(self, pose: NDArray[np.floating], drag: object, ends: bool) -> None:
        self._canvas.post(DragBox(int(self._handle.what), pose[:3, 3], drag))


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw boxes while a page of the planned motion is open."""
    return canvas.follow(state, _Boxes(canvas).draw)


PANELS = ("motion", "motion_pick", "motion_plots", "motion_files")

LAYER = Layer("motion_boxes", 90, (Pick, Plan, Timeline), build, panel=PANELS, silent=True)
