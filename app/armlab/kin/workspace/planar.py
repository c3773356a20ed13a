"""Planar arms of two and three links without joint limits: workspaces, orientations and solutions in closed form.

The distance r of the tool point from the first axis is all that counts. psi is the angle of the last link against the
direction from the first axis to the tool point; the arm's mirror image has -psi.

Where the notes differ: "not all orientations" holds in WS1 without its boundary and without WS2, not in WS1 without the
boundaries of both (4.40), and the two orientations of a 2R (4.2) become infinitely many at the origin where its links
are equal. For unequal links WS2 of a 3R is that of no equation of the notes; it can be two pieces.

References
----------
Notes, sections 4.2 and 4.3.1, figures 4.6 and 4.9.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats
from armlab.kin.ik.screws import screws_of
from armlab.kin.lines import PARALLEL_ANGLE
from armlab.kin.workspace.first_joint import FULL_TURN

Floats = NDArray[np.float64]
Interval = tuple[float, float]
Signs = tuple[int, ...]

EDGE = 1e-12
"""Difference of radii, relative to the sum of the links, below which they are equal."""

NO_LINK = 1e-9
"""Length, relative to the sum of the links, below which a link counts as missing."""


@dataclass(frozen=True)
class PlanarWorkspace:
    """The workspace of a planar arm with two or three links that turns all the way round in each joint.

    Attributes
    ----------
    lengths : tuple of float
        Metres, from the first link on.
    inner, outer : float
        Metres: the tool point reaches the radii from one to the other (WS1).
    area : float
        Area of WS1, m².
    dexterous : tuple of (float, float)
        Closed intervals of radii in metres where all orientations are possible (WS2), in order; (0, 0) is the origin
        alone, the empty tuple nowhere.
    singular : tuple of (float, tuple of signs)
        The circles on which the arm can stand with all links on one line through the first axis, smallest first: the
        radius, and the ways; a sign is 1 where a link points to the tool point and -1 where it points back.
    """

    lengths: tuple[float, ...]
    inner: float
    outer: float
    area: float
    dexterous: tuple[Interval, ...]
    singular: tuple[tuple[float, tuple[Signs, ...]], ...]

    def is_dexterous(self, r: float) -> bool:
        """Return whether all orientations are possible at a radius in metres."""
        edge = EDGE * sum(self.lengths)
        return any(low - edge <= r <= high + edge for low, high in self.dexterous)


def planar_workspace(lengths: Sequence[float]) -> PlanarWorkspace:
    """Return the workspace of a planar arm from its link lengths.

    Parameters
    ----------
    lengths : two or three positive numbers
        Metres.

    Raises
    ------
    InputError
        Not two or three positive lengths.

    Examples
    --------
    >>> planar_workspace((1.0, 0.75, 0.5)).dexterous
    ((0.0, 0.25), (0.75, 1.25))
    """
    links = _checked(lengths)
    outer = math.fsum(links)
    inner = _rounded(math.fsum((2.0 * max(links), *(-length for length in links))), links)
    area = math.pi * (outer - inner) * (outer + inner)
    return PlanarWorkspace(links, inner, outer, area, _dexterous(links), _singular(links))


def tool_angles(lengths: Sequence[float], r: ArrayLike) -> tuple[Floats, Floats]:
    """Return between which angles of the last link a 3R can hold the tool at radii.

    The joint before the last link has to be in the annulus of the first two links. Its distance from the first axis,
    d² = r² + l3² - 2 r l3 cos psi, grows with psi.

    Parameters
    ----------
    lengths : three positive numbers
        Metres.
    r : array_like, shape (...)
        Metres, not negative.

    Returns
    -------
    low, high : ndarray, shape (...)
        Radians in [0, pi]: psi from low to high and from -high to -low; nan where there is none.
    """
    a, b, c = _three(lengths)
    at, edge = _radii(r), EDGE * (a + b + c)
    nearest, farthest = abs(at - c), at + c
    inner, outer = _rounded(abs(a - b), (a, b, c)), a + b
    low = _angle(at, c, np.maximum(inner, nearest))
    high = _angle(at, c, np.minimum(outer, farthest))
    none = (nearest > outer + edge) | (farthest < inner - edge)
    # Where the circle of the last link touches one of the two annuli's circles the range ends exactly at 0 or pi.
    low = np.where(nearest >= inner - edge, 0.0, low)
    high = np.where(farthest <= outer + edge, np.pi, high)
    whole = at <= edge
    low, high = np.where(whole, 0.0, low), np.where(whole, np.pi, high)
    return np.where(none, np.nan, low), np.where(none, np.nan, np.maximum(high, low))


def orientations(lengths: Sequence[float], r: ArrayLike) -> Floats:
    """Return the measure of all angles the tool can have at radii: 0 to 2 pi, rad, shape (...).

    Zero of a 2R, which has one or two, but for the origin with equal links; nan outside WS1.
    """
    links, at = _checked(lengths), _radii(r)
    if len(links) == 3:
        low, high = tool_angles(links, at)
        return np.asarray(2.0 * (high - low))
    count = position_solutions(links, at)
    return np.asarray(np.where(count == 0, np.nan, np.where(np.isinf(count), math.tau, 0.0)))


def position_solutions(lengths: Sequence[float], r: ArrayLike) -> Floats:
    """Return how many configurations put the tool point at radii: 0, 1, 2 or inf, shape (...).

    Whole turns are not counted apart. For a 2R it is also the number of orientations.
    """
    links, at = _checked(lengths), _radii(r)
    edge, space = EDGE * sum(links), planar_workspace(links)
    inside = (at > space.inner + edge) & (at < space.outer - edge)
    border = (np.abs(at - space.outer) <= edge) | (np.abs(at - space.inner) <= edge)
    origin = border & (at <= edge)
    between = 2.0 if len(links) == 2 else np.inf
    return np.asarray(np.where(origin, np.inf, np.where(border, 1.0, np.where(inside, between, 0.0))))


def pose_solutions(lengths: Sequence[float], r: ArrayLike, psi: ArrayLike) -> Floats:
    """Return how many configurations of a 3R have the tool at radii with the last link at angles psi.

    0, 1, 2, or inf where equal first links fold so that joint 3 is on the first axis; shape (...).
    """
    a, b, c = _three(lengths)
    at = _radii(r)
    half = np.sin(0.5 * np.asarray(psi, dtype=np.float64))
    return position_solutions((a, b), np.hypot(at - c, 2.0 * np.sqrt(at * c) * half))


def families(lengths: Sequence[float], r: ArrayLike) -> NDArray[np.int_]:
    """Return how many closed curves the configurations of a 3R with the tool at radii are: 0, 1 or 2, shape (...).

    With the tool held the arm is a four-bar linkage with the sides l1, l2, l3, r: two curves where the shortest and the
    longest side together are shorter than the other two (Grashof), else one. On the singular circles curves meet, and
    what is returned means nothing.

    References
    ----------
    Grashof 1883; Burdick 1989, on self-motion manifolds.
    """
    links = _three(lengths)
    at = _radii(r)
    sides = np.sort(np.stack(np.broadcast_arrays(*map(np.asarray, links), at), axis=-1), axis=-1)
    two = sides[..., 0] + sides[..., 3] < sides[..., 1] + sides[..., 2]
    reached = position_solutions(links, at) > 0
    return np.asarray(np.where(reached, np.where(two, 2, 1), 0))


@lru_cache(maxsize=64)
def lengths_of(arm: Arm) -> tuple[float, ...] | None:
    """Return the two or three link lengths of a planar arm in metres; None where it is not one.

    All joints turn about parallel axes, and no link is without length. Limits are not looked at (`turns_fully`). Arms
    are compared by identity.
    """
    screws = screws_of(arm)
    if arm.n not in (2, 3) or "P" in screws.kinds:
        return None
    z = screws.z[0]
    if np.linalg.norm(np.cross(screws.z, z), axis=1).max() > PARALLEL_ANGLE:
        return None
    points = np.vstack([screws.o, screws.home[:3, 3]])
    steps = np.diff(points, axis=0)
    lengths = np.linalg.norm(steps - np.outer(steps @ z, z), axis=1)
    if lengths.min() <= NO_LINK * lengths.sum():
        return None
    return tuple(map(float, lengths))


def turns_fully(arm: Arm) -> bool:
    """Return whether the limits of every joint allow a whole turn."""
    return bool(np.all(arm.limits[:, 1] - arm.limits[:, 0] >= math.tau - FULL_TURN))


def _dexterous(links: tuple[float, ...]) -> tuple[Interval, ...]:
    if len(links) == 2:
        return ((0.0, 0.0),) if _rounded(abs(links[0] - links[1]), links) == 0.0 else ()
    a, b, c = links
    inner, edge = _rounded(abs(a - b), links), EDGE * sum(links)
    # The circle of radius c about the tool point has to lie in the annulus: about its hole, or beside it.
    pieces = [(0.0, min(c - inner, a + b - c)), (c + inner, a + b - c)]
    pieces = [(low, max(low, high)) for low, high in pieces if high >= low - edge]
    if len(pieces) == 2 and pieces[1][0] <= pieces[0][1] + edge:
        pieces = [(0.0, pieces[1][1])]
    return tuple(pieces)


def _singular(links: tuple[float, ...]) -> tuple[tuple[float, tuple[Signs, ...]], ...]:
    found: list[tuple[float, list[Signs]]] = []
    for signs in product((1, -1), repeat=len(links)):
        r = math.fsum(sign * length for sign, length in zip(signs, links, strict=True))
        if r < 0.0 and _rounded(-r, links) > 0.0:
            continue
        r = _rounded(r, links)
        known = next((ways for radius, ways in found if abs(radius - r) <= EDGE * sum(links)), None)
        # On the origin a way and its opposite are the same configurations.
        if known is None:
            found.append((r, [signs]))
        elif r > 0.0 or tuple(-sign for sign in signs) not in known:
            known.append(signs)
    return tuple((r, tuple(ways)) for r, ways in sorted(found))


def _angle(r: Floats, c: float, d: Floats) -> Floats:
    """Return the angle between the sides r and c of a triangle whose third side is d; shape (...)."""
    across = np.maximum((d - (r - c)) * (d + (r - c)), 0.0)
    along = np.maximum((r + c - d) * (r + c + d), 0.0)
    return np.asarray(2.0 * np.arctan2(np.sqrt(across), np.sqrt(along)))


def _rounded(length: float, links: Sequence[float]) -> float:
    """Return a length; zero when it is negative, or zero up to rounding."""
    return length if length > EDGE * sum(links) else 0.0


def _checked(lengths: Sequence[float]) -> tuple[float, ...]:
    values = as_floats(lengths, "lengths", "two or three lengths in metres")
    if values.ndim != 1 or len(values) not in (2, 3) or not np.all(np.isfinite(values)) or not np.all(values > 0):
        raise InputError(f"lengths: expected two or three positive lengths in metres, got {values.tolist()}")
    return tuple(values.tolist())


def _three(lengths: Sequence[float]) -> tuple[float, float, float]:
    links = _checked(lengths)
    if len(links) != 3:
        raise InputError(f"lengths: expected three positive lengths in metres, got {list(links)}")
    return links[0], links[1], links[2]


def _radii(r: ArrayLike) -> Floats:
    at = as_floats(r, "r", "radii in metres")
    if np.any(at < 0):
        raise InputError("r: expected radii in metres, which are not negative")
    return at
