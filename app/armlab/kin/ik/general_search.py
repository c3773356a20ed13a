"""The search for all solutions of an arm with six revolute joints: eliminations, descents, and the number of roots.

A formulation is a cyclic shift of the loop (6) and a hidden joint (3). On general arms all 18 work. On special ones
(parallel, crossing or meeting axes) roots share eigenvalues, whose eigenvectors mix, and most formulations are
singular; a pose can be special, too. Both end when every motion of the loop is moved a little at random: the roots
part, the matrices become regular, the candidates are off by about the size of the move over their distance, and
Newton's method on the loop itself removes that. Too small a move leaves roots together, too large a one takes nearly
double ones away, so sizes differ from pass to pass.

How many roots an arm has, complex ones included, is counted at random poses: 16 for general arms, 8 for most that
people build. A pose at which as many regular ones are found is done with (see `general_complex`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.general_complex import OUTERMOST, Roots, distinct, joined, newton
from armlab.kin.ik.general_equations import all_angles, equations
from armlab.kin.ik.general_family import rank_losses
from armlab.kin.ik.general_loop import JOINTS, Complex, Floats, Loop, inverses, turns
from armlab.kin.ik.general_merge import wrapped
from armlab.kin.ik.general_polish import polish
from armlab.kin.ik.general_roots import leading, matrices, roots
from armlab.kin.rotations import rotation_from_axis_angle
from armlab.kin.transforms import transform

SEED = 6
"""Seed of the random moves and poses: the same arm and pose give the same answer, bit by bit."""

RANKED_ON = 6
"""Number of random poses on which formulations are ranked."""

STARTS, STEPS_OF_DESCENT, PATIENCE_OF_DESCENT = 96, 40, 15
"""Starts, steps and patience of the search by descents, for singular arms and poses."""

NOTHING, NEARLY_NOTHING = 1e-12, 2e-2
"""Sizes, in radians and units of length: below the first a value is rounding, below the second the arm is nearly
special."""


class Pass(NamedTuple):
    """One elimination: the size of the moves, and the rank of the formulation."""

    size: float
    rank: int


PASSES = (Pass(1e-8, 0), Pass(1e-6, 0), Pass(1e-8, 1), Pass(1e-11, 0))
"""Eliminations that are done in turn until all roots are found."""

ELSEWHERE = 1e-2
"""Distance in some joint, in radians, from which a solution found by a descent is another than a root."""

MOST = 16
"""Largest number of roots of an arm with six revolute joints."""

BORDERS = (OUTERMOST, 9.0, 6.0, 4.0)
"""Bounds of the imaginary part up to which roots are counted; the first at which most random poses agree is used.
Nearly special arms have roots near infinity, which rounding hides at some poses."""


@dataclass(frozen=True, eq=False)
class Search:
    """The part of a search that does not depend on the pose.

    Attributes
    ----------
    loop : Loop
    formulations : tuple of (shift, hidden)
        Best first; none for a deficient arm.
    moves : ndarray, shape (passes, 6, 4, 4)
        Small random motions.
    starts : ndarray, shape (starts, 6)
        Random configurations to search from where roots have merged or are members of a family.
    deficient : bool
        Whether the Jacobian is singular everywhere: the arm has fewer than six freedoms. It reaches every pose in its
        workspace in infinitely many ways; and the least move of a link makes it impossible, so that elimination finds
        nothing.
    counts : tuple of (float, int)
        How many regular roots the arm has at most random poses, complex ones counted, up to imaginary parts; the
        largest border first. Empty where random poses do not agree.
    nearly_special : bool
        Whether a length or an angle of the arm nearly vanishes while it has fewer than sixteen roots: the others are
        nearly at infinity, and at special poses they come back.
    """

    loop: Loop
    formulations: tuple[tuple[int, int], ...]
    moves: Floats
    starts: Floats
    deficient: bool
    counts: tuple[tuple[float, int], ...] = ()
    nearly_special: bool = False

    @classmethod
    def of(cls, arm: Arm) -> Search:
        """Rank the formulations of an arm and count its roots, in some ten milliseconds."""
        loop, rng = Loop.of(arm), np.random.default_rng(SEED)
        moves = np.array([[small_motion(rng, one.size) for _ in range(JOINTS)] for one in PASSES])
        starts = rng.uniform(-np.pi, np.pi, (STARTS, JOINTS))
        some = starts[:RANKED_ON]
        if rank_losses(loop.links, some, np.eye(4)).all():
            return cls(loop, (), moves, starts, True)
        hands = forward(loop, some)
        search = cls(loop, _ranking(loop, hands, moves[0]), moves, starts, False)
        counts, nearly = _counted(search, hands), _has_nearly_zero(loop.links)
        nearly = nearly and any(number < MOST for _, number in counts)
        # For other arms roots with large imaginary parts are no farther than the rest, and all of them count.
        return replace(search, counts=counts if nearly else counts[:1], nearly_special=nearly)

    @property
    def number(self) -> int:
        """Number of regular roots of the arm at a random pose; 0 when it is not known."""
        return self.counts[0][1] if self.counts else 0

    def candidates(self, hands: Floats, number: int) -> tuple[NDArray[np.intp], Complex]:
        """Return the candidates of one pass for N targets (N, 4, 4): index of the target (m,), and angles (m, 6)."""
        motions = motions_of(self.loop, hands) @ self.moves[number]
        return candidates_of(motions, self.formulations[PASSES[number].rank])

    def roots(self, hands: Floats, number: int) -> list[Roots]:
        """Return the roots of one pass for each of N targets (N, 4, 4)."""
        owner, q = self.candidates(hands, number)
        q, sizes, norms = newton(self.loop.links, q, hands[owner])
        rows = [np.flatnonzero(owner == k) for k in range(len(hands))]
        return [distinct(q[k], sizes[k], norms[k]) for k in rows]

    def is_whole(self, roots: Roots) -> bool:
        """Return whether there are as many regular roots as the arm has; more would mean that the number is wrong."""
        return any(roots.counted(border) == number for border, number in self.counts)

    def finds_others(self, hand: Floats, roots: Roots) -> bool:
        """Return whether descents lead to a solution that is none of the roots.

        At a singular pose of a nearly special arm, roots that came back from infinity may stand in the count for
        others that have nearly merged.
        """
        found, listed = self.descents(hand), roots.q[roots.real].real
        if not len(found) or not len(listed):
            return len(found) > 0
        return bool((np.abs(wrapped(found[:, None] - listed)).max(axis=2).min(axis=1) > ELSEWHERE).any())

    def descents(self, hand: Floats) -> Floats:
        """Return the results of Newton's method from random starts, shape (m, 6)."""
        hands = np.broadcast_to(hand, (STARTS, 4, 4))
        q, sizes = polish(self.loop.links, self.starts, hands, STEPS_OF_DESCENT, PATIENCE_OF_DESCENT)
        return q[sizes < self.loop.reached]


def forward(loop: Loop, q: Floats) -> Floats:
    """Return the ends of the chain of a loop at angles (k, 6), shape (k, 4, 4)."""
    hands = np.tile(np.eye(4), (len(q), 1, 1))
    for i in range(JOINTS - 1):
        hands = hands @ turns(q[:, i]) @ loop.links[i]
    return np.asarray(hands @ turns(q[:, JOINTS - 1]))


def motions_of(loop: Loop, hands: Floats) -> Floats:
    """Return the motions between the joints of the closed loop, shape (N, 6, 4, 4)."""
    motions = np.empty((len(hands), JOINTS, 4, 4))
    motions[:, :5] = loop.links
    motions[:, 5] = inverses(hands)
    return motions


def candidates_of(motions: Floats, formulation: tuple[int, int]) -> tuple[NDArray[np.intp], Complex]:
    """Return the candidates of one formulation, complex ones too: which loop (m,), and all angles (m, 6).

    There are none where the elimination is exactly singular.
    """
    shift, hidden = formulation
    shifted = np.roll(motions, -shift, axis=1)
    found = equations(shifted)
    try:
        owner, middle = roots(found.middle, hidden)
    except np.linalg.LinAlgError:
        return np.empty(0, dtype=np.intp), np.empty((0, JOINTS), dtype=np.complex128)
    with np.errstate(all="ignore"):  # what spurious roots lead to is anything
        return owner, np.roll(all_angles(shifted, found, owner, middle), shift, axis=1)


def small_motion(rng: np.random.Generator, size: float) -> Floats:
    """Return a random rigid motion with an angle (rad) and a displacement of about ``size``."""
    turn, way = rng.normal(size=(2, 3)) * size
    return np.asarray(transform(rotation_from_axis_angle(turn, np.linalg.norm(turn)), way), dtype=np.float64)


def _ranking(loop: Loop, hands: Floats, moves: Floats) -> tuple[tuple[int, int], ...]:
    """Return the formulations, most regular first, by the median over some targets of a slightly moved loop."""
    motions = motions_of(loop, hands) @ moves
    scores = {}
    for shift in range(JOINTS):
        found = equations(np.roll(motions, -shift, axis=1))
        # Blocks that are nearly singular spoil what follows; a tenth is good enough.
        blocks = np.log(np.minimum(1.0, 10.0 * found.evenness) + 1e-300)
        for hidden in range(3):
            regularity = leading(matrices(found.middle, hidden))[2]
            scores[shift, hidden] = float(np.median(np.log(regularity + 1e-300) + blocks))
    return tuple(sorted(scores, key=lambda formulation: -scores[formulation]))


def _has_nearly_zero(links: Floats) -> bool:
    """Return whether an entry of the constant motions (length, sine, cosine) is nearly but not exactly zero."""
    sizes = np.abs(links[:, :3])
    return bool(((sizes > NOTHING) & (sizes < NEARLY_NOTHING)).any())


def _counted(search: Search, hands: Floats) -> tuple[tuple[float, int], ...]:
    """Return the bounds up to which most of some targets have the same number of roots, and these numbers."""
    found = search.roots(hands, 0)
    for number in range(1, len(PASSES)):
        counts = [roots.counted(OUTERMOST) for roots in found]
        if min(counts) == max(counts):
            break
        found = [joined(*two) for two in zip(found, search.roots(hands, number), strict=True)]
    agreed = []
    for border in BORDERS:
        counts = [roots.counted(border) for roots in found]
        most = max(counts)
        # No arm has more than sixteen, and none more at special poses than at random ones.
        if most == MOST or (most > 0 and 2 * counts.count(most) > len(counts)):
            agreed.append((border, most))
    return tuple(agreed)
