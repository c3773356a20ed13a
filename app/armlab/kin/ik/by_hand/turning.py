"""Joint 1 turns the plane of the arm to a point: one right triangle, seen along axis 1.

With (x, y) the point seen from axis 1, d the distance at which the arm passes beside the axis, and theta the direction
in which the arm reaches,

    -x sin(theta) + y cos(theta) = d,   rho = ± sqrt(x² + y² - d²),   theta = atan2(y, x) - atan2(d, rho)

and rho is how far the point lies ahead of axis 1.

References
----------
Notes 4.24-4.38 (the equation) and 4.96-4.99 (d = 0), corrected; Siciliano et al., *Robotics*, 2.12.4.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from armlab.kin.ik.by_hand.step import (
    Arc,
    Branch,
    Case,
    Circle,
    Line,
    Point,
    Quantity,
    Segment,
    Shape,
    Triangle,
    Vector,
)
from armlab.kin.ik.by_hand.work import Work
from armlab.kin.ik.problem import REACHED_M
from armlab.kin.ik.screws import Screws, cross, rotation
from armlab.kin.ik.trig import DOUBLE, wrap
from armlab.kin.lines import Line as Straight
from armlab.kin.lines import common_normal

RIGHT = 1e-9
"""Cosine of the angle of two axes below which it counts as a right angle."""

NIL = 1e-12
"""Angle, rad, below which that of the zero of a table is none."""

MARK = 0.22
"""Radius of the arc that marks an angle, in length scales."""


@dataclass(frozen=True, eq=False)
class Pillar:
    """Axis 1 and what joint 1 carries, where axis 2 is at a right angle to it.

    Attributes
    ----------
    foot : ndarray, shape (3,)
        Point of axis 1 next to axis 2, frame 0.
    up, east, north : ndarray, shape (3,)
        Axis 1, and the directions from which and towards which its angle is counted: x of frame 0 where that can be.
    ahead : ndarray, shape (3,)
        Where the arm reaches at q1 = 0: across axes 1 and 2.
    zero : float
        The angle of ``ahead`` from ``east``, rad.
    shoulder : float
        How far axis 2 lies ahead of axis 1, m.
    """

    foot: Vector
    up: Vector
    east: Vector
    north: Vector
    ahead: Vector
    zero: float
    shoulder: float


@dataclass(frozen=True, eq=False)
class Turned:
    """The plane of the arm once joint 1 has its value.

    Attributes
    ----------
    ahead, up : ndarray, shape (3,)
        Its axes in frame 0.
    rho, z : float
        The point in them, from `Pillar.foot`, m.
    aside : ndarray, shape (3,)
        From the foot to the plane, frame 0.
    """

    ahead: Vector
    up: Vector
    rho: float
    z: float
    aside: Vector


@lru_cache(maxsize=64)
def pillar_of(s: Screws) -> Pillar | None:
    """Return the pillar of an arm (compared by identity); None unless axes 1 and 2 are turns at a right angle."""
    if s.kinds[:2] != "RR" or abs(float(s.z[0] @ s.z[1])) > RIGHT:
        return None
    normal = common_normal(Straight(s.o[0], s.z[0]), Straight(s.o[1], s.z[1]), scale=s.scale)
    up = s.z[0]
    east = np.eye(3)[0] if abs(up[0]) < 0.9 else np.eye(3)[1]
    east = east - (east @ up) * up
    east = east / np.linalg.norm(east)
    north = cross(up, east)
    ahead = cross(up, s.z[1])
    shoulder = float((normal.foot2 - normal.foot1) @ ahead)
    # Ahead is where axis 2 lies; where the two axes meet, the half of the plane that x of frame 0 points to.
    sideways = float(ahead @ east)
    against = shoulder if normal.a > 0.0 else sideways if abs(sideways) > RIGHT else float(ahead @ north)
    if against < 0.0:
        ahead, shoulder = -ahead, -shoulder
    zero = math.atan2(float(ahead @ north), float(ahead @ east))
    return Pillar(normal.foot1, up, east, north, ahead, zero, shoulder if normal.a > 0.0 else 0.0)


def beside(pillar: Pillar, point: Vector) -> float:
    """Return how far a point, given at q1 = 0, lies to the left of the plane through axis 1, in metres."""
    return float((point - pillar.foot) @ cross(pillar.up, pillar.ahead))


def turn_plane(work: Work, pillar: Pillar, home: Vector, place: Vector, name: str) -> Turned:
    """Find joint 1 so that a point of the arm's plane can come to its place.

    Parameters
    ----------
    work : Work
    pillar : Pillar
    home, place : ndarray, shape (3,)
        Where the point is at q = 0, and where it is to be; frame 0.
    name : str
        Of the point, in words.
    """
    way = place - pillar.foot
    x, y, z = (float(way @ axis) for axis in (pillar.east, pillar.north, pillar.up))
    d = beside(pillar, home)
    d = d if abs(d) > work.tiny else 0.0
    far = math.hypot(x, y)
    square = (far - abs(d)) * (far + abs(d))
    case: Case = "two"
    if far <= work.tiny and d == 0.0:
        case = "any"
    elif abs(d) - far > REACHED_M:
        case = "none"
    elif square <= DOUBLE * far * far:
        case = "merged"
    k = work.choose("q1", 2) if case == "two" else 0
    root = math.sqrt(square) if case == "two" else 0.0
    angles = _angles(work, pillar, case, (x, y, d), root)
    rho = root if k == 0 else -root
    theta = wrap(pillar.zero + angles[k]) if angles else math.nan
    ahead = rotation(pillar.up, angles[k]) @ pillar.ahead if angles else pillar.ahead
    left = cross(pillar.up, ahead)
    work.add(
        "q1",
        "q_1",
        f"Seen along axis 1, the plane of the arm is turned towards {name}",
        "atan2 of two lengths" if d == 0.0 else "a sin θ + b cos θ = c",
        *_written(pillar, x, y, z, d, rho, theta, case, k),
        index=0,
        branches=_branches(work, case, d, angles),
        chosen=k,
        case=case,
        note=_note(case, d, name),
        gap=max(0.0, abs(d) - far),
        shapes=_shapes(work, pillar, place, (x, y, z), d, rho, theta, ahead),
    )
    return Turned(ahead, pillar.up, rho, z, d * left)


def _angles(work: Work, pillar: Pillar, case: Case, seen: tuple[float, float, float], root: float) -> tuple[float, ...]:
    """Return the values of joint 1, none where the point cannot be placed; ``seen`` has x, y and d."""
    x, y, d = seen
    if case == "none":
        return ()
    if case == "any":
        return (work.kept(0),)
    ways = (0.0,) if case == "merged" else (root, -root)
    return tuple(wrap(math.atan2(y, x) - math.atan2(d, rho) - pillar.zero) for rho in ways)


def _branches(work: Work, case: Case, d: float, angles: tuple[float, ...]) -> tuple[Branch, ...]:
    titles: tuple[str, ...] = ("facing it", "facing away")
    if d != 0.0 and work.arm.n == 6:
        titles = ("shoulder left", "shoulder right") if d > 0.0 else ("shoulder right", "shoulder left")
    titles = {"any": ("as it is",), "merged": ("both",), "none": ()}.get(case, titles)
    return tuple(Branch(title, value) for title, value in zip(titles, angles, strict=True))


def _note(case: Case, d: float, name: str) -> str:
    if case == "any":
        return f"Shoulder singularity: {name} lies on axis 1, so θ₁ may be any angle. The present one is kept."
    if case == "merged":
        return (
            f"Shoulder singularity: {name} is exactly as far from axis 1 as the offset of the arm: both values "
            "coincide."
        )
    if case == "none":
        return f"Out of reach: {name} is {{gap}} nearer to axis 1 than the offset of the arm allows."
    return ""


def _written(
    pillar: Pillar, x: float, y: float, z: float, d: float, rho: float, theta: float, case: Case, k: int
) -> tuple[dict[str, Quantity], tuple[Line, ...]]:
    """Return the quantities and the equations."""
    values = {"x": Quantity("x", x), "y": Quantity("y", y), "z": Quantity("z", z)}
    if case == "any":
        values["theta"] = Quantity(r"\theta_1", theta, "rad")
        return values, ()
    if d != 0.0:
        values["d"] = Quantity("d", d)
    if case == "none":
        return values, (Line("", r"-<x>\,\sin\theta_1 + <y>\,\cos\theta_1 = <d>"),)
    values |= {"rho": Quantity(r"\rho", rho), "theta": Quantity(r"\theta_1", theta, "rad")}
    if d == 0.0:
        sign = 1.0 if k == 0 else -1.0
        values |= {"sx": Quantity(r"\pm x", sign * x), "sy": Quantity(r"\pm y", sign * y)}
        lines = [
            Line("rho", r"<sign>\sqrt{<x>^2 + <y>^2}"),
            Line("theta", r"\mathrm{atan2}(<sy>,\, <sx>)"),
        ]
    else:
        lines = [
            Line("", r"-<x>\,\sin\theta_1 + <y>\,\cos\theta_1 = <d>"),
            Line("rho", r"<sign>\sqrt{<x>^2 + <y>^2 - <d>^2}"),
        ]
        if abs(y + d) > 1e-9 * math.hypot(x, y):
            values["t"] = Quantity(r"\tan\frac{\theta_1}{2}", (rho - x) / (y + d), "")
            lines.append(Line("t", r"\frac{<rho> - <x>}{<y> + <d>}"))
        lines.append(Line("theta", r"\mathrm{atan2}(<y>,\, <x>) - \mathrm{atan2}(<d>,\, <rho>)"))
    if abs(pillar.zero) > NIL:
        values |= {
            "zero": Quantity(r"\theta_{1,0}", pillar.zero, "rad"),
            "q": Quantity("q_1", wrap(theta - pillar.zero), "rad"),
        }
        lines.append(Line("q", "<theta> - <zero>"))
    return values, tuple(lines)


def _shapes(
    work: Work,
    pillar: Pillar,
    place: Vector,
    xyz: tuple[float, float, float],
    d: float,
    rho: float,
    theta: float,
    ahead: Vector,
) -> tuple[Shape, ...]:
    x, _, z = xyz
    axis = pillar.foot + z * pillar.up
    corner = axis + x * pillar.east
    shapes: list[Shape] = [
        Segment(pillar.foot, axis, "z", "helper"),
        Segment(axis, corner, "x", "wanted"),
        Segment(corner, place, "y", "wanted"),
        Point(place, "", "wanted"),
    ]
    if d != 0.0:
        shapes.append(Circle(axis, pillar.up, abs(d)))
    if not math.isfinite(theta):
        return (*shapes, Segment(axis, place, "", "helper"))
    end = axis + rho * ahead
    if d != 0.0:
        shapes += [Triangle(np.array([axis, end, place]), "given"), Segment(end, place, "d", "given")]
    else:
        shapes.append(Triangle(np.array([axis, corner, place]), "wanted"))
    shapes += [
        Segment(axis, end, "rho", "given"),
        Arc(axis, MARK * work.s.scale * pillar.east, pillar.up, theta, "theta"),
    ]
    return tuple(shapes)
