"""Families of solutions: the joints move and the tool stands still.

An isolated solution may be singular, too (a stretched elbow, where two branches merge). The difference is what a step
along the null vector of the Jacobian costs: in a family Newton's method brings it back at once, without undoing it;
beside an isolated solution it falls back to where it came from, or reaches nothing.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik import general_polish as newton
from armlab.kin.ik.general_loop import Floats
from armlab.kin.ik.nearly_still import DEPENDENT, is_dependent, slack_ways

SINGULAR = 1e-5
"""Singular value of the Jacobian, in radians and units of length, below which it is singular. Newton's method stops
about 1e-6 from a fold."""

SLACK = 3e-3
"""Singular value, likewise, below which the tool hardly moves along a direction; see `armlab.kin.ik.nearly_still`."""

STEP = 0.35
"""Step along a curve, in radians over all six joints together."""

WEAK, MOST_CORRECTIONS = 1e-4, 7
"""Singular value, relative to the largest, below which a direction is not corrected on a curve; number of
corrections."""

MOST_STEPS = 60
"""Largest number of steps in each direction: a curve that is not closed after them, 42 rad, is left open. Closed curves
on which four joints turn are up to some 27 rad long."""

MOST_CURVES, MOST_TRIED = 8, 12
"""Largest numbers of curves that are followed and of other members that are tried: by then there are known to be
infinitely many."""

MOST_POINTS = 200
"""Number of points of all curves together after which no further curve is followed."""

REPRESENTATIVES = 4
"""Number of representatives of a curve, or of families of higher dimension."""

Reached = tuple[float, float]


class Split(NamedTuple):
    """Solutions, told apart.

    Attributes
    ----------
    isolated, singular : ndarray of bool, shape (m,)
    curves : tuple of ndarray, shape (s, 6)
        Points about `STEP` apart on each family with one freedom.
    freedom : int
        Dimension of the largest family, 0 without any.
    members : ndarray, shape (r, 6)
        Representatives of the families.
    """

    isolated: NDArray[np.bool_]
    singular: NDArray[np.bool_]
    curves: tuple[Floats, ...]
    freedom: int
    members: Floats


def split(links: Floats, q: Floats, hand: Floats, reached: Reached) -> Split:
    """Tell isolated solutions, singular ones and families apart.

    Parameters
    ----------
    links : ndarray, shape (5, 4, 4)
        See `Loop`.
    q : ndarray, shape (m, 6)
        Polished solutions, angles with their offsets.
    hand : ndarray, shape (4, 4)
    reached : tuple of float
        Errors in units of length and radians up to which a pose counts as reached: beside a wrist that is straight but
        for 1e-8, say, one nearly moves along a family, and nobody can tell.
    """
    losses, suspect = _losses(links, q, hand)
    isolated, curves, more = np.ones(len(q), dtype=bool), list[Floats](), list[Floats]()
    for i in np.flatnonzero(suspect):
        if losses[i] and any(_distances(curve, q[i]).min() < STEP for curve in curves):
            isolated[i] = False
        elif len(more) < MOST_TRIED and (on := _on(links, q[i], hand, reached)) is not None:
            isolated[i] = False
            if losses[i] > 1 or len(curves) == MOST_CURVES or sum(map(len, curves)) >= MOST_POINTS:
                more.append(on[0])
            elif all(_distances(one, q[i]).min() >= STEP for one in curves):
                curves.append(self_motion(links, *on, hand, reached))
        elif losses[i] and len(more) == MOST_TRIED:
            # Where so many can move, others are taken to do so as well.
            isolated[i] = False
    members = [*(_evenly(curve) for curve in curves), *more[:REPRESENTATIVES]]
    return Split(
        isolated=isolated,
        singular=losses > 0,
        curves=tuple(curves),
        # A family along which the tool nearly stands still is nowhere singular, and a curve.
        freedom=int(np.maximum(losses[~isolated], 1).max(initial=0)),
        members=np.vstack(members) if members else np.empty((0, 6)),
    )


def rank_losses(links: Floats, q: Floats, hand: Floats) -> NDArray[np.intp]:
    """Return the rank deficiency of the Jacobians at configurations (m, 6), shape (m,)."""
    return _losses(links, q, hand)[0]


def _losses(links: Floats, q: Floats, hand: Floats) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """Return the rank deficiency of the Jacobians at q (m, 6), and at which q the arm may move on, shape (m,) each."""
    columns = newton.errors_and_columns(links, q, np.broadcast_to(hand, (len(q), 4, 4)))[1]
    # The other four singular values multiply to no more than (sum of squares / 4)^2, and a determinant costs a tenth
    # of a decomposition.
    squares = (columns * columns).sum(axis=(1, 2))
    near = np.flatnonzero(np.abs(np.linalg.det(columns)) < DEPENDENT * squares * (squares / 4.0) ** 2)
    losses, suspect = np.zeros(len(q), dtype=np.intp), np.zeros(len(q), dtype=bool)
    if len(near):
        values = np.linalg.svd(columns[near], compute_uv=False)
        losses[near] = (values < SINGULAR).sum(axis=1)
        suspect[near] = (losses[near] > 0) | is_dependent(values)
    return losses, suspect


def self_motion(links: Floats, q: Floats, along: Floats, hand: Floats, reached: Reached) -> Floats:
    """Return points of the curve of solutions through one.

    Parameters
    ----------
    links : ndarray, shape (5, 4, 4)
    q, along : ndarray, shape (6,)
        A solution, and the unit direction in which the curve leaves it.
    hand : ndarray, shape (4, 4)
    reached : float
        See `split`.

    Returns
    -------
    ndarray, shape (s, 6)
        From ``q`` on, all around, when the curve closes; else both ways from it.
    """
    ahead, closed = _walk(links, q, hand, along, reached, q)
    if closed:
        return ahead
    back, closed = _walk(links, q, hand, -along, reached, ahead[-1])
    return np.concatenate([ahead, back[:0:-1]] if closed else [back[:0:-1], ahead])


def _on(links: Floats, q: Floats, hand: Floats, reached: Reached) -> tuple[Floats, Floats] | None:
    """Return a solution and the direction (6,) in which a step leads on to another; None where none does.

    It is the given one, unless that only comes near the pose, and the next one comes nearer.
    """
    errors, columns, _ = newton.errors_and_columns(links, q[None], hand[None])
    ways, values, _ = np.linalg.svd(columns[0])
    some = slack_ways(ways[:, values < SLACK].T[::-1])
    on = _next(links, q, hand, some, np.zeros(6), reached) if len(some) else None
    return None if on is None else (q, on.way) if _is_reached(errors, reached)[0] else (on.q, on.along)


def _walk(
    links: Floats, start: Floats, hand: Floats, along: Floats, reached: Reached, end: Floats
) -> tuple[Floats, bool]:
    """Follow a curve; return its points (s, 6) and whether it came to the point ``end`` (6,), where it closes."""
    points, bend = [start], np.zeros(6)
    for _ in range(MOST_STEPS):
        step = _next(links, points[-1], hand, along[None], bend, reached)
        if step is None:
            break
        found, turn = step.q, step.along
        if len(points) > 2 and _distances(end[None], found)[0] < 0.75 * STEP:
            return np.array(points), True
        points.append(found)
        before, along = along, turn if turn @ (points[-1] - points[-2]) > 0.0 else -turn
        bend = along - before
    return np.array(points), False


class _Step(NamedTuple):
    """A step along a curve: its initial direction (6,), the solution at its end, and the null vector there."""

    way: Floats
    q: Floats
    along: Floats


def _next(links: Floats, q: Floats, hand: Floats, ways: Floats, bend: Floats, reached: Reached) -> _Step | None:
    """Return the first step of those in some directions (k, 6) that leads to a solution; None where none does.

    Half a step ahead there has to be one as well, and each near where it is looked for: beside a curve of solutions,
    not another isolated one. The curve is taken to bend on as it did in the last step.
    """
    parts = np.tile([1.0, 0.5], len(ways))[:, None]
    across, hands = np.repeat(ways, 2, axis=0), np.broadcast_to(hand, (2 * len(ways), 4, 4))
    straight = q + STEP * parts * across
    found = newton.nearest(links, straight + 0.5 * STEP * parts**2 * bend, hands, WEAK, MOST_CORRECTIONS, across=across)
    aside = np.linalg.norm(found.q - straight, axis=1) < STEP / 2.0 * parts[:, 0]
    good = aside & _is_reached(found.errors, reached)
    for k in np.flatnonzero(good[::2] & good[1::2]):
        return _Step(ways[k], found.q[2 * k], _weakest(found.columns[2 * k]))
    return None


def _is_reached(errors: Floats, reached: Reached) -> NDArray[np.bool_]:
    """Return which errors (k, 6) of configurations near the pose are as small as ``reached``, shape (k,)."""
    place, turn = np.linalg.norm(errors.reshape(-1, 2, 3), axis=2).T
    return np.asarray((place < reached[0]) & (turn < reached[1]))


def _weakest(columns: Floats) -> Floats:
    """Return the joint direction (6,) that moves the tool least, from a Jacobian given by columns (6, 6)."""
    return np.asarray(np.linalg.svd(columns)[0][:, -1])


def _distances(points: Floats, q: Floats) -> Floats:
    """Return the distances (s,) of points (s, 6) from one configuration, with angles modulo whole turns."""
    apart = (points - q + np.pi) % (2.0 * np.pi) - np.pi
    return np.asarray(np.linalg.norm(apart, axis=1))


def _evenly(curve: Floats) -> Floats:
    """Return `REPRESENTATIVES` points evenly along a curve, or all when there are fewer."""
    chosen = np.unique(np.linspace(0, len(curve), REPRESENTATIVES, endpoint=False).astype(int))
    return np.asarray(curve[chosen])
