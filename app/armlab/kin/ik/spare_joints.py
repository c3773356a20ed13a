"""All solutions of arms with joints to spare: traced curves of solutions, or families of higher dimension."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.answer import BEYOND, SURFACE, Answer, in_order, is_beyond, verified_rows
from armlab.kin.ik.closed_form import known_structure
from armlab.kin.ik.dimension import local_dimension, null_dimension
from armlab.kin.ik.inside_limits import exact_inside
from armlab.kin.ik.many_starts import STARTS, many_starts
from armlab.kin.ik.method import methods
from armlab.kin.ik.search import Begin, inside_solutions
from armlab.kin.ik.self_motion import STEP, SelfMotion, distance_to, evenly, trace_self_motion
from armlab.kin.ik.solutions import Completeness, beyond_limits, wrapped_rows
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.ik.verified import distinct, reaches
from armlab.kin.transforms import inverse

Vector = NDArray[np.float64]

FAMILY_STARTS = 48
"""Number of starts of the search for the self-motions of a redundant arm; each gives a piece of a family."""

INSIDE_STARTS = 12
"""Least number of starts of a search inside the limits, when the search without them found too few there."""

FAMILIES = 4
"""Largest number of curves that are traced."""

POINTS = 400
"""Largest number of traced points of all curves: some 60 rad of travel, which take half of the time."""

PROBED = 3
"""Number of singular solutions whose dimension is examined, in families of more than one dimension."""

REPRESENTATIVES = 8
"""Number of representatives of each family, and least number that is looked for inside the limits."""

_SEARCHED = f"Searched from {FAMILY_STARTS + STARTS} random starts; a search cannot prove that there are no others."


def with_spare_joints(arm: Arm, T: Vector, seed: int) -> Answer:
    """Return the answer for an arm that has more joints than its task needs; T (4, 4) in the world."""
    why = known_structure(arm).why
    if is_beyond(arm, T):
        return Answer([], "none", BEYOND, "self_motion", why)
    spare = known_structure(arm).free
    found = _found(arm, T, seed, 1 if spare == 1 else REPRESENTATIVES)
    if not found:
        return Answer([], "at least", _SEARCHED, "self_motion", why)
    if spare == 1:
        return _of_curves(arm, T, found, why)
    return Answer(found[:SURFACE], *_of_surfaces(arm, T, found[:SURFACE]), "self_motion", why)


def _found(arm: Arm, T: Vector, seed: int, wanted: int) -> list[Vector]:
    """Return solutions, only those inside the limits if there are any; at least ``wanted`` of these are looked for."""
    G = np.asarray(inverse(arm.base) @ T, dtype=np.float64)
    found = verified_rows(arm, T, list(many_starts(arm, G, seed=seed, starts=FAMILY_STARTS, inside=True)))
    inside = [q for q in found if arm.within_limits(q)]
    if len(inside) < wanted:
        begin = Begin(arm, None, None, seed, max(INSIDE_STARTS, 2 * wanted))
        target = task_error_of(arm).target(T)
        more = inside_solutions(begin, target, methods()["dls"], wanted - len(inside))
        exact = [row for q in more if (row := exact_inside(arm, q, target)) is not None]
        inside = in_order(arm, distinct(arm, [*inside, *exact]))
    return inside or found or verified_rows(arm, T, list(many_starts(arm, G, seed=seed + 1)))


def _of_surfaces(arm: Arm, T: Vector, found: list[Vector]) -> tuple[Completeness, str]:
    """Return the completeness of the solutions around some, and a sentence on their dimension."""
    dimension = max(local_dimension(arm, q, T) for q in found[:FAMILIES])
    if dimension == 0:
        return "at least", "No small step leads on from them."
    return "infinite", f"{_stand(len(found))} for {_family(dimension)}."


def _stand(count: int) -> str:
    return "This one stands" if count == 1 else f"These {count} stand"


def _family(dimension: int) -> str:
    return "a curve of them" if dimension == 1 else f"a family of {dimension} dimensions"


def _of_curves(arm: Arm, T: Vector, found: list[Vector], why: str) -> Answer:
    """Trace the self-motions through solutions; points evenly along them represent all solutions."""
    motions, surface, dimension = _motions(arm, T, found)
    if any(arm.within_limits(q) for q in [*surface, *(motion.q[0] for motion in motions)]):
        motions = [motion for motion in motions if arm.within_limits(motion.q[0])]
        surface = [q for q in surface if arm.within_limits(q)]
    curves = [motion for motion in motions if len(motion.q) > 1]
    target = task_error_of(arm).target(T)
    along = [row for motion in motions for row in evenly(arm, motion, REPRESENTATIVES)]
    points = distinct(arm, [*(row for row in along if reaches(arm, row, target)), *surface[:SURFACE]])
    completeness: Completeness = "infinite" if curves or surface else "at least"
    reasons = []
    if surface:
        reasons.append(f"{_stand(min(SURFACE, len(surface)))} for {_family(dimension)}.")
    if curves:
        count = len(curves)
        several = f"{count} {'family was' if count == 1 else 'families were'} found"
        reasons.append(f"{several}, each by up to {REPRESENTATIVES} of them.")
    reason = " ".join(reasons) or "No step along a self-motion led on from them."
    families = tuple(motion.q for motion in curves)
    return Answer(in_order(arm, points), completeness, reason, "self_motion", why, families)


def _motions(arm: Arm, T: Vector, found: list[Vector]) -> tuple[list[SelfMotion], list[Vector], int]:
    """Return self-motions through solutions, those of families of more dimensions, and how many these have.

    A line in a family of more dimensions says little about it and may go on for ever: it is not traced.
    """
    motions: list[SelfMotion] = []
    surface: list[Vector] = []
    most, left = 1, POINTS
    for q in found:
        if len(motions) == FAMILIES or left < POINTS // 10:
            break
        if distance_to(arm, q, [motion.q for motion in motions]) <= 2.0 * STEP:
            continue
        if null_dimension(arm, q, T) > 1:
            # The first of the many singular solutions of a pose show the dimension of all.
            dimension = local_dimension(arm, q, T) if len(surface) < PROBED else most
            if dimension > 1:
                surface.append(q)
                most = max(most, dimension)
                continue
        motion = _motion(arm, T, q, left)
        motions.append(motion)
        left -= len(motion.q)
    return motions, surface, most


def _motion(arm: Arm, T: Vector, q: Vector, steps: int) -> SelfMotion:
    """Return the self-motion through a solution: inside the limits, or all of it when no traced point is inside."""
    if arm.within_limits(q):
        return trace_self_motion(arm, q, T, steps=steps)
    motion = trace_self_motion(arm, q, T, limits=False, steps=steps)
    rows = wrapped_rows(arm, motion.q)
    inside = rows[~np.any(beyond_limits(arm, rows), axis=1)]
    return trace_self_motion(arm, inside[len(inside) // 2], T, steps=steps) if len(inside) else motion
