"""The region of a planar arm in which its tool is, and commands that bring it into one or into a singularity."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.planar import lengths_of, tool_angles
from armlab.kin.workspace.planar_pose import Place, along_ray, configurations, place_of, stretched
from armlab.kin.workspace.planar_regions import Region, region_at, regions
from armlab.kin.workspace.sheet_maps import sheet_of
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import SAME, Target, target_pose
from armlab.session.state import Command, State

ON = 1e-4
"""Distance, in reaches of the arm, within which the tool counts as on a circle."""


@dataclass(frozen=True)
class Standing:
    """The place of the tool of a planar arm.

    Attributes
    ----------
    place : Place
    region : Region or None
        None outside WS1, which only a target can be.
    """

    place: Place
    region: Region | None


def tool_standing(state: State) -> Standing | None:
    """Return the place of the tool, or None if the arm is not planar."""
    arm = state[Joints].arm
    lengths = lengths_of(arm)
    if lengths is None:
        return None
    place = place_of(arm, state[Joints].q)
    return Standing(place, region_near(lengths, place.r))


def target_distance(state: State) -> float | None:
    """Return the distance of a planar arm's target from the first axis, metres, or None while it is at the tool."""
    arm = state[Joints].arm
    if state[Target].pose is None or lengths_of(arm) is None:
        return None
    return float(first_joint(arm).split(target_pose(state)[:3, 3])[0])


def region_near(lengths: tuple[float, ...], r: float) -> Region | None:
    """Return the region of a radius in metres, or a circle near it if there is one."""
    near = [one for one in regions(lengths) if one.low == one.high and abs(one.low - r) <= ON * sum(lengths)]
    return near[0] if near else region_at(lengths, r)


def outermost(state: State) -> NDArray[np.float64] | None:
    """Return four points of the outer circle of a planar arm, (4, 3) in the world, metres, or None for other arms."""
    arm = state[Joints].arm
    lengths = lengths_of(arm)
    if lengths is None:
        return None
    around = sum(lengths) * np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    return sheet_of(arm, 0.0).points(around)


@dataclass(frozen=True)
class GoToRegion(Command):
    """Bring the tool into the middle of a region, or onto its circle, along its present ray from the axis.

    Parameters
    ----------
    index : int
        0-based, from the inside out.
    """

    index: int
    label: ClassVar[str] = "move into a region"

    def apply(self, state: State) -> State:
        """Return the state with the tool there; `InputError` if joint limits or held joints forbid it."""
        arm, found = state[Joints].arm, regions(_lengths(state))
        if not 0 <= self.index < len(found):
            raise InputError(f"region: expected 1 to {len(found)}, got {self.index + 1}")
        region = found[self.index]
        inside = _on_circle(state, region) if region.ways else _in_the_middle(state, region)
        free = [q for q in inside if not _held_off(state, q)]
        if not free and not region.ways:
            free = _within(state, region, state[Joints].locked)
        if free:
            return state.replace(state[Joints].moved_to(free[0]))
        if inside or (not region.ways and _within(state, region, (False,) * arm.n)):
            raise InputError("the held joints keep the tool from that region along this line: release them first")
        raise InputError("the joint limits keep the tool from that region along this line")


@dataclass(frozen=True)
class StandStretched(Command):
    """Stretch or fold the arm onto the line to its tool: a singular configuration of a circle.

    Parameters
    ----------
    index : int
        Of the region, 0-based from the inside out.
    way : int
        Which of its configurations, 0-based.
    """

    index: int
    way: int
    label: ClassVar[str] = "singular configuration"

    def apply(self, state: State) -> State:
        """Return the state with the arm in that configuration; `InputError` if there is none or limits forbid it."""
        arm, found = state[Joints].arm, regions(_lengths(state))
        ways = found[self.index].ways if 0 <= self.index < len(found) else ()
        if not 0 <= self.way < len(ways):
            raise InputError("there is no singular configuration of that number")
        theta = place_of(arm, state[Joints].q).theta
        q = stretched(arm, ways[self.way], theta)
        if held := _held_off(state, q):
            raise InputError(f"joint {held[0]} is held and would have to move: release it first")
        return state.replace(state[Joints].moved_to(q))


def possible_joints(arm: Arm, lengths: tuple[float, ...], place: Place) -> list[NDArray[np.float64]]:
    """Return the arcs of angles, rad, at which joint 3 can be on the circle of radius l3 about the tool point.

    Each is (first, last), in the axes of the arm's `FirstJoint`, seen from the tool point.
    """
    low, high = (float(value) for value in tool_angles(lengths, place.r))
    if not low <= high:
        return []
    back = place.theta + np.pi
    if low <= 0.0 and high >= np.pi:
        return [np.array([back, back + 2.0 * np.pi])]
    if low <= 0.0:
        return [np.array([back - high, back + high])]
    if high >= np.pi:
        return [np.array([back + low, back + 2.0 * np.pi - low])]
    return [np.array([back + low, back + high]), np.array([back - high, back - low])]


def _on_circle(state: State, region: Region) -> list[NDArray[np.float64]]:
    """Return the singular configurations of a circle that the limits allow, along the present ray."""
    arm = state[Joints].arm
    theta = place_of(arm, state[Joints].q).theta
    found = []
    for signs in region.ways:
        with suppress(InputError):
            found.append(stretched(arm, signs, theta))
    return found


def _in_the_middle(state: State, region: Region) -> list[NDArray[np.float64]]:
    """Return the configurations in the middle of a ring that the limits allow, the nearest first.

    The last link of a 3R is turned as little as possible.
    """
    arm, q, lengths = state[Joints].arm, state[Joints].q, _lengths(state)
    now, r = place_of(arm, q), 0.5 * (region.low + region.high)
    psi = _nearest_angle(lengths, r, now.psi) if len(lengths) == 3 else now.psi
    inside = [each for each in configurations(arm, Place(r, now.theta, psi)) if arm.within_limits(each)]
    return sorted(inside, key=lambda each: _way(each, q))


def _within(state: State, region: Region, held: tuple[bool, ...]) -> list[NDArray[np.float64]]:
    """Return the configuration with which the tool comes nearest to the middle of a ring, if any leads into it."""
    arm, q = state[Joints].arm, state[Joints].q
    rows, r = along_ray(arm, place_of(arm, q).theta, np.where(held, q, np.nan))
    off = np.abs(r - 0.5 * (region.low + region.high))
    edge = ON * sum(_lengths(state))
    if not off.size or off.min() >= 0.5 * (region.high - region.low) - edge:
        return []
    return [rows[int(np.argmin(off))]]


def _held_off(state: State, q: NDArray[np.float64]) -> list[int]:
    """Return the held joints, 1-based, that a configuration would move."""
    joints = state[Joints]
    return [i + 1 for i in range(joints.arm.n) if joints.locked[i] and abs(q[i] - joints.q[i]) > SAME]


def _lengths(state: State) -> tuple[float, ...]:
    lengths = lengths_of(state[Joints].arm)
    if lengths is None:
        raise InputError("arm: expected a planar arm of two or three links with revolute joints")
    return lengths


def _nearest_angle(lengths: tuple[float, ...], r: float, psi: float) -> float:
    """Return the possible angle nearest to a given one, a little inside the ends of a range."""
    low, high = (float(value) for value in tool_angles(lengths, r))
    inset = 0.05 * (high - low)
    low, high = low if low <= 0.0 else low + inset, high if high >= np.pi else high - inset
    return float(np.copysign(np.clip(abs(psi), low, high), psi))


def _way(q: NDArray[np.float64], now: NDArray[np.float64]) -> float:
    return float(np.abs(q - now).sum())
