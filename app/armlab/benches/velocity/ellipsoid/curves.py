"""The ellipsoid over the distance of the tool of a planar 2R from its first axis, and along the planned motion."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.api import Planned, last_planned
from armlab.benches.velocity.ellipsoid.state import Manipulability, VelocityBlock
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ellipsoid import measures
from armlab.kin.two_link import TwoLink, distance, two_link
from armlab.session.parts.joints import Joints
from armlab.session.state import State

Array = NDArray[np.float64]

POINTS = 301
"""Number of points of a curve over the distance."""

MOST = 401
"""Largest number of points along a motion."""


class OverDistance(NamedTuple):
    """The velocity ellipse of a planar 2R over the distance of its tool from the first axis.

    Attributes
    ----------
    link : TwoLink
    r : ndarray, shape (POINTS,)
        Metres, rising, from one singular end to the other.
    sigma : ndarray, shape (POINTS, 2)
        Half axes, m/s for joint speeds of length 1 rad/s.
    w : ndarray, shape (POINTS,)
        Their product.
    roundest : float
        Where the half axes are most alike, metres.
    """

    link: TwoLink
    r: Array
    sigma: Array
    w: Array
    roundest: float


@lru_cache(maxsize=64)
def over_distance(arm: Arm) -> OverDistance | None:
    """Return the curves of the notes, section 5.3, for any planar 2R; None for other arms."""
    try:
        link = two_link(arm)
    except InputError:
        return None
    r = np.linspace(*link.ends, POINTS)
    sigma = link.sigma(r)
    # Between equal links the fold is at r = 0, where the half axes are l and 0.
    ratio = sigma[:, 1] / sigma[:, 0]
    fine = np.linspace(r[max(int(np.argmax(ratio)) - 1, 0)], r[min(int(np.argmax(ratio)) + 1, POINTS - 1)], POINTS)
    close = link.sigma(fine)
    roundest = float(fine[np.argmax(close[:, 1] / close[:, 0])])
    return OverDistance(link, r, sigma, sigma.prod(axis=-1), roundest)


def present_distance(state: State) -> float:
    """Return the distance of the tool point from the first joint axis, metres."""
    joints = state[Joints]
    return float(distance(joints.arm, joints.q))


class AlongMotion(NamedTuple):
    """The ellipsoid along a motion: times in seconds, w, and the shortest half axis, each of shape (k,)."""

    t: Array
    w: Array
    sigma_min: Array


def along_motion(state: State) -> AlongMotion | None:
    """Return the measures of the ellipsoid along the planned motion, or None if none is planned."""
    planned = last_planned(state)
    return None if planned is None or planned.samples is None else _along(planned, state[Manipulability].block)


@lru_cache(maxsize=8)
def _along(planned: Planned, block: VelocityBlock) -> AlongMotion | None:
    samples = planned.samples
    if samples is None or len(samples.t) == 0:
        return None
    pick = np.unique(np.linspace(0, len(samples.t) - 1, min(len(samples.t), MOST)).round().astype(int))
    found = measures(block.rows(samples.q[pick]), block.speeds, block.size)
    return AlongMotion(samples.t[pick], found.w, found.sigma_min)
