"""Three joints carry a point to a place: Pieper's equations for every sequence of turns and slides.

With x3 = E_3 t, x2 = E_2 x3 and E_1 x2 = w, joint 1 leaves two numbers of x2 as they are: for a turn the height along
its axis and the distance from a point of it, for a slide the two coordinates across it. They leave two equations in
joints 2 and 3. With n the common normal from axis 1 to axis 2, a its length, (y1, y2, h) the coordinates of x3 in
(n, z2 x n, z2) from its foot on axis 2, and (g1, g2) those of x2,

    sigma g2 + kappa h = Z,    |x3|² + a² + 2 a g1 = R,    g1² + g2² = y1² + y2²

where sigma and kappa are sine and cosine between axes 1 and 2. Arms that people build make one of them linear in sine
and cosine of joint 3; the general case is of degree four.

References
----------
Pieper 1968; Craig, *Introduction to Robotics*, 4.6. Notes, sections 4.3.4 and 4.3.5, are special cases.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from armlab.kin.ik.closed._roots import Roots, roots
from armlab.kin.ik.closed_form import FREE_ANGLES
from armlab.kin.ik.screws import Screws, Vector, across, angle_about, cross
from armlab.kin.ik.trig import NEARLY, Angles, sine_cosine
from armlab.kin.lines import Line, common_normal

ON_AXIS = 1e-10
"""Distance from an axis, in length scales, below which a point lies on it and determines no angle."""

FLAT = 1e-12
"""Sine or relative length below which a value counts as zero."""


@dataclass(frozen=True, eq=False)
class Placed:
    """Values of three joints, and the indices (0-based) of those that were chosen freely."""

    q: tuple[float, float, float]
    free: frozenset[int]


def place(s: Screws, t: Vector, w: Vector) -> list[Placed]:
    """Return all values of joints 1, 2, 3 that carry the point t of link 3 (at q = 0) to w; metres, frame 0."""
    placer = _Placer(s, np.asarray(t), np.asarray(w))
    found = []
    for q2, q3, free in placer.last_two():
        x2 = s.moved(1, q2, s.moved(2, q3, placer.t))
        if s.kinds[0] == "P":
            found.append(Placed((float(s.z[0] @ (placer.w - x2)), q2, q3), free))
        elif across(s.z[0], placer.w - s.o[0]) <= ON_AXIS * s.scale:
            found += [Placed((q1, q2, q3), free | {0}) for q1 in FREE_ANGLES]
        else:
            found.append(Placed((angle_about(s.z[0], x2 - s.o[0], placer.w - s.o[0]), q2, q3), free))
    return found


Pairs = Iterator[tuple[float, float, frozenset[int]]]


@dataclass(frozen=True, eq=False)
class _Placer:
    s: Screws
    t: Vector
    w: Vector

    def last_two(self) -> Pairs:
        """Yield values of joints 2 and 3, and which of them are free."""
        ways = {"RR": self._turns, "RP": self._turn_and_slide, "PR": self._slide_and_turn, "PP": self._slides}
        yield from ways[self.s.kinds[:2]]()

    def third(self, q3: float) -> Vector:
        """Return the point moved by joint 3."""
        return self.s.moved(2, q3, self.t)

    def _values(self, f: Callable[[float], float], size: float) -> Iterator[tuple[float, frozenset[int]]]:
        yield from _each(roots(f, self.s.kinds[2] == "R", size, self.s.scale), 2)

    def _at_distance(self, square: Callable[[float], float], wanted: float) -> Iterator[tuple[float, frozenset[int]]]:
        """Yield the values of joint 3 at which a squared distance, in m², has the wanted value."""
        yield from self._values(lambda q3: square(q3) - wanted, wanted + self.s.scale**2)

    def _turns(self) -> Pairs:
        s, w, L = self.s, self.w, self.s.scale
        normal = common_normal(Line(s.o[0], s.z[0]), Line(s.o[1], s.z[1]), scale=L)
        n, a = normal.normal, normal.a
        m = cross(s.z[1], n)
        parallel = normal.kind in ("parallel", "coincident")
        sigma, kappa = 0.0 if parallel else float(s.z[0] @ m), float(s.z[0] @ s.z[1])
        Z, R = float(s.z[0] @ (w - normal.foot1)), float((w - normal.foot1) @ (w - normal.foot1))

        def local(q3: float) -> tuple[float, float, float]:
            y = self.third(q3) - normal.foot2
            return float(y @ n), float(y @ m), float(y @ s.z[1])

        def square(q3: float) -> float:
            y = self.third(q3) - normal.foot2
            return float(y @ y)

        if a == 0.0:
            if sigma == 0.0:
                return  # One axis twice: not three joints for a place.
            for q3, free in self._at_distance(square, R):
                y1, y2, h = local(q3)
                yield from self._with(sine_cosine(y1, y2, (Z - kappa * h) / sigma, L), q3, free)
            return
        if sigma == 0.0:
            for q3, free in self._values(lambda q3: kappa * local(q3)[2] - Z, L + abs(Z)):
                y1, y2, _ = local(q3)
                g1 = (R - a * a - square(q3)) / (2.0 * a)
                yield from self._with(sine_cosine(-y2, y1, g1, L), q3, free)
            return
        heights = [local(q3)[2] for q3 in (0.0, 1.0, 2.0)]
        if max(heights) - min(heights) <= FLAT * L:
            for g1, g2 in _of_constant_height(Z, R, a, sigma, kappa, heights[0]):
                for q3, free in self._at_distance(square, heights[0] ** 2 + g1 * g1 + g2 * g2):
                    yield from self._towards(local(q3), g1, g2, q3, free)
            return

        def residual(q3: float) -> float:
            y1, y2, h = local(q3)
            g1, g2 = (R - a * a - square(q3)) / (2.0 * a), (Z - kappa * h) / sigma
            return g1 * g1 + g2 * g2 - y1 * y1 - y2 * y2

        size = (R + L * L) ** 2 / (a * a) + (abs(Z) + L) ** 2 / sigma**2
        for q3, free in self._values(residual, size):
            y = local(q3)
            g1, g2 = (R - a * a - square(q3)) / (2.0 * a), (Z - kappa * y[2]) / sigma
            yield from self._towards(y, g1, g2, q3, free)

    def _turn_and_slide(self) -> Pairs:
        s, w, L = self.s, self.w, self.s.scale
        z1, z2, o = s.z[0], s.z[1], s.o[0]
        kappa, Z = float(z1 @ z2), float(z1 @ (w - o))
        R = float((w - o) @ (w - o))
        if abs(kappa) > FLAT:

            def slide(q3: float) -> float:
                return (Z - float(z1 @ (self.third(q3) - o))) / kappa

            def residual(q3: float) -> float:
                x = self.third(q3) - o + slide(q3) * z2
                return float(x @ x) - R

            for q3, free in self._values(residual, (R + L * L) / kappa**2):
                yield slide(q3), q3, free
            return
        for q3, free in self._values(lambda q3: float(z1 @ (self.third(q3) - o)) - Z, L + abs(Z)):
            x = self.third(q3) - o
            along, rest = float(z2 @ x), float(x @ x)
            for q2 in _halves(1.0, along, rest, R):
                yield q2, q3, free

    def _slide_and_turn(self) -> Pairs:
        s, w, L = self.s, self.w, self.s.scale
        z1, z2, o = s.z[0], s.z[1], s.o[1]
        n = cross(z1, z2)
        if float(np.linalg.norm(n)) <= FLAT:
            n = cross(z2, np.eye(3)[int(np.argmin(np.abs(z2)))])
        n = n / np.linalg.norm(n)
        m, v = cross(z2, n), cross(z1, n)
        g1, V = float(n @ (w - o)), float(v @ (w - o))
        vm, vz = float(v @ m), float(v @ z2)

        def local(q3: float) -> tuple[float, float, float]:
            y = self.third(q3) - o
            return float(y @ n), float(y @ m), float(y @ z2)

        if abs(vm) <= FLAT:
            for q3, free in self._values(lambda q3: vz * local(q3)[2] - V, L + abs(V)):
                y1, y2, _ = local(q3)
                yield from self._with(sine_cosine(-y2, y1, g1, L), q3, free)
            return

        def residual(q3: float) -> float:
            y1, y2, h = local(q3)
            g2 = (V - vz * h) / vm
            return g1 * g1 + g2 * g2 - y1 * y1 - y2 * y2

        for q3, free in self._values(residual, (L + abs(V) + abs(g1)) ** 2 / vm**2):
            y = local(q3)
            yield from self._towards(y, g1, (V - vz * y[2]) / vm, q3, free)

    def _slides(self) -> Pairs:
        s, w, L = self.s, self.w, self.s.scale
        normal = cross(s.z[0], s.z[1])
        across_both = float(np.linalg.norm(normal))
        if across_both <= FLAT:
            return
        normal = normal / across_both
        sideways = cross(normal, s.z[0])
        for q3, free in self._values(lambda q3: float(normal @ (self.third(q3) - w)), L + float(np.abs(w).max())):
            yield float(sideways @ (w - self.third(q3))) / float(sideways @ s.z[1]), q3, free

    def _with(self, angles: Angles, q3: float, free: frozenset[int]) -> Pairs:
        for q2, chosen in _each(Roots(angles.values, angles.every), 1):
            yield q2, q3, free | chosen

    def _towards(self, y: tuple[float, float, float], g1: float, g2: float, q3: float, free: frozenset[int]) -> Pairs:
        """Yield the angle of joint 2 from (y1, y2) to (g1, g2)."""
        if math.hypot(y[0], y[1]) <= ON_AXIS * self.s.scale:
            yield from self._with(Angles(every=True), q3, free)
            return
        yield math.atan2(y[0] * g2 - y[1] * g1, y[0] * g1 + y[1] * g2), q3, free


def _each(found: Roots, joint: int) -> Iterator[tuple[float, frozenset[int]]]:
    """Yield the roots, or representatives when every value is a root."""
    if found.every:
        yield from ((value, frozenset({joint})) for value in FREE_ANGLES)
    else:
        yield from ((value, frozenset()) for value in found.values)


def _of_constant_height(
    Z: float, R: float, a: float, sigma: float, kappa: float, h: float
) -> Iterator[tuple[float, float]]:
    """Yield (g1, g2) with axis 3 parallel to axis 2: (a + g1)² = R − g2² − h², in front of axis 1 and behind it."""
    g2 = (Z - kappa * h) / sigma
    for far in _halves(1.0, 0.0, g2 * g2 + h * h, R):
        yield far - a, g2


def _halves(a: float, half: float, first: float, second: float) -> tuple[float, ...]:
    """Return the real roots of a x² + 2 half x + first - second = 0, with ``first`` and ``second`` not negative.

    One where they merge, or have just vanished by rounding: that of the last two, whose difference may be nothing else.
    """
    square = half * half - a * (first - second)
    scale = half * half + abs(a) * (first + second)
    if square < -NEARLY * scale:
        return ()
    if square <= 1e-14 * scale:
        return (-half / a,)
    root = math.sqrt(square)
    return ((-half + root) / a, (-half - root) / a)
