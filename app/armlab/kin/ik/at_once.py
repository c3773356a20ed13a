"""Solutions of the commonest industrial arms in some ten microseconds each: the branch near a start comes first.

Axes 2 and 3 parallel and at a right angle to axis 1, then a spherical wrist with right angles (PUMA), or axis 4
parallel to them, too, and axes 4, 5, 6 at right angles with the last two meeting (Universal Robots). Both are the same
three problems in another order: a height along the parallel axes gives q1, a planar 2R gives q2 and q3, and three axes
at right angles give the rest. The closed forms of `armlab.kin.ik.closed` serve every arm of their kind, find all
solutions and know the special poses; here nothing is special: a caller verifies what comes, and has other means where
nothing does.

References
----------
Pieper 1968; Hawkins 2013; notes, section 4.3.2.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.closed_form import closed_form_of
from armlab.kin.ik.screws import Screws, Vector, cross, rotation, screws_of
from armlab.kin.lines import Line, common_normal
from armlab.kin.transforms import inverse, transform

RIGHT = 1e-9
"""Cosine of the angle of two axes below which it counts as a right angle."""

Three = tuple[float, float, float]


class AtOnce:
    """An arm with an elbow and a wrist, seen in axes with z along joint 1 and y along joint 2 where q is zero.

    Points of the plane across the parallel axes are complex numbers z + i x, which a turn about y multiplies.
    """

    def __init__(self, s: Screws, is_parallel: bool) -> None:
        z, y = s.z[0], s.z[1]
        axes = np.column_stack([cross(y, z), y, z])
        place = transform(axes, s.o[0])
        here = inverse(place)
        directions, (_, shoulder, elbow, fourth, *_) = s.z @ axes, (s.o - s.o[0]) @ axes
        meeting = common_normal(Line(s.o[4], s.z[4]), Line(s.o[5], s.z[5]), scale=s.scale).foot1
        centre = (meeting - s.o[0]) @ axes
        self._is_parallel, self._scale = is_parallel, s.scale
        self._sense3, self._sense4 = float(directions[2][1]), float(directions[3][1])
        self._height, self._shoulder = float(centre[1]), _flat(shoulder)
        self._upper, self._hand = _flat(elbow) - self._shoulder, _flat(centre - fourth)
        self._lower = _flat(fourth - elbow) if is_parallel else _flat(centre - elbow)
        # The wrist turns like Euler angles z, y, z in axes of its own: e3 along its first axis, e2 along its second.
        e3 = np.array((0.0, 1.0, 0.0)) if is_parallel else directions[3]
        e2 = directions[4]
        e1 = cross(e2, e3)
        self._e1, self._e2, self._e3 = (tuple(e.tolist()) for e in (e1, e2, e3))
        self._bent = math.atan2(float(directions[5] @ e1), float(directions[5] @ e3))
        last = np.column_stack([e1, e2, e3]) @ rotation(np.array((0.0, 1.0, 0.0)), self._bent)
        self._before = here
        self._after = inverse(s.home) @ place @ transform(last, centre)

    @property
    def bends(self) -> bool:
        """Whether both links of the elbow have a length."""
        return abs(self._upper) > RIGHT * self._scale and abs(self._lower) > RIGHT * self._scale

    def solutions(self, T: Vector, near: Sequence[float]) -> Iterator[list[float]]:
        """Yield candidates q (6) for a pose (4, 4) in frame 0; of two branches, the one nearer to ``near`` first."""
        rows = (self._before @ T @ self._after).tolist()[:3]
        (*x_row, px), (*y_row, py), (*z_row, pz) = rows
        square = px * px + py * py - self._height * self._height
        if square < 0.0:
            return
        root, way = math.sqrt(square), math.atan2(py, px)
        firsts = [(way - math.atan2(self._height, out), out) for out in (root, -root)]
        for q1, out in _nearer_first(firsts, near[0]):
            c, s = math.cos(q1), math.sin(q1)
            turned = [c * a + s * b for a, b in zip(x_row, y_row, strict=True)]
            side = [c * b - s * a for a, b in zip(x_row, y_row, strict=True)]
            goal = complex(pz, out)
            if self._is_parallel:
                around = self._sense3 * near[2] + self._sense4 * near[3] + near[1]
                for whole, q5, q6 in self._wrist(turned, side, z_row, around, near[4]):
                    for q2, q3 in self._elbow(goal - cmath.rect(1.0, whole) * self._hand, near[2]):
                        yield [q1, q2, q3, self._sense4 * (whole - q2 - self._sense3 * q3), q5, q6]
                continue
            for q2, q3 in self._elbow(goal, near[2]):
                back = cmath.rect(1.0, -q2 - self._sense3 * q3)
                plane = [back * complex(a, b) for a, b in zip(z_row, turned, strict=True)]
                x, z = [value.imag for value in plane], [value.real for value in plane]
                for q4, q5, q6 in self._wrist(x, side, z, near[3], near[4]):
                    yield [q1, q2, q3, q4, q5, q6]

    def _elbow(self, goal: complex, near: float) -> Iterator[tuple[float, float]]:
        """Yield q2 and q3 of the planar 2R: shoulder + e^(i q2) (upper + e^(+-i q3) lower) = goal."""
        far, upper, lower = goal - self._shoulder, self._upper, self._lower
        a, b = abs(upper), abs(lower)
        cosine = (abs(far) ** 2 - a * a - b * b) / (2.0 * a * b)
        if abs(cosine) > 1.0:
            return
        angle, straight = math.acos(cosine), cmath.phase(upper) - cmath.phase(lower)
        thirds = [(self._sense3 * (turn + straight), turn + straight) for turn in (angle, -angle)]
        for q3, turn in _nearer_first(thirds, near):
            yield cmath.phase(far / (upper + cmath.rect(1.0, turn) * lower)), q3

    def _wrist(
        self, x: Sequence[float], y: Sequence[float], z: Sequence[float], near0: float, near1: float
    ) -> Iterator[Three]:
        """Yield the three wrist angles of a rotation given by its rows, whose columns are those of the hand."""
        (a, b, c), (d, e, f), (g, h, i) = self._e1, self._e2, self._e3
        k0, k1, k2 = x[2], y[2], z[2]
        along0, along1 = a * k0 + b * k1 + c * k2, d * k0 + e * k1 + f * k2
        end0, end1 = g * x[0] + h * y[0] + i * z[0], g * x[1] + h * y[1] + i * z[1]
        sine, cosine = math.hypot(along0, along1), g * k0 + h * k1 + i * k2
        middles = [(math.atan2(sign * sine, cosine) - self._bent, sign) for sign in (1.0, -1.0)]
        for middle, sign in _nearer_first(middles, near1):
            yield math.atan2(sign * along1, sign * along0), middle, math.atan2(sign * end1, -sign * end0)


def _flat(point: Vector) -> complex:
    return complex(float(point[2]), float(point[0]))


def _nearer_first(pair: list[tuple[float, float]], near: float) -> list[tuple[float, float]]:
    (one, _), (other, _) = pair
    is_first = abs(math.remainder(one - near, math.tau)) <= abs(math.remainder(other - near, math.tau))
    return pair if is_first else pair[::-1]


@lru_cache(maxsize=64)
def at_once(arm: Arm) -> AtOnce | None:
    """Return the arm's fast solver (arms are compared by identity); None when it has none."""
    known = closed_form_of(arm)
    if known is None or known[0].key not in ("spherical_wrist", "three_parallel") or "P" in screws_of(arm).kinds:
        return None
    s, is_parallel = screws_of(arm), known[0].key == "three_parallel"
    right = [(0, 1), (3, 4), (4, 5)]
    parallel = [(1, 2), (2, 3)] if is_parallel else [(1, 2)]
    is_built_so = all(abs(s.z[i] @ s.z[j]) < RIGHT for i, j in right) and all(
        np.linalg.norm(cross(s.z[i], s.z[j])) < RIGHT for i, j in parallel
    )
    if not is_built_so:
        return None
    found = AtOnce(s, is_parallel)
    return found if found.bends else None
