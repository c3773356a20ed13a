"""Small solids that explain: frames, joint symbols."""

from __future__ import annotations

from functools import cache

import trimesh

from armlab.ui.colours import AXES, Rgb, joint_colour
from armlab.ui.figure.anatomy import Anatomy
from armlab.ui.figure.glb import CREASE, coloured
from armlab.ui.figure.solids import along, block, drum, lathe, placed

FRAME_LENGTH = 0.115
"""Length of a frame's arrows, in sizes of the arm."""

_DIRECTIONS = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


@cache
def frame_glb() -> bytes:
    """Return three arrows of unit length from a ball: x, y, z."""
    width = 0.033
    arrow = lathe([(0.0, 0.0), (width, 0.0), (width, 0.78), (2.6 * width, 0.78), (0.0, 1.0)], sides=20)
    scene = trimesh.Scene()
    ball = trimesh.creation.icosphere(subdivisions=3, radius=1.7 * width)
    scene.add_geometry(coloured(ball, (70, 78, 90), 0.6))
    for axis, direction in _DIRECTIONS.items():
        solid = trimesh.graph.smooth_shade(placed(arrow, along(direction)), angle=CREASE)
        scene.add_geometry(coloured(solid, AXES[axis], 0.6))
    exported: bytes = scene.export(file_type="glb", include_normals=True)
    return exported


def symbols_of(anatomy: Anatomy) -> list[bytes]:
    """Return the symbol of each joint, about z of its axis."""
    return [
        _symbol(body.revolute, symbol_height(anatomy, i) / 3.0, joint_colour(i))
        for i, body in enumerate(anatomy.bodies)
    ]


def symbol_height(anatomy: Anatomy, i: int) -> float:
    """Return the height of the symbol of joint i (0-based) in metres, along its axis."""
    return 3.75 * float(anatomy.radius[i])


def _symbol(revolute: bool, r: float, colour: Rgb) -> bytes:
    """Return the symbol of the textbooks about z: a cylinder for a revolute, a box for a prismatic joint."""
    solid = drum(0.55 * r, 1.5 * r, 0.1 * r) if revolute else block((0.95 * r, 0.95 * r, 3.0 * r), 0.1 * r)
    solid = trimesh.graph.smooth_shade(solid, angle=CREASE)
    scene = trimesh.Scene()
    scene.add_geometry(coloured(solid, colour, 0.5))
    exported: bytes = scene.export(file_type="glb", include_normals=True)
    return exported
