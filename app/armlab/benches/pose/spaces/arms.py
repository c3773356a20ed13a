"""Planar 3R arms of the same r: described by the place of joint 3 and its angle, or by the pose of the tool."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cache
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.pose.spaces.state import Spaces
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.solutions import wrapped_rows
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.representations import (
    arms_by_third_joint,
    by_third_joint,
    third_joint_misfit,
    third_joint_on_first_axis,
)
from armlab.kin.rotations import rotation_about
from armlab.kin.task import task_named
from armlab.kin.transforms import inverse
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State
from armlab.session.way_to_solution import nearest_copy

Floats = NDArray[np.float64]

SAME = 1e-6
"""Largest difference of joint values, radians up to whole turns, of two arms that are one."""

NO_ANGLE = "the x axis of its tool is along z of frame 0, so that the tool has no angle φ"

SYMBOLS = {"joint3": ("p_x", "p_y", "q_3"), "tool": ("p_x", "p_y", "φ")}
"""Components of r for each description."""


class Twins(NamedTuple):
    """The present arm, and the others that have the same r.

    Attributes
    ----------
    r : ndarray, shape (3,)
        Metres, metres, radians, in frame 0.
    q : ndarray, shape (n,)
        Of the present arm.
    others : ndarray, shape (k, 3)
        Configurations of the others; none where the present one is stretched or folded, and some where there are
        infinitely many.
    """

    r: Floats
    q: Floats
    others: Floats


def misfit(state: State) -> str:
    """Return why the arm cannot be described here, or not as it is chosen; empty if it can."""
    arm = state[Joints].arm
    no_angle = state[Spaces].described == "tool" and not has_angle(arm)
    return third_joint_misfit(arm) or (NO_ANGLE if no_angle else "")


def has_angle(arm: Arm) -> bool:
    """Return whether the tool of a planar 3R has an angle φ: its x axis is not along z of frame 0."""
    T = inverse(arm.base) @ arm.fk(np.zeros(arm.n))
    return math.hypot(*T[:2, 0]) > SAME


@cache
def suited() -> tuple[str, ...]:
    """Return the keys of the arms that can be described here."""
    return tuple(key for key, robot in catalogue().robots.items() if third_joint_misfit(robot.arm) is None)


def r_of(arm: Arm, q: Floats, described: str) -> Floats:
    """Return r of a configuration."""
    if described == "joint3":
        return by_third_joint(arm, q)
    T = inverse(arm.base) @ arm.fk(q)
    return np.array([T[0, 3], T[1, 3], math.atan2(T[1, 0], T[0, 0])])


def arms_of(arm: Arm, r: Floats, described: str) -> Floats:
    """Return all configurations of this r, shape (k, 3)."""
    if described == "joint3":
        return wrapped_rows(arm, np.asarray(arms_by_third_joint(arm, r)).reshape(-1, arm.n))
    # A tool may be turned over, or tilted: it is turned about z and moved in the plane, and stays so.
    T = np.array(inverse(arm.base) @ arm.fk(np.zeros(3)), dtype=np.float64)
    T[:3, :3] = rotation_about("z", r[2] - math.atan2(T[1, 0], T[0, 0])) @ T[:3, :3]
    T[:2, 3] = r[:2]
    found = solve_all(replace(arm, task=task_named("xy phi")), arm.base @ T)
    return np.asarray(found.q, dtype=np.float64)


def twins_of(state: State) -> Twins:
    """Return the present arm and the others of the same r; `InputError` for an arm that cannot be described here."""
    joints, described = state[Joints], state[Spaces].described
    why = misfit(state)
    if why:
        raise InputError(f"arm: {why}")
    r = r_of(joints.arm, joints.q, described)
    every = arms_of(joints.arm, r, described)
    others = [q for q in every if float(np.abs(_apart(q, joints.q)).max()) > SAME]
    return Twins(r, np.array(joints.q), np.array(others).reshape(-1, 3))


def are_infinitely_many(state: State) -> bool:
    """Return whether a whole curve of arms has the r of the present one: joint 1 may then have any angle."""
    return third_joint_on_first_axis(state[Joints].arm, state[Joints].q)


def r_apart(arm: Arm, twins: Twins, described: str) -> float:
    """Return the largest difference of r of an arm and of the others, metres or radians; angles up to whole turns."""
    gaps = [_r_gap(r_of(arm, q, described), twins.r) for q in twins.others]
    return float(np.abs(gaps).max()) if gaps else 0.0


def _r_gap(one: Floats, other: Floats) -> Floats:
    """Return the difference of two r; the angle of one may be half a turn and that of the other minus half a turn."""
    return np.append((one - other)[:2], _apart(one[2:], other[2:]))


def tools_apart(state: State) -> tuple[float, float] | None:
    """Return how far the tools of the present arm and of the first other are apart, if there is one.

    Metres, and radians between their directions.
    """
    twins, arm = twins_of(state), state[Joints].arm
    if not len(twins.others):
        return None
    one, other = arm.fk(twins.q), arm.fk(twins.others[0])
    turn = one[:3, :3].T @ other[:3, :3]
    return float(np.linalg.norm(one[:3, 3] - other[:3, 3])), abs(math.atan2(turn[1, 0], turn[0, 0]))


def _apart(one: Floats, other: Floats) -> Floats:
    return np.asarray((one - other + math.pi) % math.tau - math.pi)


@dataclass(frozen=True)
class SetR(Command):
    """Set one component of r, and move the arm to the nearest configuration that has it.

    Parameters
    ----------
    component : int
        0 to 2.
    value : float
        Metres; radians of the last.
    """

    component: int
    value: float
    label: ClassVar[str] = "component of r"

    def apply(self, state: State) -> State:
        """Return the state with the arm there."""
        if self.component not in (0, 1, 2):
            raise InputError(f"component: expected 0 to 2, got {self.component}")
        twins, joints, described = twins_of(state), state[Joints], state[Spaces].described
        r = np.array(twins.r)
        r[self.component] = self.value
        if not np.isfinite(r).all():
            raise InputError(f"r: expected finite numbers, got {r.tolist()}")
        inside = _copies(joints, arms_of(joints.arm, r, described))
        if not inside:
            raise InputError("No arm has this r: it is out of reach, or outside the limits of the joints.")
        return _moved(state, min(inside, key=lambda q: float(np.abs(q - joints.q).max())))


@dataclass(frozen=True)
class GoToTwin(Command):
    """Move to the other arm of the same r."""

    label: ClassVar[str] = "other arm of the same r"

    def apply(self, state: State) -> State:
        """Return the state with the arm there."""
        others = _copies(state[Joints], twins_of(state).others)
        if not others:
            raise InputError("No other arm has this r inside the limits of the joints.")
        return _moved(state, others[0])


def _copies(joints: Joints, found: Floats) -> list[Floats]:
    """Return those of some configurations, (k, n), that are inside the limits, by whole turns next to the present."""
    copies = (nearest_copy(joints.arm, q, joints.q) for q in found)
    return [q for q in copies if q is not None]


def _moved(state: State, q: Floats) -> State:
    moved = state[Joints].moved_to(q)
    if float(np.abs(_apart(moved.q, q)).max()) > SAME:
        raise InputError("A joint that would have to move is held.")
    return state if moved is state[Joints] else state.replace(moved)
