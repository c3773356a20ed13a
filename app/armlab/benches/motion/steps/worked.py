"""The five steps from knots to a motion of the joints, with the numbers of each.

Notes, the list before section 6.1. The steps were computed by `armlab.benches.motion.plan.planning`; this module reads
the result of each.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.moves import Stretch, Waypoint
from armlab.benches.motion.plan.paths import places
from armlab.benches.motion.plan.question import Feasible, Leg, Question
from armlab.benches.motion.plan.samples import DRAWN
from armlab.benches.motion.plan.state import Plan, last_planned
from armlab.kin.arm import Arm
from armlab.kin.conditioning import NEAR
from armlab.kin.ik.branches import branch_names
from armlab.kin.motion import Followed, Path, ToolPath, swept
from armlab.kin.rotations import axis_angle
from armlab.session.state import State

Floats = NDArray[np.float64]

ARMS = 5
"""Number of arms that are shown along the path."""

BETWEEN = 240
"""Number of samples up to which the joint path is evaluated at several places between two; beyond, only half way."""

FINE = 2001
"""Number of points by which the length of a tool path is measured, exact to a relative 1e-6 for an arc."""

LARGER = (100.0, 50.0, 20.0, 10.0, 5.0, 2.0)
"""Factors by which distances from the path may be drawn larger."""

DRAWN_APART, UNSEEN = 0.08, 1e-4
"""Largest distance that is drawn larger, and least one that is worth it, in length scales of the arm."""


@dataclass(frozen=True, eq=False)
class Apart:
    """The distance of the tool from its wanted place, while the joints follow their path.

    Attributes
    ----------
    s : ndarray, shape (k,)
    q : ndarray, shape (k, n)
        rad and m.
    tool, wanted : ndarray, shape (k, 3)
        World, metres; ``wanted`` is the point of the path with the same s, for a joint move the nearest point of the
        straight lines between the knots.
    distance : ndarray, shape (k,)
        Metres, in the coordinates the arm controls.
    turn : ndarray, shape (k,)
        Radians between the orientations; zeros where the arm does not control any, and for a joint move.
    """

    s: Floats
    q: Floats
    tool: Floats
    wanted: Floats
    distance: Floats
    turn: Floats

    @property
    def worst(self) -> int:
        """Index of the largest distance."""
        return int(np.argmax(self.distance))


@dataclass(frozen=True, eq=False)
class Steps:
    """A stretch of a plan, step by step; each step is computed when it is first needed.

    Attributes
    ----------
    question : Question
    leg : Leg
        What has become of the stretch.
    stretch : Stretch
    """

    question: Question
    leg: Leg
    stretch: Stretch

    @property
    def arm(self) -> Arm:
        """The arm."""
        return self.question.arm

    @property
    def in_space(self) -> bool:
        """Whether the path is one of the tool, so that there are all five steps."""
        return self.stretch.move.space == "cartesian"

    @property
    def way(self) -> ToolPath | None:
        """Step 2: the path of the tool, or None for a joint move, or if there is no path."""
        return self.leg.tool_path

    @property
    def followed(self) -> Followed | None:
        """Steps 3 and 4: the samples and their inverse kinematics."""
        return self.leg.followed

    @property
    def path(self) -> Path | None:
        """Step 5: the path of the joints, or None."""
        return self.leg.path

    # -- 1: knots ----------------------------------------------------------------------------------------------------

    @cached_property
    def knot_q(self) -> Floats:
        """Joint values of the knots, (k, n); the first of a joint move is the end of the previous move."""
        q = np.array([point.q for point in self._waypoints])
        if not self.in_space and self.path is not None:
            q[0] = self.path.at(0.0)
        return q

    @cached_property
    def knot_poses(self) -> Floats:
        """Poses of the tool at the knots, (k, 4, 4), world."""
        if not self.in_space:
            return np.asarray(self.arm.fk(self.knot_q), dtype=np.float64)
        poses = np.array([point.wanted(self.arm) for point in self._waypoints])
        if self.way is not None:
            poses[0] = self.way.pose(0.0)
        return poses

    @property
    def _waypoints(self) -> tuple[Waypoint, ...]:
        return self.question.waypoints[self.stretch.first : self.stretch.last + 1]

    # -- 2: the path in space ----------------------------------------------------------------------------------------

    @cached_property
    def drawn(self) -> Floats:
        """Points of the tool path, (DRAWN, 3), or the ends of the straight lines between the knots, (k, 3)."""
        if self.way is None:
            return self.knot_poses[:, :3, 3]
        return np.asarray(self.way.pose(np.linspace(0.0, 1.0, DRAWN))[:, :3, 3])

    @cached_property
    def length(self) -> float:
        """Length of the path of the tool point, or of the straight lines, metres."""
        points = self.drawn if self.way is None else self.way.pose(np.linspace(0.0, 1.0, FINE))[:, :3, 3]
        return length_of(points)

    @cached_property
    def turn(self) -> float:
        """Angle through which the tool turns along its path, radians."""
        return 0.0 if self.way is None else swept(self.way.orientation)

    # -- 3 and 4: samples and their inverse kinematics ---------------------------------------------------------------

    @cached_property
    def samples(self) -> Floats:
        """Tool points of the samples, (N, 3), metres; (0, 3) if there are none."""
        if self.way is None or self.followed is None:
            return np.zeros((0, 3))
        return np.asarray(self.way.pose(self.followed.s)[:, :3, 3])

    @property
    def spacing(self) -> float:
        """Largest distance of two samples in a row, metres."""
        return float(np.linalg.norm(np.diff(self.samples, axis=0), axis=1).max(initial=0.0))

    @cached_property
    def worth(self) -> NDArray[np.int_]:
        """`Feasible` of each sample, (N,)."""
        if self.followed is None:
            return np.zeros(0, dtype=int)
        found = self.followed
        near = np.where(np.nan_to_num(found.singular_value) < NEAR, Feasible.NEAR_SINGULAR, Feasible.YES)
        return np.where(found.reached, near, Feasible.NOT_REACHED).astype(int)

    @cached_property
    def shown_arms(self) -> tuple[tuple[float, Floats], ...]:
        """Places s and joint values of a few configurations along the path; for a joint move those at the knots."""
        if not self.in_space:
            return tuple(zip(self.knot_places.tolist(), self.knot_q, strict=True))
        if self.followed is None:
            return ()
        solved = np.flatnonzero(self.followed.reached)
        picked = solved[np.unique(np.linspace(0, len(solved) - 1, ARMS).round().astype(int))] if len(solved) else solved
        return tuple((float(self.followed.s[k]), self.followed.q[k]) for k in picked)

    @property
    def least_singular(self) -> tuple[float, float] | None:
        """Ratio of smallest to largest singular value where it is least, and the s; None without any sample."""
        if self.followed is None or not self.followed.reached.any():
            return None
        k = int(np.nanargmin(self.followed.singular_value))
        return float(self.followed.singular_value[k]), float(self.followed.s[k])

    @property
    def branch(self) -> str:
        """The name of the arm's branch at the start of the path; empty if branches have no names."""
        if self.followed is None or not self.followed.reached[0]:
            return ""
        name = branch_names(self.arm, self.followed.q[:1])[0]
        return "" if name.startswith("solution") else name

    # -- 5: the path of the joints -----------------------------------------------------------------------------------

    @cached_property
    def knot_places(self) -> Floats:
        """The s of the knots of a joint move, (k,)."""
        if self.path is None:
            return np.linspace(0.0, 1.0, len(self.knot_q))
        return places(self.path, self.knot_q)

    @property
    def course(self) -> Callable[[Floats], Floats] | None:
        """Joint values (k, n) at places s (k,) of step 5; None without any.

        Joints that go each by itself have no path that they share: their s is t/T, the part of the time that is over.
        """
        motion = self.leg.motion
        if not self.stretch.move.independent:
            return None if self.path is None else self.path.at
        return None if motion is None else lambda s: motion.at(s * motion.duration)

    @cached_property
    def apart(self) -> Apart | None:
        """Distance of the tool from its path, or for a joint move from the straight lines; None without a path."""
        if self.path is None or self.course is None:
            return None
        if self.way is None or self.followed is None:
            return _beside_lines(self.arm, self.course, self.knot_places, self.knot_poses[:, :3, 3])
        return _beside_way(self.arm, self.path, self.way, between(self.followed.s))

    @cached_property
    def larger(self) -> float:
        """Factor by which the distance from the path is drawn larger, so that it is visible."""
        if self.apart is None or not self.in_space:
            return 1.0
        most = float(self.apart.distance.max()) / self.arm.length_scale
        return 1.0 if most < UNSEEN else next((k for k in LARGER if k * most <= DRAWN_APART), 1.0)

    @cached_property
    def tool_length(self) -> float:
        """Length of the tool's path while the joints follow theirs, metres; 0 without a path."""
        if self.course is None:
            return 0.0
        return length_of(np.asarray(self.arm.position(self.course(np.linspace(0.0, 1.0, FINE)))))


def steps(state: State) -> Steps | None:
    """Return the steps of the chosen stretch, in the motion planned last, or None while there are none."""
    planned, chosen = last_planned(state), state[Plan].stretch
    if planned is None or chosen is None:
        return None
    for leg in planned.legs:
        if leg.stretch is not None and (leg.stretch.first, leg.stretch.last) == (chosen.first, chosen.last):
            return Steps(planned.question, leg, leg.stretch)
    return None


def length_of(points: Floats) -> float:
    """Return the length of the line through points (k, 3), metres."""
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def between(s: Floats) -> Floats:
    """Return places at which a path through samples is evaluated: the samples and an odd number between each two.

    If the samples are many the places are only those half way between them.
    """
    if len(s) - 1 > BETWEEN:
        return 0.5 * (s[1:] + s[:-1])
    parts = 2 * max(1, BETWEEN // (len(s) - 1))
    share = np.arange(parts) / parts
    return np.append((s[:-1, None] + share * np.diff(s)[:, None]).ravel(), s[-1])


def _beside_way(arm: Arm, path: Path, way: ToolPath, s: Floats) -> Apart:
    q, wanted = path.at(s), way.pose(s)
    pose = np.asarray(arm.fk(q), dtype=np.float64)
    tool, there = pose[:, :3, 3], wanted[:, :3, 3]
    # In the axes of frame 0, in which the coordinates of a task are.
    error = (tool - there) @ arm.base[:3, :3]
    held = arm.task.coordinates or [0, 1, 2]
    return Apart(s, q, tool, there, np.linalg.norm(error[:, held], axis=1), _turn(arm, pose, wanted))


def _turn(arm: Arm, pose: Floats, wanted: Floats) -> Floats:
    """Return the angle between orientations, (k,), in the components that the arm controls."""
    if arm.task.rotation == "none":
        return np.zeros(len(pose))
    if arm.task.rotation == "approach":
        z, its = pose[:, :3, 2], wanted[:, :3, 2]
        return np.asarray(np.arctan2(np.linalg.norm(np.cross(z, its), axis=1), np.sum(z * its, axis=1)))
    _, angle = axis_angle(pose[:, :3, :3].transpose(0, 2, 1) @ wanted[:, :3, :3])
    return np.asarray(angle)


def _beside_lines(arm: Arm, course: Callable[[Floats], Floats], knots: Floats, corners: Floats) -> Apart:
    s = np.union1d(np.linspace(0.0, 1.0, 2 * BETWEEN + 1), knots)
    q = course(s)
    tool = np.asarray(arm.position(q), dtype=np.float64)
    wanted = nearest_on(corners, tool)
    return Apart(s, q, tool, wanted, np.linalg.norm(tool - wanted, axis=1), np.zeros(len(s)))


def nearest_on(corners: Floats, points: Floats) -> Floats:
    """Return the nearest points, (k, 3), of the straight lines through corners (c, 3) to points (k, 3)."""
    start, along = corners[:-1], np.diff(corners, axis=0)
    square = np.sum(along * along, axis=1)
    share = np.einsum("kci,ci->kc", points[:, None] - start, along) / np.where(square > 0.0, square, 1.0)
    near = start + np.clip(share, 0.0, 1.0)[:, :, None] * along
    best = np.argmin(np.linalg.norm(near - points[:, None], axis=2), axis=1)
    return np.asarray(near[np.arange(len(points)), best])


def kept(found: Steps | None, before: Steps | None) -> Steps | None:
    """Return the earlier steps if they are the same, because their numbers are known."""
    same = found is not None and before is not None and found.leg is before.leg
    return before if same else found
