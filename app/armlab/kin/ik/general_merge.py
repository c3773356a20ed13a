"""Solutions from many ways of looking, each once.

Newton's method leaves simple solutions exact and scatters where k of them merge: an error e of the pose is one of
e^(1/k) of the angles, 1e-8 to 1e-3 rad. So no distance in angles tells two solutions from one. The pose does: between
two solutions the arm has to leave the target, and how far, half-way, is what can be told from rounding or not.
"""

from __future__ import annotations

import numpy as np

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

BETWEEN = 1e-14
"""Error at the bottom of the valley half-way between two candidates, up to which they are one: some ten roundings."""

IDENTICAL = 1e-9
"""Radians: what is closer is one without asking the pose."""

WEAK, STAYED = 1e-4, 0.1
"""Of the largest singular value: directions along the valley; and of the distance: how far its bottom is at most."""

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
    same = _same(links, q, sizes, apart, hand)
    kept: list[int] = []
    for k in range(len(q)):
        if not same[k, kept].any():
            kept.append(k)
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


def _same(links: Floats, q: Floats, sizes: Floats, apart: Floats, hand: Floats) -> np.ndarray:
    """Return which pairs are one: half-way between them the error is no larger than theirs, or rounding.

    Candidates of high multiplicity lie in a bent valley: its bottom beside the middle of the chord counts.
    """
    one, other = np.nonzero(np.tril(apart < CLOSE, -1))
    half_way = q[one] + 0.5 * wrapped(q[other] - q[one])
    between, left = nearest(links, half_way, np.broadcast_to(hand, (len(one), 4, 4)), WEAK, exact=REFINED)
    stayed = np.linalg.norm(between - half_way, axis=1) < STAYED * apart[one, other]
    found = stayed & (left <= np.maximum(4.0 * np.maximum(sizes[one], sizes[other]), BETWEEN))
    same = np.zeros((len(q), len(q)), dtype=bool)
    same[one[found], other[found]] = same[other[found], one[found]] = True
    return same


def wrapped(angles: Floats) -> Floats:
    """Return angles without their whole turns, between half a turn back and half a turn ahead."""
    return np.asarray(angles - 2.0 * np.pi * np.round(angles / (2.0 * np.pi)))
