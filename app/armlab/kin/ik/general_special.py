"""Poses at which roots merge, go to infinity or become families: roots are followed there from a pose beside.

At a random pose nearby elimination finds all roots the arm has. Followed to the pose asked for, each has a regular
root for its end, or one that several share, or a family, or infinity. When every end is known, and every real one is in
the list, the list is complete.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from armlab.kin.ik.general_complex import OUTERMOST, REGULAR, SAME, Roots, joined, near, newton
from armlab.kin.ik.general_family import Split, split
from armlab.kin.ik.general_loop import Complex, Floats
from armlab.kin.ik.general_merge import merged, wrapped
from armlab.kin.ik.general_search import PASSES, SEED, Search
from armlab.kin.ik.general_track import Ends, Way, follow

SIZES = (0.1, 0.2)
"""Distances of the pose beside the target, in radians and units of length, tried in turn until all ends are known."""

FOLLOWED = 1e-6
"""Distance u from the end of the way below which an end counts as reached."""

FAST, FAR = 0.03, 4.0
"""Speed in log u, and imaginary part, from which on a root that is followed goes to infinity."""

BESIDE = 0.3
"""Imaginary part up to which the real part of a root is a start for a real solution."""

MULTIPLE = 12.0
"""Largest distance of an end, as a factor of its speed in log u: where k roots merge it is k; more than twelve do
not."""

STRAY = 1e-6
"""Largest distance, in radians, of an end from a real solution, in addition to that."""

CLUSTER, MOST_PAIRS = 1e-2, 24
"""Distance in all joints, in radians, of solutions between which others are looked for; and the largest number of
pairs."""

AMONG = np.array([-1.0, -0.5, 0.5, 1.5, 2.0])
"""Parameters of points on the line through two such solutions."""

MOST_LOOSE = 8
"""Number of descents whose results stand for all solutions, where an arm has nearly fewer than six freedoms: the pose
is then nearly reached along families, and exactly only where descents do not find it."""


class Resolved(NamedTuple):
    """Real solutions at a special pose.

    Attributes
    ----------
    q : ndarray, shape (k, 6)
        Exact, each once; of families some members.
    parts : Split
        Their kinds.
    roots : Roots
        Regular ones, complex ones included.
    complete : bool
        Whether the ends of all roots are known, and the real ones listed.
    """

    q: Floats
    parts: Split
    roots: Roots
    complete: bool


def resolve(search: Search, hand: Floats, roots: Roots, known: Floats) -> Resolved:
    """Return the real solutions at a pose where not all roots of the arm are regular.

    Parameters
    ----------
    search : Search
    hand : ndarray, shape (4, 4)
    roots : Roots
        The result of elimination at the pose itself.
    known : ndarray, shape (k, 6)
        Real solutions that others found.
    """
    links, rng = search.loop.links, np.random.default_rng(SEED)
    found = search.descents(hand)
    q = merged(links, np.concatenate([found, known, _starts(roots.q)]), hand)
    if search.deficient and not len(q):
        q = found[:MOST_LOOSE]
    parts = _parted(search, q, hand)
    # More ways than one only where they can prove something.
    for size in SIZES if search.counts and not search.nearly_special else SIZES[:1] if search.formulations else ():
        if parts.freedom:
            break
        way = Way.beside(hand, rng, size)
        beside, whole = _all_roots(search, way.start)
        ends = follow(links, way, beside)
        regular, rest = _reached(search, ends, hand)
        roots = joined(roots, regular)
        q = merged(links, np.concatenate([q, _starts(roots.q), _starts(ends.q)]), hand)
        among = _among(q)
        q = merged(links, np.concatenate([q, among]), hand) if len(among) else q
        parts = _parted(search, q, hand)
        # When two ways lead to one root, one of them has lost its own.
        lost = len(beside) - len(rest.q) - len(regular.q)
        if whole and lost <= 0 and all(_is_known(q, *end) for end in zip(rest.q, rest.speed, strict=True)):
            return Resolved(q, parts, roots, True)
        if whole and lost <= 0 and (rest.u <= FOLLOWED).all():
            # All ends are there, and another way would lead to them again.
            break
    return Resolved(q, parts, roots, False)


def _parted(search: Search, q: Floats, hand: Floats) -> Split:
    return split(search.loop.links, q, hand, search.loop.allowed)


def _all_roots(search: Search, hand: Floats) -> tuple[Complex, bool]:
    """Return regular roots (m, 6) at a neighbouring pose, and whether these are all the arm has."""
    found = search.roots(hand[None], 0)[0]
    for number in range(1, len(PASSES)):
        if search.is_whole(found):
            break
        found = joined(found, search.roots(hand[None], number)[0])
    return found.q[found.regular], not search.nearly_special and search.is_whole(found)


def _reached(search: Search, ends: Ends, hand: Floats) -> tuple[Roots, Ends]:
    """Return the regular roots among the ends, without repetitions, and the other ends."""
    hands = np.broadcast_to(hand, (len(ends.q), 4, 4))
    at = np.flatnonzero(ends.u == 0.0)
    q, _, norms = newton(search.loop.links, ends.q[at], hands[at])
    regular = norms < REGULAR
    rest = np.setdiff1d(np.arange(len(ends.q)), at[regular])
    q = q[regular]
    kept = ~np.tril(near(q, SAME), -1).any(axis=1)
    return Roots(q[kept], np.ones(int(kept.sum()), dtype=bool)), Ends(ends.q[rest], ends.u[rest], ends.speed[rest])


def _is_known(q: Floats, end: Complex, speed: float) -> bool:
    """Return whether an end is at infinity, or one of the real solutions (k, 6)."""
    outside = float(np.abs(end.imag).max())
    if outside >= OUTERMOST or (outside > FAR and speed > FAST):
        return True
    if not len(q) or not np.isfinite(speed):
        return False
    apart = np.hypot(wrapped(end.real - q), end.imag).max(axis=1)
    return bool(apart.min() <= MULTIPLE * speed + STRAY)


def _among(q: Floats) -> Floats:
    """Return starts between and beside close solutions (k, 6): of three in a row the outer ones may hide the third."""
    one, other = np.nonzero(np.tril(np.abs(wrapped(q[:, None] - q)).max(axis=2) < CLUSTER, -1))
    one, other = one[:MOST_PAIRS], other[:MOST_PAIRS]
    ways = wrapped(q[other] - q[one])
    return np.asarray((q[one][:, None] + AMONG[:, None] * ways[:, None]).reshape(-1, 6))


def _starts(q: Complex) -> Floats:
    """Return the real parts of nearly real roots, shape (k, 6)."""
    return np.asarray(q[np.abs(q.imag).max(axis=1, initial=0.0) < BESIDE].real)
