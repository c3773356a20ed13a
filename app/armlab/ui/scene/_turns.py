"""A joint variable in the scene: an arc from x of the previous frame to x of the joint's own, or a stroke along z."""

from __future__ import annotations

import math

import numpy as np

from armlab.kin.dh import link_transform
from armlab.kin.rotations import quaternion_from_rotation
from armlab.kin.sweeps import arc
from armlab.ui.colours import joint_colour
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.anatomy import Body, Pose
from armlab.ui.figure.housings import SLEEVE_HALF_WIDTH, half_length
from armlab.ui.scene._nodes import move, seen
from armlab.ui.scene._strokes import HEAD, THICK, add_head, add_line, add_name, dashes, polyline, stretch

RADIUS = 3.3
"""Radius of an arc, in tube radii of its joint: outside the housing."""

CLEAR = 0.3
"""Height of an arc over the face of its housing, and distance of a stroke from the sleeve, in tube radii."""

RAY, NAME_AT = 1.2, 1.45
"""End of the rays, and place of the name, in radii of the arc."""

NAME_PART = 0.3
"""Position of the name along a stroke, 0 to 1, away from the joints that follow."""

STEP = math.radians(6.0)
LEAST_ANGLE, LEAST_STROKE = 1e-4, 1e-4
"""Least angle, radians, and least stroke, in sizes of the arm: below them only the name is drawn."""


def before_turn(body: Body, theta: float) -> Pose:
    """Return the axis of a joint in the node of the previous body, with x along that of the previous frame."""
    return np.array(body.mount @ link_transform(0.0, 0.0, 0.0, -theta))


class Turn:
    """The arc of a revolute joint."""

    def __init__(self, canvas: LayerCanvas, i: int) -> None:
        figure = canvas.drawn.figure
        anatomy, scene, size, colour = figure.anatomy, canvas.scene, canvas.size, joint_colour(i)
        body, r = anatomy.bodies[i], float(anatomy.radius[i])
        self._i, self._offset = i, anatomy.arm.rows[i].theta
        self._radius = RADIUS * r
        self._middle = figure.housings[i]
        self._over = half_length(anatomy, i, self._middle) + CLEAR * r
        self._pose = before_turn(body, self._offset)
        path = f"{canvas.node(i)}/angle{i + 1}"
        wxyz = quaternion_from_rotation(self._pose[:3, :3])
        self._from = scene.add_frame(path, show_axes=False, wxyz=wxyz, position=self._pose[:3, 3])
        ray = np.array([RAY * self._radius, 0.0, 0.0])
        add_line(scene, f"{path}/from", dashes(np.zeros(3), ray, 6), colour, size)
        self._arc = add_line(scene, f"{path}/arc", polyline(arc(0.1, self._radius)), colour, size, THICK)
        self.name = add_name(scene, f"{path}/name", "", ray, "center-center")
        own = f"{canvas.node(i + 1)}/angle_to{i + 1}"
        self._to = scene.add_frame(own, show_axes=False)
        add_line(scene, f"{own}/ray", polyline([np.zeros(3), ray]), colour, size)
        self._head_angle = HEAD * size / self._radius
        tip = np.array([self._radius, 0.0, 0.0])
        back = self._radius * np.array([math.cos(self._head_angle), -math.sin(self._head_angle), 0.0])
        self._heads = {
            side: add_head(scene, f"{own}/head{k}", tip, (tip - back) * (1.0, side, 1.0), colour, HEAD * size)
            for k, side in enumerate((1.0, -1.0))
        }

    def face(self, side: float) -> None:
        """Move to the upper (+1) or the lower (−1) face of the housing."""
        height = self._middle + side * self._over
        move(self._from, self._pose[:3, 3] + height * self._pose[:3, 2])
        move(self._to, (0.0, 0.0, height))

    def follow(self, q: float) -> None:
        """Draw the arc of a joint value."""
        angle = q + self._offset
        size = abs(angle)
        for side, head in self._heads.items():
            seen(head, size > 1.5 * self._head_angle and angle * side > 0.0)
        seen(self._arc, size > LEAST_ANGLE)
        if size > LEAST_ANGLE:
            # The line ends inside its head.
            drawn = size - 0.6 * self._head_angle if size > 1.5 * self._head_angle else size
            self._arc.points = polyline(arc(math.copysign(drawn, angle), self._radius, STEP))
        middle = 0.5 * angle
        at = NAME_AT * self._radius
        move(self.name, (at * math.cos(middle), at * math.sin(middle), 0.0))


class Slide:
    """The stroke of a prismatic joint, from d = 0 to where the joint is, beside its sleeve."""

    def __init__(self, canvas: LayerCanvas, i: int) -> None:
        anatomy, scene, size, colour = canvas.drawn.figure.anatomy, canvas.scene, canvas.size, joint_colour(i)
        body, r = anatomy.bodies[i], float(anatomy.radius[i])
        self._size, self._offset, self._head_length = size, body.offset, HEAD * size
        side = (SLEEVE_HALF_WIDTH + 1.2) * r
        path = f"{canvas.node(i)}/angle{i + 1}"
        scene.add_frame(
            path,
            show_axes=False,
            wxyz=quaternion_from_rotation(body.mount[:3, :3]),
            position=(body.mount @ [side, 0.0, 0.0, 1.0])[:3],
        )
        tick = polyline([[-side, 0.0, 0.0], [0.4 * r, 0.0, 0.0]])
        add_line(scene, f"{path}/from", tick, colour, size)
        self._line = add_line(scene, f"{path}/arc", polyline([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), colour, size, THICK)
        self.name = add_name(scene, f"{path}/name", "", (0.0, 0.0, 0.0), "center-left")
        own = f"{canvas.node(i + 1)}/angle_to{i + 1}"
        scene.add_frame(own, show_axes=False, position=(side, 0.0, 0.0))
        add_line(scene, f"{own}/ray", tick, colour, size)
        self._heads = {
            sign: add_head(scene, f"{own}/head{k}", np.zeros(3), (0.0, 0.0, sign), colour, self._head_length)
            for k, sign in enumerate((1.0, -1.0))
        }

    def face(self, side: float) -> None:
        """Do nothing, as a stroke can be seen from all sides."""

    def follow(self, q: float) -> None:
        """Draw the stroke of a joint value."""
        stroke = q + self._offset
        length = abs(stroke)
        for sign, head in self._heads.items():
            seen(head, length > 1.5 * self._head_length and stroke * sign > 0.0)
        seen(self._line, length > LEAST_STROKE * self._size)
        if length > LEAST_STROKE * self._size:
            drawn = length - 0.6 * self._head_length if length > 1.5 * self._head_length else length
            stretch(self._line, (0.0, 0.0, math.copysign(drawn, stroke)))
        move(self.name, (0.012 * self._size, 0.0, NAME_PART * stroke))
