"""Prismatic joints: a rail with a moving block, or a ram in a sleeve."""

from __future__ import annotations

import math

from armlab.ui.figure.anatomy import Anatomy
from armlab.ui.figure.glb import Part, joint_material
from armlab.ui.figure.solids import WIDE_SIDES, block, drum


def is_rail(anatomy: Anatomy, i: int) -> bool:
    """Return whether joint i is drawn as a rail: its link leaves sideways, or the next slide runs across it."""
    body, thin = anatomy.bodies[i], 0.15 * anatomy.radius[0]
    if abs(body.a) > thin:
        return True
    following = anatomy.bodies[i + 1] if i + 1 < len(anatomy.bodies) else None
    return following is not None and not following.revolute and abs(math.sin(body.alpha)) > 0.1


def rail(anatomy: Anatomy, i: int) -> tuple[list[Part], list[Part], float]:
    """Return the parts fixed to the body before (at the mount), those that move, and the foot of the rail.

    A square bar with end stops in the joint's colour and nine ticks between the limits.
    """
    body, r, colour = anatomy.bodies[i], float(anatomy.radius[i]), joint_material(i)
    low, high = body.offset + body.low, body.offset + body.high
    w, bottom, top = 1.7 * r, low - 1.9 * r, high + 1.9 * r
    middle, length = (bottom + top) / 2.0, top - bottom
    fixed: list[Part] = [("dark", block((w, w, length), 0.12 * r, (0.0, 0.0, middle)))]
    guide = (0.28 * r, 1.06 * w, length - 0.8 * r)
    fixed.extend(("steel", block(guide, 0.05 * r, (x, 0.0, middle))) for x in (0.38 * w, -0.38 * w))
    fixed += [(colour, block((1.25 * w, 1.25 * w, 0.5 * r), 0.1 * r, (0.0, 0.0, end))) for end in (bottom, top)]
    heights = (low + (high - low) * k / 10.0 for k in range(1, 10))
    fixed.extend(("shell", block((0.1 * r, 1.03 * w, 0.07 * r), 0.01 * r, (0.0, 0.0, z))) for z in heights)
    moving: list[Part] = [("shell", block((1.75 * w, 1.75 * w, 2.9 * r), 0.25 * r))]
    bands = (block((1.8 * w, 1.8 * w, 0.3 * r), 0.08 * r, (0.0, 0.0, z)) for z in (0.95 * r, -0.95 * r))
    moving.extend((colour, band) for band in bands)
    foot = bottom - 0.5 * r
    if i == 0:
        fixed.append(("dark", drum(2.6 * r, 0.14 * r, 0.1 * r, foot + 0.14 * r, sides=WIDE_SIDES)))
    return fixed, moving, foot


def ram(anatomy: Anatomy, i: int, tip: float) -> tuple[list[Part], list[Part], float]:
    """Return the fixed and the moving parts of a ram, and its foot; the rod ends ``tip`` before the node.

    The rod is long enough to stay in the sleeve at full stroke, and reaches beyond the node if that goes behind the
    sleeve. It carries a mark each tenth of the arm's size, and a cap where it may leave the sleeve.
    """
    body, r, colour = anatomy.bodies[i], float(anatomy.radius[i]), joint_material(i)
    low, high = body.offset + body.low, body.offset + body.high
    w = 1.7 * r
    sleeve = min(1.6 * r + 0.25 * (high - low), 0.8 * max(low - tip, 1.6 * r) + 1.2 * r)
    fixed: list[Part] = [("shell", block((1.75 * w, 1.75 * w, 2.0 * sleeve), 0.3 * r))]
    ends = (sleeve - 0.5 * r, 0.5 * r - sleeve)
    fixed.extend((colour, block((1.82 * w, 1.82 * w, 0.34 * r), 0.1 * r, (0.0, 0.0, z))) for z in ends)
    bottom, top = _ends_of_rod(low, high, tip, sleeve, 0.8 * r)
    rod = block((0.8 * w, 0.8 * w, top - bottom), 0.1 * r, (0.0, 0.0, (bottom + top) / 2.0))
    moving: list[Part] = [("steel", rod)]
    step = 0.1 * anatomy.size
    behind, ahead = int((-tip - bottom) / step), int((top + tip) / step)
    marks = (k * step - tip for k in (*range(-1, -behind - 1, -1), *range(1, ahead + 1)))
    moving.extend(("dark", block((0.83 * w, 0.83 * w, 0.09 * r), 0.01 * r, (0.0, 0.0, z))) for z in marks)
    caps = (z for z in (bottom, top) if z != -tip)
    moving.extend((colour, block((0.95 * w, 0.95 * w, 0.4 * r), 0.08 * r, (0.0, 0.0, z))) for z in caps)
    return fixed, moving, -sleeve


def _ends_of_rod(low: float, high: float, tip: float, sleeve: float, over: float) -> tuple[float, float]:
    """Return the lower and the upper end of a rod in the node of its body.

    It reaches through the sleeve, and ``over`` beyond, on each side of the node on which the sleeve comes to be: behind
    it when the rod is out, ahead of it when the travel is negative.
    """
    ahead = low < -0.5 * sleeve
    behind = high > 0.5 * sleeve or not ahead
    return -(high + sleeve + over) if behind else -tip, sleeve + over - low if ahead else -tip
