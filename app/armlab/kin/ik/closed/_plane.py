"""Arms with parallel revolute axes: they move in a plane, and may lift it.

In the plane a point is a complex number; a turn about c is x -> c + exp(i s q) (x - c), s = ±1 its sense, a slide is
x -> x + u q, and a lift adds to the height.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from armlab.kin.ik.closed._placing import ON_AXIS, _halves
from armlab.kin.ik.closed_form import FREE_ANGLES, Found
from armlab.kin.ik.screws import Screws, Vector
from armlab.kin.ik.trig import NEARLY, sine_cosine, wrap

ALONG = 1e-9
"""Sine or cosine of the angle of a slide with the plane below which it lies in the plane or across it."""


@dataclass(frozen=True)
class Flat:
    """A joint that moves the plane in itself.

    Attributes
    ----------
    joint : int
        0-based.
    turns : bool
    centre : complex
        For a turn, the point where its axis meets the plane at q = 0, metres.
    way : complex
        For a slide, its direction; for a turn, its sense, 1 or -1.
    """

    joint: int
    turns: bool
    centre: complex
    way: complex

    def move(self, x: complex, q: float) -> complex:
        """Return the point to which the joint carries a point."""
        if self.turns:
            return self.centre + cmath.exp(1j * self.way.real * q) * (x - self.centre)
        return x + self.way * q

    def turned(self, x: complex, to: complex) -> float:
        """Return the angle of a revolute joint that carries a point to the direction of another from its centre."""
        return wrap(self.way.real * cmath.phase((to - self.centre) * (x - self.centre).conjugate()))


@dataclass(frozen=True, eq=False)
class Plane:
    """The arm in its plane.

    Attributes
    ----------
    u, v, n : ndarray, shape (3,)
        Axes of the plane and its normal, the direction of the first turn, in frame 0.
    flats : tuple of Flat
    lifts : tuple of (joint, sense)
    tool : complex
        The tool point at q = 0.
    home : ndarray, shape (4, 4)
    scale : float
    """

    u: Vector
    v: Vector
    n: Vector
    flats: tuple[Flat, ...]
    lifts: tuple[tuple[int, float], ...]
    tool: complex
    home: Vector
    scale: float

    def point(self, p: Vector) -> complex:
        """Return a point of space in the plane."""
        return complex(float(self.u @ p), float(self.v @ p))

    @property
    def kinds(self) -> str:
        """The types of the joints in the plane, such as ``"RR"``."""
        return "".join("R" if flat.turns else "P" for flat in self.flats)


def plane_of(s: Screws) -> Plane:
    """Return the plane of an arm, whose structure must be planar with at least one revolute joint."""
    n = s.z[s.kinds.index("R")]
    # Frame 0's own x and y where it can be, so that coordinates are those on screen.
    u = np.eye(3)[0] if abs(n[0]) < 0.9 else np.eye(3)[1]
    u = u - (u @ n) * n
    u = u / np.linalg.norm(u)
    v = np.cross(n, u)
    flats, lifts = [], []
    for i, kind in enumerate(s.kinds):
        along = float(n @ s.z[i])
        if kind == "R":
            flats.append(Flat(i, True, complex(u @ s.o[i], v @ s.o[i]), complex(math.copysign(1.0, along))))
        elif abs(along) > ALONG:
            lifts.append((i, math.copysign(1.0, along)))
        else:
            flats.append(Flat(i, False, 0j, complex(u @ s.z[i], v @ s.z[i])))
    p = s.home[:3, 3]
    return Plane(u, v, n, tuple(flats), tuple(lifts), complex(u @ p, v @ p), s.home, s.scale)


Way = tuple[dict[int, float], frozenset[int]]
"""Values by joint (0-based), and the set of joints that were chosen freely."""


def solve_plane(plane: Plane, G: Vector, angle: bool) -> list[Way]:
    """Return all values of the joints, with the lift, that bring the tool to a place, and to an angle where asked.

    Parameters
    ----------
    plane : Plane
        A plane with two joints, or three when the angle counts, and at most one lift.
    G : ndarray, shape (4, 4)
        Target in frame 0.
    angle : bool
    """
    w = plane.point(G[:3, 3])
    if angle:
        ways = list(_with_angle(plane, G, w))
    else:
        first, second = plane.flats
        ways = list(place_two(first, second, plane.tool, w, plane.scale))
    height = float(plane.n @ (G[:3, 3] - plane.home[:3, 3]))
    raised = {joint: sense * height for joint, sense in plane.lifts}
    return [({**values, **raised}, free) for values, free in ways]


def heading(plane: Plane, G: Vector) -> float:
    """Return the angle in radians about the plane's normal from the hand at q = 0 to the wanted one."""
    turned = G[:3, :3] @ plane.home[:3, :3].T
    across = np.array([[plane.u @ turned @ plane.u, plane.u @ turned @ plane.v],
                       [plane.v @ turned @ plane.u, plane.v @ turned @ plane.v]])  # fmt: skip
    return math.atan2(across[1, 0] - across[0, 1], across[0, 0] + across[1, 1])


def _with_angle(plane: Plane, G: Vector, w: complex) -> Iterator[Way]:
    first, second, third = plane.flats
    phi = heading(plane, G)
    turning = [flat for flat in plane.flats if flat.turns]
    if third.turns:
        # The place of axis 3 does not depend on q3, and follows from the wanted pose.
        centre = w + cmath.exp(1j * phi) * (third.centre - plane.tool)
        for values, free in place_two(first, second, third.centre, centre, plane.scale):
            rest = phi - sum(flat.way.real * values[flat.joint] for flat in (first, second) if flat.turns)
            yield {**values, third.joint: wrap(third.way.real * rest)}, free
    elif first.turns:
        # Seen from the tool the arm is the same with the order of its joints reversed.
        back = cmath.exp(-1j * phi)

        def from_tool(x: complex) -> complex:
            return plane.tool + back * (x - w)

        goal = from_tool(first.centre)
        for values, free in place_two(_undone(third), _undone(second), first.centre, goal, plane.scale):
            rest = phi - sum(flat.way.real * values[flat.joint] for flat in (second,) if flat.turns)
            yield {**values, first.joint: wrap(first.way.real * rest)}, free
    elif len(turning) == 1:
        q2 = wrap(second.way.real * phi)
        gap = w - second.move(plane.tool + 0j, q2)
        # third acts before the turn: its direction turns with it.
        ways = first.way, cmath.exp(1j * phi) * third.way
        for (q1, q3), chosen in _combined(ways, gap, plane.scale):
            free = frozenset({first.joint, third.joint}) if chosen else frozenset()
            yield {first.joint: q1, second.joint: q2, third.joint: q3}, free


def _undone(flat: Flat) -> Flat:
    """Return the inverse motion for the same joint value."""
    return Flat(flat.joint, flat.turns, flat.centre, -flat.way)


def place_two(first: Flat, second: Flat, t: complex, w: complex, scale: float) -> Iterator[Way]:
    """Yield all values of two joints that carry the point t to w in the plane."""
    if first.turns and second.turns:
        yield from _two_turns(first, second, t, w, scale)
    elif first.turns:
        x = t - first.centre
        along = (x * second.way.conjugate()).real
        for q2 in _halves(1.0, along, abs(x) ** 2, abs(w - first.centre) ** 2):
            yield from _then_first(first, {second.joint: q2}, t + q2 * second.way, w, scale, frozenset())
    elif second.turns:
        x = w - second.centre
        along = -(x * first.way.conjugate()).real
        for q1 in _halves(1.0, along, abs(x) ** 2, abs(t - second.centre) ** 2):
            yield from _then_first(second, {first.joint: q1}, t, w - q1 * first.way, scale, frozenset())
    else:
        for (q1, q2), chosen in _combined((first.way, second.way), w - t, scale):
            free = frozenset({first.joint, second.joint}) if chosen else frozenset()
            yield {first.joint: q1, second.joint: q2}, free


def _two_turns(first: Flat, second: Flat, t: complex, w: complex, scale: float) -> Iterator[Way]:
    # |D + E exp(i s q2)|² = |w - c1|² with D from axis 1 to axis 2 and E from axis 2 to the point.
    D, E = second.centre - first.centre, t - second.centre
    product = D.conjugate() * E
    c = (abs(w - first.centre) ** 2 - abs(D) ** 2 - abs(E) ** 2) / 2.0
    angles = sine_cosine(-product.imag, product.real, c, scale * scale)
    turns = FREE_ANGLES if angles.every else angles.values
    free = frozenset({second.joint}) if angles.every else frozenset()
    for turned in turns:
        q2 = wrap(second.way.real * turned)
        yield from _then_first(first, {second.joint: q2}, second.move(t, q2), w, scale, free)


def _then_first(
    turn: Flat, values: dict[int, float], x: complex, w: complex, scale: float, free: frozenset[int]
) -> Iterator[Way]:
    """Yield the values together with those of a turn that carries x to w, or any value when both are its centre."""
    if abs(w - turn.centre) <= ON_AXIS * scale:
        for q in FREE_ANGLES:
            yield {**values, turn.joint: q}, free | {turn.joint}
    else:
        yield {**values, turn.joint: turn.turned(x, w)}, free


def _combined(ways: tuple[complex, complex], gap: complex, scale: float) -> Iterator[tuple[tuple[float, float], bool]]:
    """Yield the lengths along two directions whose sum is a gap, and whether the first was chosen freely."""
    a, b = ways
    determinant = (a.conjugate() * b).imag
    if abs(determinant) > ALONG:
        yield ((gap.conjugate() * b).imag / determinant, (a.conjugate() * gap).imag / determinant), False
    elif abs((a.conjugate() * gap).imag) <= NEARLY * scale:
        # Only along themselves do parallel slides move; forward kinematics decides whether the rest is small enough.
        for length in (scale * angle / math.pi for angle in FREE_ANGLES):
            yield (length, (b.conjugate() * (gap - length * a)).real), True


def found_in_plane(plane: Plane, n: int, ways: list[Way], none: str) -> Found:
    """Return solutions in a plane as arrays (n,), with sentences on free joints."""
    q = [np.array([values[i] for i in range(n)]) for values, _ in ways]
    slides = frozenset(flat.joint for flat in plane.flats if not flat.turns)
    return Found(q, families_of([free for _, free in ways], slides), "" if q else none)


def families_of(free: list[frozenset[int]], slides: frozenset[int] = frozenset()) -> tuple[str, ...]:
    """Return a sentence for each set of free joints (0-based); ``slides`` are those that are free where parallel."""
    sentences = []
    for joints in sorted({tuple(sorted(some)) for some in free if some}):
        named = " and ".join(f"q{joint + 1}" for joint in joints)
        axes = " and ".join(str(joint + 1) for joint in joints)
        if slides.issuperset(joints):
            sentences.append(f"Joints {axes} slide in one direction: either of {named} may have any value.")
            continue
        many = len(joints) > 1
        what = "points to be placed lie on the axes" if many else "point to be placed lies on the axis"
        sentences.append(f"The {what} of joint{'s' if many else ''} {axes}: {named} may have any value.")
    return tuple(sentences)
