"""All solutions of arms with joints to spare: curves of them, traced, or more."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.answer import BEYOND, SURFACE, Answer, in_order, is_beyond, verified_rows
from armlab.kin.ik.closed_form import known_structure
from armlab.kin.ik.many_starts import STARTS, many_starts
from armlab.kin.ik.self_motion import STEP, SelfMotion, distance_to, evenly, trace_self_motion
from armlab.kin.ik.solutions import Completeness, beyond_limits, wrapped_rows
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.ik.verified import distinct, reaches
from armlab.kin.transforms import inverse

Vector = NDArray[np.float64]

FAMILY_STARTS = 48
"""Starts of the search for the self-motions of a redundant arm; each one is a piece of a family."""

FAMILIES = 4
"""Curves that are traced."""

REPRESENTATIVES = 8
"""Configurations that stand for each of them."""

_SEARCHED = f"Looked for from {FAMILY_STARTS + STARTS} random starts; a search proves nothing."


def with_spare_joints(arm: Arm, T: Vector, seed: int) -> Answer:
    """Return what is found for an arm that has more joints than its task needs; T (4, 4) in the world."""
    why = known_structure(arm).why
    if is_beyond(arm, T):
        return Answer([], "none", BEYOND, "self_motion", why)
    G = np.asarray(inverse(arm.base) @ T, dtype=np.float64)
    starts = list(many_starts(arm, G, seed=seed, starts=FAMILY_STARTS, inside=True))
    found = verified_rows(arm, T, starts)
    if not found:
        more = list(many_starts(arm, G, seed=seed + 1))
        found = verified_rows(arm, T, more)
    if not found:
        return Answer([], "at least", _SEARCHED, "self_motion", why)
    inside = [q for q in found if arm.within_limits(q)]
    found = inside or found
    if known_structure(arm).free > 1:
        reason = f"These {min(SURFACE, len(found))} stand for them."
        return Answer(found[:SURFACE], "infinite", reason, "self_motion", why)
    return _of_curves(arm, T, found, why)


def _of_curves(arm: Arm, T: Vector, found: list[Vector], why: str) -> Answer:
    """Trace the self-motions through solutions and let points evenly along them stand for all."""
    motions: list[SelfMotion] = []
    for q in found:
        if len(motions) == FAMILIES:
            break
        if distance_to(arm, q, [motion.q for motion in motions]) > 2.0 * STEP:
            motions.append(_motion(arm, T, q))
    inside = [motion for motion in motions if arm.within_limits(motion.q[0])]
    motions = inside or motions
    curves = [motion for motion in motions if len(motion.q) > 1]
    target = task_error_of(arm).target(T)
    along = [row for motion in motions for row in evenly(arm, motion, REPRESENTATIVES)]
    points = in_order(arm, distinct(arm, [row for row in along if reaches(arm, row, target)]))
    completeness: Completeness = "infinite" if curves else "at least"
    count = len(curves)
    reason = (
        f"{count} {'family was' if count == 1 else 'families were'} found, each by up to {REPRESENTATIVES} of them."
        if curves
        else "No step along a self-motion led on from them."
    )
    return Answer(points, completeness, reason, "self_motion", why, tuple(motion.q for motion in curves))


def _motion(arm: Arm, T: Vector, q: Vector) -> SelfMotion:
    """Return the self-motion through a solution: inside the limits, or all of it where no traced point is inside."""
    if arm.within_limits(q):
        return trace_self_motion(arm, q, T)
    motion = trace_self_motion(arm, q, T, limits=False)
    rows = wrapped_rows(arm, motion.q)
    inside = rows[~np.any(beyond_limits(arm, rows), axis=1)]
    return trace_self_motion(arm, inside[len(inside) // 2], T) if len(inside) else motion
