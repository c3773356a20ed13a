"""The geometric paths of a plan: curves through the waypoints, before any inverse kinematics."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.moves import EULER_AXES, Stretch, Waypoint
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik import judge
from armlab.kin.motion import Orientation, Path, Through, ToolPath, about_one_axis, by_euler_angles, held
from armlab.kin.wrist import wrist_centre

Floats = NDArray[np.float64]

FINE = 2001
"""Number of samples of a path among which the place of a waypoint is looked for."""


def joint_path(arm: Arm, stretch: Stretch, knots: Floats) -> Path:
    """Return the path of a stretch in joint space through configurations (k, n); `InputError` names the move.

    Where the way between waypoints has a length, it is in radians; see `joint_scales`.
    """
    return _laid(stretch, knots, joint_scales(arm))


def joint_scales(arm: Arm) -> Floats | None:
    """Return the length of each joint's motion that counts as a radian, (n,): for prismatic joints the length scale.

    None of an arm whose joints are all of one kind: the way is in radians or in metres.
    """
    if arm.revolute.all() or not arm.revolute.any():
        return None
    return np.where(arm.revolute, 1.0, arm.length_scale)


def tool_path(arm: Arm, stretch: Stretch, poses: Floats) -> ToolPath:
    """Return the path of the tool along a stretch through poses (k, 4, 4).

    Raises
    ------
    InputError
        The path cannot be laid through them; the text names the move.
    """
    move = stretch.move
    turns = arm.task.rotation != "none"
    point = np.zeros(3)
    if move.turning == "wrist" and turns:
        centre = wrist_centre(arm)
        if centre is None:
            raise InputError(f"move {stretch.title}: the last three axes of {arm.name} do not meet in a point")
        point = centre
    position = _laid(stretch, poses[:, :3, :3] @ point + poses[:, :3, 3])
    passing = passed(stretch, poses)
    rotations = passing[:, :3, :3]
    points = rotations @ point + passing[:, :3, 3]
    return ToolPath(position, _orientation(stretch, position, points, rotations, turns), point)


def passed(stretch: Stretch, poses: Floats) -> Floats:
    """Return the poses that the path through poses (k, 4, 4) has one after the other: some end in the first again."""
    return np.concatenate([poses, poses[:1]]) if stretch.move.returns else poses


def _orientation(stretch: Stretch, position: Path, points: Floats, R: Floats, turns: bool) -> Orientation:
    turning = stretch.move.turning
    if not turns or turning == "kept":
        return held(R[0])
    if turning == "euler":
        if len(R) > 2:
            raise InputError(
                f"move {stretch.title}: Euler angles go from one waypoint to the next; stop at waypoint "
                f"{stretch.first + 2}, or rotate about one axis"
            )
        return by_euler_angles(R[0], R[1], EULER_AXES)
    if len(R) == 2:
        return about_one_axis(R[0], R[1])
    return Through(R, places(position, points), position.corners)


def places(path: Path, points: Floats) -> Floats:
    """Return the s at which a path passes points (k, m), or comes nearest to them, increasing from 0 to 1.

    Together, and not one after the other: a path may pass a point again where a later one is meant.
    """
    s = np.linspace(0.0, 1.0, FINE)
    if len(points) < 3:
        return np.array([0.0, 1.0])
    curve, places = path.at(s), np.arange(FINE)
    # Least sum of squared distances of all points so far with the last of them at each sample, and where the one
    # before it is then; the first and last sample belong to the ends.
    total, before = np.where(places == 0, 0.0, np.inf), []
    for point in points[1:-1]:
        least = np.minimum.accumulate(total)[:-1]
        first = np.concatenate([[True], least[1:] < least[:-1]])
        before.append(np.concatenate([[0], np.maximum.accumulate(np.where(first, places[:-1], 0))]))
        total = np.concatenate([[np.inf], least]) + np.sum((curve - point) ** 2, axis=1)
    found = [int(np.argmin(total[:-1]))]
    for each in reversed(before[1:]):
        found.append(int(each[found[-1]]))
    exact = [_snapped(float(s[place]), path.pieces) for place in reversed(found)]
    return np.array([0.0, *exact, 1.0])


def _snapped(place: float, pieces: Floats) -> float:
    """Return the end of a piece that is at most one sample away, because the path passes its waypoint there exactly."""
    if not len(pieces):
        return place
    nearest = float(pieces[int(np.abs(pieces - place).argmin())])
    return nearest if abs(nearest - place) <= 1.0 / (FINE - 1) else place


def shortfall(arm: Arm, point: Waypoint) -> str:
    """Return in words the distance of a waypoint's pose from the arm's tool; empty if the tool reaches it."""
    if point.pose is None:
        return ""
    found = judge(arm, point.wanted(arm), np.array(point.q))
    return "" if found.reached else f"{1e3 * found.position_error:.1f} mm out of reach"


def refuse_coincident(arm: Arm, waypoints: Sequence[Waypoint], parts: Sequence[Stretch]) -> None:
    """Raise `InputError` if two waypoints in a row are the same, and the path between them needs a length."""
    for stretch in parts:
        if not stretch.move.kind.apart:
            continue
        for k in range(stretch.first, stretch.last):
            one, other = waypoints[k], waypoints[k + 1]
            if stretch.move.space == "joint":
                same = np.allclose(one.q, other.q, rtol=0.0, atol=1e-9)
                what = "the same configuration as"
            else:
                here, there = one.wanted(arm), other.wanted(arm)
                same = np.allclose(here[:3, 3], there[:3, 3], rtol=0.0, atol=1e-9 * arm.length_scale)
                what = "at the same place as"
            if same:
                more = "" if stretch.move.space == "joint" else "; to rotate the tool in place, use a joint move"
                raise InputError(f"waypoint {k + 2}: {what} waypoint {k + 1}; move or remove one of them{more}")


def _laid(stretch: Stretch, points: Floats, scales: Floats | None = None) -> Path:
    """Return the path of a stretch; its errors name the move, and the waypoints of the plan."""
    try:
        return stretch.move.kind.path(points, scales=scales, **stretch.move.path.options)
    except InputError as refusal:
        raise InputError(f"move {stretch.title}: {counted(str(refusal), stretch.first)}") from None


def counted(text: str, first: int) -> str:
    """Return a sentence with its waypoints counted from the start of the plan."""
    if first == 0:
        return text

    def raised(found: re.Match[str]) -> str:
        return re.sub(r"\d+", lambda number: str(int(number[0]) + first), found[0])

    return re.sub(r"\bwaypoints? \d+(?: (?:and|to) \d+)?", raised, text, flags=re.IGNORECASE)
