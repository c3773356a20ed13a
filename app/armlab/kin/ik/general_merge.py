"""Solutions found in several ways, without repetitions.

Newton's method leaves simple solutions exact and scatters where k of them merge: an error e of the pose is one of
e^(1/k) of the angles, 1e-8 to 1e-3 rad. So no distance in angles tells two solutions from one. The pose does: between
two solutions the arm has to leave the target, and how far, half-way, is what can be told from rounding or not.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik.general_loop import Floats
from armlab.kin.ik.general_polish import errors_and_columns, nearest, polish

ROUNDING = 3e-14
"""Error of the pose, in radians and units of length, that some ten products of matrices may cause."""

REFINED = 1e-15
STEPS = 40
"""Largest number of steps of the last polishing: at a double root each halves the distance, from 1e-4 to 1e-8 in
fifteen."""

CUTOFF = 1e-11
"""Singular value, relative to the largest, below which a direction belongs to a family and is not polished."""

WORTH = 1e-6
"""Error of a candidate below which it is polished."""

EXACT = 1e-12
"""Error of an exact solution; one with a larger error only comes near the pose."""

BETWEEN = 5e-14
"""Error at the bottom of the valley between two candidates up to which they are one: some hundred roundings, since
another formula for the same arm differs by some ten."""

IDENTICAL = 1e-9
"""Distance, in radians, below which two solutions are one without further test."""

WEAK, STAYED = 1e-4, 0.1
"""Singular value, relative to the largest, of the directions along the valley; and the greatest distance to its bottom,
relative to that of the candidates."""

WEAKER, ASIDE = (1e-4, 1e-6, 1e-8), 0.5
"""Singular values, tried in turn, and distance likewise, for candidates nearer to one another than their accuracy."""

HALF_WAY, BESIDE = (0.5,), (0.25, 0.75)
"""Fractions of the way between two candidates at which the pose is tested: at the middle there may be a third
solution."""

CLOSE = 0.3
"""Distance, in radians over all joints, from which two candidates are not one."""


def merged(links: Floats, q: Floats, hand: Floats) -> Floats:
    """Return exact solutions (k, 6) from candidates (m, 6) near them, each once: the most exact of its copies."""
    if not len(q):
        return np.empty((0, 6))
    q, sizes = _refined(links, *polish(links, q, np.broadcast_to(hand, (len(q), 4, 4))), hand)
    order = np.argsort(sizes, kind="stable")
    order = order[sizes[order] < EXACT]
    q, sizes = q[order], sizes[order]
    apart = np.linalg.norm(wrapped(q[:, None] - q), axis=2)
    first = ~np.tril(apart < IDENTICAL, -1).any(axis=1)
    q, sizes, apart = q[first], sizes[first], apart[np.ix_(first, first)]
    pairs = _Pairs(links, hand, q, sizes)
    one, other = np.nonzero(np.tril(apart < CLOSE, -1))
    same = np.zeros((len(q), len(q)), dtype=bool)
    same[one, other] = pairs.joined(one, other, HALF_WAY)
    kept: list[int] = []
    rest = np.arange(len(q))
    while len(rest):
        # The most exact of those left stands for itself, and for all that are one with it.
        first, rest = rest[0], rest[1:]
        kept.append(int(first))
        alike = rest[same[rest, first]]
        rest = np.setdiff1d(rest, alike[pairs.joined(alike, np.full(len(alike), first), BESIDE)])
    return q[kept]


def _refined(links: Floats, q: Floats, sizes: Floats, hand: Floats) -> tuple[Floats, Floats]:
    """Return candidates after Newton steps without damping, which at multiple roots would end them early.

    Half-way between two roots a step leads far out, and the next ones come back: each candidate may do so once.
    """
    rows = np.flatnonzero((sizes > REFINED) & (sizes < WORTH))
    q, sizes, going = q.copy(), sizes.copy(), q[rows]
    last, jumped = sizes.copy(), np.zeros(len(q), dtype=bool)
    for _ in range(STEPS):
        if not len(rows):
            break
        errors, columns, now = errors_and_columns(links, going, np.broadcast_to(hand, (len(rows), 4, 4)))
        better = now < sizes[rows]
        q[rows[better]], sizes[rows[better]] = going[better], now[better]
        steady = now <= 2.0 * last[rows]
        on = (now > REFINED) & (steady | (~jumped[rows] & (last[rows] > ROUNDING) & (now < WORTH)))
        last[rows], jumped[rows] = now, jumped[rows] | ~steady
        rows, going = rows[on], going[on]
        going = going + (errors[on, None] @ np.linalg.pinv(columns[on], rcond=CUTOFF))[:, 0]
    return q, sizes


class _Pairs:
    """Candidates (m, 6): two of them are one when the error between them nowhere exceeds theirs or rounding.

    A candidate is known up to twice its error over its least singular value: a Newton step, which is half the way to a
    double root, is about as long, and rounding is an error, too.
    """

    def __init__(self, links: Floats, hand: Floats, q: Floats, sizes: Floats) -> None:
        self.links, self.hand, self.q, self.sizes = links, hand, q, sizes
        columns = errors_and_columns(links, q, np.broadcast_to(hand, (len(q), 4, 4)))[1]
        least = np.linalg.svd(columns, compute_uv=False)[:, -1]
        self.blurs = 2.0 * np.maximum(sizes, REFINED) / np.maximum(least, CUTOFF)

    def joined(self, one: NDArray[np.intp], other: NDArray[np.intp], parts: tuple[float, ...]) -> NDArray[np.bool_]:
        """Return which pairs, by their rows (k,), are one solution, judged at some points between them."""
        ways = wrapped(self.q[other] - self.q[one])
        apart = np.linalg.norm(ways, axis=1)
        enough = np.maximum(4.0 * np.maximum(self.sizes[one], self.sizes[other]), BETWEEN)
        blurred = apart <= self.blurs[one] + self.blurs[other]
        joined = np.ones(len(one), dtype=bool)
        for part in parts:
            for some, weak, stayed in ((~blurred, (WEAK,), STAYED), (blurred, WEAKER, ASIDE)):
                k = np.flatnonzero(joined & some)
                if len(k):
                    there = self.q[one[k]] + part * ways[k]
                    joined[k] = _is_bottom(self.links, there, stayed * apart[k], enough[k], self.hand, weak)
        return joined


def _is_bottom(
    links: Floats, q: Floats, aside: Floats, enough: Floats, hand: Floats, weak: tuple[float, ...]
) -> NDArray[np.bool_]:
    """Return where the bottom of a valley is no farther than ``aside`` (m,) from q (m, 6) and its error small enough.

    Candidates of high multiplicity lie in a bent valley, and the chord between them leaves it.
    """
    found = np.zeros(len(q), dtype=bool)
    for cutoff in weak:
        rest = np.flatnonzero(~found)
        if not len(rest):
            break
        bottom = nearest(links, q[rest], np.broadcast_to(hand, (len(rest), 4, 4)), cutoff, exact=REFINED)
        found[rest] = (np.linalg.norm(bottom.q - q[rest], axis=1) < aside[rest]) & (bottom.sizes <= enough[rest])
    return found


def wrapped(angles: Floats) -> Floats:
    """Return angles without whole turns, of any shape, between half a turn back and half a turn ahead."""
    return np.asarray(angles - 2.0 * np.pi * np.round(angles / (2.0 * np.pi)))
