"""References for an arm: a tool pose and its velocity at each time, or joint values and their rates.

References
----------
Notes 7.1: tracking of a reference in time, regulation to a constant one; 7.11-7.12, where the scheme for joints needs
q_d and its derivative, not p_d as printed.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats, finite_floats
from armlab.kin.field import positive
from armlab.kin.motion import Law, Motion, ToolPath
from armlab.kin.transforms import as_pose

Floats = NDArray[np.float64]

LONGEST = 600.0
"""Longest duration of a reference, seconds."""


class ToolAims(NamedTuple):
    """Wanted poses and twists of the tool at N times.

    Attributes
    ----------
    poses : ndarray, shape (N, 4, 4)
        In the world.
    twists : ndarray, shape (N, 6)
        (p_dot; omega) of the tool point, world axes, m/s and rad/s.
    """

    poses: Floats
    twists: Floats


class JointAims(NamedTuple):
    """Wanted joint values and rates at N times.

    Attributes
    ----------
    q, qdot : ndarray, shape (N, n)
        rad or m, and a second.
    """

    q: Floats
    qdot: Floats


class Reference(ABC):
    """A reference over a time.

    Attributes
    ----------
    duration : float
        Seconds.
    still : bool
        Whether it does not move: a case of regulation.
    """

    duration: float
    still: bool = False

    @abstractmethod
    def tool(self, arm: Arm, t: Floats) -> ToolAims:
        """Return poses and twists of the tool at times (N,)."""

    def joints(self, arm: Arm, t: Floats) -> JointAims | None:
        """Return joint values and their rates at times (N,); None where the reference says nothing about joints."""
        return None


class LineReference(Reference):
    """A line at constant velocity, the tool's axes kept parallel to themselves.

    Parameters
    ----------
    start : array_like, shape (4, 4)
        Pose of the tool in the world at time 0.
    velocity : array_like, shape (3,)
        m/s, in the world.
    duration : float
        Seconds.

    Raises
    ------
    InputError
        No pose, no velocity, or no duration of at most `LONGEST`.
    """

    def __init__(self, start: ArrayLike, velocity: ArrayLike, duration: float) -> None:
        self.start = as_pose(start, "start")
        self.velocity = finite_floats(velocity, "velocity", (3,), "three finite numbers")
        self.duration = checked_duration(duration)

    def tool(self, arm: Arm, t: Floats) -> ToolAims:
        """Return p0 + v t."""
        poses = np.repeat(self.start[None], len(t), axis=0)
        poses[:, :3, 3] += t[:, None] * self.velocity
        twists = np.zeros((len(t), 6))
        twists[:, :3] = self.velocity
        return ToolAims(poses, twists)


class CircleReference(Reference):
    """A circle at constant speed, the tool's axes kept parallel to themselves.

    Parameters
    ----------
    start : array_like, shape (4, 4)
        Pose of the tool in the world at time 0.
    centre : array_like, shape (3,)
        World, metres.
    normal : array_like, shape (3,)
        Axis it goes round counter-clockwise; what it has along the radius is left out.
    rate : float
        rad/s.
    duration : float
        Seconds.

    Raises
    ------
    InputError
        Not finite, no duration, the start at the centre, or an axis along the radius.
    """

    def __init__(self, start: ArrayLike, centre: ArrayLike, normal: ArrayLike, rate: float, duration: float) -> None:
        self.start = as_pose(start, "start")
        self.centre = finite_floats(centre, "centre", (3,), "three finite numbers")
        self.rate = float(finite_floats(rate, "rate", (), "a finite number"))
        self.duration = checked_duration(duration)
        axis = finite_floats(normal, "normal", (3,), "three finite numbers")
        self.x = self.start[:3, 3] - self.centre
        across = np.cross(axis, self.x)
        if np.linalg.norm(across) <= 1e-9 * np.linalg.norm(axis) * max(float(np.linalg.norm(self.x)), 1.0):
            raise InputError("circle: expected a start away from the centre, and an axis that is not along the radius")
        self.y = across * (np.linalg.norm(self.x) / np.linalg.norm(across))

    def tool(self, arm: Arm, t: Floats) -> ToolAims:
        """Return centre + x cos + y sin."""
        c, s = np.cos(self.rate * t)[:, None], np.sin(self.rate * t)[:, None]
        poses = np.repeat(self.start[None], len(t), axis=0)
        poses[:, :3, 3] = self.centre + c * self.x + s * self.y
        twists = np.zeros((len(t), 6))
        twists[:, :3] = self.rate * (c * self.y - s * self.x)
        return ToolAims(poses, twists)


class FixedPose(Reference):
    """A target that stands still; regulation in space.

    Parameters
    ----------
    pose : array_like, shape (4, 4)
        In the world.
    duration : float
        Seconds the arm is given.
    """

    still = True

    def __init__(self, pose: ArrayLike, duration: float) -> None:
        self.pose, self.duration = as_pose(pose, "target"), checked_duration(duration)

    def tool(self, arm: Arm, t: Floats) -> ToolAims:
        """Return the pose, at rest."""
        return ToolAims(np.repeat(self.pose[None], len(t), axis=0), np.zeros((len(t), 6)))


class JointReference(Reference):
    """A motion of the joints, such as a planned one.

    Parameters
    ----------
    motion : Motion
        A motion of n joints; before its start and after its end the joints are at rest.
    """

    def __init__(self, motion: Motion) -> None:
        self.motion, self.duration = motion, checked_duration(motion.duration)

    def joints(self, arm: Arm, t: Floats) -> JointAims:
        """Return q_d and its derivative."""
        return JointAims(*self.motion.derivatives(t, (0, 1)))

    def tool(self, arm: Arm, t: Floats) -> ToolAims:
        """Return poses and twists of the tool of this arm at these joint values: f(q_d), and J(q_d) qdot_d."""
        q, qdot = self.joints(arm, t)
        twists = np.einsum("kij,kj->ki", arm.jacobian(q), qdot)
        return ToolAims(np.asarray(arm.fk(q), dtype=np.float64), np.asarray(twists, dtype=np.float64))


class FixedJoints(Reference):
    """A configuration that stands still; regulation of the joints.

    Parameters
    ----------
    q : array_like, shape (n,)
        rad or m.
    duration : float
        Seconds the arm is given.

    Raises
    ------
    InputError
        Not numbers, or no duration of at most `LONGEST`.
    """

    still = True

    def __init__(self, q: ArrayLike, duration: float) -> None:
        self.q = as_floats(q, "q", "joint values")
        self.duration = checked_duration(duration)

    def joints(self, arm: Arm, t: Floats) -> JointAims:
        """Return the configuration, at rest."""
        q = finite_floats(self.q, "q", (arm.n,), f"{arm.n} finite joint values")
        return JointAims(np.repeat(q[None], len(t), axis=0), np.zeros((len(t), arm.n)))

    def tool(self, arm: Arm, t: Floats) -> ToolAims:
        """Return the pose of the tool in this configuration, at rest."""
        pose = np.asarray(arm.fk(self.q), dtype=np.float64)
        return ToolAims(np.repeat(pose[None], len(t), axis=0), np.zeros((len(t), 6)))


class ToolReference(Reference):
    """A path of the tool run through by a timing law.

    Parameters
    ----------
    path : ToolPath
    law : Law
        From 0 to 1.
    """

    def __init__(self, path: ToolPath, law: Law) -> None:
        self.path, self.law, self.duration = path, law, checked_duration(law.duration)

    def tool(self, arm: Arm, t: Floats) -> ToolAims:
        """Return pose(s(t)) and twist(s) ds/dt."""
        s, rate = self.law.derivatives(t, (0, 1))
        inside = np.clip(s, 0.0, 1.0)
        return ToolAims(self.path.pose(inside), self.path.twist(inside) * rate[:, None])


def checked_duration(duration: float) -> float:
    """Return a duration in seconds; `InputError` unless it is positive and at most `LONGEST`."""
    seconds = positive(duration, "duration")
    if seconds > LONGEST:
        raise InputError(f"duration: expected at most {LONGEST:g} s, got {seconds:g}")
    return seconds
