"""Two robots in the scene with the frames of their bases and tools, the reach of B, and the handle of a base."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.frames.two.reach import Meeting, end_of_b, meeting_of, q_of_b
from armlab.benches.frames.two.state import LINK_A, NONE, DragRobotBase, TwoRobots
from armlab.benches.frames.two.ui.robot import Robot
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.colours import FINE_INK, VERMILLION, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.marks import FRAME_LENGTH
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._handle import Handle
from armlab.ui.scene._marks import Marks, Named, Segment, Sketch
from armlab.ui.scene._nodes import add_triad, put
from armlab.ui.switches import DARK
from armlab.ui.units import Units, units_of

Floats = NDArray[np.float64]

AXES = 0.35
"""Length of the axes of a frame, metres."""

HANDLE = 0.6
"""Length of the arrows of the handle, metres."""

ABOVE = 0.18
"""Height of the marks above the middle of the links, metres, so that the links do not hide them."""

FINE = 0.35
"""Thickness of lines, in usual thicknesses for an arm of 2 m."""

SIZE = 2.0

DASHES = 60
"""Number of dashes of the circle that B reaches."""

NAMED = -0.7
"""Angle from the place of the tools to the name of the circle, radians."""

SHORT = 1e-3
"""Distance of the tools, metres, above which the gap between them is drawn."""

ALL = ("world", "A", "B", "EA", "EB")


class _Picture:
    """Both robots and their marks."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._a = Robot(canvas, "two/a", 2)
        self._b = {links: Robot(canvas, f"two/b{links}", links) for links in (2, 3)}
        scale = AXES / FRAME_LENGTH
        self._triads = {name: add_triad(canvas.scene, canvas.path(f"two/{name}"), scale) for name in ALL}
        self._names = {name: Named(canvas, f"two/{name}_name") for name in ALL}
        self._lines, self._gap = Sketch(canvas, "two/reach"), Sketch(canvas, "two/gap")
        for sketch, weight in ((self._lines, FINE), (self._gap, 1.0)):
            sketch.weigh(weight * SIZE / canvas.size)
        self._said = Named(canvas, "two/said")
        self._circle = Named(canvas, "two/circle")
        self._handle = Handle(canvas, canvas.path("two/handle"), self._dragged, scale=HANDLE / canvas.size)

    def show(self, state: State) -> None:
        """Show both robots of a state."""
        part, found, units = state[TwoRobots], state.derived(meeting_of), units_of(state)
        self._a.show(found.T_wa, np.array(part.q_a), LINK_A)
        for links, robot in self._b.items():
            if links == found.joints:
                robot.show(found.T_wb, q_of_b(state), part.link)
            else:
                robot.hide()
        end = end_of_b(state)
        self._show_frames(found)
        ink = FINE_INK[DARK.on(state)]
        self._lines.draw(Marks(strokes=circle(found.T_wb[:3, 3], found.reach, ink)))
        self._circle.show(f"2 l = {units.length(found.reach)}", _lifted(found.T_wb[:3, 3] + found.reach * _side(found)))
        self._show_gap(found, end, units)
        self._show_handle(part)

    def _show_frames(self, found: Meeting) -> None:
        T_w_ea = found.T_wa @ found.T_a_ea
        poses = {"world": np.eye(4), "A": found.T_wa, "B": found.T_wb, "EA": T_w_ea, "EB": found.T_w_eb}
        for name, T in poses.items():
            at = np.array(T)
            at[:3, 3] = _lifted(T[:3, 3]) if name != "world" else T[:3, 3]
            put(self._triads[name], at)
            # The names of tools that meet stand behind their own axes.
            back = (1.0, 0.5) if name in ("EA", "EB") else (0.45, 0.45)
            self._names[name].show(name, at[:3, 3] - AXES * T[:3, :2] @ back)

    def _show_gap(self, found: Meeting, end: Floats, units: Units) -> None:
        """Show how far the tool of B is from where it should be."""
        start, stop = _lifted(end[:3, 3]), _lifted(found.T_w_eb[:3, 3])
        apart = float(np.linalg.norm(stop - start))
        gap: list[Segment] = [(start, stop, VERMILLION)] if apart > SHORT else []
        self._gap.draw(Marks(strokes=gap))
        text = f"{units.length(apart)} apart" if gap else ""
        self._said.show(text, 0.5 * (start + stop) + np.array([0.0, -0.5 * AXES, 0.0]))

    def _show_handle(self, part: TwoRobots) -> None:
        def put() -> None:
            base = np.array(part.base(part.selected))
            base[:3, 3] = _lifted(base[:3, 3])
            self._handle.show_arrows(base, base[:3, :3], "xy", "z")

        self._handle.at(part.selected, None if part.selected == NONE else put)

    def _dragged(self, pose: NDArray[np.floating], drag: object, ends: bool) -> None:
        self._canvas.post(DragRobotBase(str(self._handle.what), pose, drag))


def _lifted(p: Floats) -> Floats:
    return np.asarray(p + np.array([0.0, 0.0, ABOVE]))


def _side(found: Meeting) -> Floats:
    """Return the unit vector from the base of B to where its circle is named, (3,): beside the place of the tools."""
    towards = found.T_w_eb[:3, 3] - found.T_wb[:3, 3]
    angle = np.arctan2(towards[1], towards[0]) + NAMED
    return np.array([np.cos(angle), np.sin(angle), 0.0])


def circle(middle: Floats, radius: float, colour: Rgb) -> list[Segment]:
    """Return the dashes of a circle in the plane around a point (3,)."""
    angles = np.linspace(0.0, 2.0 * np.pi, 2 * DASHES + 1)
    points = middle + radius * np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1)
    return [(points[k], points[k + 1], colour) for k in range(0, 2 * DASHES, 2)]


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw both robots."""
    return _Picture(canvas).show


LAYER = Layer("two_robots", order=74, watches=(TwoRobots, Display, Notation), build=build, panel="two_robots")
