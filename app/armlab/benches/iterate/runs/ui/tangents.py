"""The picture of Newton's method in one variable: the curve, the moving tangent, and the iterates on the axis."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.iterate.newton_1d.clip import Place
from armlab.benches.iterate.runs.one_equation import Solved
from armlab.kin.ik.iterate.newton_1d import Newton1D as Iterate1D
from armlab.ui import svg
from armlab.ui.chart import Chart, Range
from armlab.ui.colours import BLUE, ORANGE, VERMILLION, css
from armlab.ui.format import subscript
from armlab.ui.html import Inside, Markup, tag

WIDTH, HEIGHT = 320, 220
LEFT, BOTTOM = 34, 18
"""Size of the picture, and room for numbers at its left and bottom edges, pixels."""

POINTS = 241

MARGIN = 0.12
"""Margin beside the iterates, relative to their extent."""

PALE = 0.4
"""Opacity of the tangent that has led to the present iterate."""

NARROW = 1e-6
"""Extent of iterates, relative to their size, that is not enlarged to fill the picture."""

WIDE = 12.0
"""Extent, in multiples of that of the first three iterates, up to which all are shown; beyond it those up to the
next."""

LARGEST = 1e300
"""Largest number that is drawn: greater ones overflow on the way to a pixel."""

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class View:
    """The visible part of the plane, and the curve in it.

    Attributes
    ----------
    chart : Chart
    at, curve : ndarray, shape (POINTS,)
        Abscissas over the range, and the function there.
    """

    chart: Chart
    at: Floats
    curve: Floats

    @classmethod
    def of(cls, solved: Solved, place: Place) -> View:
        """Return the view of the iterates around the present one."""
        found = [each.x for each in solved.iterates if _fits(each)]
        near = [each.x for each in solved.iterates[max(0, place.k - 1) : place.k + 2] if _fits(each)]
        first = _span(found[:3]) or 1.0
        seen = found if _span(found) <= WIDE * first else near
        low, high = min(seen), max(seen)
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        half = max(half * (1.0 + 2.0 * MARGIN), NARROW * max(1.0, abs(middle)))
        if len(found) == 1:
            half = max(1.0, 0.5 * abs(middle))
        x = (middle - half, middle + half)
        at = np.linspace(*x, POINTS)
        curve = np.array([solved.f(float(each)) for each in at])
        curve[np.abs(curve) > LARGEST] = np.nan
        return cls(Chart("it-tangents", x, _heights(solved, x, curve), WIDTH, HEIGHT, LEFT, BOTTOM), at, curve)


def _heights(solved: Solved, x: Range, curve: Floats) -> Range:
    """Return the visible range of ordinates."""
    finite = curve[np.isfinite(curve)]
    # The heights of the iterates in sight, and the axis; a pole beside them must not flatten the rest.
    heights = [0.0, *(each.f for each in solved.iterates if x[0] <= each.x <= x[1] and _fits(each))]
    reach, span = max(heights) - min(heights), float(np.ptp(finite)) if len(finite) else 0.0
    # A start at a root has no height: then all of the curve is shown.
    reach = reach if reach > NARROW * span else span
    low = max(float(finite.min()), min(heights) - reach) if len(finite) else -1.0
    high = min(float(finite.max()), max(heights) + reach) if len(finite) else 1.0
    low, high = min(low, 0.0), max(high, 0.0)
    room = MARGIN * (high - low) or 1.0
    return low - room, high + room


def picture(solved: Solved, place: Place) -> Markup:
    """Return the picture as SVG, or a sentence where the present iterate is too large for one."""
    k = place.k
    if not _fits(solved.iterates[k]):
        return tag("p.dim", f"{subscript('x', k)} or f is above 10³⁰⁰: too large to be drawn.")
    view = View.of(solved, place)
    chart = view.chart
    # The curve is interrupted where f has no value, and beside poles.
    drawn = zip(view.at.tolist(), view.curve.tolist(), strict=True)
    near = [(x, y if abs(chart.py(y)) < 4.0 * HEIGHT else math.nan) for x, y in drawn]
    curve = chart.line(near, stroke=css(BLUE), stroke_width=2)
    parts: list[Inside] = [chart.grid(), chart.zero(), curve, _iterates(chart, solved, k)]
    here = solved.iterates[k]
    after = solved.iterates[k + 1] if k < solved.last else None
    if k:
        parts.append(_tangent(chart, solved, Place(k - 1, 1.0), PALE))
    parts.append(_tangent(chart, solved, place, 1.0))
    if after is not None and place.climb > 0.0:
        parts.append(_line(chart, (after.x, 0.0), (after.x, place.climb * after.f), css(VERMILLION), "3 3", 1.4))
    spot = here.x, here.f
    if after is not None and place.root > 0.0:
        spot = (here.x + place.root * (after.x - here.x), here.f * (1.0 - place.root))
        if place.climb > 0.0:
            spot = (after.x, place.climb * after.f)
    parts.append(_dot(chart, *spot, 4.5, css(VERMILLION)))
    return chart.picture("Function, tangent and iterates", parts)


def _tangent(chart: Chart, solved: Solved, place: Place, opacity: float) -> Inside:
    """Return the tangent, which grows from the point of the curve to both sides."""
    here = solved.iterates[place.k]
    slope = here.tangent.slope
    reach = 1.5 * (chart.x[1] - chart.x[0]) * place.tangent
    if slope and place.k < solved.last:
        reach = max(reach, place.tangent * abs(here.f / slope) * 1.05)
    ends = [(here.x + side * reach, here.f + side * reach * slope) for side in (-1.0, 1.0)]
    up = _line(chart, (here.x, 0.0), (here.x, here.f), "currentColor", "2 3", 1.0)
    lines = up, _line(chart, ends[0], ends[1], css(ORANGE), "", 1.8)
    return lines if opacity == 1.0 else tag("g", lines, opacity=f"{opacity}")


def _iterates(chart: Chart, solved: Solved, k: int) -> list[Inside]:
    """Return the iterates so far on the axis; a name that others would cover is left out."""
    marks, taken = list[Inside](), list[float]()
    for i in range(k, -1, -1):
        x = chart.px(solved.iterates[i].x)
        if not LEFT <= x <= WIDTH:
            continue
        marks.append(_dot(chart, solved.iterates[i].x, 0.0, 2.6, "currentColor"))
        if all(abs(x - other) > 18.0 for other in taken):
            taken.append(x)
            above = solved.iterates[i].f < 0.0
            y = chart.py(0.0) + (-7.0 if above else 14.0)
            anchor = "end" if x > WIDTH - 14 else "middle"
            marks.append(svg.text("", x, y, subscript("x", i), anchor))
    return marks


def _line(
    chart: Chart, start: tuple[float, float], end: tuple[float, float], colour: str, dash: str, width: float
) -> Markup | None:
    points = (chart.px(start[0]), chart.py(start[1]), chart.px(end[0]), chart.py(end[1]))
    if not all(abs(value) < 1e7 for value in points):
        return None
    x1, y1, x2, y2 = (f"{value:.1f}" for value in points)
    looks = {"stroke": colour, "stroke_width": f"{width}", "stroke_dasharray": dash or None}
    return chart.cut(f"M{x1} {y1}L{x2} {y2}", **looks)


def _dot(chart: Chart, x: float, y: float, radius: float, colour: str) -> Markup | None:
    cx, cy = chart.px(x), chart.py(y)
    inside = -radius <= cy <= HEIGHT and LEFT - radius <= cx <= WIDTH + radius
    return svg.shape("circle", cx=cx, cy=cy, r=radius, fill=colour) if inside else None


def _fits(iterate: Iterate1D) -> bool:
    return max(abs(iterate.x), abs(iterate.f)) <= LARGEST


def _span(values: Sequence[float]) -> float:
    return max(values) - min(values)
