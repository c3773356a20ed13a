"""Places of the housings on the joint axes, which make coincident frames and spherical wrists readable."""

from __future__ import annotations

import math

import numpy as np

from armlab.ui.figure.anatomy import Anatomy, Body

RADIUS = 1.38
HALF_LENGTH = 1.2
"""Half length of a housing, in tube radii."""

SLEEVE_HALF_WIDTH = 1.5
"""Half width of the box around a rod or a rail, in tube radii."""


def housing_offsets(anatomy: Anatomy) -> list[float]:
    """Return the place of each housing along z of its node; 0 for a prismatic joint, which has none.

    The first stands on the base column when d1 is long enough, else the base hangs below it. One that would sit inside
    the housing before it moves forward along its axis; one at the end of a link that arrives along its axis, with
    nothing behind it, moves back. All others sit at the origin of their frame.
    """
    offsets = [_first(anatomy)]
    for i in range(1, len(anatomy.bodies)):
        offsets.append(_next(anatomy, i, offsets[-1]))
    return offsets


def half_length(anatomy: Anatomy, i: int, offset: float) -> float:
    """Return half the length of housing i, longer where the sleeve of a slide would hide it."""
    usual = HALF_LENGTH * float(anatomy.radius[i])
    if i + 1 == len(anatomy.bodies) or anatomy.bodies[i + 1].revolute:
        return usual
    r = float(anatomy.radius[i + 1])
    on_it = np.linalg.norm(anatomy.bodies[i + 1].mount[:3, 3] - [0.0, 0.0, offset]) < 2.0 * r
    return max(usual, SLEEVE_HALF_WIDTH * r + 0.5 * r) if on_it else usual


def _first(anatomy: Anatomy) -> float:
    body, r = anatomy.bodies[0], float(anatomy.radius[0])
    if not body.revolute or body.d < 4.0 * r:
        return 0.0
    return min(2.6 * r, 0.4 * body.d)


def _next(anatomy: Anatomy, i: int, offset_before: float) -> float:
    body, before, r = anatomy.bodies[i], anatomy.bodies[i - 1], float(anatomy.radius[i])
    if not body.revolute:
        return 0.0
    thin = 0.15 * anatomy.radius[0]
    at = body.mount[:3, 3]
    if before.revolute and np.linalg.norm(at - [0.0, 0.0, offset_before]) < 2.2 * r:
        side = math.copysign(1.0, body.d) if body.d else 1.0
        return side * (min(2.5 * r, 0.55 * abs(body.d)) if abs(body.d) > thin else 2.1 * r)
    bends = abs(math.sin(body.alpha)) >= 0.1
    if body.length < thin and i + 1 < len(anatomy.bodies) and bends and _arrives_along(before, body, thin):
        return -2.3 * r
    return 0.0


def _arrives_along(before: Body, body: Body, thin: float) -> bool:
    """Return whether the previous link reaches this joint along the joint's own axis."""
    came = np.array([0.0, 0.0, 1.0] if abs(before.a) < thin else [1.0, 0.0, 0.0])
    return abs(float(came @ body.mount[:3, 2])) > 0.9
