"""The bench of velocities: the speed of each joint, the axes of J, and two points of a link."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats
from armlab.kin.dh import link_transform
from armlab.kin.velocity.jacobians import AXES
from armlab.session.fields import FieldPart, choice, number, own, some, text, vector, whole
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Json, PartType, State

Floats = NDArray[np.float64]
Xyz = tuple[float, float, float]

CLIP_KEY = "speeds"

MATRIX = "jacobian"
"""Key by which the scene knows a selection in J."""

MARKS = ("v", "omega", "points")
"""Marks that can be drawn: the parts of v with their sum, the parts of omega, and the two points of a link."""

FOLDS = ("points", "higher")
"""Parts of the page that can be folded away."""

FASTEST: dict[bool, float] = {True: math.pi, False: 1.0}
"""Largest speed if the arm states no limit: rad/s of a joint that turns, m/s of one that slides."""

USUAL: dict[bool, float] = {True: math.radians(30.0), False: 0.1}
"""Initial speed if the limits allow it: rad/s of a joint that turns, m/s of one that slides."""

FARTHEST = 100.0
"""Largest distance of a point from its link, metres."""

APART = 0.2
"""Distance of the two points of a link without length, in length scales."""

DRAWN, SAMPLES, SHARE = 0.45, 64, 0.9
"""Length of the longest arrow in reaches of the arm, number of random configurations, and the share that keeps to
it."""


def _point(xyz: Sequence[float]) -> Xyz:
    x, y, z = finite_floats(xyz, "point of a link", (3,), "three finite numbers, in metres").tolist()
    for axis, value in zip("xyz", (x, y, z), strict=True):
        if abs(value) > FARTHEST:
            raise InputError(f"point of a link, {axis}: expected at most {FARTHEST:g} m either way, got {value:.6g} m")
    return x, y, z


def _points(data: Json) -> tuple[Xyz, Xyz]:
    first, second = data
    return _point(first), _point(second)


@dataclass(frozen=True, eq=False)
class Velocity(FieldPart):
    """Choices of the bench.

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
        Key of the loaded example; empty if it has been changed or there is none.
    """

    key: ClassVar[str] = "velocity"
    kept_by_undo: ClassVar[bool] = True

    leave_example: ClassVar[tuple[str, ...]] = ("example", "marks", "unfolded", "reached")

    arm: Arm
    qdot: tuple[float, ...] = vector("q̇", "speeds of the joints, rad/s and m/s", kept="")
    axes: str = choice("axes of the rows of J", "world", AXES)
    link: int = whole("link whose points are looked at", 1, 1, kept="")
    points: tuple[Xyz, Xyz] = own("two points of the link", ((0.0,) * 3,) * 2, _points, kept="")
    marks: frozenset[str] = some("drawn in the scene", ("v",), MARKS)
    unfolded: frozenset[str] = some("parts of the page that are unfolded", (), FOLDS)
    reached: float | None = number("", "where the film stands", None, unit="s", kept="")
    example: str = text("example", kept="")

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return every joint at its usual speed, and the ends of the last link."""
        arm = robot.arm
        return cls(arm, tuple(usual_speed(arm, i) for i in range(arm.n)), "world", arm.n, ends_of(arm, arm.n))

    def with_values(self, values: Mapping[str, Any]) -> Self:
        """Return the part with some fields set, and speeds clipped to the limits of the joints."""
        part = super().with_values(values)
        return replace(part, qdot=tuple(within(part.arm, i, value) for i, value in enumerate(part.qdot)))

    def check(self) -> None:
        """Refuse a link that the arm does not have, and a negative time of the film."""
        if self.link > self.arm.n:
            raise InputError(f"link: expected 1 to {self.arm.n}, got {self.link}")
        if self.reached is not None and self.reached < 0.0:
            raise InputError(f"reached: expected at least 0 s, got {self.reached:g}")

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the speeds of joints that are still there and of the same kind, and the link with typed points."""
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
        """Forget the place of the film when it is closed, and the example when the student moves the arm."""
        part = self
        if self.example and self is before[Velocity] and now[Joints].q is not before[Joints].q:
            part = replace(part, example="")
        return part if part.reached is None or now[Timeline].clip == CLIP_KEY else replace(part, reached=None)


PART = PartType(Velocity, order=26)


def fastest(arm: Arm, joint: int) -> float:
    """Return the largest speed of a joint (0-based) that can be chosen, rad/s or m/s."""
    limit = float(arm.speed_limits[joint])
    return limit if math.isfinite(limit) else FASTEST[bool(arm.revolute[joint])]


def usual_speed(arm: Arm, joint: int) -> float:
    """Return the initial speed of a joint (0-based), rad/s or m/s."""
    return min(USUAL[bool(arm.revolute[joint])], fastest(arm, joint))


def within(arm: Arm, joint: int, value: float) -> float:
    """Return a speed of a joint (0-based), clipped to its limits."""
    most = fastest(arm, joint)
    return min(max(value, -most), most)


def ends_of(arm: Arm, link: int) -> tuple[Xyz, Xyz]:
    """Return the two ends of a link in the axes of its frame: at its own joint and at the next one.

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
        apart = min(APART * arm.length_scale, FARTHEST)
        far = near + np.array([apart if near[0] + apart <= FARTHEST else -apart, 0.0, 0.0])
    # A length of just the largest distance may be rounded up.
    return _points(np.clip((near, far), -FARTHEST, FARTHEST) + 0.0)


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
    """Return the scale for drawing parts (N, 3, n) and their sum."""
    sums, longest = np.linalg.norm(parts.sum(axis=2), axis=1), np.linalg.norm(parts, axis=1).max(axis=1)
    usual = float(np.quantile(np.maximum(sums, longest), SHARE))
    if usual < 1e-9:
        return 1.0
    wanted = DRAWN * 2.0 * arm.length_scale / usual
    power = 10.0 ** math.floor(math.log10(wanted))
    return max(step * power for step in (1.0, 2.0, 3.0, 5.0) if step * power <= wanted * (1.0 + 1e-9))
