"""The two frames of the chosen transform, and the selection in its matrix as vectors."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.pose.tool.state import MATRIX, Pair, PoseView, pair_at
from armlab.benches.pose.tool.ui.notation import cosine
from armlab.session.parts.notation import Notation
from armlab.session.parts.selection import Selection
from armlab.session.state import State
from armlab.ui.colours import AXES, PURPLE, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._marks import Marks, Segment, Sketch, Triad, Vector, across, arc
from armlab.ui.units import Units, units_of

LENGTH = 0.24
ARC = 0.13
"""Length of a highlighted axis, and radius of the arc between two, in sizes of the arm."""

LEAST = 1e-9
"""Least length of a p with a direction, metres."""

COLOURS: tuple[Rgb, ...] = tuple(AXES[axis] for axis in "xyz")


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw both frames and the highlighted vectors, which follow the arm."""
    frame, reference = Triad(canvas, "lit_frame"), Triad(canvas, "lit_reference")
    sketch = Sketch(canvas, "lit")

    def draw(state: State, q: NDArray[np.float64]) -> None:
        view, units = state[PoseView], units_of(state)
        pair = pair_at(canvas.drawn.figure.anatomy.arm, q, view)
        apart = pair.distance > LEAST
        reference.show(f"{{{view.reference}}}" if apart else f"{{{view.reference}, {view.frame}}}", pair.reference)
        frame.show(f"{{{view.frame}}}" if apart else "", pair.frame)
        sketch.draw(marks_of(pair, state[Selection].of(MATRIX), canvas.size, units))

    return canvas.follow(state, draw)


def marks_of(pair: Pair, selected: Selection, size: float, units: Units) -> Marks:
    """Return the marks in the world of a selected entry, row or column."""
    row, column = selected.row, selected.column
    if not selected.matrix or row == 3:
        return Marks()
    if column == 3:
        return _whole_position(pair, units) if row is None else _component(pair, row, units)
    if row is None and column is not None:
        at = pair.frame[:3, 3]
        return Marks(arrows=[(at, at + LENGTH * size * pair.frame[:3, column], COLOURS[column])])
    if column is None and row is not None:
        return _row(pair, row, size)
    if row is not None and column is not None:
        return _cosine(pair, row, column, size, units)
    return Marks()


def _whole_position(pair: Pair, units: Units) -> Marks:
    start, end = pair.reference[:3, 3], pair.frame[:3, 3]
    if pair.distance < LEAST:
        return Marks(label="p = 0", at=start)
    return Marks([(start, end, PURPLE)], label=f"|p| = {units.length(pair.distance)}", at=0.5 * (start + end))


def _component(pair: Pair, i: int, units: Units) -> Marks:
    """Return p_i along axis i of the reference, and the way from its end to the point."""
    start, value = pair.reference[:3, 3], float(pair.transform[i, 3])
    foot = start + value * pair.reference[:3, i]
    name = f"p_{'xyz'[i]} = {units.length(value)}"
    strokes: list[Segment] = [(foot, pair.frame[:3, 3], PURPLE)] if pair.distance > LEAST else []
    if abs(value) < LEAST:
        return Marks(strokes=strokes, label=name, at=start)
    return Marks([(start, foot, COLOURS[i])], strokes, name, 0.5 * (start + foot))


def _row(pair: Pair, i: int, size: float) -> Marks:
    """Return axis i of the reference at the moved frame, and its components along the axes there."""
    at, axis = pair.frame[:3, 3], pair.reference[:3, i]
    strokes: list[Segment] = []
    corner = at
    for j in range(3):
        reached = corner + LENGTH * size * float(pair.transform[i, j]) * pair.frame[:3, j]
        strokes.append((corner, reached, COLOURS[j]))
        corner = reached
    return Marks([(at, at + LENGTH * size * axis, COLOURS[i])], strokes)


def _cosine(pair: Pair, i: int, j: int, size: float, units: Units) -> Marks:
    """Return axis i of the reference and axis j of the moved frame, both there, with the angle between them."""
    at, fixed, moved = pair.frame[:3, 3], pair.reference[:3, i], pair.frame[:3, j]
    angle = pair.angle(i, j)
    normal: Vector = np.cross(fixed, moved)
    length = float(np.linalg.norm(normal))
    normal = normal / length if length > LEAST else across(fixed)
    between = fixed * np.cos(0.5 * angle) + np.cross(normal, fixed) * np.sin(0.5 * angle)
    return Marks(
        [(at, at + LENGTH * size * fixed, COLOURS[i]), (at, at + LENGTH * size * moved, COLOURS[j])],
        arc(at, ARC * size * fixed, normal, angle, PURPLE),
        cosine(float(pair.transform[i, j]), angle, units),
        at + 1.25 * ARC * size * between,
    )


LAYER = Layer("lit", order=65, watches=(PoseView, Selection, Notation), build=build, panel="pose")
