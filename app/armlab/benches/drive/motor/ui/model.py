"""The solids of a motor with a disc on its shaft; lengths in units of the model, y away from the disc, z up."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from numpy.typing import NDArray

from armlab.benches.drive.motor.state import Motor
from armlab.benches.drive.stage import around
from armlab.session.state import State
from armlab.ui.colours import ORANGE, Rgb
from armlab.ui.figure.glb import Look, scene_glb
from armlab.ui.figure.mesh import Solid, joined, placed
from armlab.ui.figure.solids import along, block, drum

BODY, LONG = 0.62, 0.75
"""Radius and half length of the housing."""

DISC, DISC_AT, THICK = 0.8, -1.15, 0.05
"""Radius, place on the axis and half thickness of the disc."""

POINTER = 0.09
"""Half width of the pointer on the disc."""

TICKS = 12

BACK = (0.0, 1.0, 0.0)
HOUSING: Look = ((74, 82, 95), 0.46, 0.0)
STEEL: Look = ((178, 186, 196), 0.3, 0.4)
COPPER: Look = ((196, 124, 74), 0.35, 0.3)
PALE: Look = ((214, 219, 226), 0.45, 0.0)
"""Looks of what is seen."""

GHOST: Rgb = (128, 137, 150)

APART, MIDDLE = 1.15, 0.4
"""Distance of each of two motors from the middle of the model, and place of its housing on the axis."""

HALF = (1.5, 1.5, 1.15)
"""Half edges of the box that holds one motor."""


@cache
def housing_glb() -> bytes:
    """Return the housing with its flange, terminals and foot."""
    body = placed(drum(BODY, LONG, 0.06), along(BACK, (0.0, 0.05, 0.0)))
    flange = placed(drum(0.82 * BODY, 0.06, 0.02), along(BACK, (0.0, -LONG - 0.02, 0.0)))
    foot = block((1.1, 1.1, 0.1), 0.03, (0.0, 0.05, -BODY - 0.05))
    terminals = [placed(drum(0.06, 0.1, 0.02), along((0.0, 0.0, 1.0), (x, 0.45, BODY + 0.06))) for x in (-0.18, 0.18)]
    return scene_glb([(joined([body, foot]), HOUSING), (flange, STEEL), (joined(terminals), COPPER)])


@cache
def disc_glb(pale: bool = False) -> bytes:
    """Return shaft, disc and pointer, which turn; the pointer is up."""
    shaft = placed(drum(0.1, 0.28, 0.02), along(BACK, (0.0, -LONG - 0.24, 0.0)))
    disc = placed(drum(DISC, THICK, 0.02), along(BACK, (0.0, DISC_AT, 0.0)))
    front = DISC_AT - THICK
    pointer = block((2.0 * POINTER, 0.05, 0.92 * DISC), 0.02, (0.0, front, 0.46 * DISC))
    marks = [_tick(k * 2.0 * math.pi / TICKS, front) for k in range(1, TICKS)]
    colour: Look = ((150, 158, 170), 0.5, 0.0) if pale else (ORANGE, 0.45, 0.0)
    return scene_glb([(shaft, STEEL), (disc, PALE), (pointer, colour), (joined(marks), HOUSING)])


def _tick(angle: float, front: float) -> Solid:
    c, s = math.cos(angle), math.sin(angle)
    pose = np.array([[c, 0.0, s, 0.0], [0.0, 1.0, 0.0, 0.0], [-s, 0.0, c, 0.0], [0.0, 0.0, 0.0, 1.0]])
    return placed(block((0.03, 0.03, 0.1), 0.008, (0.0, front, 0.88 * DISC)), pose)


def places(state: State) -> list[NDArray[np.float64]]:
    """Return the middles of the motors in the model: one, or two where the state is looked at."""
    if state[Motor].shown != "state":
        return [np.array([0.0, MIDDLE, 0.0])]
    return [np.array([-APART, MIDDLE, 0.0]), np.array([APART, MIDDLE, 0.0])]


def around_motors(state: State) -> NDArray[np.float64]:
    """Return the corners of what belongs in the picture."""
    wide = APART if len(places(state)) == 2 else 0.0
    return around(state, (HALF[0] + wide, HALF[1], HALF[2]))
