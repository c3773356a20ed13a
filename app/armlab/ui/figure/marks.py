"""Small solids for explanations: frames and joint symbols."""

from __future__ import annotations

import math
from functools import cache, lru_cache

from armlab.ui.colours import AXES, Rgb, joint_colour
from armlab.ui.figure.anatomy import Anatomy
from armlab.ui.figure.glb import scene_glb
from armlab.ui.figure.mesh import Solid, placed
from armlab.ui.figure.solids import along, block, drum, lathe

FRAME_LENGTH = 0.115
"""Length of a frame's arrows, in sizes of the arm."""

SYMBOL_STEP = 0.02
"""Relative step between the sizes of symbols, so that an arm being edited can use the same again."""

HALF_SIDES = 10
"""Rings of the ball of a frame, from pole to pole."""

_DIRECTIONS = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


@cache
def frame_glb() -> bytes:
    """Return three arrows of unit length from a ball: x, y, z."""
    width = 0.033
    arrow = lathe([(0.0, 0.0), (width, 0.0), (width, 0.78), (2.6 * width, 0.78), (0.0, 1.0)], sides=20)
    arrows = [(placed(arrow, along(_DIRECTIONS[axis])), (colour, 0.6, 0.0)) for axis, colour in AXES.items()]
    return scene_glb([(_ball(1.7 * width), ((70, 78, 90), 0.6, 0.0)), *arrows])


def _ball(radius: float) -> Solid:
    """Return a ball around the origin."""
    heights = [math.pi * k / HALF_SIDES for k in range(HALF_SIDES + 1)]
    ball = lathe(
        [(radius * math.sin(angle), -radius * math.cos(angle)) for angle in heights], 2 * HALF_SIDES, soft=True
    )
    return Solid(ball.vertices, ball.vertices / radius, ball.faces)


def symbols_of(anatomy: Anatomy) -> list[bytes]:
    """Return the symbol of each joint, about z of its axis."""
    return [
        _symbol(body.revolute, round(math.log(symbol_height(anatomy, i)) / SYMBOL_STEP), joint_colour(i))
        for i, body in enumerate(anatomy.bodies)
    ]


def symbol_height(anatomy: Anatomy, i: int) -> float:
    """Return the height of the symbol of joint i (0-based) in metres, along its axis."""
    return 3.75 * float(anatomy.radius[i])


@lru_cache(maxsize=512)
def _symbol(revolute: bool, steps: int, colour: Rgb) -> bytes:
    """Return the textbook symbol about z: a cylinder for a revolute joint, a box for a prismatic one."""
    r = math.exp(steps * SYMBOL_STEP) / 3.0
    solid = drum(0.55 * r, 1.5 * r, 0.1 * r, soft=True) if revolute else block((0.95 * r, 0.95 * r, 3.0 * r), 0.1 * r)
    return scene_glb([(solid, (colour, 0.5, 0.0))])
