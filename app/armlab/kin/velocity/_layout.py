"""The parts of an arm's structure that distinguish its singularities: planar part, wrist, and important points."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.joint_scale import joint_scale
from armlab.kin.lines import PARALLEL_ANGLE, RELATIVE_LENGTH
from armlab.kin.spare import RANK_TOLERANCE, spare_joints
from armlab.kin.velocity.subspaces import task_axes, task_lengths, task_matrix, task_size
from armlab.kin.wrist import wrist_centre

Array = NDArray[np.float64]

IN_LINE = 1e-6
"""Sine of the angle of two axes, or distance in length scales, that counts as zero in one configuration."""


@dataclass(frozen=True, eq=False)
class Layout:
    """The properties that hold in every configuration.

    Attributes
    ----------
    rank : int
        Rank of the task Jacobian where the arm is not singular.
    usual : ndarray, shape (s, m, n)
        Scaled task Jacobians of some configurations.
    run : tuple of int
        0-based turns about parallel axes, of a planar part; empty for none.
    wrist : tuple of int or None
        0-based joints of the wrist.
    spherical : bool
        Whether the three axes of the wrist meet.
    centre : ndarray, shape (3,), or None
        Centre of a spherical wrist, or where the last two axes of a wrist meet, in tool axes; the tool point itself
        where only that is controlled.
    centre_name : str
    ends_at_centre : bool
        Whether the centre ends the planar part: else the last of its axes does.
    shoulder : ndarray, shape (3,), or None
        The point where the first three axes meet, in the world, for a 7R arm with a spherical wrist.
    """

    rank: int
    usual: Array
    run: tuple[int, ...]
    wrist: tuple[int, int, int] | None
    spherical: bool
    centre: Array | None
    centre_name: str
    ends_at_centre: bool
    shoulder: Array | None = None

    @property
    def end_name(self) -> str:
        """The end of the planar part, in words, when it is none of its axes."""
        return self.centre_name if self.ends_at_centre else ""


@lru_cache(maxsize=64)
def layout_of(arm: Arm) -> Layout:
    """Return the layout of an arm, computed from random configurations."""
    spare = spare_joints(arm)
    samples = [_lines(arm, q) for q in spare.samples[:3]]
    run = _run(arm, samples)
    meeting = wrist_centre(arm) if arm.n >= 6 and arm.task.key == "pose" else None
    position_only = arm.task.rotation == "none"
    scale = joint_scale(arm) / task_lengths(arm)[:, None]
    usual = np.array([task_matrix(arm, q) for q in spare.samples]) * scale
    rank = int(np.linalg.matrix_rank(usual, tol=RANK_TOLERANCE * task_size(arm)).max())
    n = arm.n
    if meeting is not None and n == 6 and (not run or run[-1] < n - 3):
        return Layout(rank, usual, run, (n - 3, n - 2, n - 1), True, meeting, "the wrist centre", True)
    if meeting is not None and n == 7 and arm.revolute.all():
        shoulder = _meeting(samples[0], arm.length_scale)
        if shoulder is not None:
            return Layout(rank, usual, (), (4, 5, 6), True, meeting, "the wrist centre", True, shoulder)
    if n == 6 and run == (1, 2, 3) and arm.revolute.all() and arm.task.rotation == "full":
        crossing = _crossing(arm, spare.samples)
        if crossing is not None:
            return Layout(rank, usual, run, (3, 4, 5), False, crossing, "the point where axes 5 and 6 meet", False)
    if position_only and run:
        # A turning joint behind the run that moves the tool point moves it along a line of their axes too: no elbow.
        moved = np.abs(usual).max(axis=(0, 1)) > RELATIVE_LENGTH * arm.length_scale
        if (moved & arm.revolute)[run[-1] + 1 :].any():
            return Layout(rank, usual, (), None, False, None, "", False)
        return Layout(rank, usual, run, None, False, np.zeros(3), "the tool point", True)
    return Layout(rank, usual, run if len(run) >= 3 else (), None, False, None, "", False)


def _lines(arm: Arm, q: Array) -> tuple[Array, Array]:
    """Return the directions and points of the joint axes, (n, 3) each, in the world."""
    whole = np.asarray(arm.frames(q), dtype=np.float64)
    frames = whole[:-1] if arm.convention == "standard" else whole[1:]
    return frames[:, :3, 2], frames[:, :3, 3]


def _run(arm: Arm, samples: list[tuple[Array, Array]]) -> tuple[int, ...]:
    """Return the longest run of parallel revolute axes, at least two, with prismatic ones along them in between."""
    best: list[int] = []
    for first in range(arm.n):
        run: list[int] = []
        for k in range(first, arm.n):
            if not all(np.linalg.norm(np.cross(z[first], z[k])) <= PARALLEL_ANGLE for z, _ in samples):
                break
            if arm.revolute[k]:
                run.append(k)
        if len(run) > max(len(best), 1):
            best = run
    return tuple(best)


def _meeting(lines: tuple[Array, Array], scale: float) -> Array | None:
    """Return the point (3,) where the first three axes meet; None when they do not."""
    z, points = lines[0][:3], lines[1][:3]
    across = np.eye(3) - z[:, :, None] * z[:, None, :]
    point = np.linalg.lstsq(across.sum(axis=0), (across @ points[:, :, None]).sum(axis=0)[:, 0], rcond=None)[0]
    gaps = np.linalg.norm(np.cross(z, point - points), axis=1)
    return np.asarray(point) if gaps.max() <= RELATIVE_LENGTH * scale else None


def _crossing(arm: Arm, samples: Array) -> Array | None:
    """Return the point where the axes of joints 5 and 6 meet, in tool axes; None when they do not."""
    found = []
    for q in samples[:2]:
        z, points = _lines(arm, q)
        a, b, way = z[4], z[5], points[5] - points[4]
        normal = np.cross(a, b)
        if np.linalg.norm(normal) <= PARALLEL_ANGLE or abs(normal @ way) > RELATIVE_LENGTH * arm.length_scale:
            return None
        s = np.cross(way, b) @ normal / (normal @ normal)
        T = arm.fk(q)
        found.append(T[:3, :3].T @ (points[4] + s * a - T[:3, 3]))
    same = np.allclose(found[0], found[1], rtol=0.0, atol=RELATIVE_LENGTH * arm.length_scale)
    return np.asarray(found[0]) if same else None


class Posture:
    """Axes and points of an arm in one configuration, in the world.

    Attributes
    ----------
    arm : Arm
    q : ndarray, shape (n,)
    axes, points : ndarray, shape (n, 3)
        Direction of each joint axis and a point on it.
    """

    def __init__(self, arm: Arm, q: Array, layout: Layout) -> None:
        self.arm, self.q, self._layout = arm, q, layout
        self.axes, self.points = _lines(arm, q)
        self._tool = np.asarray(arm.fk(q), dtype=np.float64)

    @property
    def run_axis(self) -> Array:
        """The direction of the axes of the planar part."""
        return np.asarray(self.axes[self._layout.run[0]])

    @cached_property
    def centre(self) -> Array | None:
        """The centre of the layout in the world."""
        centre = self._layout.centre
        return None if centre is None else self._tool[:3, :3] @ centre + self._tool[:3, 3]

    @cached_property
    def centre_jacobian(self) -> Array:
        """The linear Jacobian of the centre by the joints before the wrist, (3, k), m/s."""
        assert self.centre is not None
        J = self.arm.jacobian(self.q)[:, : self._layout.wrist[0] if self._layout.wrist else None]
        return np.asarray(J[:3] + np.cross(J[3:].T, self.centre - self._tool[:3, 3]).T)

    @cached_property
    def point_columns(self) -> Array:
        """The linear Jacobian of the tool point by all joints, (3, n), whichever coordinates the task has."""
        return np.asarray(self.arm.jacobian(self.q)[:3])

    @property
    def shoulder_centre(self) -> Array | None:
        """The point where the first three axes meet; None when it is not known."""
        return self._layout.shoulder

    @property
    def shoulder_point(self) -> Array | None:
        """The point that joint 1 moves across the planar part; None when the arm has no such joint."""
        turned = self._layout.run[:1] == (1,) and bool(self.arm.revolute[0])
        return self.centre if turned else None

    @property
    def elbow_points(self) -> Array | None:
        """The points (k, 3) of a planar part that are in line, seen along its axes, when it is stretched or folded."""
        layout = self._layout
        if not layout.run or (layout.centre is None and len(layout.run) < 3):
            return None
        points = self.points[list(layout.run)]
        if layout.ends_at_centre and self.centre is not None:
            points = np.vstack([points, self.centre])
        z = self.run_axis
        return np.asarray(points - np.outer(points @ z, z)) if len(points) > 2 else None

    @cached_property
    def task_axes(self) -> Array:
        """The directions of the task's components in the world, (m, 3)."""
        return task_axes(self.arm, self.q)

    def on_axis(self, k: int) -> bool:
        """Return whether the tool point lies on the axis of joint k (0-based)."""
        way = self._tool[:3, 3] - self.points[k]
        return float(np.linalg.norm(np.cross(self.axes[k], way))) <= IN_LINE * self.arm.length_scale

    def same_line(self, i: int, k: int) -> bool:
        """Return whether the axes of two joints (0-based) are in one line."""
        turned = float(np.linalg.norm(np.cross(self.axes[i], self.axes[k])))
        apart = float(np.linalg.norm(np.cross(self.axes[i], self.points[k] - self.points[i])))
        return turned <= IN_LINE and apart <= IN_LINE * self.arm.length_scale
