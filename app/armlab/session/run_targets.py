"""Where runs begin, and their targets: the initial ones, and those that are accepted."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.iterate import TaskVector, iterate
from armlab.kin.ik.iterate.problem import Problem
from armlab.kin.transforms import as_pose
from armlab.session.parts.target import FARTHEST

ASIDE = 0.4
"""Distance of each joint of the first target from the start, radians or fractions of half a stroke."""

REGULAR = 0.02
"""Least ratio of the smallest to the largest singular value of the task's Jacobian, lengths scaled, at a start: in the
catalogue it is 0.05 and more."""

TRIED, ITERATED, FEW = 40, 6, 12
"""Number of configurations that are tried beside a singular one, of the best of them from which Newton's method is
tried, and of its steps."""


@lru_cache(maxsize=8)
def first_start(robot: Robot) -> NDArray[np.float64]:
    """Return the configuration (n,) from which the first runs begin: the first named pose that is not singular.

    An arm of one's own often has none but q = 0, where it is stretched or its wrist is straight, and from where no
    method goes anywhere: then one of some random ones around home, inside the limits, from which Newton's method
    reaches the target; the most regular of them where it reaches the target from none, and home itself where all of
    them are singular.
    """
    arm, named = robot.arm, np.array(list(robot.poses.values()), dtype=float)
    regular = named[_regularity(arm, named) > REGULAR]
    start = np.array(regular[0] if len(regular) else _beside(arm, named[0]))
    start.setflags(write=False)
    return start


def _beside(arm: Arm, home: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a configuration (n,) beside a singular one, or that one where all that are tried are singular."""
    rng = np.random.default_rng(0)
    beside = np.asarray(arm.clip(home + 2.0 * _way(arm) * rng.uniform(-1.0, 1.0, (TRIED, arm.n))), dtype=np.float64)
    good = np.minimum(_regularity(arm, beside), _regularity(arm, _towards_target(arm, beside)))
    best = [beside[i] for i in np.argsort(-good)[:ITERATED] if good[i] > REGULAR]
    return next((q for q in best if _newton_arrives(arm, q)), best[0] if best else home)


def newton_for(arm: Arm) -> str:
    """Return the key of Newton's method for an arm; with fewer joints than components of the task it is Gauss's."""
    return "gauss_newton" if arm.n < arm.task.m else "newton"


def first_target(robot: Robot) -> NDArray[np.float64]:
    """Return the pose of the tool not far from where the first runs begin."""
    pose = np.array(robot.arm.fk(_towards_target(robot.arm, first_start(robot))), dtype=np.float64)
    pose.setflags(write=False)
    return pose


def _towards_target(arm: Arm, start: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the configuration (..., n) of the first target.

    The first joint a little towards the middle of its range, the others away from it, where there is room: in the
    middle arms are stretched, a singular configuration to begin with.
    """
    low, high = arm.limits.T
    way = np.where(start <= 0.5 * (low + high), 1.0, -1.0) * _way(arm)
    aside = start - way
    inside = (aside >= low) & (aside <= high) & (np.arange(arm.n) > 0)
    return np.asarray(arm.clip(np.where(inside, aside, start + way)))


def _newton_arrives(arm: Arm, start: NDArray[np.float64]) -> bool:
    target = np.array(arm.fk(_towards_target(arm, start)), dtype=np.float64)
    return iterate(arm, target, start, newton_for(arm), most=FEW).success


def _way(arm: Arm) -> NDArray[np.float64]:
    """Return the way of each joint from the start to the first target, rad or m."""
    return np.asarray(np.where(arm.revolute, ASIDE, 0.5 * ASIDE * (arm.limits[:, 1] - arm.limits[:, 0])))


def _regularity(arm: Arm, q: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the smallest over the largest singular value of the task's Jacobian at configurations (B, n)."""
    at = Problem(arm, np.eye(4), TaskVector(arm.task), range(arm.n), clamp=False).at(q)
    return np.divide(at.sigma_min, at.sigma_max, out=np.zeros(len(q)), where=at.sigma_max > 0.0)


def checked_target(robot: Robot, pose: ArrayLike) -> NDArray[np.float64]:
    """Return a target (4, 4), read-only; `InputError` when it is no pose or much too far away."""
    arm, checked = robot.arm, np.array(as_pose(pose, "target"), dtype=np.float64)
    if np.linalg.norm(checked[:3, 3] - arm.base[:3, 3]) > FARTHEST * 2.0 * arm.length_scale:
        raise InputError(f"target: farther than {FARTHEST:g} times the reach of the arm")
    checked.setflags(write=False)
    return checked


def target_after(robot: Robot, pose: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a target after an edit of the table: the same, or the first one where it is now much too far away."""
    try:
        return checked_target(robot, pose)
    except InputError:
        return first_target(robot)
