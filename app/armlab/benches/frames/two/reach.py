"""The meeting of two robots: the pose that robot B has to reach in its own base, and its solutions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.benches.frames.two.state import LINK_A, TwoRobots
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import inverse, transform
from armlab.session.state import State

Floats = NDArray[np.float64]

SAME = 1e-6
"""Angle, radians, and length, metres, up to which the tool of B is as it has to be."""

FOLDED = "folded"
"""Name of the configuration with the tool on the base."""


@lru_cache(maxsize=64)
def planar(links: int, length: float) -> Arm:
    """Return a planar arm with links of one length, metres, about parallel axes, on frame 0."""
    return Arm.from_dh([("R", length, 0.0, 0.0, 0.0)] * links)


@dataclass(frozen=True, eq=False)
class Way:
    """One configuration of robot B.

    Attributes
    ----------
    q : ndarray, shape (n,)
        Radians.
    name : str
        Such as ``"elbow up"``.
    turned_off : float
        Angle by which its tool misses the wanted orientation, radians in (-pi, pi].
    off : float
        Distance of its tool from the wanted place, metres.
    """

    q: Floats
    name: str
    turned_off: float
    off: float

    @property
    def meets(self) -> bool:
        """Whether the tool is as the pose says, orientation included."""
        return abs(self.turned_off) < SAME and self.off < SAME


@dataclass(frozen=True, eq=False)
class Meeting:
    """The equations 3.125 to 3.133 with numbers.

    Attributes
    ----------
    T_wa, T_wb, T_a_ea, T_ea_eb, T_w_eb, T_b_eb : ndarray, shape (4, 4)
        Poses by their names: ``T_a_ea`` is the tool of A in the base of A.
    angle : float
        Of the tool of B in the base of B, about z, radians.
    distance : float
        From the base of B to the place of its tool, metres.
    joints : int
        Number of joints of B.
    link : float
        Length of each of its links, metres.
    asked : float
        Distance from the base of B, metres, which its first two links have to bridge: to the tool, or with three links
        and the pose given to the axis of joint 3.
    ways : tuple of Way
        Solutions; of two links with a pose asked, those of the position, of which few have the orientation.
    sentence : str
        Whether these are all, and why there are none.
    nearest : ndarray, shape (n,)
        The stretched arm that points there, for when there is no solution.
    needs_angle : bool
        Whether the orientation counts.
    """

    T_wa: Floats
    T_wb: Floats
    T_a_ea: Floats
    T_ea_eb: Floats
    T_w_eb: Floats
    T_b_eb: Floats
    angle: float
    distance: float
    joints: int
    link: float
    asked: float
    ways: tuple[Way, ...]
    sentence: str
    nearest: Floats
    needs_angle: bool

    @property
    def reach(self) -> float:
        """The distance that two links bridge, metres."""
        return 2.0 * self.link

    @property
    def solutions(self) -> tuple[Way, ...]:
        """The configurations that do all that is asked."""
        return tuple(way for way in self.ways if way.meets or not self.needs_angle)

    @property
    def only_link(self) -> float | None:
        """The length of two equal links, metres, with which a 2R arm has the whole pose, and in one way; or None.

        With u along the tool the elbow is at p - l u, and l away from the base: l = |p|^2 / (2 p . u).
        """
        p, u = self.T_b_eb[:2, 3], self.T_b_eb[:2, 0]
        along = float(p @ u)
        return None if along <= SAME else float(p @ p) / (2.0 * along)


def meeting(part: TwoRobots) -> Meeting:
    """Return the meeting of both robots."""
    T_wa, T_wb = part.base("A"), part.base("B")
    T_a_ea = np.asarray(planar(2, LINK_A).fk(part.q_a), dtype=np.float64)
    T_ea_eb = np.asarray(transform(rotation_about("z", part.between)), dtype=np.float64)
    T_w_eb = T_wa @ T_a_ea @ T_ea_eb
    T_b_eb = np.asarray(inverse(T_wb) @ T_w_eb)
    p, angle = T_b_eb[:2, 3], math.atan2(float(T_b_eb[1, 0]), float(T_b_eb[0, 0]))
    joints = 3 if part.version == "three_links" else 2
    arm = planar(joints, part.link)
    found = ik.solve_all(arm, T_b_eb)
    ways = tuple(_way(arm, q, name, T_b_eb) for q, name in zip(found.q, found.names, strict=True))
    if part.version == "two_links" and np.linalg.norm(p) < SAME:
        # Of the folded arms, which all have the position, those found are samples: the one with the angle is made here.
        ways = (_way(arm, np.array([math.remainder(angle - math.pi, 2.0 * math.pi), math.pi]), FOLDED, T_b_eb),)
    wrist = p - part.link * T_b_eb[:2, 0] if joints == 3 else p
    towards = math.atan2(float(wrist[1]), float(wrist[0]))
    nearest = [towards, 0.0] if joints == 2 else [towards, 0.0, math.remainder(angle - towards, 2.0 * math.pi)]
    return Meeting(
        T_wa,
        T_wb,
        T_a_ea,
        T_ea_eb,
        T_w_eb,
        T_b_eb,
        angle,
        float(np.linalg.norm(p)),
        joints,
        part.link,
        float(np.linalg.norm(wrist)),
        ways,
        found.sentence,
        np.array(nearest),
        part.version != "two_links_position",
    )


def _way(arm: Arm, q: Floats, name: str, wanted: Floats) -> Way:
    T = np.asarray(arm.fk(q), dtype=np.float64)
    between = T[:3, :3].T @ wanted[:3, :3]
    turned_off = math.atan2(float(between[1, 0]), float(between[0, 0]))
    return Way(np.asarray(q), name, turned_off, float(np.linalg.norm(T[:3, 3] - wanted[:3, 3])))


def meeting_of(state: State) -> Meeting:
    """Return the meeting of both robots."""
    return meeting(state[TwoRobots])


def shown_way(state: State) -> Way | None:
    """Return the configuration in which B is drawn: the chosen elbow, if there is one of that name, else the first."""
    found, elbow = state.derived(meeting_of), state[TwoRobots].elbow
    ways = found.solutions or found.ways
    return next((way for way in ways if way.name.endswith(elbow)), ways[0] if ways else None)


def q_of_b(state: State) -> Floats:
    """Return the joint values with which B is drawn, (n,), radians; stretched towards the place if out of reach."""
    way = state.derived(shown_way)
    return state.derived(meeting_of).nearest if way is None else way.q


def end_of_b(state: State) -> Floats:
    """Return the pose in the world of the tool of B as it is drawn, (4, 4)."""
    found = state.derived(meeting_of)
    return np.asarray(found.T_wb @ planar(found.joints, found.link).fk(q_of_b(state)))
