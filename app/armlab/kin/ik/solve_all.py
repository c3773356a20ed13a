"""Every solution of the inverse kinematics, by the best way the arm's structure allows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.checks import whole_number
from armlab.kin.ik.answer import BEYOND, SURFACE, Answer, held_mask, in_order, is_beyond, verified_rows
from armlab.kin.ik.branches import branch_names
from armlab.kin.ik.closed_form import closed_form_of, known_structure
from armlab.kin.ik.general_6r import solve_general
from armlab.kin.ik.held import checked_held, with_held
from armlab.kin.ik.many_starts import STARTS, many_starts
from armlab.kin.ik.self_motion import trace_self_motion
from armlab.kin.ik.solutions import Completeness, IkSolutions, beyond_limits
from armlab.kin.ik.spare_joints import with_spare_joints
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.ik.verified import polished, reaches
from armlab.kin.transforms import as_pose, inverse

Vector = NDArray[np.float64]


def solve_all(arm: Arm, T: ArrayLike, *, seed: int = 0, held: Mapping[int, float] | None = None) -> IkSolutions:
    """Find all joint values that put the tool at a pose, as far as the arm's task goes.

    A closed form where the structure has one, elimination for other arms of six turns, the self-motion for arms with
    joints to spare, and a search from many starts for the rest. Each solution is verified by forward kinematics to
    1e-9 m and rad. Joint limits do not restrict the solutions of arms without spare joints; they are reported.

    Parameters
    ----------
    arm : Arm
    T : array_like, shape (4, 4)
        Wanted pose of the tool in the world. Components outside the task are ignored. Where its rotation is one only
        nearly (1e-6 is let through), the nearest rotation is meant.
    seed : int
        Of random starts, where they are used; the same call gives the same answer, bit by bit.
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
    return _finished(arm, answer)


def _solve(arm: Arm, T: Vector, seed: int) -> Answer:
    if closed_form_of(arm) is not None:
        answer = _by_closed_form(arm, T)
        if answer is not None:
            return answer
    if known_structure(arm).free:
        return with_spare_joints(arm, T, seed)
    if bool(arm.revolute.all()) and arm.n == 6 and arm.task.key == "pose":
        return _by_elimination(arm, T)
    return _by_search(arm, T, seed)


def _by_closed_form(arm: Arm, T: Vector) -> Answer | None:
    """Return what the closed form gives; None where it only sampled a family and no sample was a solution."""
    known = closed_form_of(arm)
    assert known is not None
    form, why = known
    G = np.asarray(inverse(arm.base) @ T, dtype=np.float64)
    found = form.solve(arm, G)
    q = verified_rows(arm, T, found.q)
    why = f"{form.title}: {why}"
    if q and found.families:
        return Answer(q, "infinite", " ".join(found.families), form.key, why)
    if q:
        return Answer(q, "complete", "", form.key, why)
    if found.sampled or (found.q and arm.n == 6):
        return None
    reason = found.none or "The target is off what the joints of this arm can do."
    return Answer([], "none", reason, form.key, why)


def _by_elimination(arm: Arm, T: Vector) -> Answer:
    found = solve_general(arm, T)
    why = f"General 6R: {known_structure(arm).why}"
    q = in_order(arm, found.q)
    completeness: Completeness = found.completeness
    if completeness == "complete" and not q:
        completeness = "none"
    return Answer(q, completeness, f"{found.reason[:1].upper()}{found.reason[1:]}.", "general_6r", why, found.families)


def _by_search(arm: Arm, T: Vector, seed: int, held: dict[int, float] | None = None) -> Answer:
    why = "No closed form is known here for this arm and task: a search from random starts."
    if is_beyond(arm, T):
        return Answer([], "none", BEYOND, "many_starts", why)
    G = np.asarray(inverse(arm.base) @ T, dtype=np.float64)
    q = verified_rows(arm, T, list(many_starts(arm, G, seed=seed, held=held)), held)
    if any(_moves(arm, row, T, held) for row in q):
        reason = "Some of them move while the tool stands still."
        return Answer(q[:SURFACE], "infinite", reason, "many_starts", why)
    reason = f"{'Found from' if q else 'Looked for from'} {STARTS} random starts; a search proves nothing."
    return Answer(q, "at least", reason, "many_starts", why)


def _moves(arm: Arm, q: Vector, T: Vector, held: dict[int, float] | None) -> bool:
    """Return whether a configuration without held joints is a point of a self-motion."""
    return not held and len(trace_self_motion(arm, q, T, limits=False, steps=4).q) > 3


def _with_held(arm: Arm, T: Vector, seed: int, held: dict[int, float]) -> Answer:
    """Solve for the joints that are not held."""
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
    q = [row for row in whole(answer.q) if polished(arm, row, target, held_mask(arm, held)) is not None]
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
        # Of some solutions nothing follows for the others.
        every = answer.completeness == "complete"
        limits = " None of them within the joint limits." if every else " None was found within the joint limits."
    return f"{head} {answer.reason}".strip() + limits


def _nearest_pose(T: Vector) -> Vector:
    U, _, V = np.linalg.svd(T[:3, :3])
    pose = T.copy()
    R = U @ V
    # What is a rotation up to rounding stays as it came.
    if float(np.abs(R - T[:3, :3]).max()) > 1e-14:
        pose[:3, :3] = R
    return pose
