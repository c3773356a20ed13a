"""Names of solutions: on which side their elbow, shoulder, wrist and slide are.

Told from points and lines in space, so they hold for both conventions, for any offsets and any base. The elbow of a
planar arm is up where q2 is negative (Siciliano et al., *Robotics*, 2.12), that is, to the left of the way from
shoulder to hand seen against the axes; that of an arm turned by joint 1 is up where it is above the line from shoulder
to wrist. Left and right, front and back of a shoulder, and the sign of the wrist are those of the lesson check
``branch``; there "no flip" is called positive and "flip" negative. Arms that have none of these get numbers.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.closed_form import known_structure
from armlab.kin.ik.screws import cross
from armlab.kin.relations import Axes

Vector = NDArray[np.float64]
Tell = Callable[["Pose"], str]

BESIDE = 1e-6
"""Distance from a border, in length scales or as the sine of an angle, below which an arm is on neither side."""


class Pose:
    """Joint axes and tool of an arm in one configuration, in the world."""

    def __init__(self, arm: Arm, q: Vector) -> None:
        frames = np.asarray(arm.frames(q), dtype=np.float64)
        axes = frames[:-1] if arm.convention == "standard" else frames[1:]
        self.arm, self.q, self.points, self.directions = arm, q, axes[:, :3, 3], axes[:, :3, 2]
        # x after joint 1; the same in both conventions.
        self.x1 = frames[1, :3, 0]
        self.tool = frames[-1, :3, :3] @ arm.tool[:3, 3] + frames[-1, :3, 3]
        self.fourth = frames[4, :3, 3] if arm.n > 3 else self.tool

    def side(self, value: float, words: tuple[str, str, str]) -> str:
        """Return the first word for a positive length, the second for a negative one, the third for zero."""
        least = BESIDE * self.arm.length_scale
        return words[0] if value > least else words[1] if value < -least else words[2]


def branch_names(arm: Arm, q: NDArray[np.floating]) -> tuple[str, ...]:
    """Return a name for each solution, q of shape (k, n); the same name does not come twice.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)])
    >>> branch_names(arm, np.radians([[0.0, 90.0], [90.0, -90.0]]))
    ('elbow down', 'elbow up')
    """
    tells = features(arm)
    if not tells:
        return tuple(f"solution {k + 1}" for k in range(len(q)))
    names = []
    for row in q:
        pose = Pose(arm, np.asarray(row, dtype=np.float64))
        names.append(", ".join(tell(pose) for tell in tells))
    total, seen = Counter(names), Counter[str]()
    for k, name in enumerate(names):
        if total[name] > 1:
            seen[name] += 1
            names[k] = f"{name} ({seen[name]})"
    return tuple(names)


@lru_cache(maxsize=64)
def features(arm: Arm) -> tuple[Tell, ...]:
    """Return the features that distinguish the branches of an arm, the shoulder first."""
    axes, structure = Axes(arm), known_structure(arm)
    if structure.key in ("planar", "scara", "cylindrical"):
        return _of_plane(axes)
    if structure.key == "wrist":
        return (_wrist(1),)
    hand = arm.n == 6 and axes.turns(4, 6) and axes.perpendicular(4) and axes.perpendicular(5)
    spherical = hand and axes.meet(4)
    runs_on = arm.n > 3 and axes.turns(1, 4) and _parallel_apart(axes, 3)
    turning = arm.n >= 3 and axes.turns(1, 3) and axes.perpendicular(1) and _parallel_apart(axes, 2)
    found: list[Tell] = []
    if turning and (arm.n == 3 or spherical or runs_on):
        end = _end(arm, spherical, runs_on)
        # With a fourth parallel axis it is the point of axes 5 and 6 that stays beside the plane of axis 1.
        beside = _fifth if runs_on and hand else end
        found = [_shoulder(arm, beside, end, sided=arm.n == 6), _elbow((1, 2), end, turned=True)]
    elif axes.kinds[:3] == "RRP" and axes.perpendicular(1) and axes.perpendicular(2) and (arm.n == 3 or spherical):
        end = _end(arm, spherical, False)
        found = [_shoulder(arm, end, end, sided=arm.n == 6), _slide(2, 1, end)]
    if found and hand and (spherical or runs_on):
        found.append(_wrist(4))
    return tuple(found)


def _parallel_apart(axes: Axes, link: int) -> bool:
    return axes.parallel(link) and not axes.touching(link)


def _of_plane(axes: Axes) -> tuple[Tell, ...]:
    lifts = axes.beside_plane or []
    flats = [j - 1 for j in range(1, axes.arm.n + 1) if j not in lifts]
    kinds = "".join(axes.kinds[j] for j in flats)
    if kinds[:2] == "RR":
        hand = (lambda pose: pose.points[flats[2]]) if kinds[:3] == "RRR" else _tool
        return (_elbow((flats[0], flats[1]), hand, turned=False),)
    if kinds[:2] == "RP":
        end = (lambda pose: pose.points[flats[2]]) if kinds[:3] == "RPR" else _tool
        return (_slide(flats[1], flats[0], end),)
    return ()


Point = Callable[[Pose], Vector]


def _tool(pose: Pose) -> Vector:
    return pose.tool


def _fourth(pose: Pose) -> Vector:
    return pose.fourth


def _fourth_axis(pose: Pose) -> Vector:
    return np.asarray(pose.points[3])


def _fifth(pose: Pose) -> Vector:
    """Return the point where axes 5 and 6 meet: the origin of axis 6, or of axis 5 when that lies off axis 6."""
    o5, z5, o6, z6 = pose.points[4], pose.directions[4], pose.points[5], pose.directions[5]
    # Perpendicular axes: the foot on axis 5 of the point of axis 6.
    return np.asarray(o5 + ((o6 - o5) @ z5) * z5 if abs(z5 @ z6) < 1e-9 else o6)


def _end(arm: Arm, spherical: bool, runs_on: bool) -> Point:
    """Return the end of the forearm."""
    if spherical:
        return _fourth
    return _fourth_axis if runs_on else _tool


def _shoulder(arm: Arm, beside: Point, end: Point, sided: bool) -> Tell:
    zero = Pose(arm, np.zeros(arm.n))
    offset = float((beside(zero) - zero.points[0]) @ zero.directions[1])
    if not sided or abs(offset) <= BESIDE * arm.length_scale:
        return lambda pose: (
            "shoulder " + pose.side(float((end(pose) - pose.points[0]) @ pose.x1), ("front", "back", "above"))
        )

    def tell(pose: Pose) -> str:
        up, across = pose.directions[0], pose.directions[1]
        point = beside(pose) - pose.points[0]
        ahead = point - (point @ across) * across - (point @ up) * up
        value = float(cross(up, ahead) @ across) * math.copysign(1.0, offset)
        return "shoulder " + pose.side(value, ("left", "right", "above"))

    return tell


def _elbow(joints: tuple[int, int], hand: Point, turned: bool) -> Tell:
    def tell(pose: Pose) -> str:
        axis = pose.directions[joints[0]]
        origin = pose.points[0]

        def flat(p: Vector) -> Vector:
            return np.asarray(p - ((p - origin) @ axis) * axis)

        shoulder, elbow, end = (flat(p) for p in (pose.points[joints[0]], pose.points[joints[1]], hand(pose)))
        way = end - shoulder
        length = float(np.linalg.norm(way))
        least = BESIDE * pose.arm.length_scale
        if length <= least:
            return "elbow folded"
        way = way / length
        aside = elbow - shoulder - ((elbow - shoulder) @ way) * way
        if float(np.linalg.norm(aside)) <= least:
            # Folded, the elbow lies beyond the end, or with the longer forearm on the other side of the shoulder.
            return "elbow straight" if -least < (elbow - shoulder) @ way < length else "elbow folded"
        up = pose.directions[0] if turned else cross(axis, way)
        return "elbow " + pose.side(float(aside @ up), ("up", "down", "beside"))

    return tell


def _slide(slide: int, turn: int, end: Point) -> Tell:
    """Return the feature that says on which side of a revolute axis the end of a slide is."""

    def tell(pose: Pose) -> str:
        reach = float((end(pose) - pose.points[turn]) @ pose.directions[slide])
        return "slide " + pose.side(reach, ("ahead", "behind", "beside the axis"))

    return tell


def _wrist(joint: int) -> Tell:
    def tell(pose: Pose) -> str:
        sine = math.sin(float(pose.q[joint]) + pose.arm.rows[joint].theta)
        return "wrist " + ("no flip" if sine > BESIDE else "flip" if sine < -BESIDE else "straight")

    return tell
