"""The plane in the scene: the point as an arrow, and the arcs of both angles."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.atan2.angle import Angle, present
from armlab.benches.body.atan2.state import MOST, Plane
from armlab.benches.body.forms.stage import stage_of
from armlab.benches.body.forms.ui.base import BaseFrame
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State
from armlab.ui.colours import BLUE, GREY, INK, VERMILLION
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._marks import Marks, Named, Segment, Sketch, arc
from armlab.ui.switches import DARK
from armlab.ui.units import units_of

Floats = NDArray[np.float64]

UNIT = 1.5 / MOST
"""Length of a unit of the plane, in radii of the outermost gimbal ring."""

INNER, OUTER, RAY = 0.5, 0.75, 1.2
"""Radii of the arcs of atan2 and of atan, and length of the direction of atan, in the same."""

Z = np.array([0.0, 0.0, 1.0])


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the axes, the point and the arcs."""
    _, radius = stage_of(state)
    base = BaseFrame(canvas, "atan2/base", radius)
    thick, fine = Sketch(canvas, "atan2/thick", 0.8), Sketch(canvas, "atan2/fine", 0.6)
    names = [Named(canvas, f"atan2/name{k}") for k in range(2)]

    def show(state: State) -> None:
        centre, _ = stage_of(state)
        found, units = present(state), units_of(state)
        base.show(centre)
        thick.draw(_moved(arrow_of(found, DARK.on(state)), centre, radius))
        fine.draw(_moved(arcs_of(found), centre, radius))
        for name, said, angle, at in zip(
            names, ("atan2", "atan"), (found.atan2, found.atan), (INNER, OUTER), strict=True
        ):
            text = "" if angle is None else f"{said} {units.angle(angle)}"
            way = _way(0.5 * (angle or 0.0)) * (at + 0.12)
            name.show(text, centre + radius * way)

    return show


def arrow_of(found: Angle, dark: bool) -> Marks:
    """Return the point as an arrow from the origin, in radii; nothing at the origin."""
    tip = UNIT * np.array([found.x, found.y, 0.0])
    return Marks() if found.atan2 is None else Marks([(np.zeros(3), tip, INK[dark])])


def arcs_of(found: Angle) -> Marks:
    """Return the arcs of both angles, in radii, and the direction of atan where it is another one."""
    strokes: list[Segment] = []
    for angle, radius, colour in ((found.atan2, INNER, BLUE), (found.atan, OUTER, VERMILLION)):
        if angle is not None:
            strokes += arc(np.zeros(3), np.array([radius, 0.0, 0.0]), Z, angle, colour)
    if found.atan is not None and not found.right:
        strokes.append((np.zeros(3), RAY * _way(found.atan), VERMILLION))
    strokes.append((np.array([0.0, -UNIT * MOST, 0.0]), np.zeros(3), GREY))
    strokes.append((np.array([-UNIT * MOST, 0.0, 0.0]), np.zeros(3), GREY))
    return Marks(strokes=strokes)


def _way(angle: float) -> Floats:
    return np.array([math.cos(angle), math.sin(angle), 0.0])


def _moved(marks: Marks, centre: Floats, radius: float) -> Marks:
    def placed(segments: list[Segment]) -> list[Segment]:
        return [(centre + radius * start, centre + radius * end, colour) for start, end, colour in segments]

    return Marks(placed(marks.arrows), placed(marks.strokes))


LAYER = Layer(
    "atan2",
    order=70,
    watches=(Plane, Notation, Display, RobotPart),
    build=build,
    panel="atan2",
)
