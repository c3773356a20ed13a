"""Effects of the chosen joint speeds at a configuration: the parts of the twist, a link's points, the higher orders."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.speeds.state import Velocity
from armlab.kin.arm import Arm
from armlab.kin.velocity.jacobians import ToolMotion, jacobian_at, link_jacobian, tool_motion
from armlab.kin.velocity.rigid import point_velocity
from armlab.session.parts.joints import Joints
from armlab.session.state import State

Floats = NDArray[np.float64]

INSTANT = 1e-4
"""Time before and after, seconds, between which the way of the tool is measured."""


@dataclass(frozen=True, eq=False)
class Moving:
    """The velocity of the tool and the contribution of each joint, in the world.

    Attributes
    ----------
    J : ndarray, shape (6, n)
        World axes, at the tool point.
    speeds : ndarray, shape (n,)
        rad/s and m/s.
    tool : ndarray, shape (4, 4)
    axes : ndarray, shape (3, 3)
        Columns are the axes in which J is written on screen.
    origins : ndarray, shape (n, 3)
        A point of each joint's axis, metres.
    """

    J: Floats
    speeds: Floats
    tool: Floats
    axes: Floats
    origins: Floats

    @property
    def point(self) -> Floats:
        """The tool point, metres."""
        return np.asarray(self.tool[:3, 3])

    @property
    def parts(self) -> Floats:
        """Contributions of the joints, (6, n): m/s and rad/s (notes 1.9-1.10)."""
        return np.asarray(self.J * self.speeds)

    @property
    def twist(self) -> Floats:
        """Sum of the contributions, (6,): ``(v; omega) = J qdot``."""
        return np.asarray(self.J @ self.speeds)

    @property
    def matrix(self) -> Floats:
        """J in the chosen axes."""
        back = self.axes.T
        return np.concatenate([back @ self.J[:3], back @ self.J[3:]])


def moving_at(arm: Arm, q: Floats, speeds: Floats, axes: str) -> Moving:
    """Return the effects of joint speeds at a configuration."""
    frames = np.asarray(arm.frames(q), dtype=np.float64)
    tool = frames[-1] @ arm.tool
    on_axis = frames[:-1] if arm.convention == "standard" else frames[1:]
    chosen = {"world": np.eye(3), "base": arm.base[:3, :3], "tool": tool[:3, :3]}[axes]
    return Moving(jacobian_at(arm, q), speeds, tool, chosen, on_axis[:, :3, 3])


def speeds_of(state: State) -> Floats:
    """Return the joint speeds (n,), rad/s and m/s, with 0 for a held joint."""
    return np.where(state[Joints].locked, 0.0, state[Velocity].qdot)


def moving_of(state: State) -> Moving:
    """Return the effects of the chosen speeds at the present configuration."""
    joints = state[Joints]
    return moving_at(joints.arm, joints.q, state.derived(speeds_of), state[Velocity].axes)


@dataclass(frozen=True, eq=False)
class TwoPoints:
    """Two points of one link and their velocities, in the world.

    Attributes
    ----------
    first, second : ndarray, shape (3,)
        Metres.
    v1, omega : ndarray, shape (3,)
        Of the first point, m/s, and of the link, rad/s.
    """

    first: Floats
    second: Floats
    v1: Floats
    omega: Floats

    @property
    def lever(self) -> Floats:
        """Vector r12 from the first point to the second, metres."""
        return np.asarray(self.second - self.first)

    @property
    def across(self) -> Floats:
        """Cross product ``omega x r12``, m/s, perpendicular to r12."""
        return np.asarray(np.cross(self.omega, self.lever))

    @property
    def v2(self) -> Floats:
        """Velocity of the second point, ``v2 = v1 + omega x r12`` (notes 1.8)."""
        return point_velocity(self.v1, self.omega, self.lever)


def two_points_at(arm: Arm, q: Floats, speeds: Floats, part: Velocity) -> TwoPoints:
    """Return the two points of the chosen link."""
    frame = np.asarray(arm.frames(q), dtype=np.float64)[part.link]
    first, second = (frame[:3, :3] @ point + frame[:3, 3] for point in part.points)
    twist = link_jacobian(arm, q, part.link, part.points[0]) @ speeds
    return TwoPoints(first, second, twist[:3], twist[3:])


def two_points_of(state: State) -> TwoPoints:
    """Return the two points at the present configuration."""
    joints = state[Joints]
    return two_points_at(joints.arm, joints.q, state.derived(speeds_of), state[Velocity])


def higher_of(state: State) -> ToolMotion:
    """Return velocity, acceleration and jerk of the tool while the joint speeds stay constant."""
    joints = state[Joints]
    return tool_motion(joints.arm, joints.q, state.derived(speeds_of))


def measured_velocity(state: State) -> Floats:
    """Return the way of the tool from `INSTANT` before to `INSTANT` after, divided by the time: m/s, shape (3,)."""
    joints, step = state[Joints], INSTANT * state.derived(speeds_of)
    way = joints.arm.position(joints.q + step) - joints.arm.position(joints.q - step)
    return np.asarray(way / (2.0 * INSTANT), dtype=np.float64)


def time_left(state: State) -> float:
    """Return the seconds until the first moving joint is at a limit, infinite if there is no limit; 0 if none moves."""
    joints, speeds = state[Joints], state.derived(speeds_of)
    on = speeds != 0.0
    if not on.any():
        return 0.0
    ends = np.where(speeds > 0.0, joints.arm.limits[:, 1], joints.arm.limits[:, 0])
    with np.errstate(over="ignore"):
        return max(float(((ends - joints.q)[on] / speeds[on]).min()), 0.0)


def first_at_limit(state: State) -> int | None:
    """Return the joint (0-based) that ends the drive, or None if none moves."""
    joints, speeds = state[Joints], state.derived(speeds_of)
    on = np.flatnonzero(speeds != 0.0)
    if len(on) == 0:
        return None
    ends = np.where(speeds > 0.0, joints.arm.limits[:, 1], joints.arm.limits[:, 0])
    with np.errstate(over="ignore"):
        return int(on[int(np.argmin((ends - joints.q)[on] / speeds[on]))])
