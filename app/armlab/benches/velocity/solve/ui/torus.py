"""The torus of two joint angles as a drawing: its front, its back, and the angles at a pressed place."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.velocity.solve.pictures import Flat, Square
from armlab.benches.velocity.solve.state import Solve
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui import svg
from armlab.ui.form import Marks
from armlab.ui.html import Markup, styles, tag

Array = NDArray[np.float64]

HINT = "Click where the two joints are to move"

WIDE, HIGH = 284, 208
"""Width and height of the drawing, pixels."""

LARGE, SMALL = 1.0, 0.45
"""Radii: the first angle goes around the large circle, the second around the small one, from the outer edge upwards."""

TILT = math.radians(38.0)
"""Angle of the view above the plane of the large circle, radians."""

SCALE = 0.5 * (WIDE - 12) / (LARGE + SMALL)

MERIDIANS, PARALLELS, PIECES = 24, 12, 72
"""Number of circles in either direction, and of straight pieces of each."""

NEAR, TOGETHER = 12.0, 4.0
"""Distances in pixels: from a press to the torus at most, and beyond the nearest point within which the front
counts."""

SHORTEST, LONGEST = 3.0, 90.0
"""Least and largest length of the arrow, pixels; it shows the way of one second."""


def projected(q: ArrayLike) -> tuple[Array, NDArray[np.bool_]]:
    """Return the pixels (..., 2) of angles (..., 2), from the upper left corner, and which of them face the viewer."""
    angles = np.asarray(q, dtype=np.float64)
    around, along = angles[..., 0], angles[..., 1]
    out = LARGE + SMALL * np.cos(along)
    x, y, z = out * np.cos(around), out * np.sin(around), SMALL * np.sin(along)
    up = y * math.sin(TILT) + z * math.cos(TILT)
    facing = -np.cos(along) * np.sin(around) * math.cos(TILT) + np.sin(along) * math.sin(TILT)
    pixels = np.stack([0.5 * WIDE + SCALE * x, 0.5 * HIGH - SCALE * up], axis=-1)
    return pixels, np.asarray(facing > 0.0)


def _depth(q: Array) -> Array:
    """Return the depth of points of the torus towards the viewer, in radii."""
    out = LARGE + SMALL * np.cos(q[..., 1])
    return np.asarray(-out * np.sin(q[..., 0]) * math.cos(TILT) + SMALL * np.sin(q[..., 1]) * math.sin(TILT))


def path(lines: Array, front: bool) -> str:
    """Return the path commands of the pieces (k, 2, 2) of lines that are in front, or behind."""
    ends, seen = projected(lines)
    chosen = ends[np.all(seen, axis=1) if front else ~np.all(seen, axis=1)]
    return "".join(f"M{a:.1f} {b:.1f}L{c:.1f} {d:.1f}" for (a, b), (c, d) in chosen.tolist())


@cache
def _mesh() -> tuple[str, str]:
    """Return the circles of the torus, in front and behind."""
    steps = np.linspace(-math.pi, math.pi, PIECES + 1)
    pieces = []
    for count, first in ((MERIDIANS, True), (PARALLELS, False)):
        for angle in np.linspace(-math.pi, math.pi, count, endpoint=False):
            fixed = np.full_like(steps, angle)
            line = np.stack([fixed, steps] if first else [steps, fixed], axis=1)
            pieces.append(np.stack([line[:-1], line[1:]], axis=1))
    lines = np.concatenate(pieces)
    return path(lines, True), path(lines, False)


def torus_markup(place: Marks, found: Square) -> Markup:
    """Return the torus with the singular set; `place` of a form makes it clickable."""
    front, behind = _mesh()
    seen = svg.drawing(
        "",
        WIDE,
        HIGH,
        "The torus of both joint angles",
        svg.path("behind", behind),
        svg.path("mesh", front),
        svg.path("singular.far", path(found.singular, False)),
        svg.path("singular", path(found.singular, True)),
    )
    return tag("div.so-ring", seen, tag("b.so-way"), tag("b.so-here"), title=HINT, **place)


def torus_style(state: State, answer: Flat) -> Markup:
    """Return the place of the arm on the torus and its velocity, as style."""
    q = np.array(state[Joints].q[list(state[Solve].pair)])
    (x, y), seen = projected(q)
    step = 1e-4 * answer.answer.qdot
    ahead, _ = projected(q + step)
    across, down = ((ahead - (x, y)) / 1e-4).tolist()
    length, turn = min(math.hypot(across, down), LONGEST), math.degrees(math.atan2(down, across))
    way = "block" if length > SHORTEST else "none"
    return styles(
        [
            f".al .so-ring{{--x:{100.0 * x / WIDE:.2f}%;--y:{100.0 * (1.0 - y / HIGH):.2f}%;--len:{length:.1f}px;"
            f"--turn:{turn:.2f}deg;--way:{way};--fade:{1.0 if seen else 0.45:g}}}"
        ]
    )


@cache
def _seen() -> tuple[Array, Array]:
    """Return angles on a close grid that are in front, and their pixels, both (N, 2)."""
    steps = np.linspace(-math.pi, math.pi, 2 * PIECES, endpoint=False)
    q = np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1).reshape(-1, 2)
    pixels, seen = projected(q)
    return q[seen], pixels[seen]


def pressed(x: float, y: float) -> tuple[float, float] | None:
    """Return the angles of the torus at a place of the drawing, or None beside it.

    Parameters
    ----------
    x, y : float
        Parts of the drawing, from the upper left corner.
    """
    q, pixels = _seen()
    gaps = np.linalg.norm(pixels - (x * WIDE, y * HIGH), axis=1)
    if float(gaps.min()) > NEAR:
        return None
    near = np.flatnonzero(gaps <= float(gaps.min()) + TOGETHER)
    # Of the layers of the torus the nearest to the eye, and of it the point nearest to the press.
    depths = _depth(q[near])
    layer = near[depths > depths.max() - SMALL]
    first, second = q[layer[int(np.argmin(gaps[layer]))]].tolist()
    return first, second
