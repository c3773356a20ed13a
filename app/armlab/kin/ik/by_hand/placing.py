"""Three joints carry a point to a place: the kinds that are solved by hand, step by step.

An arm that turns a plane with two links in it, one that turns a plane with a turn and a slide in it, and three slides.
The point may be the tool or the centre of a wrist.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from armlab.kin.ik.by_hand.step import Branch, Line, Point, Quantity, Segment, Vector
from armlab.kin.ik.by_hand.stretch import Stroke, stretch
from armlab.kin.ik.by_hand.triangle import Joint, Links, between, reach
from armlab.kin.ik.by_hand.turning import RIGHT, Pillar, Turned, pillar_of, turn_plane
from armlab.kin.ik.by_hand.work import Work, triple
from armlab.kin.ik.screws import Screws, across, cross
from armlab.kin.ik.trig import wrap

Placer = Callable[[Work, Vector, Vector, str], None]
"""``placer(work, home, place, name)``: where the point is at q = 0, where it is to be, and its name in words."""

INDEPENDENT = 1e-9
"""Smallest singular value with which the directions of slides count as independent."""

SHORT = 1e-9
"""Length, in length scales, below which a link has none."""


def placer_of(s: Screws, home: Vector) -> Placer | None:
    """Return how the first three joints place a point, given where it is at q = 0; None where not by hand."""
    if s.kinds[:3] == "PPP":
        return slides if np.linalg.svd(s.z[:3].T)[1][-1] > INDEPENDENT else None
    pillar = pillar_of(s)
    if pillar is None:
        return None
    if s.kinds[:3] == "RRR" and across(s.z[1], s.z[2]) <= RIGHT:
        lengths = _of_elbow(s, pillar, home)[0]
        return elbow if min(lengths) > SHORT * s.scale else None
    if s.kinds[:3] == "RRP" and abs(float(s.z[1] @ s.z[2])) <= RIGHT:
        return polar
    return None


def flat(pillar: Pillar, point: Vector) -> complex:
    """Return a point, given at q = 0, in the plane that joint 1 turns, from axis 2."""
    way = point - pillar.foot
    return complex(float(way @ pillar.ahead) - pillar.shoulder, float(way @ pillar.up))


def sense(s: Screws, pillar: Pillar, joint: int) -> float:
    """Return whether a joint lifts what it carries, 1, or lowers it, -1."""
    return 1.0 if float(s.z[joint] @ cross(pillar.ahead, pillar.up)) > 0.0 else -1.0


def _of_elbow(s: Screws, pillar: Pillar, home: Vector) -> tuple[tuple[float, float], float, float]:
    return between(0j, flat(pillar, s.o[2]), flat(pillar, home))


def shoulder_of(pillar: Pillar, turned: Turned) -> Vector:
    """Return the shoulder in frame 0: the point of axis 2 in the plane of what is placed."""
    return np.asarray(pillar.foot + turned.aside + pillar.shoulder * turned.ahead)


def seen_from_shoulder(pillar: Pillar, rho: Quantity, z: Quantity) -> tuple[dict[str, Quantity], tuple[str, str, str]]:
    """Return the quantities, and the LaTeX of both coordinates and the distance, of a point from the shoulder."""
    given = {"rho": rho, "z": z}
    if pillar.shoulder == 0.0:
        return given, ("<rho>", "<z>", r"\sqrt{<rho>^2 + <z>^2}")
    given["a1"] = Quantity("a_1", pillar.shoulder)
    return given, ("<rho> - <a1>", "<z>", r"\sqrt{(<rho> - <a1>)^2 + <z>^2}")


def elbow(work: Work, home: Vector, place: Vector, name: str) -> None:
    """Place a point by a turn of the plane of two links."""
    pillar = _pillar(work)
    turned = turn_plane(work, pillar, home, place, name)
    given, how = seen_from_shoulder(pillar, Quantity(r"\rho", turned.rho), Quantity("z", turned.z))
    two_links(work, pillar, turned, home, complex(turned.rho - pillar.shoulder, turned.z), given, how, name)


def two_links(
    work: Work,
    pillar: Pillar,
    turned: Turned,
    home: Vector,
    end: complex,
    given: dict[str, Quantity],
    how: tuple[str, str, str],
    name: str,
) -> None:
    """Find joints 2 and 3, which carry a point, given at q = 0, to a place in the plane, given from the shoulder."""
    s = work.s
    lengths, zero, bend = _of_elbow(s, pillar, home)
    joints = (Joint(1, sense(s, pillar, 1), zero), Joint(2, sense(s, pillar, 2), bend))
    links = Links(
        shoulder_of(pillar, turned),
        turned.ahead,
        turned.up,
        lengths,
        joints,
        ("L_2", "L_3", name, "the shoulder"),
        np.array([0.0, 1.0]),
    )
    reach(work, links, end, given, how)


def polar(work: Work, home: Vector, place: Vector, name: str) -> None:
    """Place a point by a turn of the plane of a turn and a slide."""
    s, pillar = work.s, _pillar(work)
    turned = turn_plane(work, pillar, home, place, name)
    given, how = seen_from_shoulder(pillar, Quantity(r"\rho", turned.rho), Quantity("z", turned.z))
    way = complex(float(s.z[2] @ pillar.ahead), float(s.z[2] @ pillar.up))
    seen = flat(pillar, home) * way.conjugate()
    zero = float(np.angle(way))
    stroke = Stroke(
        shoulder_of(pillar, turned),
        turned.ahead,
        turned.up,
        Joint(1, sense(s, pillar, 1), zero),
        2,
        seen.imag,
        seen.real,
        (name, "the shoulder"),
    )
    stretch(work, stroke, complex(turned.rho - pillar.shoulder, turned.z), given, how)


def _pillar(work: Work) -> Pillar:
    pillar = pillar_of(work.s)
    assert pillar is not None
    return pillar


def slides(work: Work, home: Vector, place: Vector, name: str) -> None:
    """Place a point by three slides."""
    along_slides(work, work.s.z[:3].T, home, place, name, [0, 1, 2])


def along_slides(
    work: Work, directions: Vector, home: Vector, place: Vector, name: str, coordinates: list[int]
) -> None:
    """Find slides with independent directions, columns of shape (m, m), for the controlled coordinates."""
    back = np.linalg.inv(directions)
    gap = place - home
    at = np.array(home)
    for i in range(len(coordinates)):
        normal = np.zeros(3)
        normal[coordinates] = back[i]
        value = float(normal @ gap)
        end = at + value * work.s.z[i]
        n = i + 1
        values = {
            "n": Quantity(rf"\mathbf{{n}}_{n}", triple(normal), ""),
            "gap": Quantity(r"\mathbf{p} - \mathbf{p}_0", triple(gap)),
            "q": Quantity(f"q_{n}", value),
        }
        work.add(
            f"q{n}",
            f"q_{n}",
            f"The way from {name} at zero to its place, measured along slide {n} and across the others",
            "read off",
            values,
            (Line("q", r"<n> \cdot <gap>"),),
            index=i,
            branches=(Branch("", value),),
            shapes=(
                Segment(home, place, "", "wanted"),
                Segment(at, end, "q", "found"),
                Point(place, "", "wanted"),
            ),
        )
        at = end


def make_up(
    work: Work, pillar: Pillar, total: Quantity, way: float, title: str, shapes: tuple[Segment | Point, ...]
) -> None:
    """Find joint 4, which makes up for what joints 2 and 3 leave of their common turn.

    Parameters
    ----------
    work : Work
    pillar : Pillar
    total : Quantity
        The common turn, rad.
    way : float
        1 where it counts from ahead to up, -1 the other way.
    title : str
    shapes : tuple
        The drawing.
    """
    assert isinstance(total.value, float)
    second, third, fourth = (sense(work.s, pillar, i) for i in (1, 2, 3))
    value = wrap(fourth * (way * total.value - second * work.q[1] - third * work.q[2]))
    values = {
        "total": total,
        "q2": Quantity("q_2", work.q[1], "rad"),
        "q3": Quantity("q_3", work.q[2], "rad"),
        "q": Quantity("q_4", value, "rad"),
    }
    terms = [(fourth * way, "total"), (-fourth * second, "q2"), (-fourth * third, "q3")]
    work.add(
        "q4",
        "q_4",
        title,
        "sum of the angles",
        values,
        (Line("q", summed(terms)),),
        index=3,
        branches=(Branch("", value),),
        shapes=shapes,
    )


def summed(terms: list[tuple[float, str]]) -> str:
    """Return the sum of named quantities with their signs, in LaTeX."""
    text = " ".join(f"{'+' if sign > 0.0 else '-'} <{name}>" for sign, name in terms)
    return text.removeprefix("+ ")
