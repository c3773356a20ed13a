"""The table, the object, the frames of table and tool, and the handle of what is dragged."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.frames.table.commands import DragObject, DragTable
from armlab.benches.frames.table.state import NONE, TableTask, Task, task_of
from armlab.kin.transforms import transform
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State
from armlab.ui.colours import FINE_INK, INK, ORANGE, PURPLE, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._handle import Handle
from armlab.ui.scene._marks import Marks, Named, Segment, Sketch, Triad
from armlab.ui.scene._nodes import put, seen
from armlab.ui.switches import DARK
from armlab.ui.units import units_of

Floats = NDArray[np.float64]

WOOD: Rgb = (196, 178, 152)
STEEL: Rgb = (96, 106, 120)
"""Colours of the table and of the object."""

LONG, WIDE = 1.1, 0.8
"""Edges of the table, in length scales of the arm; it grows with the place of the object."""

THICK, MARGIN, EDGE = 0.04, 0.12, 0.07
"""Thickness of the table, its margin around origin and object, and the edge of the object, in the same."""

FLAT = 0.4
"""Height of the object, in its edges."""

UP = np.array([0.0, 0.0, 1.0])

WEIGHT = 0.5
"""Thickness of the arrows, in usual thicknesses."""


def span(state: State) -> tuple[Floats, Floats]:
    """Return the least and the largest x and y of the table in its own frame, (2,) each, metres."""
    scale = state[RobotPart].robot.arm.length_scale
    place, margin = np.array(state[TableTask].place), MARGIN * scale
    low = np.minimum(place, 0.0) - margin
    high = np.maximum(np.array([LONG, WIDE]) * scale, place + margin)
    return low, high


def corners(state: State) -> Floats:
    """Return the corners of the table in the world, (4, 3)."""
    T, (low, high) = state.derived(task_of).T_wt, span(state)
    flat = np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]])
    return np.asarray(np.column_stack([flat, np.zeros(4)]) @ T[:3, :3].T + T[:3, 3])


class _Picture:
    """Table, object, frames and handle."""

    def __init__(self, canvas: LayerCanvas, state: State) -> None:
        self._canvas = canvas
        scale = state[RobotPart].robot.arm.length_scale
        self._thick = THICK * scale
        self._edge = EDGE * scale
        self._table: viser.BoxHandle = canvas.scene.add_box(
            canvas.path("table/top"), WOOD, (1.0, 1.0, 1.0), cast_shadow=True
        )
        self._object: viser.BoxHandle = canvas.scene.add_box(
            canvas.path("table/object"), STEEL, (self._edge, self._edge, FLAT * self._edge), cast_shadow=True
        )
        self._frames = {name: Triad(canvas, f"table/{name}") for name in ("T", "E")}
        self._place = Named(canvas, "table/place")
        self._height = Named(canvas, "table/height")
        self._arrows = Sketch(canvas, "table/arrows", WEIGHT)
        self._handle = Handle(canvas, canvas.path("table/handle"), self._dragged)

    def show(self, state: State) -> None:
        """Show the task of a state."""
        found, units = state.derived(task_of), units_of(state)
        self._show_table(state, found)
        put(self._object, transform(found.T_wt[:3, :3], found.object + 0.5 * FLAT * self._edge * UP))
        self._frames["T"].show("T", found.T_wt)
        self._frames["E"].show("E", found.T_we)
        self._place.show("P", found.object + self._edge * found.T_wt[:3, 0])
        height = state[TableTask].height
        between = found.object + 0.5 * (found.T_we[:3, 3] - found.object)
        self._height.show(f"h = {units.length(height)}" if height > self._edge else "", between)
        self._arrows.draw(Marks(self._ways(state, found)))
        self._show_handle(state, found)

    def _show_table(self, state: State, found: Task) -> None:
        low, high = span(state)
        x, y = (high - low).tolist()
        if self._table.dimensions != (x, y, self._thick):
            self._table.dimensions = (x, y, self._thick)
        middle = np.array([*(0.5 * (low + high)).tolist(), -0.5 * self._thick, 1.0])
        put(self._table, transform(found.T_wt[:3, :3], (found.T_wt @ middle)[:3]))
        seen(self._table, True)

    def _ways(self, state: State, found: Task) -> list[Segment]:
        """Return the arrows from the base to the table, on to the object, up to the tool, and from the base to it."""
        dark, base = DARK.on(state), state[RobotPart].robot.arm.base[:3, 3]
        table, tool = found.T_wt[:3, 3], found.T_we[:3, 3]
        ways: list[Segment] = [
            (base, table, FINE_INK[dark]),
            (table, found.object, PURPLE),
            (tool, found.object, ORANGE),
            (base, tool, INK[dark]),
        ]
        return [each for each in ways if np.linalg.norm(each[1] - each[0]) > 1e-6]

    def _show_handle(self, state: State, found: Task) -> None:
        selected = state[TableTask].selected

        def put() -> None:
            if selected == "table":
                self._handle.show_arrows(found.T_wt, found.T_wt[:3, :3], "xyz", "z")
            else:
                self._handle.show_arrows(transform(found.T_wt[:3, :3], found.object), found.T_wt[:3, :3], "xy")

        self._handle.at(selected, None if selected == NONE else put)

    def _dragged(self, pose: NDArray[np.floating], drag: object, ends: bool) -> None:
        if self._handle.what == "table":
            self._canvas.post(DragTable(pose, drag))
        else:
            self._canvas.post(DragObject(pose[:3, 3], drag))


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the table."""
    return _Picture(canvas, state).show


LAYER = Layer(
    "table_task", order=75, watches=(TableTask, Display, Notation, RobotPart), build=build, panel="table_task"
)
