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
from armlab.kin.lines import CommonNormal, Line, common_normal

ON_AXIS = 1e-10
"""Distance from an axis, in length scales, below which a point lies on it and determines no angle."""

FLAT = 1e-12
"""Sine or relative length below which a value counts as zero."""

NEARLY_FLAT = 1e-4
"""Sine or relative length below which a value may be zero up to the digits of the table: the general equation is then
nearly a square, and the special one, with zero, is solved as well. Solutions of the true arm are found from both."""


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

Coordinates = tuple[float, float, float]
"""Coordinates (y1, y2, h) of a point, metres."""


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

    def values(self, f: Callable[[float], float], size: float) -> Iterator[tuple[float, frozenset[int]]]:
        """Yield the values of joint 3 at which f vanishes, a sum of terms of this size."""
        far = max(self.s.scale, float(np.linalg.norm(self.w - self.s.o[0])))
        yield from _each(roots(f, self.s.kinds[2] == "R", size, far), 2)

    def samples(self, f: Callable[[float], float]) -> list[float]:
        """Return a function of joint 3 at three of its values."""
        step = 1.0 if self.s.kinds[2] == "R" else self.s.scale
        return [f(k * step) for k in range(3)]

    def largest(self, f: Callable[[float], float]) -> float:
        """Return the size of a function of joint 3."""
        return max(map(abs, self.samples(f)))

    def _turns(self) -> Pairs:
        normal = common_normal(Line(self.s.o[0], self.s.z[0]), Line(self.s.o[1], self.s.z[1]), scale=self.s.scale)
        yield from _TwoTurns.of(self, normal).last_two()

    def _turn_and_slide(self) -> Pairs:
        s, w, L = self.s, self.w, self.s.scale
        z1, z2, o = s.z[0], s.z[1], s.o[0]
        kappa, Z = float(z1 @ z2), float(z1 @ (w - o))
        R = float((w - o) @ (w - o))

        def lacking(q3: float) -> float:
            return Z - float(z1 @ (self.third(q3) - o))

        def residual(q3: float) -> float:
            x = kappa * (self.third(q3) - o) + lacking(q3) * z2
            return float(x @ x) - kappa**2 * R

        if abs(kappa) > FLAT:
            for q3, free in self.values(residual, kappa**2 * (R + L * L) + self.largest(lacking) ** 2):
                yield lacking(q3) / kappa, q3, free
        if abs(kappa) <= NEARLY_FLAT:
            for q3, free in self.values(lacking, L + abs(Z)):
                x = self.third(q3) - o
                for q2 in _halves(1.0, float(z2 @ x), float(x @ x), R):
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

        def local(q3: float) -> Coordinates:
            y = self.third(q3) - o
            return float(y @ n), float(y @ m), float(y @ z2)

        def lacking(q3: float) -> float:
            return V - vz * local(q3)[2]

        def residual(q3: float) -> float:
            y1, y2, _ = local(q3)
            return vm**2 * (g1 * g1 - y1 * y1 - y2 * y2) + lacking(q3) ** 2

        if abs(vm) > FLAT:
            for q3, free in self.values(residual, vm**2 * (g1 * g1 + L * L) + self.largest(lacking) ** 2):
                yield from self.towards(local(q3), g1, lacking(q3) / vm, q3, free)
        if abs(vm) <= NEARLY_FLAT:
            for q3, free in self.values(lacking, L + abs(V)):
                y1, y2, _ = local(q3)
                yield from self.with_angles(sine_cosine(-y2, y1, g1, L), q3, free)

    def _slides(self) -> Pairs:
        s, w, L = self.s, self.w, self.s.scale
        normal = cross(s.z[0], s.z[1])
        across_both = float(np.linalg.norm(normal))
        if across_both <= FLAT:
            return
        normal = normal / across_both
        sideways = cross(normal, s.z[0])
        for q3, free in self.values(lambda q3: float(normal @ (self.third(q3) - w)), L + float(np.abs(w).max())):
            yield float(sideways @ (w - self.third(q3))) / float(sideways @ s.z[1]), q3, free

    def with_angles(self, angles: Angles, q3: float, free: frozenset[int]) -> Pairs:
        """Yield the angles of joint 2, or representatives where it may have any."""
        for q2, chosen in _each(Roots(angles.values, angles.every), 1):
            yield q2, q3, free | chosen

    def towards(self, y: Coordinates, g1: float, g2: float, q3: float, free: frozenset[int]) -> Pairs:
        """Yield the angle of joint 2 from (y1, y2) to (g1, g2)."""
        if math.hypot(y[0], y[1]) <= ON_AXIS * self.s.scale:
            yield from self.with_angles(Angles(every=True), q3, free)
            return
        yield math.atan2(y[0] * g2 - y[1] * g1, y[0] * g1 + y[1] * g2), q3, free


@dataclass(frozen=True, eq=False)
class _TwoTurns:
    """Two turns before joint 3, in the quantities of the equations above."""

    placer: _Placer
    normal: CommonNormal
    m: Vector
    a: float
    sigma: float
    kappa: float
    Z: float
    R: float

    @classmethod
    def of(cls, placer: _Placer, normal: CommonNormal) -> _TwoTurns:
        z1, z2 = placer.s.z[0], placer.s.z[1]
        m, far = cross(z2, normal.normal), placer.w - normal.foot1
        sigma = 0.0 if normal.kind in ("parallel", "coincident") else float(z1 @ m)
        return cls(placer, normal, m, normal.a, sigma, float(z1 @ z2), float(z1 @ far), float(far @ far))

    def last_two(self) -> Pairs:
        """Yield values of joints 2 and 3; where the arm is nearly special, those of the special arm as well."""
        L = self.placer.s.scale
        meeting, parallel, level = self.a, abs(self.sigma), self._spread()
        if meeting <= FLAT * L and parallel <= FLAT:
            return  # One axis twice: not three joints for a place.
        if min(meeting / L, parallel, level / L) > FLAT:
            yield from self._in_general()
        if meeting <= NEARLY_FLAT * L and parallel > FLAT:
            yield from self._meeting()
        if parallel <= NEARLY_FLAT and meeting > FLAT * L:
            yield from self._parallel()
        if level <= NEARLY_FLAT * L and meeting > FLAT * L and parallel > FLAT:
            yield from self._level()

    def _local(self, q3: float) -> Coordinates:
        y = self.placer.third(q3) - self.normal.foot2
        return float(y @ self.normal.normal), float(y @ self.m), float(y @ self.placer.s.z[1])

    def _square(self, q3: float) -> float:
        y = self.placer.third(q3) - self.normal.foot2
        return float(y @ y)

    def _beside(self, q3: float) -> float:
        """Return a g1."""
        return (self.R - self.a * self.a - self._square(q3)) / 2.0

    def _lacking(self, q3: float) -> float:
        """Return sigma g2."""
        return self.Z - self.kappa * self._local(q3)[2]

    def _spread(self) -> float:
        """Return how far joint 3 moves the point along axis 2, in metres."""
        heights = self.placer.samples(lambda q3: self._local(q3)[2])
        return max(heights) - min(heights)

    def _in_general(self) -> Pairs:
        a, sigma, L = self.a, self.sigma, self.placer.s.scale

        def residual(q3: float) -> float:
            y1, y2, _ = self._local(q3)
            # Times (a sigma)²: a division by what nearly vanishes would make all coefficients small beside the terms.
            one, two = sigma * self._beside(q3), a * self._lacking(q3)
            return one * one + two * two - (a * sigma) ** 2 * (y1 * y1 + y2 * y2)

        one, two = (self.placer.largest(f) for f in (self._beside, self._lacking))
        size = (sigma * one) ** 2 + (a * two) ** 2 + (a * sigma * L) ** 2
        for q3, free in self.placer.values(residual, size):
            yield from self.placer.towards(self._local(q3), self._beside(q3) / a, self._lacking(q3) / sigma, q3, free)

    def _meeting(self) -> Pairs:
        for q3, free in self._at_distance(self.R):
            y1, y2, _ = self._local(q3)
            angles = sine_cosine(y1, y2, self._lacking(q3) / self.sigma, self.placer.s.scale)
            yield from self.placer.with_angles(angles, q3, free)

    def _parallel(self) -> Pairs:
        L = self.placer.s.scale
        for q3, free in self.placer.values(self._lacking, L + abs(self.Z)):
            y1, y2, _ = self._local(q3)
            angles = sine_cosine(-y2, y1, self._beside(q3) / self.a, L)
            yield from self.placer.with_angles(angles, q3, free)

    def _level(self) -> Pairs:
        """Yield the values with axis 3 parallel to axis 2: (a + g1)² = R − g2² − h², before and behind axis 1."""
        h = self._local(0.0)[2]
        g2 = (self.Z - self.kappa * h) / self.sigma
        for far in _halves(1.0, 0.0, g2 * g2 + h * h, self.R):
            g1 = far - self.a
            for q3, free in self._at_distance(h * h + g1 * g1 + g2 * g2):
                yield from self.placer.towards(self._local(q3), g1, g2, q3, free)

    def _at_distance(self, wanted: float) -> Iterator[tuple[float, frozenset[int]]]:
        """Yield the values of joint 3 at which the squared distance, in m², has the wanted value."""
        yield from self.placer.values(lambda q3: self._square(q3) - wanted, wanted + self.placer.s.scale**2)


def _each(found: Roots, joint: int) -> Iterator[tuple[float, frozenset[int]]]:
    """Yield the roots, or representatives when every value is a root."""
    if found.every:
        yield from ((value, frozenset({joint})) for value in FREE_ANGLES)
    else:
        yield from ((value, frozenset()) for value in found.values)


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
