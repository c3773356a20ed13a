"""Two bodies that make the same two rotations, one in either order."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.body.forms.timing import amounts
from armlab.benches.body.order.state import Order
from armlab.kin.commuting import across, apart_by_order, beyond_first_order
from armlab.kin.rotations import rotation_from_axis_angle
from armlab.session.state import State

Floats = NDArray[np.float64]

SMALLEST = -5.0
"""Power of ten of the smallest angle that is drawn, radians."""

POINTS = 121


@dataclass(frozen=True, eq=False)
class Pair:
    """Two rotations in one order.

    Attributes
    ----------
    order : (int, int)
        Which comes first, and which after it, 0-based.
    axes : ndarray, shape (2, 3)
        Of the rotations as they are counted, of unit length.
    angles : ndarray, shape (2,)
        Radians, likewise.
    carried : bool
        Whether the body carries the axes along.
    """

    order: tuple[int, int]
    axes: Floats
    angles: Floats
    carried: bool

    def turn(self, k: int, part: float = 1.0) -> Floats:
        """Return the rotation that comes k-th, 0-based, made in part, (3, 3)."""
        which = self.order[k]
        return np.asarray(rotation_from_axis_angle(self.axes[which], part * self.angles[which]))

    def at(self, time: float) -> Floats:
        """Return the orientation at a time of the film in seconds, (3, 3)."""
        one, other = amounts(time, 2).tolist()
        first, second = self.turn(0, one), self.turn(1, other)
        return np.asarray(first @ second if self.carried else second @ first)

    def angle(self, k: int, time: float) -> float:
        """Return how far the rotation that comes k-th is made at a time, radians."""
        return float(amounts(time, 2)[k] * self.angles[self.order[k]])

    def axis(self, k: int) -> Floats:
        """Return the axis of the rotation that comes k-th where it is then, in the base frame."""
        axis = self.axes[self.order[k]]
        return np.asarray(self.turn(0) @ axis) if self.carried and k else axis


@dataclass(frozen=True, eq=False)
class Ends:
    """Where both orders end.

    Attributes
    ----------
    apart : float
        Angle between the ends, radians.
    rule : float
        That angle to second order: the product of the angles and the sine between the axes, radians.
    beyond : float
        Largest entry of what is left of R of a, then b, when I + S(dphi) is taken away.
    largest : float
        The larger of both angles, radians.
    """

    apart: float
    rule: float
    beyond: float
    largest: float


def pairs_of(state: State) -> tuple[Pair, Pair]:
    """Return the rotations in both orders: first a, and first b."""
    part = state[Order]
    axes = np.array([part.a, part.b])
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    angles, carried = np.array(part.angles), part.about == "body"
    return Pair((0, 1), axes, angles, carried), Pair((1, 0), axes, angles, carried)


def ends_of(state: State) -> Ends:
    """Return how far apart both orders end."""
    part = state[Order]
    one, other = part.angles
    return Ends(
        float(apart_by_order(part.a, part.b, one, other)),
        abs(one * other) * float(across(part.a, part.b)),
        float(_beyond(part, one, other)),
        max(abs(one), abs(other)),
    )


def _beyond(part: Order, one: ArrayLike, other: ArrayLike) -> Floats:
    """Return what a, then b, has beyond I + S(dphi): that of R_b R_a, of R_a R_b where the axes are carried along."""
    if part.about == "body":
        return beyond_first_order(part.b, part.a, other, one)
    return beyond_first_order(part.a, part.b, one, other)


def curves(part: Order) -> tuple[Floats, Floats, Floats, Floats]:
    """Return log10 of the larger angle, and of what it leaves: between the ends, by the rule, and beyond I + S(dphi).

    The ratio of the two angles stays as it is.
    """
    powers = np.linspace(SMALLEST, math.log10(math.pi), POINTS)
    angles = np.array(part.angles)
    share = angles / max(float(np.abs(angles).max()), 1e-300)
    one, other = (10.0**powers * each for each in share.tolist())
    found = (
        apart_by_order(part.a, part.b, one, other),
        np.abs(one * other) * across(part.a, part.b),
        _beyond(part, one, other),
    )
    with np.errstate(divide="ignore"):
        logs = [np.log10(each) for each in found]
    apart, rule, beyond = (np.where(each > 2.0 * SMALLEST - 2.0, each, np.nan) for each in logs)
    return powers, apart, rule, beyond
