"""All solutions of the inverse kinematics of any arm with six revolute joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.checks import wrong
from armlab.kin.ik.general_complex import NO_ROOTS, Roots, joined
from armlab.kin.ik.general_family import Split, split
from armlab.kin.ik.general_loop import Floats, Loop, orthonormal, principal
from armlab.kin.ik.general_near import nearly
from armlab.kin.ik.general_search import PASSES, STARTS, Search
from armlab.kin.ik.general_special import resolve
from armlab.kin.ik.problem import REACHED_M
from armlab.kin.transforms import as_pose

Completeness = Literal["complete", "infinite", "at least"]

TOLERANCE = REACHED_M
"""Tolerance, in metres and radians, within which a pose is reached. Solutions are polished to rounding; only where two
branches would merge just beyond the pose, the configuration between them is no better than this."""

STILL = 1e-9
"""Largest motion of the tool along a family for which it is said to stand still: metres (units of length for large
arms) and radians."""

ROUNDING = 1e-14
"""Rounding error, relative to the distance of the target: no configuration comes nearer."""


@dataclass(frozen=True, eq=False)
class GeneralSolutions:
    """All solutions for one pose, joint limits ignored.

    Attributes
    ----------
    q : ndarray, shape (k, 6)
        Solutions in (-pi, pi], sorted by joint 1, then 2 and so on, each rounded to 1e-6; of families only
        representatives.
    completeness : str
        ``"complete"``: these are all; ``"infinite"``: there are families of solutions besides the isolated ones;
        ``"at least"``: these are solutions, but not all roots of the equations could be accounted for.
    singular : ndarray of bool, shape (k,)
        Solutions with a singular Jacobian: branches merge there, or it is a member of a family.
    families : tuple of ndarray, shape (s, 6)
        Points along each curve of solutions, in order; angles go on over half a turn.
    position_error, rotation_error : ndarray, shape (k,)
        Errors of the arm's own forward kinematics, in m and rad.
    reason : str
        Sentence on how that is known.
    passes : int
        Number of eliminations at the pose itself.
    missed : tuple of float, or None
        Errors of the best configuration, in m and rad: rounding when there are solutions, the remaining distance when
        one nearly reaches the pose, None when nothing came near.
    """

    q: Floats
    completeness: Completeness
    singular: NDArray[np.bool_]
    families: tuple[Floats, ...]
    position_error: Floats
    rotation_error: Floats
    reason: str
    passes: int
    missed: tuple[float, float] | None = None

    def __len__(self) -> int:
        return len(self.q)


@lru_cache(maxsize=64)
def search_of(arm: Arm) -> Search:
    """Return the prepared search of an arm (arms are compared by identity)."""
    return Search.of(arm)


def solve_general(
    arm: Arm, T: ArrayLike, *, tolerance: float = TOLERANCE, known: Sequence[ArrayLike] = ()
) -> GeneralSolutions:
    """Find all configurations that put the tool of a 6R arm at a pose, joint limits ignored.

    Parameters
    ----------
    arm : Arm
        Six revolute joints, of any geometry.
    T : array_like, shape (4, 4)
        Wanted pose of the tool in the world, all of it, whatever the arm's task. Where its rotation is one only nearly
        (entries with three decimals are enough), the nearest rotation is meant.
    tolerance : float
        Metres and radians within which a configuration is a solution.
    known : sequence of array_like, each of shape (6,)
        Solutions that others found: where branches merge a start beside them may not lead to them.

    Returns
    -------
    GeneralSolutions
        The same call gives the same answer, bit by bit.

    Raises
    ------
    InputError
        The arm is no 6R, ``T`` is no pose, or the tolerance is not positive.

    References
    ----------
    Raghavan and Roth 1990; Manocha and Canny 1994; notes, section 4.3 (at most 16 solutions). See `general_equations`
    for the derivation, `general_search` for what makes it work on special arms, `general_complex` and
    `general_special` for why the list is complete.

    Examples
    --------
    >>> half = np.pi / 2
    >>> table = [(0.3, half, 0), (1, 0, 0), (0, half, 0.2), (1.5, 0, 0), (0, half, 0), (0, 0, 0)]
    >>> arm = Arm.from_dh([("R", a, alpha, d, 0.0) for a, alpha, d in table])
    >>> found = solve_general(arm, arm.fk([0.0, 1.875488980810294, 1.962805312, -0.1337315894, 0.0, 0.0]))
    >>> len(found), found.completeness
    (16, 'complete')
    """
    return _solved(arm, [as_pose(T, "T")], tolerance, np.array(known, dtype=np.float64).reshape(-1, 6))[0]


def solve_general_batch(
    arm: Arm, poses: Sequence[ArrayLike], *, tolerance: float = TOLERANCE
) -> list[GeneralSolutions]:
    """Solve many poses of one arm as `solve_general` does, in less than half the time each.

    Rounding depends on the size of a batch: results equal those of single calls only to about 1e-12.

    Parameters
    ----------
    arm : Arm
    poses : sequence of array_like, each of shape (4, 4)
    tolerance : float

    Raises
    ------
    InputError
        As `solve_general`; the text says which pose.
    """
    if not isinstance(poses, (Sequence, np.ndarray)) or isinstance(poses, str):
        raise wrong("poses", "a list of 4 x 4 matrices", poses)
    single = len(poses) == 1
    checked = [as_pose(T, "T" if single else f"pose {k + 1}") for k, T in enumerate(poses)]
    return _solved(arm, checked, tolerance, np.empty((0, 6)))


def _solved(arm: Arm, checked: list[Floats], tolerance: float, known: Floats) -> list[GeneralSolutions]:
    """Return the solutions for checked poses; ``known`` are solutions of all of them."""
    if not isinstance(tolerance, (int, float)) or not 0.0 < tolerance < np.inf:
        raise wrong("tolerance", "a positive number of metres and radians", tolerance)
    search = search_of(arm)
    if not checked:
        return []
    wanted = orthonormal(np.array(checked))
    hands = search.loop.hands(wanted)
    within = np.flatnonzero(
        np.linalg.norm(hands[:, :3, 3], axis=1) <= search.loop.reach + tolerance / search.loop.scale
    )
    results = [_beyond(search.loop)] * len(checked)
    if len(within):
        firsts = [NO_ROOTS] * len(within) if search.deficient else search.roots(hands[within], 0)
        for k, first in zip(within, firsts, strict=True):
            results[k] = _solve(arm, search, wanted[k], hands[k], first, tolerance, known + search.loop.offsets)
    return results


def _solve(
    arm: Arm, search: Search, T: Floats, hand: Floats, roots: Roots, tolerance: float, known: Floats
) -> GeneralSolutions:
    """Continue until all roots are accounted for; then verify and sort them."""
    links, passes = search.loop.links, 0 if search.deficient else 1
    # Roots of a nearly special arm may have come back from infinity: a second pass looks for them.
    least = 2 if search.nearly_special else 1
    while 0 < passes < len(PASSES) and (passes < least or not search.is_whole(roots)):
        roots = joined(roots, search.roots(hand[None], passes)[0])
        passes += 1
    whole = search.is_whole(roots)
    if whole and search.nearly_special:
        whole = not roots.merging and not search.finds_others(hand, roots)
    if whole:
        found, complete = roots.q[roots.real].real, True
    else:
        found, parts, roots, complete = resolve(search, hand, roots, known)
    exact, beside = len(found), nearly(links, roots, known, found, hand)
    if whole or (len(beside) and not parts.freedom):
        # Roots that are all regular leave no room for a family, but for one that stands still only nearly.
        found, beside = np.concatenate([found, beside]), beside[:0]
        parts = split(links, found, hand, search.loop.allowed)
    isolated = np.flatnonzero(parts.isolated)
    q = principal(np.concatenate([found[isolated], parts.members, beside]) - search.loop.offsets)
    folds = parts.singular[isolated] & (isolated < exact)
    singular = np.ones(len(q), dtype=bool)
    singular[: len(isolated)] = folds | (isolated >= exact)
    position, rotation = _errors(arm, q, T)
    close = (position <= max(tolerance, ROUNDING * float(np.linalg.norm(T[:3, 3])))) & (rotation <= tolerance)
    kept = np.flatnonzero(close)
    kept = kept[np.lexsort(np.round(q[kept], 6).T[::-1])]
    completeness: Completeness = "infinite" if parts.freedom else "complete" if complete else "at least"
    members = slice(len(isolated), len(isolated) + len(parts.members))
    alone = int(close.sum()) - int(close[members].sum())
    still = float(np.maximum(position / max(1.0, search.loop.scale), rotation)[members].max(initial=0.0)) <= STILL
    return GeneralSolutions(
        q=q[kept],
        completeness=completeness,
        singular=singular[kept],
        families=tuple(curve - search.loop.offsets for curve in parts.curves),
        position_error=position[kept],
        rotation_error=rotation[kept],
        reason=_reason(search, completeness, alone, int(folds.sum()), parts, still),
        passes=passes,
        missed=_missed(position, rotation),
    )


def _missed(position: Floats, rotation: Floats) -> tuple[float, float] | None:
    """Return the errors in m and rad of the best of some configurations; None when there are none."""
    if not len(position):
        return None
    best = int(np.argmin(position + rotation))
    return float(position[best]), float(rotation[best])


def _errors(arm: Arm, q: Floats, T: Floats) -> tuple[Floats, Floats]:
    """Return the errors of the arm's own forward kinematics in m and rad, shape (k,) each."""
    # One by one is faster than a batch as small as this.
    tool = np.array([arm.fk(one) for one in q]).reshape(-1, 4, 4)
    position = np.linalg.norm(tool[:, :3, 3] - T[:3, 3], axis=1)
    # |R - R'| = 2 sqrt(2) sin(theta / 2) in the Frobenius norm.
    chord = np.linalg.norm((tool - T)[:, :3, :3], axis=(1, 2)) / np.sqrt(8.0)
    return np.asarray(position), np.asarray(2.0 * np.arcsin(np.minimum(chord, 1.0)))


def _beyond(loop: Loop) -> GeneralSolutions:
    none = np.empty(0)
    return GeneralSolutions(
        q=np.empty((0, 6)),
        completeness="complete",
        singular=np.zeros(0, dtype=bool),
        families=(),
        position_error=none,
        rotation_error=none,
        reason=f"the wrist would be farther from joint 1 than all links in a line, {loop.reach * loop.scale:.3f} m",
        passes=0,
    )


def _reason(search: Search, completeness: Completeness, isolated: int, folds: int, parts: Split, still: bool) -> str:
    if completeness == "infinite":
        curves = len(parts.curves)
        families = f"{curves} curves" if curves > 1 else "a curve" if curves else f"{parts.freedom}-parameter families"
        also = f", and {isolated} isolated solution{'' if isolated == 1 else 's'}" if isolated else ""
        if not still:
            moving = "configurations whose joints move while the tool stays within what counts as reached"
            return f"{families} of {moving}{also}"
        return f"{families} of singular configurations whose joints move while the tool stands still{also}"
    if completeness == "at least":
        if search.deficient:
            return f"searched from {STARTS} random starts, which proves nothing"
        return "not all roots of the equations of this arm could be told apart at this pose"
    if isolated == 0:
        return f"none of the {_number(search)} roots is real"
    merge = f"; {folds} of them singular, where branches merge" if folds else ""
    return f"all {_number(search)} roots of the arm are accounted for{merge}"


def _number(search: Search) -> str:
    """Return the number of roots of an arm in words; of nearly special arms some lie near infinity."""
    least = min(number for _, number in search.counts)
    return f"{least}" if least == search.number else f"{least} to {search.number}"
