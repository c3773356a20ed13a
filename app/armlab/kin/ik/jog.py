"""Jogging the tool: one small step along or about axes, on the way the arm is on, or the reason why it cannot go."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats
from armlab.kin.ik.method import method_named
from armlab.kin.ik.search import problem_of
from armlab.kin.ik.solve import come_closer
from armlab.kin.ik.verdict import Verdict, checked_locks, free_joints, joint_values, judge
from armlab.kin.rotations import rotation_from_axis_angle
from armlab.kin.transforms import as_pose

Floats = NDArray[np.float64]
Why = Literal["", "limit", "singular", "reach"]

FARTHEST = math.radians(20.0)
"""Largest change of a joint in one step, rad or length scales. A step that needs more is not taken: it passes beside a
singularity, where the arm would have to hurry, or leads to another branch."""

ALONG = 1e-9
"""Component of a unit vector below which a direction has none: rounding of a few products of rotations."""

FULL = 0.999
"""Part of `FARTHEST` from which a joint counts as held back by it, because of rounding."""


class Jogged(NamedTuple):
    """The outcome of a step.

    Attributes
    ----------
    q : ndarray, shape (n,)
        Where the arm is then, rad and m; where it was if the step cannot be taken.
    why : str
        Why it cannot: ``"limit"``, ``"singular"``, ``"reach"``; empty if it is taken.
    joints : tuple of int
        Places in q, from 0: of the joints at their limits, or of those that would have to change by more than
        `FARTHEST`.
    """

    q: Floats
    why: Why
    joints: tuple[int, ...]


def displaced(arm: Arm, T: ArrayLike, step: ArrayLike, in_tool: bool) -> Floats:
    """Return a pose of the tool (4, 4) after a step along and about axes through the tool point.

    Parameters
    ----------
    arm : Arm
    T : array_like, shape (4, 4)
        The tool in the world.
    step : array_like, shape (6,)
        Metres along x, y, z, and the rotation vector about them in radians.
    in_tool : bool
        Whether the axes are those of the tool, or else those of frame 0.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)])
    >>> displaced(arm, arm.fk([0.0, 0.0]), [0.1, 0, 0, 0, 0, 0], False)[:3, 3].tolist()
    [2.1, 0.0, 0.0]
    """
    pose = np.array(as_pose(T, "T"), dtype=np.float64)
    by = finite_floats(step, "step", (6,), "6 finite numbers")
    R = np.array(pose[:3, :3] if in_tool else arm.base[:3, :3])
    pose[:3, 3] += R @ by[:3]
    angle = float(np.linalg.norm(by[3:]))
    if angle > 0.0:
        pose[:3, :3] = rotation_from_axis_angle(R @ by[3:] / angle, angle) @ pose[:3, :3]
    return pose


def directions(arm: Arm, T: ArrayLike, in_tool: bool) -> tuple[bool, ...]:
    """Return whether the arm's task can follow a step along x, y, z, and about them: six truth values.

    Parameters
    ----------
    arm : Arm
    T : array_like, shape (4, 4)
        The tool in the world.
    in_tool : bool
        Whether the axes are those of the tool, or else those of frame 0.
    """
    tool = arm.base[:3, :3].T @ as_pose(T, "T")[:3, :3]
    axes = tool.T if in_tool else np.eye(3)
    left_out = [k for k in range(3) if k not in arm.task.coordinates]
    along = [bool(np.all(np.abs(axis[left_out]) < ALONG)) for axis in axes]
    about = {
        "none": [False] * 3,
        "phi": [bool(np.all(np.abs(axis[:2]) < ALONG)) for axis in axes],
        "approach": [bool(np.linalg.norm(np.cross(axis, tool[:, 2])) > ALONG) for axis in axes],
        "full": [True] * 3,
    }
    return (*along, *about[arm.task.rotation])


def jogged(
    arm: Arm, q: ArrayLike, step: ArrayLike, in_tool: bool = False, locked: Sequence[bool] | None = None
) -> Jogged:
    """Take one step of the tool from a configuration, by inverse kinematics that starts there.

    No joint changes by more than `FARTHEST`, and the step is taken as a whole or not at all; so the arm moves on
    steadily. It can come to another branch only beside a singularity, where both are that near.

    Parameters
    ----------
    arm : Arm
    q : array_like, shape (n,)
    step : array_like, shape (6,)
        See `displaced`; what the arm's task does not control is left aside.
    in_tool : bool
    locked : sequence of bool, optional
        Joints that may not move.

    Raises
    ------
    InputError
        Shapes or numbers are wrong.
    """
    start, held = joint_values(arm, q, "q"), checked_locks(arm, locked)
    T = displaced(arm, arm.fk(start), step, in_tool)
    scale = np.where(arm.revolute, 1.0, arm.length_scale)
    # The second time only to tell why: the step may be possible for joints that hurry, or not at all.
    for farthest in (FARTHEST, math.inf):
        there, verdict = _closest(arm, T, start, held, farthest)
        hurried = np.flatnonzero(np.abs(there - start) > FULL * FARTHEST * scale)
        if not len(hurried):
            break
    if verdict.reached and len(hurried):
        return Jogged(start, "singular", tuple(hurried.tolist()))
    if verdict.reached:
        return Jogged(there, "", ())
    return Jogged(start, "limit", verdict.limits) if verdict.limits else Jogged(start, "reach", ())


def _closest(
    arm: Arm, T: Floats, start: Floats, held: Sequence[bool] | None, farthest: float
) -> tuple[Floats, Verdict]:
    """Return the configuration (n,) that comes closest to a pose from a start, and the verdict on it."""
    problem = problem_of(arm, method_named("dls"))
    there = np.array(come_closer(problem, problem.target(T), start, free_joints(held), farthest).q)
    return there, judge(arm, T, there, held)
