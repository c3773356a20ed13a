"""Passes of elimination and polishing until they agree.

A formulation is a cyclic shift of the loop (6) and a hidden joint (3). On general arms all 18 work. On special ones
(parallel, crossing or meeting axes) roots share eigenvalues, whose eigenvectors mix, and most formulations are
singular; a pose can be special, too. Both end when every motion of the loop is moved a little at random: the roots
part, the matrices become regular, the candidates are off by about the size of the move over their distance, and
Newton's method on the loop itself removes that. Too small a move leaves roots together, too large a one takes nearly
double ones away, so sizes differ from pass to pass. A pass costs about half a millisecond, so the first two are made
at once.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik import general_polish as newton
from armlab.kin.ik.general_equations import all_angles, equations
from armlab.kin.ik.general_family import rank_losses
from armlab.kin.ik.general_loop import JOINTS, Floats, Loop, inverses, turns
from armlab.kin.ik.general_roots import leading, matrices, roots, unrest
from armlab.kin.rotations import rotation_from_axis_angle
from armlab.kin.transforms import transform

SEED = 6
"""Of the moves and of the poses formulations are ranked on: the same arm and pose give the same answer, bit by bit."""

RANKED_ON = 6
"""Random poses formulations are ranked on."""

STARTS, STEPS_OF_DESCENT, PATIENCE_OF_DESCENT = 96, 40, 15
"""Of the search by descents, for arms and poses that are singular."""

SAME, SAME_SINGULAR = 1e-5, 1e-2
"""Solutions closer than this, in radians in all joints together, are one. An error e of the pose is one of e^(1/k) of
the angles where k solutions merge, so singular ones scatter."""

RESTLESS = 1e-3
"""Roots that differ by more between the first two passes show a family; at regular poses they differ by less than
1e-4."""

ACCEPTED = 1e-9
"""Error of a solution in radians and units of length."""


class Pass(NamedTuple):
    """One elimination: how large the moves are, and the formulation by its rank."""

    size: float
    rank: int


STAGES = (
    (Pass(1e-8, 0), Pass(1e-6, 0)),
    (Pass(1e-5, 0), Pass(1e-7, 0)),
    (Pass(1e-4, 0), Pass(1e-6, 1)),
    (Pass(1e-8, 1), Pass(1e-6, 2)),
    (Pass(1e-5, 2), Pass(1e-8, 3)),
)
"""After each the passes so far are compared."""

PASSES = tuple(one for stage in STAGES for one in stage)


class Found(NamedTuple):
    """What some passes found for one pose.

    Attributes
    ----------
    q : ndarray, shape (m, 6)
        Configurations without repetition, angles with their offsets.
    sizes : ndarray, shape (m,)
        Their errors.
    by : ndarray of bool, shape (m, passes)
        Which passes found each.
    """

    q: Floats
    sizes: Floats
    by: NDArray[np.bool_]

    @property
    def agreed(self) -> bool:
        """Whether one pass found all, and each was found at least twice; with nothing found, whether two looked."""
        if not len(self.q):
            return int(self.by.shape[1]) >= 2
        return bool(self.by.all(axis=0).any() and (self.by.sum(axis=1) >= 2).all())


@dataclass(frozen=True, eq=False)
class Search:
    """All that does not depend on the pose.

    Attributes
    ----------
    loop : Loop
    formulations : tuple of (shift, hidden)
        Best first; none for a deficient arm.
    moves : ndarray, shape (passes, 6, 4, 4)
        Small random motions.
    starts : ndarray, shape (starts, 6)
        Random configurations to search from where elimination has nothing to say.
    deficient : bool
        Whether the Jacobian is singular everywhere: the arm has fewer than six freedoms. What it reaches, it reaches in
        infinitely many ways; and the least move of a link makes it impossible, so that elimination finds nothing.
    """

    loop: Loop
    formulations: tuple[tuple[int, int], ...]
    moves: Floats
    starts: Floats
    deficient: bool

    @classmethod
    def of(cls, arm: Arm) -> Search:
        """Rank the formulations of an arm; a few milliseconds."""
        loop, rng = Loop.of(arm), np.random.default_rng(SEED)
        moves = np.array([[small_motion(rng, one.size) for _ in range(JOINTS)] for one in PASSES])
        starts = rng.uniform(-np.pi, np.pi, (STARTS, JOINTS))
        deficient = bool(rank_losses(loop.links, starts[:RANKED_ON], np.eye(4)).all())
        formulations = () if deficient else _ranking(loop, moves[1], starts[:RANKED_ON])
        return cls(loop, formulations, moves, starts, deficient)

    def stage(self, hands: Floats, number: int) -> tuple[list[Found], Floats]:
        """Make the passes of one stage for N targets, shape (N, 4, 4).

        Returns
        -------
        found : list of Found
            For each target.
        unrest : ndarray, shape (N,)
            See `unrest`; infinite where an elimination failed.
        """
        N, passes = len(hands), STAGES[number]
        first, ranks = sum(map(len, STAGES[:number])), sorted({one.rank for one in passes})
        owners, candidates, restless = [], [], np.zeros(N)
        for rank in ranks:
            mine = np.array([k for k, one in enumerate(passes) if one.rank == rank])
            motions = (motions_of(self.loop, hands) @ self.moves[first + mine][:, None]).reshape(-1, JOINTS, 4, 4)
            owner, q, circle = candidates_of(motions, self.formulations[rank])
            owners.append(mine[owner // N] * N + owner % N)
            candidates.append(q)
            if len(mine) == 2:
                restless = unrest(circle[:N], circle[N:])
        by, pose = np.divmod(np.concatenate(owners), N)
        q, sizes = newton.polish(self.loop.links, np.concatenate(candidates), hands[pose])
        good, every = sizes < ACCEPTED, np.eye(len(passes), dtype=bool)
        rows = [np.flatnonzero(good & (pose == k)) for k in range(N)]
        return [merged(q[k], sizes[k], every[by[k]]) for k in rows], restless

    def descents(self, hand: Floats) -> Found:
        """Return what Newton's method finds from random starts, in two halves that count as passes."""
        hands = np.broadcast_to(hand, (STARTS, 4, 4))
        q, sizes = newton.polish(self.loop.links, self.starts, hands, STEPS_OF_DESCENT, PATIENCE_OF_DESCENT)
        good = sizes < ACCEPTED
        halves = np.repeat(np.eye(2, dtype=bool), STARTS // 2, axis=0)
        return merged(q[good], sizes[good], halves[good])


def motions_of(loop: Loop, hands: Floats) -> Floats:
    """Return the motions between the turns of the closed loop, shape (N, 6, 4, 4)."""
    motions = np.empty((len(hands), JOINTS, 4, 4))
    motions[:, :5] = loop.links
    motions[:, 5] = inverses(hands)
    return motions


def candidates_of(
    motions: Floats, formulation: tuple[int, int]
) -> tuple[NDArray[np.intp], Floats, NDArray[np.complex128]]:
    """Return the candidates of one formulation: which loop (m,), all angles (m, 6), and all roots (B, 24).

    There are none where the elimination is exactly singular: the pass then disagrees with the others.
    """
    shift, hidden = formulation
    shifted = np.roll(motions, -shift, axis=1)
    found = equations(shifted)
    try:
        owner, middle, circle = roots(found.middle, hidden)
    except np.linalg.LinAlgError:
        return np.empty(0, dtype=np.intp), np.empty((0, JOINTS)), np.full((len(motions), 24), np.nan + 0j)
    return owner, np.roll(all_angles(shifted, found, owner, middle), shift, axis=1), circle


def merged(q: Floats, sizes: Floats, by: NDArray[np.bool_]) -> Found:
    """Return configurations without repetition: of those that are the same the most exact one."""
    order = np.argsort(sizes, kind="stable")
    q, sizes, by = q[order], sizes[order], by[order]
    return _without_repetition(q, sizes, by, newton.groups(q, SAME))


def without_echoes(found: Found, singular: NDArray[np.bool_]) -> Found:
    """Return the same with singular solutions that are closer than `SAME_SINGULAR` taken for one."""
    first, rows = np.arange(len(found.q)), np.flatnonzero(singular)
    first[rows] = rows[newton.groups(found.q[rows], SAME_SINGULAR)]
    return _without_repetition(*found, first)


def _without_repetition(q: Floats, sizes: Floats, by: NDArray[np.bool_], first: NDArray[np.intp]) -> Found:
    together = np.zeros_like(by)
    np.logical_or.at(together, first, by)
    kept = first == np.arange(len(q))
    return Found(q[kept], sizes[kept], together[kept])


def joined(one: Found, other: Found) -> Found:
    """Return what the passes of both found."""
    by = np.zeros((len(one.q) + len(other.q), one.by.shape[1] + other.by.shape[1]), dtype=bool)
    by[: len(one.q), : one.by.shape[1]] = one.by
    by[len(one.q) :, one.by.shape[1] :] = other.by
    return merged(np.concatenate([one.q, other.q]), np.concatenate([one.sizes, other.sizes]), by)


def small_motion(rng: np.random.Generator, size: float) -> Floats:
    """Return a random rigid motion whose angle (rad) and way are about ``size``."""
    turn, way = rng.normal(size=(2, 3)) * size
    return np.asarray(transform(rotation_from_axis_angle(turn, np.linalg.norm(turn)), way), dtype=np.float64)


def _ranking(loop: Loop, moves: Floats, q: Floats) -> tuple[tuple[int, int], ...]:
    """Return the formulations, most regular first, by the median over random q (k, 6) of the slightly moved loop."""
    hands = np.tile(np.eye(4), (len(q), 1, 1))
    for i in range(5):
        hands = hands @ turns(q[:, i]) @ loop.links[i]
    motions = motions_of(loop, hands @ turns(q[:, 5])) @ moves
    scores = {}
    for shift in range(JOINTS):
        found = equations(np.roll(motions, -shift, axis=1))
        # Blocks that are nearly singular spoil what follows; a tenth is good enough.
        blocks = np.log(np.minimum(1.0, 10.0 * found.evenness) + 1e-300)
        for hidden in range(3):
            regularity = leading(matrices(found.middle, hidden))[2]
            scores[shift, hidden] = float(np.median(np.log(regularity + 1e-300) + blocks))
    return tuple(sorted(scores, key=lambda formulation: -scores[formulation]))
