"""Both poses, the axis with the helix about it, the body on its way, and the straight way beside it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.frames.screw.film import Ways, part_of, ways_of
from armlab.benches.frames.screw.state import NONE, POSES, DragPose, Screw
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import INK, ORANGE, PURPLE, SKY
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.marks import FRAME_LENGTH
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._arrows import pale_frame
from armlab.ui.scene._block import Block
from armlab.ui.scene._handle import Handle
from armlab.ui.scene._marks import Marks, Named, Segment, Sketch
from armlab.ui.scene._nodes import add_triad, put, seen
from armlab.ui.switches import DARK
from armlab.ui.units import Units, units_of

Floats = NDArray[np.float64]

BODY = 0.32
"""Radius of the block, metres; its frame is 0.62 of it long."""

AXES = 0.16
"""Length of the axes of both poses, metres."""

HANDLE = 0.26
"""Length of the arrows of the handle, metres."""

BETWEEN = (1.0 / 6.0, 1.0 / 3.0, 2.0 / 3.0, 5.0 / 6.0)
"""Parts of the motion at which pale frames stand."""

PARTS = 48
"""Number of strokes of a way."""

BEYOND = 0.35
"""Length of the axis beyond the feet of both poses, metres."""

NAMED = 0.08
"""Distance of names from their places, metres."""

FARTHEST = 20.0
"""Distance of the axis, metres, beyond which it is not drawn."""

THICK, FINE = 0.6, 0.4
"""Thickness of the axis and of the ways, in usual thicknesses for axes of the usual length."""

LEAST = 1e-6


class _Picture:
    """Poses, axis, ways and body."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        scale = AXES / FRAME_LENGTH
        self._poses = {which: add_triad(canvas.scene, canvas.path(f"screw/pose{which}"), scale) for which in POSES}
        self._names = {which: Named(canvas, f"screw/name{which}") for which in POSES}
        self._world = add_triad(canvas.scene, canvas.path("screw/world"), scale)
        self._world_name = Named(canvas, "screw/world_name")
        self._pale = [
            pale_frame(canvas.scene, canvas.path(f"screw/pale{k}"), 0.7 * AXES, 0.4) for k in range(len(BETWEEN))
        ]
        self._body = Block(canvas, "screw/body", BODY)
        self._other = pale_frame(canvas.scene, canvas.path("screw/other"), 0.62 * BODY, 0.5)
        self._axis, self._ways = Sketch(canvas, "screw/axis"), Sketch(canvas, "screw/ways")
        for sketch, weight in ((self._axis, THICK), (self._ways, FINE)):
            sketch.weigh(weight * AXES / (FRAME_LENGTH * canvas.size))
        self._said, self._straight = Named(canvas, "screw/said"), Named(canvas, "screw/straight")
        self._handle = Handle(canvas, canvas.path("screw/handle"), self._dragged, scale=HANDLE / canvas.size)

    def show(self, state: State) -> None:
        """Show both ways of a state, and the body at the time of the film."""
        part, found, s = state[Screw], state.derived(ways_of), part_of(state)
        dark = DARK.on(state)
        self._show_poses(found)
        self._body.show(found.at(s))
        seen(self._other, part.straight)
        if part.straight:
            put(self._other, found.straight(s))
        self._show_axis(found, units_of(state), dark)
        self._show_ways(found, part.straight)
        self._show_handle(part)

    def _show_poses(self, found: Ways) -> None:
        self._world_name.show("world", np.array([0.0, 0.0, -NAMED]))
        for which, T in zip(POSES, (found.first, found.second), strict=True):
            put(self._poses[which], T)
            self._names[which].show(POSES[which], T[:3, 3] - NAMED * T[:3, 2] - 0.5 * NAMED * T[:3, 0])
        for frame, T in zip(self._pale, found.at(np.array(BETWEEN)), strict=True):
            seen(frame, found.screw.kind != "none")
            put(frame, T)

    def _show_axis(self, found: Ways, units: Units, dark: bool) -> None:
        """Show the axis as an arrow through the feet of both poses, and fine lines to them."""
        screw = found.screw
        if screw.kind not in ("rotation", "screw") or found.radius > FARTHEST:
            self._axis.draw(Marks())
            text = f"{units.length(screw.distance)} along, no turn" if screw.kind == "translation" else ""
            self._said.show(text, 0.5 * (found.first[:3, 3] + found.second[:3, 3]) + np.array([0.0, 0.0, NAMED]))
            return
        start, end = axis_ends(found)
        feet: list[Segment] = [
            (screw.foot(T[:3, 3]), T[:3, 3], INK[dark]) for T in (found.first, found.second) if found.radius > LEAST
        ]
        self._axis.draw(Marks([(start, end, PURPLE)], feet))
        self._said.show(f"{units.angle(screw.angle)}, {units.length(screw.distance)}", end + NAMED * screw.direction)

    def _show_ways(self, found: Ways, straight: bool) -> None:
        lines = ways_lines(found, straight)
        self._ways.draw(Marks(strokes=lines))
        apart = float(np.linalg.norm(found.at(0.75)[:3, 3] - found.straight(0.75)[:3, 3]))
        self._straight.show("straight" if straight and apart > NAMED else "", found.straight(0.75)[:3, 3])

    def _show_handle(self, part: Screw) -> None:
        def put() -> None:
            T = part.pose(part.selected)
            if part.handle == "turn":
                self._handle.show_rings(T, T[:3, :3])
            else:
                self._handle.show_arrows(T, np.eye(3))

        self._handle.at(part.selected, None if part.selected == NONE else put)

    def _dragged(self, pose: NDArray[np.floating], drag: object, ends: bool) -> None:
        self._canvas.post(DragPose(str(self._handle.what), pose, drag))


def axis_ends(found: Ways) -> tuple[Floats, Floats]:
    """Return the ends of the drawn axis, (3,) each: beyond the feet of both poses, the tip where it points."""
    screw = found.screw
    first = screw.foot(found.first[:3, 3])
    low, high = min(screw.distance, 0.0) - BEYOND, max(screw.distance, 0.0) + BEYOND
    return first + low * screw.direction, first + high * screw.direction


def ways_lines(found: Ways, straight: bool) -> list[Segment]:
    """Return the strokes of the way of the origin on the screw, and the dashes of the straight way if it is wanted."""
    points = found.at(np.linspace(0.0, 1.0, PARTS + 1))[:, :3, 3]
    lines: list[Segment] = [(points[k], points[k + 1], ORANGE) for k in range(PARTS)]
    if straight:
        ends = found.straight(np.linspace(0.0, 1.0, PARTS + 1))[:, :3, 3]
        lines += [(ends[k], ends[k + 1], SKY) for k in range(0, PARTS, 2)]
    return [each for each in lines if np.linalg.norm(each[1] - each[0]) > LEAST]


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw both poses and the ways between them."""
    return _Picture(canvas).show


LAYER = Layer("screw", order=77, watches=(Screw, Timeline, Display, Notation), build=build, panel="screw")
