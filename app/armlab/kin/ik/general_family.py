"""Families of solutions: curves on which the joints move and the tool stands still.

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

SINGULAR = 1e-4
"""Smallest singular value of the Jacobian, in radians and units of length, below which a solution is looked at. Newton
stops about 1e-7 from a fold."""

STEP = 0.25
"""Radians along a curve, in all six joints together."""

MOST_STEPS = 120
"""A curve that has not closed by then, 30 rad, is left open."""

PER_CURVE = 4
"""Representatives of a family."""


class Split(NamedTuple):
    """Solutions, told apart.

    Attributes
    ----------
    isolated, singular : ndarray of bool, shape (m,)
    curves : tuple of ndarray, shape (s, 6)
        One for each family: points on it about `STEP` apart.
    """

    isolated: NDArray[np.bool_]
    singular: NDArray[np.bool_]
    curves: tuple[Floats, ...]


def split(links: Floats, q: Floats, hand: Floats) -> Split:
    """Tell isolated solutions, singular ones and families apart.

    Parameters
    ----------
    links : ndarray, shape (5, 4, 4)
        See `Loop`.
    q : ndarray, shape (m, 6)
        Polished solutions, angles with their offsets.
    hand : ndarray, shape (4, 4)
    """
    isolated, singular = np.ones(len(q), dtype=bool), singular_ones(links, q, hand)
    curves: list[Floats] = []
    for i in np.flatnonzero(singular):
        if any(_distances(curve, q[i]).min() < STEP for curve in curves):
            isolated[i] = False
            continue
        curve = self_motion(links, q[i], hand)
        if curve is not None:
            isolated[i] = False
            curves.append(curve)
    return Split(isolated, singular, tuple(curves))


def singular_ones(links: Floats, q: Floats, hand: Floats) -> NDArray[np.bool_]:
    """Return which configurations (m, 6) have a singular Jacobian."""
    columns = newton.errors_and_columns(links, q, np.broadcast_to(hand, (len(q), 4, 4)))[1]
    # The other five singular values multiply to no more than (sum of squares / 5)^(5/2), and a determinant costs a tenth
    # of a decomposition.
    most = ((columns * columns).sum(axis=(1, 2)) / 5.0) ** 2.5
    suspects = np.flatnonzero(np.abs(np.linalg.det(columns)) < SINGULAR * most)
    found = np.zeros(len(q), dtype=bool)
    if len(suspects):
        found[suspects] = np.linalg.svd(columns[suspects], compute_uv=False)[:, -1] < SINGULAR
    return found


def self_motion(links: Floats, q: Floats, hand: Floats) -> Floats | None:
    """Return points of the curve of solutions through one, or None when it is isolated.

    Parameters
    ----------
    links : ndarray, shape (5, 4, 4)
    q : ndarray, shape (6,)
    hand : ndarray, shape (4, 4)

    Returns
    -------
    ndarray, shape (s, 6), or None
        From ``q`` on; all around when the curve closes, else both ways from it.
    """
    along = _null_vector(links, q, hand)
    ahead, closed = _walk(links, q, hand, along)
    if closed:
        return ahead
    back, _ = _walk(links, q, hand, -along)
    curve = np.concatenate([back[:0:-1], ahead])
    return curve if len(curve) > 1 else None


def _walk(links: Floats, start: Floats, hand: Floats, along: Floats) -> tuple[Floats, bool]:
    """Go along a curve; return its points (s, 6) and whether it closed."""
    points = [start]
    for _ in range(MOST_STEPS):
        ahead = points[-1] + STEP * along
        found, sizes = newton.polish(links, ahead[None], hand[None], newton.PATIENCE + 4)
        moved = float(np.linalg.norm(found[0] - points[-1]))
        if sizes[0] > 10.0 * newton.EXACT or not STEP / 2.0 < moved < 2.0 * STEP:
            return np.array(points), False
        if len(points) > 2 and _distances(start[None], found[0])[0] < 0.75 * STEP:
            return np.array(points), True
        points.append(found[0])
        turn = _null_vector(links, found[0], hand)
        along = turn if turn @ (points[-1] - points[-2]) > 0.0 else -turn
    return np.array(points), False


def _null_vector(links: Floats, q: Floats, hand: Floats) -> Floats:
    columns = newton.errors_and_columns(links, q[None], hand[None])[1][0]
    left = np.linalg.svd(columns)[0]
    return np.asarray(left[:, -1])


def _distances(points: Floats, q: Floats) -> Floats:
    """Return the distances (s,) of points (s, 6) from one, on the torus of angles."""
    apart = (points - q + np.pi) % (2.0 * np.pi) - np.pi
    return np.asarray(np.linalg.norm(apart, axis=1))


def representatives(curve: Floats) -> Floats:
    """Return `PER_CURVE` points of a curve (s, 6), evenly along it, or all when there are fewer."""
    return curve[np.unique(np.linspace(0, len(curve), PER_CURVE, endpoint=False).astype(int))]
