"""The parts of a harmonic drive as solids, in modules across and in widths of the ring along the axis."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.benches.drive.gears.ui.solids import circle_beside, ring
from armlab.kin.drive.strain_wave import HEIGHT, SLOPE, WIDTH, StrainWave
from armlab.ui.colours import GREEN, ORANGE, PURPLE, Rgb
from armlab.ui.figure.glb import MATERIALS, Look, scene_glb
from armlab.ui.figure.mesh import Solid
from armlab.ui.figure.solids import block, drum

Floats = NDArray[np.float64]

BAND = 1.3
"""Thickness of the ring of the flexspline without its teeth, modules."""

BEARING = 0.075
"""Thickness of the bearing between wave generator and flexspline, in radii."""

RIM = 0.13
"""Width of the ring of the circular spline outside its teeth, in radii."""

SIDES = 180
"""Number of pieces of smooth lines."""

HOUSING: Rgb = (120, 130, 145)
STEEL: Rgb = (150, 184, 214)
CAM: Rgb = (96, 106, 120)
"""Colours of the circular spline, of the flexspline, and of the wave generator."""


@lru_cache(maxsize=8)
def circular_glb(teeth: int) -> bytes:
    """Return the circular spline; the middle of a gap is on the x axis, and a mark beside it on the rim."""
    r = 0.5 * teeth
    inside = _toothed(teeth)
    outside = circle_beside(inside, (1.0 + RIM) * r)
    parts: list[tuple[Solid, Look]] = [(ring(outside, inside, 1.0), (HOUSING, 0.45, 0.1))]
    long = 0.7 * RIM * r
    at = (1.0 + 0.55 * RIM) * r
    parts.append((block((long, 0.035 * r, 0.1), 0.01, (at, 0.0, 0.5)), (GREEN, 0.4, 0.0)))
    return scene_glb(parts)


def _toothed(teeth: int) -> Floats:
    """Return the inner line of the circular spline, shape (4 teeth, 2): its teeth point to the axis."""
    r = 0.5 * teeth
    # Teeth stand half a pitch beside the x axis; towards the axis they become narrower.
    low, high = r + HEIGHT, r - HEIGHT
    corners = [(low, -(WIDTH + SLOPE * HEIGHT)), (high, -(WIDTH - SLOPE * HEIGHT))]
    corners += [(radius, -across) for radius, across in reversed(corners)]
    angle = np.array([across / radius for radius, across in corners])
    radius = np.array([radius for radius, _ in corners])
    middles = 2.0 * np.pi * (np.arange(teeth) + 0.5) / teeth
    turned = (middles[:, None] + angle).ravel()
    return np.asarray(np.tile(radius, teeth)[:, None] * np.column_stack([np.cos(turned), np.sin(turned)]))


def tooth_of_flexspline() -> Solid:
    """Return one tooth of the flexspline, which points along x from its foot in the ring."""
    foot, tip = HEIGHT + 0.3, HEIGHT
    corners = np.array(
        [
            (-foot, -(WIDTH + SLOPE * foot)),
            (tip, -(WIDTH - SLOPE * HEIGHT)),
            (tip, WIDTH - SLOPE * HEIGHT),
            (-foot, WIDTH + SLOPE * foot),
        ]
    )
    inner = np.column_stack([0.98 * corners[:, 0], 0.02 * corners[:, 1]])
    return ring(corners, inner, 0.96)


@lru_cache(maxsize=8)
def flag_glb(teeth: int) -> bytes:
    """Return the mark of a tooth of the flexspline, on its ring: at the origin, towards the axis along -x."""
    r = 0.5 * teeth
    long = (BEARING + 0.06) * r
    return scene_glb([(block((long, 0.035 * r, 0.1), 0.01, (-HEIGHT - 0.5 * long, 0.0, 0.5)), (PURPLE, 0.4, 0.0))])


@lru_cache(maxsize=8)
def generator_glb(drive: StrainWave) -> bytes:
    """Return what turns with the shape of the flexspline: its ring, the bearing, and the wave generator with its mark.

    The ring is bent, and its shape goes round with the wave generator while its material hardly turns.
    """
    r = 0.5 * drive.flexspline
    beta = 2.0 * np.pi * np.arange(SIDES) / SIDES
    radius, angle, _ = drive.shape(beta)
    edge = radius - HEIGHT
    direction = np.column_stack([np.cos(angle), np.sin(angle)])

    def line(inwards: float) -> Floats:
        return np.asarray((edge - inwards)[:, None] * direction)

    bearing = BEARING * r
    cam = line(BAND + bearing)
    parts: list[tuple[Solid, Look]] = [
        (ring(line(0.0), line(BAND), 0.96), (STEEL, 0.35, 0.2)),
        (ring(line(BAND), cam, 0.7), MATERIALS["dark"]),
        (ring(cam, circle_beside(cam, 0.02 * r), 0.86), (CAM, 0.45, 0.1)),
        (drum(0.2 * r, 0.56, 0.02, sides=48), MATERIALS["dark"]),
    ]
    long = 0.58 * r
    parts.append((block((long, 0.06 * r, 0.1), 0.01, (0.2 * r + 0.5 * long, 0.0, 0.46)), (ORANGE, 0.4, 0.0)))
    return scene_glb(parts)


def tooth_poses(drive: StrainWave, theta: float) -> tuple[Floats, Floats]:
    """Return where the teeth of the flexspline are: positions (k, 2), modules, and their directions (k,), radians."""
    generator, flexible, _ = drive.angles(theta)
    own = 2.0 * np.pi * np.arange(drive.flexspline) / drive.flexspline
    radius, angle, tilt = drive.shape(own - (generator - flexible))
    at = angle + generator
    return radius[:, None] * np.column_stack([np.cos(at), np.sin(at)]), own + flexible + tilt
