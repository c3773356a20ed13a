"""All solutions of the inverse kinematics, by the best way that the arm's structure allows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.checks import whole_number
from armlab.kin.ik.amounts import missed_in_words
from armlab.kin.ik.answer import BEYOND, SURFACE, Answer, Verified, in_order, is_beyond, verified
from armlab.kin.ik.beside import beside
from armlab.kin.ik.branches import branch_names
from armlab.kin.ik.closed_form import SAMPLES, closed_form_of, known_structure
from armlab.kin.ik.general_6r import solve_general
from armlab.kin.ik.held import checked_held, with_held
from armlab.kin.ik.inside_limits import with_those_inside
from armlab.kin.ik.many_starts import STARTS, many_starts
from armlab.kin.ik.nearly_still import moved_on
from armlab.kin.ik.self_motion import trace_self_motion
from armlab.kin.ik.solutions import Completeness, IkSolutions, beyond_limits
from armlab.kin.ik.spare_joints import with_spare_joints
from armlab.kin.ik.turned_over import TURNED_OVER, is_turned_over
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.ik.verified import distinct, reaches
from armlab.kin.transforms import as_pose, inverse

Vector = NDArray[np.float64]

DESCENTS = 64
"""Number of descents that look for further solutions, for arms without an elimination."""

LOOSE = 1e-9
"""Error, in m and rad, above which a solution is one only within the tolerance of a reached target."""

OUT_OF_REACH = 1e-2
"""Largest error, in metres and radians, of the nearest configuration that is told in the sentence."""


def solve_all(arm: Arm, T: ArrayLike, *, seed: int = 0, held: Mapping[int, float] | None = None) -> IkSolutions:
    """Find all joint values that put the tool at a pose, as far as the arm's task goes.

    A closed form where the structure has one, elimination for other arms of six turns, the self-motion for arms with
    joints to spare, and a search from many starts for the rest. Each solution is polished until the error is rounding,
    and verified by forward kinematics; where the target is just out of reach, what comes within 1e-6 m and rad of it
    counts as reached, as in `solve`. Joint limits do not restrict the solutions of arms without spare joints; they are
    reported.

    Parameters
    ----------
    arm : Arm
    T : array_like, shape (4, 4)
        Wanted pose of the tool in the world. Components outside the task are ignored, except that with φ the tool
        must not be turned over. Where its rotation is one only nearly (entries with three decimals are enough), the
        nearest rotation is meant.
    seed : int
        Seed of random starts, if there are any; the same call gives the same answer, bit by bit.
    held : mapping, optional
        Joints (1-based) that are given, with their values in rad or m: the others are solved for.

    Returns
    -------
    IkSolutions

    Raises
    ------
    InputError
        ``T`` is no pose, the seed is no whole number, or a held joint or value is wrong.

    References
    ----------
    Notes, section 4.3.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)])
    >>> found = solve_all(arm, arm.fk([0.0, np.pi / 2]))
    >>> found.names, np.degrees(found.q).round(6).tolist()
    (('elbow down', 'elbow up'), [[0.0, 90.0], [90.0, -90.0]])
    """
    pose = _nearest_pose(as_pose(T, "T"))
    seed, fixed = whole_number(seed, "seed", 0), checked_held(arm, held)
    answer = _with_held(arm, pose, seed, fixed) if fixed else _solve(arm, pose, seed)
    if not answer.q and is_turned_over(arm, pose):
        answer = replace(answer, completeness="none", reason=f"{TURNED_OVER[:1].upper()}{TURNED_OVER[1:]}.")
    return _finished(arm, answer)


def _solve(arm: Arm, T: Vector, seed: int) -> Answer:
    return with_those_inside(arm, T, seed, _by_structure(arm, T, seed))


def _by_structure(arm: Arm, T: Vector, seed: int) -> Answer:
    if closed_form_of(arm) is not None:
        answer = _by_closed_form(arm, T, seed)
        if answer is not None:
            return answer
    if known_structure(arm).free:
        return with_spare_joints(arm, T, seed)
    if _is_general(arm):
        return _by_elimination(arm, T, f"General 6R: {known_structure(arm).why}")
    return _by_search(arm, T, seed)


def _is_general(arm: Arm) -> bool:
    """Return whether elimination can find all solutions of an arm."""
    return bool(arm.revolute.all()) and arm.n == 6 and arm.task.key == "pose"


def _by_closed_form(arm: Arm, T: Vector, seed: int) -> Answer | None:
    """Return what the closed form gives; None where it only sampled a family and no sample was a solution.

    Where branches merge, or nearly, rounding decides what its square roots give: there the others are asked as well.
    """
    known = closed_form_of(arm)
    assert known is not None
    form, why = known
    G = np.asarray(inverse(arm.base) @ T, dtype=np.float64)
    found = form.solve(arm, G)
    some = verified(arm, T, found.q)
    why = f"{form.title}: {why}"
    if some.rows and found.families and _is_family(arm, T, some.rows):
        return Answer(distinct(arm, some.rows), "infinite", " ".join(found.families), form.key, why)
    if some.singular and not some.dropped and not found.sampled:
        nearly = _nearly_still(arm, T, some.rows, form.key, why)
        if nearly is not None:
            return nearly
    # Values of a free joint that were tried and led to none, as for a nearly straight wrist, prove nothing.
    if some.doubtful or (some.rows and (found.families or found.sampled)):
        if _is_general(arm):
            return _by_elimination(
                arm, T, f"{why} Branches merge at this pose or nearly: solved as a general 6R.", some.rows
            )
        if some.rows:
            return _with_descents(arm, T, seed, some, form.key, why)
    if some.rows:
        return Answer(some.rows, "complete", "", form.key, why, (), some.loose, some.missed)
    if found.sampled:
        return None
    reason = found.none or "The joints of this arm cannot reach the target."
    answer = Answer([], "none", reason, form.key, why, missed=some.missed)
    if _is_general(arm):
        # Next to a singular pose a step of the closed form may leave the next without a solution.
        second = _by_elimination(arm, T, why)
        return replace(answer, missed=second.missed) if second.completeness == "none" else second
    return answer


def _is_family(arm: Arm, T: Vector, rows: Sequence[Vector]) -> bool:
    """Return whether samples of a family are more than its end, where the other joints just reach the target.

    Where two families cross, none of the samples may be on one alone, but then there are many.
    """
    return len(rows) >= SAMPLES or any(_moves(arm, row, T, None) for row in rows)


def _with_descents(arm: Arm, T: Vector, seed: int, some: Verified, key: str, why: str) -> Answer:
    """Return the solutions of a closed form at a singular pose, and those that descents find besides."""
    G = np.asarray(inverse(arm.base) @ T, dtype=np.float64)
    starts = [*beside(arm, some.rows, G), *many_starts(arm, G, seed=seed, starts=DESCENTS)]
    every = verified(arm, T, [*some.rows, *starts])
    if any(_moves(arm, row, T, None) for row in every.rows):
        reason = "Some of them move while the tool stands still."
        return Answer(every.rows[:SURFACE], "infinite", reason, key, why)
    nearly = _nearly_still(arm, T, every.rows, key, why)
    if nearly is not None:
        return nearly
    if len(every.rows) > len(some.rows):
        reason = "Branches merge at this pose, and descents found more than the closed form."
        return Answer(every.rows, "at least", reason, key, why, (), every.loose, every.missed)
    return Answer(some.rows, "complete", "", key, why, (), some.loose, some.missed)


def _nearly_still(arm: Arm, T: Vector, rows: list[Vector], key: str, why: str) -> Answer | None:
    """Return the solutions with those reached while the tool stands still, or nearly; None when none moves."""
    on: list[Vector] = []
    for row in rows:
        on += moved_on(arm, row, T) if len(on) < SAMPLES else []
    if not on:
        return None
    q = in_order(arm, distinct(arm, [*rows, *on])[: len(rows) + SAMPLES])
    loose, missed = _loose(arm, T, q)
    still = "stays within what counts as reached" if loose else "stands still"
    return Answer(q, "infinite", f"Some of them move while the tool {still}.", key, why, (), loose, missed)


def _by_elimination(arm: Arm, T: Vector, why: str, known: Sequence[Vector] = ()) -> Answer:
    found = solve_general(arm, T, known=known)
    q = in_order(arm, found.q)
    completeness: Completeness = found.completeness
    if completeness == "complete" and not q:
        completeness = "none"
    if completeness == "infinite":
        q = distinct(arm, q)
    loose, missed = _loose(arm, T, q)
    reason = f"{found.reason[:1].upper()}{found.reason[1:]}."
    return Answer(q, completeness, reason, "general_6r", why, found.families, loose, missed or found.missed)


def _loose(arm: Arm, T: Vector, q: Sequence[Vector]) -> tuple[int, tuple[float, float] | None]:
    """Return the number of solutions that are such only within tolerance, and their largest errors in m and rad."""
    target = task_error_of(arm).target(T)
    errors = [task_error_of(arm).at(row.tolist(), target)[2] for row in q]
    loose = [one for one in errors if one.position > LOOSE * max(1.0, arm.length_scale) or one.rotation > LOOSE]
    if not loose:
        return 0, None
    return len(loose), (max(one.position for one in loose), max(one.rotation for one in loose))


def _by_search(arm: Arm, T: Vector, seed: int, held: dict[int, float] | None = None) -> Answer:
    why = "No closed form is known here for this arm and task: a search from random starts."
    if is_beyond(arm, T):
        return Answer([], "none", BEYOND, "many_starts", why)
    G = np.asarray(inverse(arm.base) @ T, dtype=np.float64)
    some = verified(arm, T, list(many_starts(arm, G, seed=seed, held=held)), held)
    q = some.rows
    if any(_moves(arm, row, T, held) for row in q):
        reason = "Some of them move while the tool stands still."
        return Answer(q[:SURFACE], "infinite", reason, "many_starts", why)
    reason = (
        f"{'Found from' if q else 'Searched from'} {STARTS} random starts; a search cannot prove that there are no "
        "others."
    )
    return Answer(q, "at least", reason, "many_starts", why, (), some.loose, some.missed)


def _moves(arm: Arm, q: Vector, T: Vector, held: dict[int, float] | None) -> bool:
    """Return whether a configuration without held joints is a point of a self-motion."""
    return not held and len(trace_self_motion(arm, q, T, limits=False, steps=4).q) > 3


def _with_held(arm: Arm, T: Vector, seed: int, held: dict[int, float]) -> Answer:
    """Return the answer for the joints that are not held."""
    values = np.array([held.get(i, 0.0) for i in range(arm.n)])
    listed = " and ".join(f"q{i + 1}" for i in sorted(held))
    if len(held) == arm.n:
        reached = reaches(arm, values, task_error_of(arm).target(T))
        why = "All joints are held."
        reason = "" if reached else "All joints are held, and the tool is elsewhere."
        return Answer([values] if reached else [], "complete" if reached else "none", reason, "held", why)
    rest = with_held(arm, held)
    if rest is None:
        return _by_search(arm, T, seed, held)
    answer = _solve(rest, T, seed)
    kept = [i for i in range(arm.n) if i not in held]

    def whole(rows: Sequence[Vector] | Vector) -> list[Vector]:
        found = []
        for row in rows:
            q = values.copy()
            q[kept] = row
            found.append(q)
        return found

    families = tuple(np.array(whole(curve)) for curve in answer.families)
    why = f"With {listed} held, {answer.why[:1].lower()}{answer.why[1:]}"
    target = task_error_of(arm).target(T)
    q = [row for row in whole(answer.q) if reaches(arm, row, target)]
    return replace(answer, q=q, why=why, families=families)


def _finished(arm: Arm, answer: Answer) -> IkSolutions:
    q = np.array(answer.q).reshape(-1, arm.n)
    beyond = beyond_limits(arm, q)
    within = ~np.any(beyond, axis=1)
    return IkSolutions(
        arm=arm,
        q=q,
        names=branch_names(arm, q),
        within_limits=within,
        beyond=beyond,
        completeness=answer.completeness,
        sentence=_sentence(answer, int(within.sum())),
        method=answer.method,
        why=answer.why,
        families=answer.families,
    )


def _sentence(answer: Answer, inside: int) -> str:
    k = len(answer.q)
    if answer.completeness == "none":
        head = "No solution."
    elif answer.completeness == "infinite":
        head = f"Infinitely many solutions, here {k} of them."
    elif answer.completeness == "at least":
        head = f"At least {k} solution{'' if k == 1 else 's'}." if k else "None found."
    else:
        head = f"{k} solution{'' if k == 1 else 's'}, and no others."
    limits = f" {inside} of them within the joint limits." if 0 < inside < k else ""
    if k and not inside:
        # Some of the solutions prove nothing on the others.
        every = answer.completeness == "complete"
        limits = " None of them within the joint limits." if every else " None was found within the joint limits."
    return " ".join(part for part in (head, answer.reason, _distance(answer)) if part) + limits


def _distance(answer: Answer) -> str:
    """Return a sentence on the distance of the nearest configurations from the target."""
    if answer.missed is None or (answer.q and not answer.loose):
        return ""
    by = missed_in_words(*answer.missed)
    if answer.q and not by:
        return ""
    if answer.q:
        some = f"{answer.loose} of them come{'s' if answer.loose == 1 else ''}"
        who = "It comes" if len(answer.q) == 1 else "They come" if answer.loose == len(answer.q) else some
        return f"{who} within {by} of the target, which counts as reached."
    if max(answer.missed) > OUT_OF_REACH or answer.completeness != "none":
        return ""
    return f"It is {by} out of reach."


def _nearest_pose(T: Vector) -> Vector:
    U, _, V = np.linalg.svd(T[:3, :3])
    pose = T.copy()
    R = U @ V
    # A rotation up to rounding is not changed.
    if float(np.abs(R - T[:3, :3]).max()) > 1e-14:
        pose[:3, :3] = R
    return pose
