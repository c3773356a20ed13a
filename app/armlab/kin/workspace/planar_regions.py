"""The regions of figure 4.9 for any planar arm of two or three links, in words and numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Literal

import numpy as np

from armlab.kin.workspace.planar import (
    EDGE,
    PlanarWorkspace,
    Signs,
    families,
    orientations,
    planar_workspace,
    tool_angles,
)

Kind = Literal["boundary", "edge", "dexterous", "partial", "crossing", "two", "origin"]

ACROSS = 2001
"""Number of radii of a ring at which the range of orientations is measured."""

NAMES: dict[Kind, str] = {
    "boundary": "boundary ∂WS₁",
    "edge": "singular circle in WS₂",
    "dexterous": "dexterous WS₂",
    "partial": "WS₁ \\ WS₂",
    "crossing": "singular circle",
    "two": "inside WS₁",
    "origin": "origin",
}


@dataclass(frozen=True)
class Region:
    """A circle or a ring about the first axis in which the same can be said of every point.

    Attributes
    ----------
    low, high : float
        Radii in metres, equal of a circle; a ring is without its edges, but with the origin.
    kind : str
        ``"boundary"``: of WS1; ``"edge"``: a singular circle with all orientations; ``"dexterous"``: all orientations;
        ``"partial"``: a range of them; ``"crossing"``: a singular circle in such a ring; ``"two"``: between the
        boundaries of a 2R; ``"origin"``: where links can fold so that joint 1 is free.
    least, most : float
        Measure of the orientations, rad, smallest and largest in the ring.
    ranges : int
        Number of separate ranges in which they lie; 0 for single orientations.
    ways : tuple of tuple of int
        The stretched and folded configurations of a singular circle, as signs of the links.
    orientations, solutions : str
        Descriptions in words.
    """

    low: float
    high: float
    kind: Kind
    least: float
    most: float
    ranges: int
    ways: tuple[Signs, ...]
    orientations: str
    solutions: str

    @property
    def name(self) -> str:
        """The name of the region."""
        return NAMES[self.kind]

    @property
    def says(self) -> str:
        """The description of the region."""
        return f"{self.orientations} {self.solutions}"


@lru_cache(maxsize=32)
def regions(lengths: tuple[float, ...]) -> tuple[Region, ...]:
    """Return circles and rings of a planar arm from the inside out.

    Parameters
    ----------
    lengths : tuple of two or three positive numbers
        Metres.
    """
    space = planar_workspace(lengths)
    circles = {r: ways for r, ways in space.singular if r <= space.outer}
    edges = sorted({space.inner, *circles})
    found: list[Region] = []
    for low, high in pairwise([*edges, math.inf]):
        if low in circles:
            found.append(_circle(space, low, circles[low]))
        if math.isfinite(high):
            found.append(_ring(space, low, high))
    return tuple(found)


def region_at(lengths: Sequence[float], r: float) -> Region | None:
    """Return the region that contains a radius in metres; None outside WS1."""
    links = tuple(map(float, lengths))
    edge = EDGE * sum(links)
    found = regions(links)
    on = [one for one in found if one.low == one.high and abs(r - one.low) <= edge]
    inside = [one for one in found if one.low < one.high and one.low - edge <= r < one.high]
    return next(iter(on + inside), None)


def _circle(space: PlanarWorkspace, r: float, ways: tuple[Signs, ...]) -> Region:
    count = _ways(len(ways))
    if len(space.lengths) == 2 and r == 0.0:
        words = "All orientations: link 2 is folded on link 1.", "Infinitely many solutions, q₁ is free; all singular."
        return Region(r, r, "origin", math.tau, math.tau, 1, ways, *words)
    if r in (space.inner, space.outer) and r > 0.0:
        return Region(r, r, "boundary", 0.0, 0.0, 0, ways, "One orientation.", "One solution, singular.")
    if r == 0.0:
        words = "All orientations, each in one way.", "Infinitely many solutions, all singular: q₁ is free."
        return Region(r, r, "origin", math.tau, math.tau, 1, ways, *words)
    many = f"Infinitely many solutions (∞¹) for the position, {count} of them singular."
    a, b, c = space.lengths
    if abs(a - b) <= EDGE * space.outer and abs(r - c) <= EDGE * space.outer:
        many += " With link 3 pointing outward links 1 and 2 fold, q₁ is free: infinitely many for that pose too."
    measure = float(orientations(space.lengths, r))
    if space.is_dexterous(r):
        return Region(r, r, "edge", math.tau, math.tau, 1, ways, "All orientations.", many)
    ranges = _ranges(space.lengths, r)
    return Region(r, r, "crossing", measure, measure, ranges, ways, _some(ranges), many)


def _ring(space: PlanarWorkspace, low: float, high: float) -> Region:
    middle = 0.5 * (low + high)
    if len(space.lengths) == 2:
        words = "Two orientations, one for each solution.", "Two solutions, elbow up and down."
        return Region(low, high, "two", 0.0, 0.0, 0, (), *words)
    curves = int(families(space.lengths, middle))
    many = f"Infinitely many solutions (∞¹) for the position, in {'one family' if curves == 1 else 'two families'}"
    many += ", none singular."
    if space.is_dexterous(middle):
        words = "All orientations.", f"Two solutions for position and angle. {many}"
        return Region(low, high, "dexterous", math.tau, math.tau, 1, (), *words)
    measures = orientations(space.lengths, np.linspace(low, high, ACROSS))
    least, most = float(measures.min()), float(measures.max())
    ranges = _ranges(space.lengths, middle)
    solutions = f"Two solutions for position and angle, one at the ends of a range. {many}"
    return Region(low, high, "partial", least, most, ranges, (), _some(ranges), solutions)


def _ranges(lengths: Sequence[float], r: float) -> int:
    """Return the number of intervals of the tool's angles: psi and -psi meet at 0 or at pi."""
    low, high = tool_angles(lengths, r)
    return 1 if low <= 0.0 or high >= math.pi else 2


def _some(ranges: int) -> str:
    where = "in one range" if ranges == 1 else "in two ranges"
    return f"Infinitely many orientations, but not all, {where}."


def _ways(count: int) -> str:
    return {1: "one", 2: "two", 3: "three", 4: "four"}[count]
