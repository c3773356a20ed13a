"""Places for boxes within the reach of an arm, and the waypoints that bring one to the goal, by inverse kinematics."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.moves import Gripper, Move, Waypoint, checked_q, flat_pose
from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.ik.target import feasible
from armlab.kin.motion import ToolPath, about_one_axis, follow, held, path_type
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import inverse, transform

Floats = NDArray[np.float64]
Point = tuple[float, float, float]

MOST_BOXES = 3
"""Largest number of boxes."""

BOX = 0.1
"""Edge of a box, in length scales of the arm."""

LIFTS, LOW_LIFTS = (0.4, 0.25, 0.15), (0.1, 0.07)
"""Ways back from a box, in length scales of the arm: the first that the arm can go is taken, low ones where it can go
no other anywhere. A SCARA with a long stroke has little room between its flange and the table."""

HEIGHTS = (0.5 * BOX, 0.2, 0.4, 0.7)
RADII = (1.0, 0.8, 1.2, 0.6)
TURNS = (0.6, 1.0, 0.35)
"""Heights of the boxes above the foot of the arm and distances from its first axis, in its length scales, and half the
angles from the first box to the goal, radians: the first that the arm reaches are taken."""

LEAST_RADIUS = 0.2
"""Least distance of the tool at home from the first axis, in length scales, that is tried for boxes, too."""

NEXT = 2.0
"""Distance from one box to the next, in edges."""

SEARCHES, SAMPLES = 3, 41
"""Starts of the inverse kinematics for each place, and samples of the line to a box."""

KEPT = 64
"""Number of arms whose places are kept."""

WAIT = 0.4
"""Wait where the gripper closes or opens in the example, seconds."""

DOES: tuple[tuple[Gripper, float], ...] = (("open", 0.0), ("close", WAIT), ("leave", 0.0), ("open", WAIT))
"""Actions of the gripper at the four waypoints, and waits."""

WELL_CONDITIONED = 0.08
"""Ratio of smallest to largest singular value of the task Jacobian from which on a line to a box is gone along."""

DECIMALS = 4
"""Decimals of the places of boxes, metres."""

JOINT, LINE = Move(), Move("cartesian")


class Table(NamedTuple):
    """Boxes and goal (world, metres), and waypoints and moves that bring the first box there."""

    boxes: tuple[Point, ...]
    goal: Point
    waypoints: tuple[Waypoint, ...]
    moves: tuple[Move, ...]


def edge_of(arm: Arm) -> float:
    """Return the edge of a box for an arm, metres."""
    return BOX * arm.length_scale


@lru_cache(maxsize=KEPT)
def table_of(robot: Robot) -> Table:
    """Return places for boxes and a goal within the reach of an arm, and how it brings the first box there.

    Raises
    ------
    InputError
        The arm cannot do it; the text says why.
    """
    arm = robot.arm
    if len(arm.task.position) < 2:
        raise InputError(
            f"pick and place: {arm.name} does not position its tool in a plane or in space, so there are no "
            f"boxes for it"
        )
    home = np.array(robot.home, dtype=float)
    tried = itertools.product((LIFTS, LOW_LIFTS), _orientations(arm), _places(arm, home))
    for lifts, down, (boxes, goal, back) in tried:
        hand = Hand(arm, home, down)
        found = _brought(hand, boxes[0], goal, back, lifts)
        if found is None:
            continue
        near = np.array(found[1].q)
        there = [each for each in boxes if _reached(arm, hand.at(each), near) is not None]
        if len(there) > 1:
            points, moves = _along_lines(arm, found)
            return Table(tuple(map(_point, there[:MOST_BOXES])), _point(goal), points, moves)
    raise InputError(
        f"pick and place: no place was found at which {arm.name} reaches boxes, the places above them and a "
        f"goal; type waypoints of your own, and put a box at one of them"
    )


def _places(arm: Arm, home: Floats) -> Iterator[tuple[list[Floats], Floats, Floats]]:
    """Yield boxes, some too many, and goal (world), with the way back from a box, a length scale long, to be tried."""
    base, size = arm.base, arm.length_scale
    at_home = (inverse(base) @ arm.fk(home))[:3, 3]
    azimuth = float(np.arctan2(at_home[1], at_home[0]))
    flat, beside = "z" not in arm.task.position, float(np.hypot(*at_home[:2]))
    radii = [*(size * share for share in RADII), *([beside] if beside > LEAST_RADIUS * size else [])]
    for height in [float(at_home[2])] if flat else [size * share for share in HEIGHTS]:
        for turn in TURNS:
            for radius in radii:
                step = NEXT * BOX * size / radius
                ways = [azimuth - turn - k * np.sign(turn) * step for k in range(MOST_BOXES)]
                spots = [
                    *((radius, way) for way in ways),
                    ((1.0 + step) * radius, ways[0]),
                    ((1.0 - step) * radius, ways[0]),
                ]
                *boxes, goal = [_around(base, r, way, height) for r, way in (*spots, (radius, azimuth + turn))]
                back = base[:3, 2] if not flat else -base[:3, :3] @ [np.cos(ways[0]), np.sin(ways[0]), 0.0]
                yield boxes, goal, size * np.asarray(back)


def _around(base: Floats, radius: float, azimuth: float, height: float) -> Floats:
    local = np.array([radius * np.cos(azimuth), radius * np.sin(azimuth), height])
    return np.asarray(np.round(base[:3, :3] @ local + base[:3, 3], DECIMALS), dtype=np.float64)


class Hand(NamedTuple):
    """How an arm holds its tool at a place: pointing down, or as at home and turned with the first axis."""

    arm: Arm
    home: Floats
    down: bool

    def at(self, place: Floats) -> Floats:
        """Return the pose of the tool at a place, (4, 4) in the world."""
        base = self.arm.base
        present = np.asarray(self.arm.fk(self.home), dtype=np.float64)
        if self.down:
            turns = [rotation_about("z", k * np.pi / 2.0) @ np.diag([1.0, -1.0, -1.0]) for k in range(4)]
            R = max((base[:3, :3] @ turn for turn in turns), key=lambda each: float(np.trace(each.T @ present[:3, :3])))
        else:
            there, here = (_azimuth(base, each) for each in (place, present[:3, 3]))
            R = base[:3, :3] @ rotation_about("z", there - here) @ base[:3, :3].T @ present[:3, :3]
        return np.asarray(feasible(self.arm, transform(R, place), present), dtype=np.float64)


def _orientations(arm: Arm) -> tuple[bool, ...]:
    """Return whether the tool is held down, in the order to be tried."""
    turned = arm.task.position == "xyz" and arm.task.rotation != "none"
    return (True, False) if turned else (False,)


def _azimuth(base: Floats, place: Floats) -> float:
    x, y, _ = base[:3, :3].T @ (place - base[:3, 3])
    return float(np.arctan2(y, x))


def _reached(arm: Arm, pose: Floats, near: Floats) -> Floats | None:
    """Return joint values that reach a pose, or None."""
    found = ik.solve(arm, pose, near, searches=SEARCHES, complete=False)
    return found.q if found.success else None


def _brought(hand: Hand, box: Floats, goal: Floats, back: Floats, lifts: tuple[float, ...]) -> list[Waypoint] | None:
    """Return the waypoints above a box, at the box, above the goal and at the goal, or None if one is not reached."""
    at_box = _reached(hand.arm, hand.at(box), hand.home)
    if at_box is None or _reached(hand.arm, hand.at(goal), at_box) is None:
        return None
    for lift in lifts:
        poses = [hand.at(place) for place in (box + lift * back, box, _over(hand.arm, goal, lift * back), goal)]
        found = _chain(hand.arm, poses, at_box)
        if found is not None:
            return [
                replace(Waypoint(checked_q(hand.arm, q), flat_pose(pose)), gripper=gripper, wait=wait)
                for q, pose, (gripper, wait) in zip(found, poses, DOES, strict=True)
            ]
    return None


def _chain(arm: Arm, poses: list[Floats], near: Floats) -> list[Floats] | None:
    """Return joint values for poses, each near those before, or None if one is not reached."""
    chain = []
    for pose in poses:
        found = _reached(arm, pose, near)
        if found is None:
            return None
        near = found
        chain.append(found)
    return chain


def _over(arm: Arm, goal: Floats, lift: Floats) -> Floats:
    """Return the place before the goal: above it, or for an arm in a plane nearer to its base."""
    if "z" in arm.task.position:
        return goal + lift
    away = goal - arm.base[:3, 3]
    return np.asarray(goal - away * float(np.linalg.norm(lift) / np.linalg.norm(away)))


def _along_lines(arm: Arm, points: list[Waypoint]) -> tuple[tuple[Waypoint, ...], tuple[Move, ...]]:
    """Return the waypoints with the moves between them: along a line to box and goal where the arm can follow one."""
    moves = [JOINT] * (len(points) - 1)
    for k in (0, 2):
        q = _end_of_line(arm, points[k], points[k + 1])
        if q is not None:
            # Of an arm with joints to spare the line ends in a configuration of its own.
            points[k + 1], moves[k] = replace(points[k + 1], q=checked_q(arm, q)), LINE
    return tuple(points), tuple(moves)


def _end_of_line(arm: Arm, start: Waypoint, end: Waypoint) -> Floats | None:
    """Return the joint values at the end of the line between two waypoints, or None if the arm cannot follow it."""
    first, last = start.wanted(arm), end.wanted(arm)
    position = path_type("line").path(np.array([first[:3, 3], last[:3, 3]]))
    turns = arm.task.rotation != "none"
    R = about_one_axis(first[:3, :3], last[:3, :3]) if turns else held(first[:3, :3])
    found = follow(arm, ToolPath(position, R, np.zeros(3)), start.q, SAMPLES)
    if not found.whole or np.nanmin(found.singular_value) < WELL_CONDITIONED:
        return None
    return np.asarray(found.joint_path().at(1.0))


def _point(place: Floats) -> Point:
    x, y, z = (float(value) + 0.0 for value in place)
    return x, y, z
