"""The visits of the arm to one place: where it comes to, and what accuracy and repeatability follow."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.robot.taught.state import TaughtGoal
from armlab.kin.arm import Arm
from armlab.kin.sensors.repeatability import Scatter, scatter_of
from armlab.session.parts.joints import Joints
from armlab.session.state import State

Floats = NDArray[np.float64]

ROUNDING = 1e-12
"""Distance from the goal, in length scales of the arm, below which the goal is reached."""


class Visits(NamedTuple):
    """Result of the visits.

    Attributes
    ----------
    goal : ndarray, shape (3,)
        Where the arm is to go, metres in the world.
    points : ndarray, shape (n, 3)
        Where it comes to.
    scatter : Scatter
    missed : ndarray, shape (n,)
        Distances across the tool's z axis by which it misses the goal, metres: what counts for a peg along it.
    """

    goal: Floats
    points: Floats
    scatter: Scatter
    missed: Floats

    def entered(self, clearance: float, yields: float) -> int:
        """Return how many pegs find their hole: what they miss by is at most the clearance and what the hand yields."""
        return int((self.missed <= clearance + yields).sum())


def visits_of(state: State) -> Visits:
    """Return the visits to the place where the arm of the table stands."""
    joints, part = state[Joints], state[TaughtGoal]
    return _visits(joints.arm, tuple(joints.q.tolist()), part)


@lru_cache(maxsize=32)
def _visits(arm: Arm, q: tuple[float, ...], part: TaughtGoal) -> Visits:
    real, commanded = part.real(arm), np.array(q)
    zero = np.where(arm.revolute, part.offset, part.slide_offset)
    spread = np.where(arm.revolute, part.scatter, part.slide_scatter)
    rng = np.random.default_rng(part.seed)
    stops = commanded + zero + spread * rng.standard_normal((part.visits + 1, arm.n))
    reached = np.asarray(real.position(stops), dtype=np.float64)
    exact = np.asarray(arm.position(commanded), dtype=np.float64)
    # One place and places in a row are rounded differently, which is no error of the arm.
    reached[np.linalg.norm(reached - exact, axis=1) <= ROUNDING * arm.length_scale] = exact
    if not spread.any():
        reached[:] = reached[0]  # processors may round places in a row differently
    # The first one is the visit at which the goal is taught.
    goal = reached[0] if part.taught else exact
    points = reached[1:]
    along = np.asarray(arm.fk(commanded)[:3, 2], dtype=np.float64)
    away = points - goal
    missed = np.linalg.norm(away - np.outer(away @ along, along), axis=1)
    return Visits(goal, points, scatter_of(points, goal), missed)
