"""A turn and a slide in a plane carry a point to a place: a right triangle, and the difference of two angles.

    l = ± sqrt(D² - h²),   theta = atan2(v, u) - atan2(h, l)

with h the distance at which the slide passes the turn, and l how far along it the point is.

References
----------
Notes 4.66-4.82, corrected: the sign of l counts in both arguments.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

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
from armlab.kin.ik.by_hand.triangle import Joint, own_value
from armlab.kin.ik.by_hand.turning import MARK
from armlab.kin.ik.by_hand.work import Work
from armlab.kin.ik.problem import REACHED_M
from armlab.kin.ik.screws import cross
from armlab.kin.ik.trig import DOUBLE, wrap


@dataclass(frozen=True, eq=False)
class Stroke:
    """A turn that carries a slide, in a plane.

    Attributes
    ----------
    origin, u, v : ndarray, shape (3,)
        The turn in frame 0, and the axes of the plane.
    turn : Joint
        Its angle is that of the direction of the slide.
    slide : int
        0-based.
    aside, start : float
        How far the point lies to the left of the turn seen along the slide, and how far along it at q = 0; metres.
    names : tuple of str
        Of the point and of the turn, in words.
    """

    origin: Vector
    u: Vector
    v: Vector
    turn: Joint
    slide: int
    aside: float
    start: float
    names: tuple[str, str]

    def at(self, point: complex) -> Vector:
        """Return a point of the plane in frame 0."""
        return np.asarray(self.origin + point.real * self.u + point.imag * self.v)


def stretch(work: Work, stroke: Stroke, end: complex, given: dict[str, Quantity], how: tuple[str, str, str]) -> None:
    """Find both joints so that the point comes to a place of the plane; arguments as of `triangle.reach`."""
    far, h = abs(end), stroke.aside if abs(stroke.aside) > work.tiny else 0.0
    square = (far - abs(h)) * (far + abs(h))
    gap = abs(h) - far
    merged = far <= work.tiny if h == 0.0 else square <= DOUBLE * far * far
    case: Case = "none" if gap > REACHED_M else "merged" if merged else "two"
    k = work.choose(f"q{stroke.slide + 1}", 2) if case == "two" else 0
    root = math.sqrt(square) if case == "two" else 0.0
    lengths = (root, -root) if case == "two" else (0.0,)
    along = lengths[k]
    free = case == "merged" and h == 0.0
    if free:
        theta = wrap(stroke.turn.zero + stroke.turn.sense * work.kept(stroke.turn.index))
    else:
        theta = wrap(math.atan2(end.imag, end.real) - math.atan2(h, along))
    shapes = _shapes(work, stroke, end, h, along, theta, case)
    without = tuple(shape for shape in shapes if not isinstance(shape, Arc))
    _length(work, stroke, far, h, lengths, k, case, max(0.0, gap), given, how, without)
    _angle(work, stroke, end, h, along, theta, free, given, how, shapes)


def _length(
    work: Work,
    stroke: Stroke,
    far: float,
    h: float,
    lengths: tuple[float, ...],
    k: int,
    case: Case,
    gap: float,
    given: dict[str, Quantity],
    how: tuple[str, str, str],
    shapes: tuple[Shape, ...],
) -> None:
    n = stroke.slide + 1
    name, turn = stroke.names
    values = given | {"D": Quantity("D", far)}
    if h != 0.0:
        values["h"] = Quantity("h", h)
    lines = [Line("D", how[2])]
    titles = ("slide ahead", "slide behind") if case == "two" else ("both",)
    branches = tuple(Branch(title, length - stroke.start) for title, length in zip(titles, lengths, strict=True))
    if case != "none":
        values["l"] = Quantity(r"\ell", lengths[k])
        lines.append(Line("l", r"<sign>\sqrt{<D>^2 - <h>^2}" if h != 0.0 else "<sign><D>"))
        if abs(stroke.start) > work.tiny:
            values |= {"start": Quantity(r"\ell_0", stroke.start), "q": Quantity(f"q_{n}", lengths[k] - stroke.start)}
            lines.append(Line("q", "<l> - <start>"))
    note = ""
    if case == "none":
        note = f"Out of reach: {name} is {{gap}} nearer to {turn} than the slide passes by it."
    elif case == "merged":
        note = f"Singular: {name} is exactly as far from {turn} as the slide passes by: both lengths are one."
        note = f"Singular: {name} lies on {turn}, and both lengths are one." if h == 0.0 else note
    work.add(
        f"q{n}",
        f"q_{n}",
        f"The length that brings the slide from {turn} to {name}, ahead or behind",
        "Pythagoras",
        values,
        tuple(lines),
        index=stroke.slide,
        branches=() if case == "none" else branches,
        chosen=k,
        case=case,
        note=note,
        gap=gap,
        shapes=shapes,
    )


def _angle(
    work: Work,
    stroke: Stroke,
    end: complex,
    h: float,
    along: float,
    theta: float,
    free: bool,
    given: dict[str, Quantity],
    how: tuple[str, str, str],
    shapes: tuple[Shape, ...],
) -> None:
    joint = stroke.turn
    n, (name, turn) = joint.number, stroke.names
    values: dict[str, Quantity] = {"theta": Quantity(rf"\theta_{n}", theta, "rad")}
    lines: list[Line] = []
    branch = Branch("as it is" if free else "", work.kept(joint.index) if free else joint.value(theta))
    if not free:
        values = given | {"l": Quantity(r"\ell", along)} | values
        if h != 0.0:
            values["h"] = Quantity("h", h)
            back = r"\mathrm{atan2}(<h>,\, <l>)"
            lines.append(Line("theta", rf"\mathrm{{atan2}}({how[1]},\, {how[0]}) - {back}"))
        else:
            # The sign of the length turns both arguments.
            sign = 1.0 if along > 0.0 else -1.0
            values |= {
                "sv": Quantity(rf"\pm {_symbols(how[1], given)}", sign * end.imag),
                "su": Quantity(rf"\pm {_symbols(how[0], given)}", sign * end.real),
            }
            lines.append(Line("theta", r"\mathrm{atan2}(<sv>,\, <su>)"))
        lines += own_value(joint, "theta", branch, values)
    work.add(
        f"q{n}",
        f"q_{n}",
        f"The slide points from {turn} to {name}, or away from it",
        "atan2 of two lengths",
        values,
        tuple(lines),
        index=joint.index,
        branches=(branch,),
        case="any" if free else "direct",
        note=f"Singular: {name} lies on {turn}, so q{n} may be any angle. The present one is kept." if free else "",
        shapes=shapes,
    )


def _symbols(template: str, given: dict[str, Quantity]) -> str:
    """Return a formula with the symbols of its quantities, in brackets where it is a sum."""
    for name, quantity in given.items():
        template = template.replace(f"<{name}>", quantity.symbol)
    return f"({template})" if " " in template else template


def _shapes(
    work: Work, stroke: Stroke, end: complex, h: float, along: float, theta: float, case: Case
) -> tuple[Shape, ...]:
    goal, normal = stroke.at(end), cross(stroke.u, stroke.v)
    shapes: list[Shape] = [Segment(stroke.origin, goal, "D" if h != 0.0 else "", "wanted"), Point(goal, "", "wanted")]
    if h != 0.0:
        shapes.append(Circle(stroke.origin, normal, abs(h)))
    else:
        corner = stroke.at(complex(end.real, 0.0))
        shapes += [Triangle(np.array([stroke.origin, corner, goal]), "wanted"), Segment(corner, goal, "", "helper")]
    if case == "none":
        return tuple(shapes)
    foot = stroke.at(along * complex(math.cos(theta), math.sin(theta)))
    radius = MARK * work.s.scale
    shapes.append(Segment(stroke.origin, foot, "l", "found"))
    if h != 0.0:
        shapes += [Segment(foot, goal, "h", "given"), Triangle(np.array([stroke.origin, foot, goal]), "given")]
    shapes += [
        Segment(stroke.origin, stroke.at(complex(1.5 * radius, 0.0)), "", "helper"),
        Arc(stroke.origin, radius * stroke.u, normal, theta, "theta"),
    ]
    return tuple(shapes)
