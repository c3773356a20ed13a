"""Relations between neighbouring joint axes, and the freedom that they leave in placing the frames.

The relation is read off the link between the two axes, (a, alpha), so it holds in every configuration. Which z lies on
which joint axis follows the convention: z_{i-1} on the axis of joint i in the standard one, z_i in the modified one.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.dh import common_normals
from armlab.kin.lines import PARALLEL_ANGLE, RELATIVE_LENGTH, Relation
from armlab.kin.rotations import rotation_about


@dataclass(frozen=True)
class AxisRelation:
    """Two neighbouring joint axes.

    Attributes
    ----------
    first, second : int
        The joints, 1-based.
    kind : "parallel", "intersecting", "coincident" or "skew"
        Relation of the axes as the table places them. The place of a prismatic axis has no meaning, only its direction.
    a, alpha : float
        The link between them: metres and radians, with the signs of the table.
    perpendicular : bool
        Whether the directions are at a right angle.
    freedom : str
        Sentence on what may be chosen when the frame between them is placed.
    """

    first: int
    second: int
    kind: Relation
    a: float
    alpha: float
    perpendicular: bool
    freedom: str


def is_parallel(alpha: float) -> bool:
    """Return whether a twist in radians makes two axes parallel or antiparallel (`PARALLEL_ANGLE`)."""
    return abs(math.sin(alpha)) <= PARALLEL_ANGLE


def is_perpendicular(alpha: float) -> bool:
    """Return whether a twist in radians is a quarter turn (`PARALLEL_ANGLE`)."""
    return abs(math.cos(alpha)) <= PARALLEL_ANGLE


def is_zero_length(length: float, arm: Arm) -> bool:
    """Return whether a length in metres is zero compared with the arm (`RELATIVE_LENGTH` of its length scale)."""
    return abs(length) <= RELATIVE_LENGTH * arm.length_scale


@dataclass(frozen=True, eq=False)
class Axes:
    """The joint axes of a table. Joints and links are counted from 1; link i lies between axes i and i+1."""

    arm: Arm

    @cached_property
    def kinds(self) -> str:
        """Joint types, such as ``"RRP"``."""
        return "".join(row.kind for row in self.arm.rows)

    @cached_property
    def links(self) -> list[tuple[float, float]]:
        """The (a, alpha) of links 0 to n."""
        return common_normals(self.arm.rows, self.arm.convention)

    def parallel(self, link: int) -> bool:
        """Return whether axes i and i+1 are parallel."""
        return is_parallel(self.links[link][1])

    def perpendicular(self, link: int) -> bool:
        """Return whether axes i and i+1 are at a right angle."""
        return is_perpendicular(self.links[link][1])

    def touching(self, link: int) -> bool:
        """Return whether the common normal of axes i and i+1 has length zero."""
        return is_zero_length(self.links[link][0], self.arm)

    def turns(self, first: int, last: int) -> bool:
        """Return whether joints ``first`` to ``last`` exist and are all revolute."""
        return last <= self.arm.n and set(self.kinds[first - 1 : last]) == {"R"}

    def meet(self, i: int) -> bool:
        """Return whether revolute axes i, i+1, i+2 meet in one point, no two neighbours in one line."""
        return (
            self.turns(i, i + 2)
            and all(self.touching(k) and not self.parallel(k) for k in (i, i + 1))
            and is_zero_length(self.arm.rows[i].d, self.arm)
        )

    def three_parallel(self, i: int) -> bool:
        """Return whether revolute axes i, i+1, i+2 are parallel, no two neighbours in one line."""
        return self.turns(i, i + 2) and all(self.parallel(k) and not self.touching(k) for k in (i, i + 1))

    def last_triple(self, test: Callable[[int], bool]) -> int | None:
        """Return the last i for which axes i, i+1, i+2 pass a test, so that a wrist is found before a shoulder."""
        return next((i for i in range(self.arm.n - 2, 0, -1) if test(i)), None)

    def direction(self, i: int, j: int) -> NDArray[np.float64]:
        """Return the direction (3,) of axis j in axes with z along axis i < j; joints between must be prismatic."""
        R: NDArray[np.float64] = np.eye(3)
        for k in range(i, j):
            R = R @ rotation_about("x", self.links[k][1])
            if k + 1 < j:
                R = R @ rotation_about("z", self.arm.rows[k].theta)
        return R[:, 2]

    @cached_property
    def beside_plane(self) -> list[int] | None:
        """The slides along the common direction of all turns, or None where the arm is not a plane with lifts.

        It is one when all revolute axes are parallel and every slide is parallel or perpendicular to them.
        """
        return self.lifts(1, self.arm.n)

    def lifts(self, first: int, last: int) -> list[int] | None:
        """Return the lifts of the plane of joints ``first`` to ``last``; None when they are no plane with lifts."""
        turning = [i for i in range(first, last + 1) if self.kinds[i - 1] == "R"]
        if not turning:
            return None
        lifts = []
        for j in range(first, last + 1):
            before = [i for i in turning if i < j]
            if not before and j == turning[0]:
                continue
            i, k = (before[-1], j) if before else (j, turning[0])
            x, y, z = self.direction(i, k)
            along, across = bool(np.hypot(x, y) <= PARALLEL_ANGLE), bool(abs(z) <= PARALLEL_ANGLE)
            if not along and (j in turning or not across):
                return None
            if along and j not in turning:
                lifts.append(j)
        return lifts


def axis_relations(arm: Arm) -> tuple[AxisRelation, ...]:
    """Return the relation of each pair of neighbouring joint axes, n - 1 of them.

    References
    ----------
    Notes, section 4.1, the list after 4.16. Two corrections: for axes in one line x is any direction perpendicular to
    them (not "at will"), and the case of intersecting axes, x along their vector product, is missing there.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 0.0, math.pi / 2, 0.3, 0.0), ("R", 0.5, 0.0, 0.0, 0.0), ("R", 0.4, 0.0, 0.0, 0.0)])
    >>> [relation.kind for relation in axis_relations(arm)]
    ['intersecting', 'parallel']
    """
    links = common_normals(arm.rows, arm.convention)
    return tuple(_relation(arm, i, *links[i]) for i in range(1, arm.n))


def end_freedoms(arm: Arm) -> tuple[str, str]:
    """Return what is free in placing frame 0 and frame n, one sentence each.

    References
    ----------
    Notes, section 4.1, the text before 4.15 and the list after 4.16; Craig, 3.4 (modified).
    """
    n = arm.n
    if arm.convention == "standard":
        return (
            "Frame 0: z0 lies on the axis of joint 1; the direction of x0 around it and the place of O0 along it are "
            "free."
            if arm.rows[0].revolute
            else "Frame 0: joint 1 slides, so z0 is parallel to it; the direction of x0 around z0 and the place of O0 "
            "are free.",
            f"Frame {n}: no joint follows, so z{n} is free; x{n} must meet z{n - 1}, the axis of joint {n}, at a right "
            "angle.",
        )
    zero = "a0 = α0 = d1 = 0" if arm.rows[0].revolute else "a0 = α0 = θ1 = 0"
    return (
        f"Frame 0: nothing moves it, so all of it is free; it is usually laid on frame 1 at q1 = 0, so that {zero}.",
        f"Frame {n}: z{n} lies on the axis of joint {n}; no axis follows, so the direction of x{n} around it and the "
        f"place of O{n} along it are free."
        if arm.rows[-1].revolute
        else f"Frame {n}: joint {n} slides, so z{n} is parallel to it; no axis follows, so the direction of x{n} "
        f"around z{n} and the place of O{n} are free.",
    )


def _relation(arm: Arm, i: int, a: float, alpha: float) -> AxisRelation:
    kind = _kind(arm, a, alpha)
    return AxisRelation(i, i + 1, kind, a, alpha, is_perpendicular(alpha), _freedom(arm, i, kind, alpha))


def _kind(arm: Arm, a: float, alpha: float) -> Relation:
    if is_parallel(alpha):
        return "coincident" if is_zero_length(a, arm) else "parallel"
    return "intersecting" if is_zero_length(a, arm) else "skew"


def _freedom(arm: Arm, i: int, kind: Relation, alpha: float) -> str:
    first, second = (f"z{i - 1}", f"z{i}") if arm.convention == "standard" else (f"z{i}", f"z{i + 1}")
    sliding = [j for j in (i, i + 1) if not arm.rows[j - 1].revolute]
    if sliding:
        return _beside_a_slide(arm, i, kind, first, second, sliding)
    if kind == "parallel":
        return (
            f"{first} and {second} are parallel: they have infinitely many common normals, so the place of x{i} along "
            f"{first} is free; it is usually chosen so that d{i} = 0."
        )
    if kind == "intersecting":
        return (
            f"{first} and {second} meet: a{i} = 0 and x{i} is parallel to {first} × {second} in either sense; the "
            f"other sense changes the sign of α{i} and turns θ{i} and θ{i + 1} by 180°."
        )
    if kind == "coincident":
        what = "sums" if math.cos(alpha) > 0.0 else "differences"
        return (
            f"{first} and {second} are one line: x{i} may be any direction perpendicular to it, anywhere along it; "
            f"only the {what} of θ{i} and θ{i + 1} and of d{i} and d{i + 1} are defined."
        )
    return (
        f"{first} and {second} are skew: they have exactly one common normal and x{i} lies along it in either sense; "
        f"the other sense changes the signs of a{i} and α{i} and turns θ{i} and θ{i + 1} by 180°."
    )


def _beside_a_slide(arm: Arm, i: int, kind: Relation, first: str, second: str, sliding: list[int]) -> str:
    if len(sliding) == 2:
        who = f"Joints {i} and {i + 1} slide: only the directions of their axes matter, their places are free"
    else:
        who = f"Joint {sliding[0]} slides: only the direction of its axis matters, its place is free"
    if kind in ("parallel", "coincident"):
        # The slide's axis then lies on its neighbour's, so its distance from the axis on the other side is given.
        beyond = 2 * sliding[0] - 1 - i
        fixed = f", which fixes a{beyond}" if len(sliding) == 1 and 0 < beyond < arm.n else ""
        return (
            f"{who}, so a{i} may be chosen 0{fixed}; x{i} is then any direction perpendicular to {first} and {second}."
        )
    return f"{who}, so a{i} may be chosen 0; x{i} is parallel to {first} × {second} in either sense."
