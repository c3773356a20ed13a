"""The motion of each joint: its axis, R with an arrow around it or P with an arrow both ways."""

from __future__ import annotations

import math

import numpy as np

from armlab.kin.rotations import quaternion_from_rotation
from armlab.kin.sweeps import arc
from armlab.session.state import State
from armlab.ui.colours import joint_colour
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.housings import SLEEVE_HALF_WIDTH, half_length
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._strokes import HEAD, THICK, Floats, Segments, add_head, add_line, add_name, dashes, polyline
from armlab.ui.switches import Switch

AXIS = 3.4
"""Length of an axis beyond its housing, in tube radii."""

AROUND, AROUND_RADIUS = math.radians(290.0), 1.5
"""Angle of the arrow around an axis, and its radius in tube radii."""

STROKE = 3.2
"""Half length of the arrow of a prismatic joint, in tube radii."""


X, Y, Z = np.eye(3)


def build(canvas: LayerCanvas, state: State) -> Show:
    """Attach the marks to the bodies before the joints: they show the axis and do not move with the joint."""
    for i, body in enumerate(canvas.drawn.figure.anatomy.bodies):
        place = f"{canvas.node(i)}/type{i + 1}"
        pose = body.mount
        canvas.scene.add_frame(
            place, show_axes=False, wxyz=quaternion_from_rotation(pose[:3, :3]), position=pose[:3, 3]
        )
        (_revolute if body.revolute else _prismatic)(canvas, i, place)
    return lambda state: None


def _revolute(canvas: LayerCanvas, i: int, place: str) -> None:
    figure, scene, size, colour = canvas.drawn.figure, canvas.scene, canvas.size, joint_colour(i)
    r = float(figure.anatomy.radius[i])
    middle = figure.housings[i]
    half = half_length(figure.anatomy, i, middle)
    top = middle + half + AXIS * r
    low, high = np.array([0.0, 0.0, middle - half - 0.6 * AXIS * r]), np.array([0.0, 0.0, top])
    add_line(scene, f"{place}/axis", _dash_dot(low, high, 0.035 * size), colour, size)
    add_head(scene, f"{place}/end", high, (0.0, 0.0, 1.0), colour, HEAD * size)
    radius, at = AROUND_RADIUS * r, np.array([0.0, 0.0, middle + half + 0.5 * AXIS * r])
    points = arc(AROUND, radius, 0.15)
    add_line(scene, f"{place}/around", polyline(points[:-1] + at), colour, size, THICK)
    before = arc(AROUND - 0.8 * HEAD * size / radius, radius)[-1]
    add_head(scene, f"{place}/turn", points[-1] + at, points[-1] - before, colour, 0.8 * HEAD * size)
    if figure.anatomy.bodies[i].d > middle + half:  # the end of the axis is inside the link
        add_name(scene, f"{place}/name", "R", at + 1.7 * radius * X, "center-center")
    else:
        add_name(scene, f"{place}/name", "R", high + 0.5 * r * Z, "bottom-center")


def _prismatic(canvas: LayerCanvas, i: int, place: str) -> None:
    anatomy, scene, size, colour = canvas.drawn.figure.anatomy, canvas.scene, canvas.size, joint_colour(i)
    r = float(anatomy.radius[i])
    aside = (SLEEVE_HALF_WIDTH + 0.9) * r * Y
    end = STROKE * r * Z
    for k, side in enumerate((aside, -aside)):  # one of them is seen
        add_line(scene, f"{place}/axis{k}", polyline([side - 0.8 * end, side + 0.8 * end]), colour, size, THICK)
        add_head(scene, f"{place}/end{k}", side + end, Z, colour, HEAD * size)
        add_head(scene, f"{place}/start{k}", side - end, -Z, colour, HEAD * size)
    add_name(scene, f"{place}/name", "P", -1.25 * aside, "center-center")


def _dash_dot(start: Floats, end: Floats, dash: float) -> Segments:
    """Return the line of an axis as in technical drawings: dashes with dots between."""
    length = float(np.linalg.norm(end - start))
    count = max(2, round(length / dash))
    if count == 2:
        return dashes(start, end, count)
    begins = np.arange(count) / count
    marks = np.concatenate([begins[:, None] + [0.0, 0.55 / count], begins[:-1, None] + np.array([0.72, 0.83]) / count])
    parts = marks[:, :, None]
    return (start + parts * (end - start)).astype(np.float32)


SWITCH = Switch("symbols", "Joint types", "The axis of each joint: R turns about it, P slides along it.", "J")
LAYER = Layer("symbols", order=85, watches=(), build=build, switch=SWITCH, silent=True)
