"""One spur wheel as a GLB file, in modules across and in widths of the wheel along its axis."""

from __future__ import annotations

from functools import lru_cache

from armlab.benches.drive.gears.ui.solids import circle_beside, ring
from armlab.kin.drive.tooth import DEDENDUM, outline
from armlab.ui.colours import Rgb, joint_colour
from armlab.ui.figure.glb import MATERIALS, Look, scene_glb
from armlab.ui.figure.mesh import Solid
from armlab.ui.figure.solids import block, drum

THINNED = 0.04
"""Difference between a gap and a drawn tooth, modules: some backlash, so that they are seen to touch."""

FINE, COARSE, MANY = 7, 5, 60
"""Number of points of a flank, also for wheels of many teeth, and the number from which these are many."""

WEB = 16
"""Least number of teeth of a wheel with a web between rim and hub; smaller ones are full."""

STEEL: Rgb = (172, 182, 195)
TINTS: dict[int, Look] = {k: (joint_colour(k), 0.42, 0.0) for k in range(4)}
"""Looks of the marks, by the number of the wheel."""


@lru_cache(maxsize=24)
def wheel_glb(teeth: int, number: int) -> bytes:
    """Return a wheel with its mark, of one colour for each number; the middle of a tooth is on the x axis."""
    edge = outline(teeth, THINNED, COARSE if teeth > MANY else FINE)
    root = 0.5 * teeth - DEDENDUM
    parts: list[tuple[Solid, Look]] = []
    if teeth < WEB:
        parts.append((ring(edge, circle_beside(edge, 0.02 * root), 1.0), (STEEL, 0.4, 0.2)))
    else:
        rim = root - 2.2
        parts.append((ring(edge, circle_beside(edge, rim), 1.0), (STEEL, 0.4, 0.2)))
        parts.append((drum(rim, 0.28, 0.01, sides=64), MATERIALS["shell"]))
    hub = min(0.34 * root, 0.18 * root + 2.0)
    parts.append((drum(hub, 0.62, 0.03, sides=40), MATERIALS["dark"]))
    # The mark reaches from the hub to the tooth on the x axis.
    long = root - hub
    parts.append(
        (block((long, 0.16 * hub + 0.12 * root**0.5, 0.05), 0.01, (hub + 0.5 * long, 0.0, 0.52)), TINTS[number])
    )
    return scene_glb(parts)
