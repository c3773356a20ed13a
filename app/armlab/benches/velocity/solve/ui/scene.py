"""The wanted velocity at the tool, its reached and lost parts, and the directions that are reached and lost."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.velocity.solve.found import Found, found_at
from armlab.benches.velocity.solve.state import Aim, Solve, arm_asked
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.colours import BLUE, GREEN, SKY, VERDICT, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.mesh import Solid
from armlab.ui.figure.solids import along, lathe
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._handle import Handle
from armlab.ui.scene._marks import Marks, Segment, Sketch
from armlab.ui.scene._nodes import add_solid, put, seen

Array = NDArray[np.float64]

SECOND = 1.0
"""Time for which an arrow shows the way of the tool point, seconds."""

TURNED = 0.3
"""Length of the arrow of 1 rad/s, in sizes of the arm."""

LEAST = 2e-3
"""Length of the shortest arrow that is drawn, in sizes of the arm."""

LINE, PLANE, THIN = 0.3, 0.26, 0.002
"""Half length of a line of directions, radius and thickness of a plane of them, in sizes of the arm."""

DASHES = 9
"""Number of dashes of half a line."""

KNOB = 0.07
"""Length of the arrows of the handle, in sizes of the arm."""

RED: Rgb = VERDICT["no"]


class Picture:
    """Arrows, lines, a plane, and the handle of the wanted velocity."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._wanted, self._dashed = Sketch(canvas, "solve/v"), Sketch(canvas, "solve/lost")
        self._disc: viser.MeshHandle | None = None
        self._handle = Handle(canvas, canvas.path("solve/handle"), self._dragged, scale=KNOB)
        self._state: State | None = None
        self._twist: tuple[float, ...] = ()
        self._found: Found | None = None

    def show(self, state: State) -> None:
        """Show the wanted velocity of a state."""
        self._state = state
        self.place(self._canvas.shown_pose)

    def place(self, q: Array) -> None:
        """Move the picture to a shown configuration."""
        state = self._state
        if state is None or len(q) != state[Joints].arm.n:
            return
        self._found = found = found_at(arm_asked(state), np.asarray(q, dtype=np.float64), state[Solve].twist)
        tool = np.asarray(found.arm.fk(q), dtype=np.float64)
        size = self._canvas.size
        self._wanted.draw(arrows_of(found, tool[:3, 3], size))
        self._dashed.draw(lines_of(found, tool[:3, 3], size))
        self._show_plane(found, tool[:3, 3])
        if found.p:
            pose = tool.copy()
            pose[:3, 3] += SECOND * found.vectors(found.v)[0]
            self._handle.show(pose, "move", "world")

    def _show_plane(self, found: Found, point: Array) -> None:
        normal = plane_of(found)
        if normal is None:
            if self._disc is not None:
                seen(self._disc, False)
            return
        if self._disc is None:
            radius = PLANE * self._canvas.size
            self._disc = add_solid(
                self._canvas.scene, self._canvas.path("solve/plane"), _disc(), SKY, scale=radius, opacity=0.3
            )
        seen(self._disc, True)
        put(self._disc, along(normal, point))

    def _dragged(self, pose: NDArray[np.floating], drag: object, ends: bool) -> None:
        found = self._found
        if found is None or not found.p:
            return
        way = (np.asarray(pose[:3, 3]) - found.arm.position(found.q)) / SECOND
        self._canvas.post(Aim(tuple(float(value) for value in found.axes[: found.p] @ way)))


def arrows_of(found: Found, point: Array, size: float) -> Marks:
    """Return arrows for v, and for its reached part if some of it is lost, for translation and rotation."""
    arrows: list[Segment] = []
    lost = bool(found.answer.lost.any())
    reached = found.vectors(found.answer.reached)
    for kind, vector in enumerate(found.vectors(found.v)):
        scale = TURNED * size if kind else SECOND
        if lost:
            arrows.append((point, point + scale * reached[kind], GREEN))
        arrows.append((point, point + scale * vector, BLUE))
    return Marks([each for each in arrows if np.linalg.norm(each[1] - each[0]) > LEAST * size])


def lines_of(found: Found, point: Array, size: float) -> Marks:
    """Return the lost part of v, the lost directions, dashed and red, and the line of reached directions, green."""
    strokes: list[Segment] = []
    for kind, (wanted, reached) in enumerate(
        zip(found.vectors(found.v), found.vectors(found.answer.reached), strict=True)
    ):
        scale = TURNED * size if kind else SECOND
        if found.answer.lost.any() and np.linalg.norm(wanted - reached) * scale > LEAST * size:
            strokes += dashed(point + scale * reached, point + scale * wanted, RED)
    lines, label = lost_lines(found), "lost direction"
    if not lines:
        lines, label = lost_turns(found), "lost turn"
    for line in lines:
        strokes += dashed(point - LINE * size * line, point + LINE * size * line, RED)
    reached_line = line_of(found)
    if reached_line is not None:
        strokes.append((point - LINE * size * reached_line, point + LINE * size * reached_line, GREEN))
    if not lines:
        return Marks([], strokes)
    return Marks([], strokes, label, point + LINE * size * lines[0])


def lost_lines(found: Found) -> list[Array]:
    """Return the lost directions of the tool point as unit vectors in the world."""
    if found.arm.task.rotation == "none" or found.p == 0:
        return [found.vectors(column)[0] for column in _orthonormal(found.spaces.lost)] if found.singular else []
    return [each.direction for each in found.reasons if each.direction is not None and not each.turning]


def lost_turns(found: Found) -> list[Array]:
    """Return the axes in the world about which rotation is lost."""
    return [each.direction for each in found.reasons if each.direction is not None and each.turning]


def line_of(found: Found) -> Array | None:
    """Return the only direction in which the tool point moves, or None if there are more or none."""
    reached = _reached(found)
    return reached[0] if len(reached) == 1 and found.p > 1 else None


def plane_of(found: Found) -> Array | None:
    """Return the normal of the plane of the velocities of the tool point, if they span only a plane in space."""
    reached = _reached(found)
    return np.asarray(np.cross(reached[0], reached[1])) if len(reached) == 2 and found.p == 3 else None


def _reached(found: Found) -> list[Array]:
    if found.arm.task.rotation != "none":
        return []
    return [found.vectors(column)[0] for column in _orthonormal(found.spaces.range)]


def _orthonormal(columns: Array) -> list[Array]:
    return list((columns / np.linalg.norm(columns, axis=0)).T) if columns.shape[1] else []


def dashed(start: Array, end: Array, colour: Rgb) -> list[Segment]:
    """Return the dashes of a line, always the same number."""
    marks = np.linspace(0.0, 1.0, 2 * DASHES)
    points = start + marks[:, None] * (end - start)
    return [(points[2 * k], points[2 * k + 1], colour) for k in range(DASHES)]


def _disc() -> Solid:
    return lathe([(0.0, -THIN), (1.0, -THIN), (1.0, THIN), (0.0, THIN)], sides=48)


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the picture; it follows every shown configuration."""
    picture = Picture(canvas)
    canvas.on_pose(picture.place)
    return picture.show


LAYER = Layer("solve", order=67, watches=(Solve,), build=build, panel=("solve", "pictures"))
