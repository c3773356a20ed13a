"""The proof by brute force: descents from thousands of random starts, which find what the list has, or more."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from armlab.benches.target.solutions.question import Question
from armlab.kin.arm import Arm
from armlab.kin.ik.loop import wrapped
from armlab.kin.ik.many_starts import many_starts
from armlab.kin.ik.self_motion import distance_to
from armlab.kin.ik.solutions import IkSolutions
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.ik.verified import solution
from armlab.kin.transforms import inverse
from armlab.session.way_to_solution import ON_CURVE, gap

Vector = NDArray[np.float64]

STARTS = 4096
PIECE = 64
"""Number of random starts in all, and in one piece of work."""

SAME = 1e-3
"""Distance, radians or length scales, below which the end of a descent is a solution of the list. A descent to a
solution in which two are about to meet stops so far from it."""

MOST = 64
"""Number of other solutions that are kept; if there are more, there are infinitely many."""


@dataclass(frozen=True, eq=False)
class Proof:
    """Results of the random starts so far.

    Attributes
    ----------
    question : Question
    solutions : IkSolutions
        The list to be proved.
    starts, reached : int
        Descents made, and how many of them ended in a solution.
    known : frozenset of int
        Which solutions of the list were met, or which of its families.
    others : tuple of ndarray, shape (n,)
        Solutions that are not in the list.
    """

    question: Question
    solutions: IkSolutions
    starts: int = 0
    reached: int = 0
    known: frozenset[int] = frozenset()
    others: tuple[Vector, ...] = field(default=(), repr=False)

    @property
    def done(self) -> bool:
        """Whether all starts were made."""
        return self.starts >= STARTS

    @property
    def of_families(self) -> bool:
        """Whether the proof is about curves of solutions rather than single ones."""
        return bool(self.solutions.families)

    @property
    def sentence(self) -> str:
        """The conclusion of the proof."""
        inside = " inside the limits" if self.of_families else ""
        said = f"{self.starts} starts, {self.reached} reached the target{inside}: "
        if not self.reached:
            return said + "no solution."
        one = len(self.others) == 1
        more = f"{'more than ' if len(self.others) >= MOST else ''}{len(self.others)} {'other' if one else 'others'}"
        if not self.of_families and self.solutions.completeness == "infinite":
            if not self.others:
                return said + "no other than those in the list."
            found = f"{more} found that {'is' if one else 'are'} not in the list"
            return said + f"{found}, as expected where there are infinitely many."
        count = len(self.solutions.families) if self.of_families else len(self.solutions)
        kind = ("family", "families") if self.of_families else ("solution", "solutions")
        same = (
            f"the same {count} {kind[count != 1]}" if len(self.known) == count else f"{len(self.known)} of the {count}"
        )
        if self.others:
            return said + f"{same}, and {more} not in the list."
        return said + f"{same}, no other."


def proved(proof: Proof) -> Iterator[Proof]:
    """Yield the proof as it grows, a piece of work at a time."""
    question = proof.question
    arm = question.arm
    G = np.asarray(inverse(arm.base) @ question.pose, dtype=np.float64)
    held = {joint - 1: value for joint, value in question.held.items()} or None
    for piece in range(STARTS // PIECE):
        arrived = many_starts(arm, G, seed=piece + 1, starts=PIECE, held=held)
        proof = _with_piece(proof, arrived)
        yield proof


def _with_piece(proof: Proof, arrived: Vector) -> Proof:
    if proof.of_families:
        arrived = _inside(proof.question.arm, arrived)
    reached, known, others = 0, set(proof.known), list(proof.others)
    arm, infinite = proof.question.arm, proof.solutions.completeness == "infinite"
    target = task_error_of(arm).target(proof.question.pose)
    held = np.array([i + 1 in proof.question.held for i in range(arm.n)])
    for q in arrived:
        k = _place(proof, q)
        if k is None and not (infinite and len(others) >= MOST):
            exact = solution(arm, q, target, held if held.any() else None)
            if exact is None:
                continue
            k = _place(proof, exact)
            if k is None and all(float(np.abs(gap(arm, exact, other)).max()) > SAME for other in others):
                others.append(exact)
        reached += 1
        if k is not None:
            known.add(k)
    return replace(
        proof,
        starts=proof.starts + PIECE,
        reached=proof.reached + reached,
        known=frozenset(known),
        others=tuple(others[:MOST]),
    )


def _inside(arm: Arm, arrived: Vector) -> Vector:
    """Return the configurations inside the limits, with whole turns added."""
    near = np.zeros(arm.n)
    placed = [wrapped(q.tolist(), near, arm.revolute, arm.limits) for q in arrived]
    return np.array([q for q in placed if arm.within_limits(q)]).reshape(-1, arm.n)


def _place(proof: Proof, q: Vector) -> int | None:
    """Return the index of the solution or family of the list to which a configuration belongs."""
    arm = proof.question.arm
    if proof.of_families:
        far = [distance_to(arm, q, [curve]) for curve in proof.solutions.families]
        return int(np.argmin(far)) if min(far) < ON_CURVE else None
    if not len(proof.solutions):
        return None
    apart = np.abs(gap(arm, proof.solutions.q, q)).max(axis=1)
    return int(np.argmin(apart)) if float(apart.min()) < SAME else None
