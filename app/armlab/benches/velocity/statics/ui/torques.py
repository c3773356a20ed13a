"""The torques and forces of the joints in the scene: arcs about revolute axes, arrows along prismatic ones.

Both hang on the body before, on which the joint stands, so a moving arm takes them along.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.kin.rotations import quaternion_from_rotation
from armlab.kin.sweeps import arc
from armlab.ui import adapter
from armlab.ui.colours import Rgb, joint_colour
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.housings import half_length
from armlab.ui.figure.mesh import Solid
from armlab.ui.figure.solids import along, lathe
from armlab.ui.scene._nodes import add_solid, move, put, seen, write
from armlab.ui.scene._strokes import HEAD, add_line, add_name, polyline
from armlab.ui.scene._turns import before_turn

LINE = 0.011
"""Thickness of an arc, in sizes of the arm."""

RADIUS, LEAST_RADIUS = 2.6, 0.05
"""Radius of an arc in tube radii of its joint, and its least value in sizes of the arm."""

FULL = math.radians(300.0)
"""Angle of the arc of the full torque, radians."""

LENGTH = 0.3
"""Length of the arrow that stands for the full force, in sizes of the arm."""

STEP = math.radians(6.0)
LEAST = 0.004
"""Share of the full torque or force below which only the value is drawn."""

LENGTH_DIGITS = 9
"""Number of decimals of a length in metres; a smaller change is rounding."""

SEEN = math.radians(0.3)
"""Smallest change of an arc that is drawn, radians."""

NAME_AT = 1.35
"""Place of the name, in radii of the arc."""


class Torque:
    """The arc of a revolute joint."""

    def __init__(self, canvas: LayerCanvas, i: int, name: str = "torque") -> None:
        figure = canvas.drawn.figure
        anatomy, scene, size, colour = figure.anatomy, canvas.scene, canvas.size, joint_colour(i)
        r = float(anatomy.radius[i])
        self._radius, self._head_length = max(RADIUS * r, LEAST_RADIUS * size), 1.3 * HEAD * size
        pose = before_turn(anatomy.bodies[i], anatomy.arm.rows[i].theta)
        over = figure.housings[i] + half_length(anatomy, i, figure.housings[i]) + 0.25 * r
        path = f"{canvas.node(i)}/{name}{i + 1}"
        node = scene.add_frame(
            path,
            show_axes=False,
            wxyz=quaternion_from_rotation(pose[:3, :3]),
            position=pose[:3, 3] + over * pose[:3, 2],
        )
        self._node = node
        self._arc = add_line(scene, f"{path}/arc", polyline(arc(0.1, self._radius)), colour, size, LINE)
        self._head = add_solid(scene, f"{path}/head", _cone(), colour, scale=self._head_length)
        self._name = add_name(scene, f"{path}/name", "", (NAME_AT * self._radius, 0.0, 0.0), "center-center")
        self._shown = math.inf

    def show(self, part: float, text: str) -> None:
        """Show a torque, as a share of the full one, and its name with its value."""
        seen(self._name, bool(text))
        write(self._name, text)
        turn = FULL * min(max(part, -1.0), 1.0)
        if abs(turn - self._shown) < SEEN:
            return
        self._shown = turn
        drawn = abs(part) > LEAST
        seen(self._arc, drawn)
        seen(self._head, drawn)
        if drawn:
            # The line ends inside its head, which points along the chord of what it covers.
            covered = min(self._head_length / self._radius, abs(turn))
            until = turn - math.copysign(covered, turn)
            self._arc.points = polyline(arc(turn - math.copysign(0.6 * covered, turn), self._radius, STEP))
            self._head.scale = 2.0 * self._radius * math.sin(0.5 * covered)
            move(self._head, self._at(until))
            adapter.set_wxyz(self._head, _in_plane(until + math.copysign(0.5 * (covered + math.pi), turn)))
        move(self._name, NAME_AT * self._at(0.5 * turn))

    def _at(self, angle: float) -> NDArray[np.float64]:
        return self._radius * np.array([math.cos(angle), math.sin(angle), 0.0])


def _in_plane(angle: float) -> tuple[float, float, float, float]:
    """Return the quaternion, wxyz, that turns z into the direction at an angle from x towards y."""
    half = math.sqrt(0.5)
    return half, -half * math.sin(angle), half * math.cos(angle), 0.0


class Push:
    """The arrow of a prismatic joint."""

    def __init__(self, canvas: LayerCanvas, i: int, name: str = "torque") -> None:
        anatomy, scene, size = canvas.drawn.figure.anatomy, canvas.scene, canvas.size
        mount, r = anatomy.bodies[i].mount, float(anatomy.radius[i])
        path = f"{canvas.node(i)}/{name}{i + 1}"
        at = mount[:3, 3] + 3.0 * r * mount[:3, 0]
        scene.add_frame(path, show_axes=False, wxyz=quaternion_from_rotation(mount[:3, :3]), position=at)
        self._size = size
        self._arrow = Arrow(scene, f"{path}/arrow", joint_colour(i), size)
        self._name = add_name(scene, f"{path}/name", "", (0.0, 0.0, 0.0), "center-left")

    def show(self, part: float, text: str) -> None:
        """Show a force, as a share of the full one, and its name with its value."""
        seen(self._name, bool(text))
        write(self._name, text)
        length = LENGTH * self._size * min(max(part, -1.0), 1.0) if abs(part) > LEAST else 0.0
        self._arrow.show(np.zeros(3), np.array([0.0, 0.0, length]))
        move(self._name, (0.02 * self._size, 0.0, 0.5 * length))


class Arrow:
    """An arrow from a point, which is moved, turned and scaled without being rebuilt.

    Its node stands where shaft and head meet, so that an arrow of the same length is moved by one node alone.

    Parameters
    ----------
    scene : viser.SceneApi
    path : str
    colour : Rgb
    size : float
        Of the arm.
    thick : float
        Radius of the shaft, in sizes of the arm.
    anchor : str
        Of the name at the tip; empty for an arrow without a name.
    """

    def __init__(
        self, scene: viser.SceneApi, path: str, colour: Rgb, size: float, thick: float = 0.0055, anchor: str = ""
    ) -> None:
        self._head_length, self._thick = 2.6 * thick * 2.0 * size, thick * size
        self._node = scene.add_frame(path, show_axes=False, visible=False)
        self._shaft = add_solid(scene, f"{path}/shaft", _rod(), colour, scale=1e-3)
        self._head = add_solid(scene, f"{path}/head", _cone(), colour, scale=1e-3)
        self._name = add_name(scene, f"{path}/name", "", (0.0, 0.0, 0.0), anchor) if anchor else None
        self._shown: tuple[float, ...] = ()
        self._lengths = (0.0, 0.0)

    def call(self, name: str) -> None:
        """Write the arrow's name at its tip; an empty one is hidden."""
        if self._name is not None:
            seen(self._name, bool(name))
            write(self._name, name)

    def show(self, start: NDArray[np.float64], vector: NDArray[np.float64]) -> None:
        """Draw the arrow from a point; the zero vector is hidden."""
        x, y, z = vector.tolist()
        wanted = (*start.tolist(), x, y, z)
        if wanted == self._shown:
            return
        self._shown = wanted
        length = math.hypot(x, y, z)
        seen(self._node, length > 0.0)
        if length == 0.0:
            return
        head = min(self._head_length, 0.6 * length)
        put(self._node, along(vector, start + (1.0 - head / length) * vector))
        self._grow(length - head, head)

    def _grow(self, shaft: float, head: float) -> None:
        before, self._lengths = self._lengths, (round(shaft, LENGTH_DIGITS), round(head, LENGTH_DIGITS))
        if self._lengths[0] != before[0]:
            adapter.set_scale(self._shaft, (self._thick, self._thick, shaft))
        if self._lengths[1] != before[1]:
            adapter.set_scale(self._head, head)
            if self._name is not None:
                move(self._name, (0.0, 0.0, head))


@cache
def _cone() -> Solid:
    """Return a head of unit length along z, from the origin."""
    return lathe([(0.0, 0.0), (0.4, 0.0), (0.0, 1.0)], sides=24)


@cache
def _rod() -> Solid:
    """Return a cylinder of unit radius and length along z, up to the origin."""
    return lathe([(0.0, -1.0), (1.0, -1.0), (1.0, 0.0), (0.0, 0.0)], sides=20)
