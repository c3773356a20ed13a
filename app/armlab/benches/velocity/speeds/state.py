"""The bench of velocities: the speed of each joint, in whose axes J is written, and two points of a link."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.dh import link_transform
from armlab.kin.velocity.jacobians import AXES
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Json, Part, PartType, State

Floats = NDArray[np.float64]
Xyz = tuple[float, float, float]

CLIP_KEY = "speeds"

MATRIX = "jacobian"
"""Under which a selection in J is known to the scene."""

MARKS = ("v", "omega", "points")
"""What can be drawn: the parts of v with their sum, the parts of omega, and the two points of a link."""

FOLDS = ("points", "higher")
"""Parts of the page that can be folded away."""

FASTEST: dict[bool, float] = {True: math.pi, False: 1.0}
"""rad/s of a joint that turns, m/s of one that slides, at most, where the arm says no limit."""

USUAL: dict[bool, float] = {True: math.radians(30.0), False: 0.1}
"""rad/s and m/s at which joints begin, where their limits allow it."""

FARTHEST = 100.0
"""Metres; a point farther from its link is a slip of the pen."""

APART = 0.2
"""Of the length scale, between two points of a link that has no length."""

DRAWN, SAMPLES, SHARE = 0.45, 64, 0.9
"""Reaches of the arm that the longest arrow has in so large a share of so many random configurations."""


@dataclass(frozen=True, eq=False)
class Velocity(Part):
    """What the bench shows.

    Attributes
    ----------
    arm : Arm
    qdot : tuple of float
        Speed of each joint, rad/s or m/s; a held joint stands still all the same, see `speeds_of`.
    axes : "world", "base" or "tool"
        Of the rows of J.
    link : int
        Whose points are looked at; link i moves with joints 1 to i.
    points : tuple of two Xyz
        In the axes of the link's frame, metres.
    marks : frozenset of str
        Of `MARKS`.
    unfolded : frozenset of str
        Parts of the page, of `FOLDS`, that are not folded away.
    reached : float or None
        The second of the film to which the present joint values belong; None while it is not on.
    example : str
        Key of the example that is in place as it was put there; empty when it is none.
    """

    key: ClassVar[str] = "velocity"
    kept_by_undo: ClassVar[bool] = True

    arm: Arm
    qdot: tuple[float, ...]
    axes: str
    link: int
    points: tuple[Xyz, Xyz]
    marks: frozenset[str] = field(default_factory=lambda: frozenset(("v",)))
    unfolded: frozenset[str] = frozenset()
    reached: float | None = None
    example: str = ""

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return every joint at its usual speed, and the ends of the last link."""
        arm = robot.arm
        return cls(arm, tuple(usual_speed(arm, i) for i in range(arm.n)), "world", arm.n, ends_of(arm, arm.n))

    def for_robot(self, robot: Robot) -> Self:
        """Keep the axes and what is drawn."""
        return replace(self.initial(robot), axes=self.axes, marks=self.marks, unfolded=self.unfolded)

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the speeds of the joints that are still there and of their kind, and the link with typed points."""
        new, arm = self.for_robot(robot), robot.arm
        if self.link - 1 in origin:
            link = origin.index(self.link - 1) + 1
            own = self.points != ends_of(self.arm, self.link)
            new = replace(new, link=link, points=self.points if own else ends_of(arm, link))
        qdot = list(new.qdot)
        for i, before in enumerate(origin):
            if before is not None and self.arm.revolute[before] == arm.revolute[i]:
                qdot[i] = within(arm, i, self.qdot[before])
        return replace(new, qdot=tuple(qdot), reached=self.reached)

    def after(self, before: State, now: State) -> Self:
        """Forget where the film stood when it is taken off, and the example when a hand moves the arm away from it."""
        part = self
        if self.example and self is before[Velocity] and now[Joints].q is not before[Joints].q:
            part = replace(part, example="")
        return part if part.reached is None or now[Timeline].clip == CLIP_KEY else replace(part, reached=None)

    def to_json(self) -> Json:
        """Write everything."""
        return {
            "qdot": list(self.qdot),
            "axes": self.axes,
            "link": self.link,
            "points": [list(point) for point in self.points],
            "marks": sorted(self.marks),
            "unfolded": sorted(self.unfolded),
            "reached": self.reached,
            "example": self.example,
        }

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; raises when it does not fit the arm."""
        arm = robot.arm
        qdot, link = tuple(float(value) for value in data["qdot"]), int(data["link"])
        first, second = (checked_point([float(value) for value in point]) for point in data["points"])
        reached = None if data["reached"] is None else float(data["reached"])
        if len(qdot) != arm.n or not all(map(math.isfinite, qdot)) or not 1 <= link <= arm.n:
            raise InputError(f"velocity: not usable: {data}")
        for names, known in (([data["axes"]], AXES), (data["marks"], MARKS), (data["unfolded"], FOLDS)):
            for name in names:
                if name not in known:
                    raise UnknownName("velocity", name, known)
        if reached is not None and not (math.isfinite(reached) and reached >= 0.0):
            raise InputError(f"velocity, reached: expected seconds, got {reached}")
        inside = tuple(within(arm, i, value) for i, value in enumerate(qdot))
        marks, unfolded = frozenset(data["marks"]), frozenset(data["unfolded"])
        points = first, second
        return cls(arm, inside, data["axes"], link, points, marks, unfolded, reached, str(data["example"]))


PART = PartType(Velocity, order=26)


def fastest(arm: Arm, joint: int) -> float:
    """Return the largest speed of a joint (0-based) that can be chosen, rad/s or m/s."""
    limit = float(arm.speed_limits[joint])
    return limit if math.isfinite(limit) else FASTEST[bool(arm.revolute[joint])]


def usual_speed(arm: Arm, joint: int) -> float:
    """Return the speed at which a joint (0-based) begins, rad/s or m/s."""
    return min(USUAL[bool(arm.revolute[joint])], fastest(arm, joint))


def within(arm: Arm, joint: int, value: float) -> float:
    """Return a speed of a joint (0-based), moved into what it can do."""
    most = fastest(arm, joint)
    return min(max(value, -most), most)


def checked_point(xyz: Sequence[float]) -> Xyz:
    """Return three finite numbers; `InputError` otherwise."""
    if len(xyz) != 3:
        raise InputError(f"point of a link: expected three numbers, got {len(xyz)}")
    for axis, value in zip("xyz", xyz, strict=True):
        if not (math.isfinite(value) and abs(value) <= FARTHEST):
            raise InputError(f"point of a link, {axis}: expected at most {FARTHEST:g} m, got {value:.6g} m")
    x, y, z = xyz
    return x, y, z


def ends_of(arm: Arm, link: int) -> tuple[Xyz, Xyz]:
    """Return the two ends of a link in the axes of its frame: where it is carried, and what it carries.

    Sliding joints stand at 0.

    Parameters
    ----------
    arm : Arm
    link : int
        1 to n.
    """
    row = arm.rows[link - 1]
    near: Floats = np.zeros(3)
    far: Floats = np.zeros(3)
    if arm.convention == "standard":
        A = link_transform(row.a, row.alpha, row.d, row.theta)
        near = np.asarray(-A[:3, :3].T @ A[:3, 3], dtype=np.float64)
    else:
        after = arm.rows[min(link, arm.n - 1)]
        A = link_transform(after.a, after.alpha, after.d, after.theta, arm.convention)
        far = np.asarray(A[:3, 3], dtype=np.float64)
    if link == arm.n:
        far = arm.tool[:3, 3]
    if float(np.linalg.norm(far - near)) < 1e-6 * arm.length_scale:
        far = near + np.array([APART * arm.length_scale, 0.0, 0.0])
    return checked_point((near + 0.0).tolist()), checked_point((far + 0.0).tolist())


@lru_cache(maxsize=128)
def drawn_scales(arm: Arm, speeds: tuple[float, ...]) -> tuple[float, float]:
    """Return the metres on screen for 1 m/s and for 1 rad/s, each from the series 1, 2, 3, 5.

    They fit nearly every configuration and do not depend on the present one: an arrow that grows is a speed that grows.
    """
    limits = arm.limits
    q = np.random.default_rng(0).uniform(limits[:, 0], limits[:, 1], (SAMPLES, arm.n))
    parts = np.asarray(arm.jacobian(q), dtype=np.float64) * np.array(speeds)
    return _scale(arm, parts[:, :3]), _scale(arm, parts[:, 3:])


def _scale(arm: Arm, parts: Floats) -> float:
    """Return what the sum, and the longest of the parts (N, 3, n), are drawn with."""
    sums, longest = np.linalg.norm(parts.sum(axis=2), axis=1), np.linalg.norm(parts, axis=1).max(axis=1)
    usual = float(np.quantile(np.maximum(sums, longest), SHARE))
    if usual < 1e-9:
        return 1.0
    wanted = DRAWN * 2.0 * arm.length_scale / usual
    power = 10.0 ** math.floor(math.log10(wanted))
    return max(step * power for step in (1.0, 2.0, 3.0, 5.0) if step * power <= wanted * (1.0 + 1e-9))
