"""Solutions from many ways of looking, each once.

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
"""Error of the pose, in radians and units of length, that some ten products of matrices may make."""

REFINED = 1e-15
STEPS = 40
"""Of the last polishing: at a double root every step halves the distance, from 1e-4 to 1e-8 in some fifteen."""

CUTOFF = 1e-11
"""Relative singular values below it are those of a family, along which nothing is to be polished."""

WORTH = 1e-6
"""Error of a candidate that is worth it."""

EXACT = 1e-12
"""Error of a solution; what stays above it only comes near the pose."""

BETWEEN = 5e-14
"""Error at the bottom of the valley between two candidates, up to which they are one: some hundred roundings, for the
numbers of another formula of the same arm differ by some ten."""

IDENTICAL = 1e-9
"""Radians: what is closer is one without asking the pose."""

WEAK, STAYED = 1e-4, 0.1
"""Of the largest singular value: directions along the valley; and of the distance: how far its bottom is at most."""

WEAKER, ASIDE = (1e-4, 1e-6, 1e-8), 0.5
"""The same, tried one after the other, for candidates nearer to one another than they are known."""

HALF_WAY, BESIDE = (0.5,), (0.25, 0.75)
"""Where between two candidates the pose is asked: half-way alone there may be a third solution."""

CLOSE = 0.3
"""Radians in all joints together: farther apart two candidates are not one."""


def merged(links: Floats, q: Floats, hand: Floats) -> Floats:
    """Return exact solutions (k, 6) from candidates (m, 6) near them, each once, the most exact of each."""
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
    """Candidates (m, 6), of which two are one where nowhere between them the error is larger than theirs or rounding.

    A candidate is known up to twice its error over its least singular value: a Newton step, which is half the way to a
    double root, is about as long, and rounding is an error, too.
    """

    def __init__(self, links: Floats, hand: Floats, q: Floats, sizes: Floats) -> None:
        self.links, self.hand, self.q, self.sizes = links, hand, q, sizes
        columns = errors_and_columns(links, q, np.broadcast_to(hand, (len(q), 4, 4)))[1]
        least = np.linalg.svd(columns, compute_uv=False)[:, -1]
        self.blurs = 2.0 * np.maximum(sizes, REFINED) / np.maximum(least, CUTOFF)

    def joined(self, one: NDArray[np.intp], other: NDArray[np.intp], parts: tuple[float, ...]) -> NDArray[np.bool_]:
        """Return which pairs, by their rows (k,), are one as far as some parts of the way between them tell."""
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
    """Return angles without their whole turns, between half a turn back and half a turn ahead."""
    return np.asarray(angles - 2.0 * np.pi * np.round(angles / (2.0 * np.pi)))
