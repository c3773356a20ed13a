"""Two links in a plane carry their end to a point: the law of cosines, and the difference of two angles.

    cos(gamma) = (D² - L1² - L2²) / (2 L1 L2),   theta = atan2(v, u) - atan2(L2 sin(gamma), L1 + L2 cos(gamma))

gamma is the angle by which the second link is bent out of the line of the first, theta that of the first link.

References
----------
Notes 4.50-4.65 and 4.94-4.105, corrected: folded links merge the two solutions as stretched ones do.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from armlab.kin.ik.branches import BESIDE
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
from armlab.kin.ik.by_hand.turning import MARK, NIL
from armlab.kin.ik.by_hand.work import Work
from armlab.kin.ik.problem import REACHED_M
from armlab.kin.ik.screws import cross
from armlab.kin.ik.trig import wrap

MERGED = 1e-7
"""Sine of the bend below which both signs of it count as one: rounding decides then whether they are real."""


@dataclass(frozen=True)
class Joint:
    """A joint that turns in the plane.

    Attributes
    ----------
    index : int
        0-based.
    sense : float
        1 where it turns its link from the first axis of the plane to the second, -1 the other way.
    zero : float
        The angle at which its value is zero, rad.
    """

    index: int
    sense: float
    zero: float

    @property
    def number(self) -> int:
        """Its number from 1."""
        return self.index + 1

    def value(self, angle: float) -> float:
        """Return the joint value at an angle."""
        return wrap(self.sense * (angle - self.zero))


@dataclass(frozen=True, eq=False)
class Links:
    """Two links in a plane.

    Attributes
    ----------
    origin, u, v : ndarray, shape (3,)
        The first joint in frame 0, and the axes of the plane.
    lengths : tuple of float
        Metres.
    joints : tuple of Joint
    names : tuple of str
        Of both lengths, of the end, and of the first joint, in words for the last two.
    up : ndarray, shape (2,), or None
        Above in the plane; None where it is the left of the way to the end.
    """

    origin: Vector
    u: Vector
    v: Vector
    lengths: tuple[float, float]
    joints: tuple[Joint, Joint]
    names: tuple[str, str, str, str]
    up: Vector | None = None

    def at(self, point: complex) -> Vector:
        """Return a point of the plane in frame 0."""
        return np.asarray(self.origin + point.real * self.u + point.imag * self.v)


def between(start: complex, middle: complex, end: complex) -> tuple[tuple[float, float], float, float]:
    """Return both lengths, the angle of the first link and the bend of the second, of three points at q = 0."""
    first, second = middle - start, end - middle
    bend = math.atan2((first.conjugate() * second).imag, (first.conjugate() * second).real)
    return (abs(first), abs(second)), math.atan2(first.imag, first.real), bend


def reach(
    work: Work, links: Links, end: complex, given: dict[str, Quantity], how: tuple[str, str, str]
) -> tuple[float, float]:
    """Find both joints so that the second link ends at a point of the plane; return the angles theta and gamma.

    Parameters
    ----------
    work : Work
    links : Links
    end : complex
    given : dict of str to Quantity
        The quantities that the point is made of.
    how : tuple of str
        LaTeX of both coordinates of the point and of its distance, made of those.
    """
    gamma = _bend(work, links, end, given, how)
    theta = _aim(work, links, end, gamma, given, how)
    return theta, gamma


def _bend(work: Work, links: Links, end: complex, given: dict[str, Quantity], how: tuple[str, str, str]) -> float:
    (L1, L2), D, joint = links.lengths, abs(end), links.joints[1]
    gap = max(D - (L1 + L2), abs(L1 - L2) - D)
    cosine = (D * D - L1 * L1 - L2 * L2) / (2.0 * L1 * L2)
    # As a product, which keeps its digits where the links are nearly in line.
    square = (L1 + L2 - D) * (L1 + L2 + D) * (D - L1 + L2) * (D + L1 - L2)
    sine = math.sqrt(max(0.0, square)) / (2.0 * L1 * L2)
    case: Case = "none" if gap > REACHED_M else "merged" if sine <= MERGED else "two"
    key = f"q{joint.number}"
    k = work.choose(key, 2) if case == "two" else 0
    straight = 0.0 if cosine > 0.0 else math.pi
    angles = (math.atan2(sine, cosine), -math.atan2(sine, cosine)) if case == "two" else (straight,)
    gamma = angles[k] if case != "none" else math.nan
    branches = () if case == "none" else tuple(_branch(work, links, end, angle, case) for angle in angles)
    one, two, name, start = links.names
    values = given | {
        "D": Quantity("D", D),
        "L1": Quantity(one, L1),
        "L2": Quantity(two, L2),
        "c": Quantity(r"\cos\gamma", cosine, ""),
        "c2": Quantity(r"\cos^2\gamma", cosine * cosine, ""),
    }
    lines = [Line("D", how[2]), Line("c", r"\frac{<D>^2 - <L1>^2 - <L2>^2}{2 \cdot <L1> \cdot <L2>}")]
    if case != "none":
        values["gamma"] = Quantity(r"\gamma", gamma, "rad")
        lines.append(Line("gamma", r"\mathrm{atan2}(<sign>\sqrt{1 - <c2>},\, <c>)"))
        lines += own_value(joint, "gamma", branches[k], values)
    work.add(
        key,
        f"q_{joint.number}",
        f"Two circles, one around {start} and one around {name}, meet where the elbow can be",
        "law of cosines",
        values,
        tuple(lines),
        index=joint.index,
        branches=branches,
        chosen=k,
        case=case,
        note=_bend_note(case, cosine, D, L1, L2, name, start),
        gap=max(0.0, gap),
        shapes=_bend_shapes(work, links, end, angles, k, case),
    )
    return gamma


def _branch(work: Work, links: Links, end: complex, gamma: float, case: Case) -> Branch:
    if case == "merged":
        return Branch("straight" if gamma == 0.0 else "folded", links.joints[1].value(gamma))
    aside = _elbow(links, end, gamma)
    if abs(end) > 0.0:
        way = end / abs(end)
        aside -= (aside * way.conjugate()).real * way
        up = complex(*links.up) if links.up is not None else 1j * way
    else:
        up = 1j
    height = (aside * up.conjugate()).real
    # Where the end is above the shoulder, both elbows are beside the way to it, none higher than the other.
    least = BESIDE * work.s.scale
    side = "up" if height > least else "down" if height < -least else "beside"
    return Branch(f"elbow {side}", links.joints[1].value(gamma))


def _elbow(links: Links, end: complex, gamma: float) -> complex:
    """Return where the elbow is in the plane."""
    L1, L2 = links.lengths
    theta = math.atan2(end.imag, end.real) - math.atan2(L2 * math.sin(gamma), L1 + L2 * math.cos(gamma))
    return complex(L1 * math.cos(theta), L1 * math.sin(theta))


def _bend_note(case: Case, cosine: float, D: float, L1: float, L2: float, name: str, start: str) -> str:
    if case == "none":
        if L1 + L2 < D:
            return f"Out of reach: {name} is {{gap}} farther from {start} than both links in one line."
        return f"Out of reach: {name} is {{gap}} nearer to {start} than the folded links can come."
    if case == "merged":
        how = "stretched" if cosine > 0.0 else "folded"
        return f"Elbow singularity: the links are {how} in one line, and both signs give the same angle."
    return ""


def _bend_shapes(
    work: Work, links: Links, end: complex, angles: tuple[float, ...], k: int, case: Case
) -> tuple[Shape, ...]:
    L1, L2 = links.lengths
    start, goal, normal = links.origin, links.at(end), cross(links.u, links.v)
    shapes: list[Shape] = [
        Circle(start, normal, L1),
        Circle(goal, normal, L2),
        Segment(start, goal, "D", "wanted"),
        Point(goal, "", "wanted"),
    ]
    if case == "none":
        way = end / abs(end) if abs(end) > 0.0 else 1.0 + 0j
        near = way * (L1 + L2 if abs(end) > L1 + L2 else abs(L1 - L2))
        return (*shapes, Segment(links.at(near), goal, "", "found"))
    elbow = _elbow(links, end, angles[k])
    point = links.at(elbow)
    shapes += [
        Triangle(np.array([start, point, goal]), "given"),
        Segment(start, point, "L1", "given"),
        Segment(point, goal, "L2", "given"),
        Segment(point, links.at(1.4 * elbow), "", "helper"),
        Arc(point, MARK * work.s.scale * (point - start) / L1, normal, angles[k], "gamma"),
    ]
    for j, angle in enumerate(angles):
        if j != k:
            other = links.at(_elbow(links, end, angle))
            shapes += [Segment(start, other, "", "helper"), Segment(other, goal, "", "helper")]
    return tuple(shapes)


def _aim(
    work: Work, links: Links, end: complex, gamma: float, given: dict[str, Quantity], how: tuple[str, str, str]
) -> float:
    (L1, L2), joint = links.lengths, links.joints[0]
    one, two, name, start = links.names
    free = abs(end) <= work.tiny
    symbol = rf"\theta_{joint.number}"
    title = f"The first link leaves the straight way from {start} to {name} by the angle β"
    key, found = f"q{joint.number}", f"q_{joint.number}"
    if free:
        value = work.kept(joint.index)
        theta = wrap(joint.zero + joint.sense * value)
        work.add(
            key,
            found,
            title,
            "difference of two angles",
            {"theta": Quantity(symbol, theta, "rad")},
            (),
            index=joint.index,
            branches=(Branch("as it is", value),),
            case="any",
            shapes=(
                Segment(links.origin, links.at(L1 * complex(math.cos(theta), math.sin(theta))), "", "given"),
                Point(links.at(end), "", "wanted"),
            ),
            note=f"Singular: {name} lies on {start}, so {key} may be any angle. The present one is kept.",
        )
        return theta
    alpha = math.atan2(end.imag, end.real)
    beta = math.atan2(L2 * math.sin(gamma), L1 + L2 * math.cos(gamma))
    theta = wrap(alpha - beta)
    branch = Branch("", joint.value(theta))
    values = given | {
        "L1": Quantity(one, L1),
        "L2": Quantity(two, L2),
        "gamma": Quantity(r"\gamma", gamma, "rad"),
        "alpha": Quantity(r"\alpha", alpha, "rad"),
        "beta": Quantity(r"\beta", beta, "rad"),
        "theta": Quantity(symbol, theta, "rad"),
    }
    lines = [
        Line("alpha", rf"\mathrm{{atan2}}({how[1]},\, {how[0]})"),
        Line("beta", r"\mathrm{atan2}(<L2>\,\sin<gamma>,\, <L1> + <L2>\,\cos<gamma>)"),
        Line("theta", r"<alpha> - <beta>"),
    ]
    lines += own_value(joint, "theta", branch, values)
    goal, normal = links.at(end), cross(links.u, links.v)
    elbow = links.at(complex(L1 * math.cos(theta), L1 * math.sin(theta)))
    radius = MARK * work.s.scale
    level = links.at(complex(1.5 * radius, 0.0))
    work.add(
        key,
        found,
        title,
        "difference of two angles",
        values,
        tuple(lines),
        index=joint.index,
        branches=(branch,),
        shapes=(
            Triangle(np.array([links.origin, elbow, goal]), "given"),
            Segment(links.origin, elbow, "L1", "given"),
            Segment(elbow, goal, "L2", "given"),
            Segment(links.origin, goal, "", "wanted"),
            Segment(links.origin, level, "", "helper"),
            Arc(links.origin, radius * links.u, normal, alpha, "alpha", "wanted"),
            Arc(links.origin, 0.7 * radius * (elbow - links.origin) / L1, normal, beta, "beta", "helper"),
            Arc(links.origin, 1.3 * radius * links.u, normal, theta, "theta"),
            Point(goal, "", "wanted"),
        ),
    )
    return theta


def own_value(joint: Joint, angle: str, branch: Branch, values: dict[str, Quantity]) -> list[Line]:
    """Return the line from an angle to the joint value, where they differ."""
    zero = abs(joint.zero) <= NIL
    if zero and joint.sense > 0.0:
        return []
    assert branch.value is not None
    n = joint.number
    values["q"] = Quantity(f"q_{n}", branch.value, "rad")
    if zero:
        return [Line("q", f"-<{angle}>")]
    symbol = values[angle].symbol
    base = symbol if "_" not in symbol else symbol.split("_")[0]
    values["zero"] = Quantity(rf"{base}_{{{n},0}}" if "_" in symbol else rf"{base}_0", joint.zero, "rad")
    return [Line("q", f"<{angle}> - <zero>" if joint.sense > 0.0 else f"<zero> - <{angle}>")]
