"""Facts of the ellipsoids that lessons can check: half axes, condition, rank."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.velocity.ellipsoid.state import Manipulability, PlacedEllipsoid, present
from armlab.session.facts import Fact, Facts
from armlab.session.state import State

LEVEL = 1e-6
"""Sine of the angle between a plane and that of x and y of the world, up to which they are one."""


def _seen(state: State) -> PlacedEllipsoid:
    return state.derived(present)


def _sigma(state: State) -> np.ndarray:
    return np.asarray(_seen(state).ellipsoid.sigma)


def _condition(state: State) -> float | None:
    """Return the longest half axis over the shortest: infinite if a direction is lost, None if all are."""
    seen, sigma = _seen(state), _sigma(state)
    if seen.ellipsoid.rank == 0:
        return None
    return float("inf") if seen.lost else float(sigma[0] / sigma[-1])


def _force(state: State) -> np.ndarray:
    return np.asarray(_seen(state).force.half_axes)


def _tilt(state: State) -> float | None:
    """Return the angle in (-pi/2, pi/2] from the world's x axis to the longest axis of an ellipse.

    None where it is a circle, or where its plane is not that of x and y of the world: there is no such angle.
    """
    seen = _seen(state)
    if len(seen.ellipsoid.sigma) != 2 or seen.is_round:
        return None
    x, y, _ = seen.axes[:, 0]
    if np.abs(seen.axes[2, :2]).max() > LEVEL:
        return None
    angle = math.atan2(float(y), float(x))
    return angle - math.pi * math.ceil(angle / math.pi - 0.5)


FACTS = Facts(
    __name__,
    (Manipulability,),
    {
        "half_axes": Fact("the half axes of the velocity ellipsoid, in m/s or rad/s", _sigma, kind="numbers"),
        "longest": Fact("the longest half axis of the velocity ellipsoid, in m/s or rad/s", lambda s: _sigma(s)[0]),
        "shortest": Fact("the shortest half axis of the velocity ellipsoid, in m/s or rad/s", lambda s: _sigma(s)[-1]),
        "condition": Fact("the longest half axis over the shortest", _condition),
        "rank": Fact("the rank of the rows that are looked at", lambda s: _seen(s).ellipsoid.rank, kind="count"),
        "longest_direction": Fact(
            "the angle from the world's x axis to the longest half axis of an ellipse",
            _tilt,
            "rad",
            only="where it lies in the plane of x and y and is no circle",
        ),
        "force_half_axes": Fact("the half axes of the force ellipsoid, in N or N m", _force, kind="numbers"),
    },
)
