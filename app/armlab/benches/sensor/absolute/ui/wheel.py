"""Solids of an encoder for a disk of radius 1: slotted tracks, hub and shaft, a bracket, lamps and sensors."""

from __future__ import annotations

import math
from functools import cache, lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.sensors.absolute import TURN, words_of
from armlab.ui.colours import Rgb
from armlab.ui.figure.glb import look_of, scene_glb
from armlab.ui.figure.mesh import Solid, joined
from armlab.ui.figure.solids import block, drum

Floats = NDArray[np.float64]

INNER, OUTER = 0.36, 0.95
"""Radii between which the tracks lie."""

GAP, THIN = 0.012, 0.008
"""Width of the rings between tracks, and half the thickness of the disk."""

OVERLAP = 0.004
"""Width by which the rings lie over the tracks, so that no light shows between."""

PIECE = math.radians(4.0)
"""Largest angle of a flat piece of a ring, radians."""

UP = 0.25 * TURN
"""Direction of the sensors in the plane of the disk: along y."""

FRONT, BACK = 0.16, -0.16
"""Places of the sensors and of the lamps along the shaft."""

DISK: Rgb = (104, 113, 127)
LIT: Rgb = (240, 196, 25)


def radii(tracks: int) -> Floats:
    """Return inner and outer radius of each track, the coarsest innermost, (tracks, 2)."""
    edges = np.linspace(INNER, OUTER, tracks + 1)
    return np.stack([edges[:-1] + 0.5 * GAP, edges[1:] - 0.5 * GAP], axis=1)


def absolute_arcs(code: str, tracks: int) -> Floats:
    """Return the dark pieces of a coded disk: begin and end in radians, inner and outer radius, (m, 4)."""
    words, width = words_of(code, tracks), TURN / 2**tracks
    found = []
    for (low, high), bit in zip(radii(tracks).tolist(), range(tracks - 1, -1, -1), strict=True):
        bits = words >> bit & 1
        begins = np.flatnonzero(np.diff(np.concatenate([[-1], bits])))
        ends = np.concatenate([begins[1:], [len(bits)]])
        dark = bits[begins] == 0
        found.append(_rows(begins[dark] * width, ends[dark] * width, low, high))
    return np.concatenate(found)


def _rows(begins: Floats, ends: Floats, low: float, high: float) -> Floats:
    count = len(begins)
    return np.stack([begins, ends, np.full(count, low), np.full(count, high)], axis=1)


def plates(arcs: Floats) -> Solid:
    """Return thin plates with a front and a back, pieces of rings.

    Parameters
    ----------
    arcs : ndarray, shape (m, 4)
        Begin and end as angles of the disk in radians, inner and outer radius. Angle zero is under the sensors when the
        disk is not turned; angles count against the turn, so that a disk that is turned on shows them later ones.
    """
    pieces = np.ceil((arcs[:, 1] - arcs[:, 0]) / PIECE - 1e-9).astype(int)
    each = np.repeat(np.arange(len(arcs)), pieces)
    step = np.arange(len(each)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    width = ((arcs[:, 1] - arcs[:, 0]) / pieces)[each]
    begin = UP - arcs[each, 0] - step * width
    directions = [np.stack([np.cos(at), np.sin(at)], axis=1) for at in (begin, begin - width)]
    low, high = arcs[each, 2, None], arcs[each, 3, None]
    # Corners counterclockwise, seen from the front: the later angle is to the right of the earlier one.
    flat = np.stack([low * directions[0], low * directions[1], high * directions[1], high * directions[0]], axis=1)
    solids = []
    for sign in (1.0, -1.0):
        vertices = np.concatenate([flat, np.full((*flat.shape[:2], 1), sign * THIN)], axis=2).reshape(-1, 3)
        normals = np.tile([0.0, 0.0, sign], (len(vertices), 1))
        corner = 4 * np.arange(len(flat))[:, None]
        order = ([0, 1, 2], [0, 2, 3]) if sign > 0.0 else ([0, 2, 1], [0, 3, 2])
        solids.append(Solid(vertices, normals, np.concatenate([corner + np.array(one) for one in order])))
    return joined(solids)


def _rings(edges: Floats) -> Floats:
    """Return whole rings, for pairs of radii (m, 2), as arcs."""
    count = len(edges)
    return np.column_stack([np.zeros(count), np.full(count, TURN), edges])


def disk_glb(arcs: Floats, tracks: int) -> bytes:
    """Return a disk with its dark pieces, rings between its tracks, its hub, and a mark at angle zero."""
    between = np.linspace(INNER, OUTER, tracks + 1)
    held = np.stack([between - 0.5 * GAP - OVERLAP, between + 0.5 * GAP + OVERLAP], axis=1)
    held[0, 0], held[-1, 1] = 0.1, 1.0
    mark = plates(np.array([[-0.012, 0.012, 0.14, INNER - 0.03]]))
    mark = Solid(mark.vertices * [1.0, 1.0, 1.6], mark.normals, mark.faces)
    hub = drum(0.13, 0.05, 0.01)
    return scene_glb(
        [
            (joined([plates(arcs), plates(_rings(held))]), (DISK, 0.5, 0.1)),
            (hub, look_of("steel")),
            (mark, (LIT, 0.5, 0.0)),
        ]
    )


@lru_cache(maxsize=24)
def absolute_glb(code: str, tracks: int) -> bytes:
    """Return the disk of an absolute encoder."""
    return disk_glb(absolute_arcs(code, tracks), tracks)


@cache
def frame_glb() -> bytes:
    """Return all that stands still: motor, shaft, and the bracket that holds lamps and sensors."""
    long, middle = 1.18 - INNER + 0.06, 0.5 * (1.18 + INNER - 0.06)
    back = block((0.12, long, 0.05), 0.012, (0.0, middle, BACK - 0.045))
    front = block((0.035, long, 0.03), 0.008, (0.0, middle, FRONT + 0.05))
    bridge = block((0.12, 0.1, FRONT - BACK + 0.14), 0.012, (0.0, 1.16, 0.0))
    motor = drum(0.42, 0.2, 0.03, z=-0.62, sides=32)
    shaft = drum(0.06, 0.3, 0.01, z=-0.25)
    return scene_glb([(joined([back, front, bridge, motor]), look_of("shell")), (shaft, look_of("steel"))])


@cache
def sensor_glb(lit: bool) -> bytes:
    """Return a sensor of unit size, dark or lit."""
    return scene_glb([(block((1.0, 1.0, 1.0), 0.12), (LIT if lit else (40, 43, 48), 0.6, 0.0))])
