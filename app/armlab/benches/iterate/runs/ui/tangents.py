"""The picture of Newton's method in one variable: the curve, the moving tangent, and the iterates on the axis."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.benches.iterate.newton_1d.clip import Place
from armlab.benches.iterate.runs.one_equation import Solved
from armlab.ui.colours import BLUE, ORANGE, VERMILLION, css
from armlab.ui.format import number, subscript
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.ticks import ticks

WIDTH, HEIGHT = 320, 220
LEFT, BOTTOM = 34, 18
"""Of the picture and of what the numbers take at its edges, in pixels."""

POINTS = 241

MARGIN = 0.12
"""Beside the iterates, in parts of what they span."""

PALE = 0.4
"""Opacity of the tangent that has led to the present iterate."""

NARROW = 1e-6
"""Span of iterates, relative to their size, that is not made to fill the picture."""

WIDE = 12.0
"""So many times what the first three iterates span, all of them are shown at once; of more, those up to the next."""

CLIPPED = "url(#it-clip)"

Floats = NDArray[np.float64]


class View:
    """The part of the plane that is drawn.

    Attributes
    ----------
    x, y : (float, float)
        Ranges.
    """

    def __init__(self, solved: Solved, place: Place) -> None:
        found = [each.x for each in solved.iterates]
        first = _span(found[:3]) or 1.0
        seen = found if _span(found) <= WIDE * first else found[max(0, place.k - 1) : place.k + 2]
        low, high = min(seen), max(seen)
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        half = max(half * (1.0 + 2.0 * MARGIN), NARROW * max(1.0, abs(middle)))
        if len(found) == 1:
            half = max(1.0, 0.5 * abs(middle))
        self.x = (middle - half, middle + half)
        self.at = np.linspace(*self.x, POINTS)
        self.curve = np.array([solved.f(float(x)) for x in self.at])
        finite = self.curve[np.isfinite(self.curve)]
        # The heights of the iterates in sight, and the axis; a pole beside them must not flatten the rest.
        heights = [0.0, *(each.f for each in solved.iterates if self.x[0] <= each.x <= self.x[1])]
        reach, span = max(heights) - min(heights), float(np.ptp(finite)) if len(finite) else 0.0
        # A start at a root has no height: then all of the curve is shown.
        reach = reach if reach > NARROW * span else span
        low = max(float(finite.min()), min(heights) - reach) if len(finite) else -1.0
        high = min(float(finite.max()), max(heights) + reach) if len(finite) else 1.0
        low, high = min(low, 0.0), max(high, 0.0)
        room = MARGIN * (high - low) or 1.0
        self.y = (low - room, high + room)

    def px(self, x: float) -> float:
        """Return the pixel of an abscissa."""
        return LEFT + (WIDTH - LEFT) * (x - self.x[0]) / (self.x[1] - self.x[0])

    def py(self, y: float) -> float:
        """Return the pixel of an ordinate."""
        return (HEIGHT - BOTTOM) * (self.y[1] - y) / (self.y[1] - self.y[0])


def picture(solved: Solved, place: Place) -> Markup:
    """Return the picture as SVG."""
    view = View(solved, place)
    k = place.k
    parts: list[Inside] = [_axes(view), _path(view), _iterates(view, solved, k)]
    here = solved.iterates[k]
    after = solved.iterates[k + 1] if k < solved.last else None
    if k:
        parts.append(_tangent(view, solved, Place(k - 1, 1.0), PALE))
    parts.append(_tangent(view, solved, place, 1.0))
    if after is not None and place.climb > 0.0:
        parts.append(_line(view, (after.x, 0.0), (after.x, place.climb * after.f), css(VERMILLION), "3 3", 1.4))
    spot = here.x, here.f
    if after is not None and place.root > 0.0:
        spot = (here.x + place.root * (after.x - here.x), here.f * (1.0 - place.root))
        if place.climb > 0.0:
            spot = (after.x, place.climb * after.f)
    parts.append(_dot(view, *spot, 4.5, css(VERMILLION)))
    inside = tag("rect", x=LEFT, y=0, width=WIDTH - LEFT, height=HEIGHT - BOTTOM)
    return tag(
        "svg.it-tangents",
        tag("clipPath", inside, id="it-clip"),
        parts,
        viewBox=f"0 0 {WIDTH} {HEIGHT}",
        role="img",
        aria_label="Function, tangent and iterates",
    )


def _tangent(view: View, solved: Solved, place: Place, opacity: float) -> Inside:
    """Return the tangent, growing from the point of the curve to both sides."""
    here = solved.iterates[place.k]
    slope = here.tangent.slope
    reach = 1.5 * (view.x[1] - view.x[0]) * place.tangent
    if slope and place.k < solved.last:
        reach = max(reach, place.tangent * abs(here.f / slope) * 1.05)
    ends = [(here.x + side * reach, here.f + side * reach * slope) for side in (-1.0, 1.0)]
    up = _line(view, (here.x, 0.0), (here.x, here.f), "currentColor", "2 3", 1.0)
    lines = up, _line(view, ends[0], ends[1], css(ORANGE), "", 1.8)
    return lines if opacity == 1.0 else tag("g", lines, opacity=f"{opacity}")


def _iterates(view: View, solved: Solved, k: int) -> list[Inside]:
    """Return the iterates so far on the axis; the names of those that others would cover are left out."""
    marks, taken = list[Inside](), list[float]()
    for i in range(k, -1, -1):
        x = view.px(solved.iterates[i].x)
        if not LEFT <= x <= WIDTH:
            continue
        marks.append(_dot(view, solved.iterates[i].x, 0.0, 2.6, "currentColor"))
        if all(abs(x - other) > 18.0 for other in taken):
            taken.append(x)
            above = solved.iterates[i].f < 0.0
            y = view.py(0.0) + (-7.0 if above else 14.0)
            anchor = "end" if x > WIDTH - 14 else "middle"
            marks.append(tag("text", subscript("x", i), x=f"{x:.1f}", y=f"{y:.1f}", text_anchor=anchor))
    return marks


def _axes(view: View) -> list[Markup]:
    lines = []
    for value in ticks(*view.x):
        x = view.px(value)
        anchor = "end" if x > WIDTH - 16 else "middle"
        lines.append(tag("path.grid", d=f"M{x:.1f} 0V{HEIGHT - BOTTOM}"))
        lines.append(tag("text.tick", _tick(value, view.x), x=f"{x:.1f}", y=HEIGHT - 4, text_anchor=anchor))
    for value in ticks(*view.y):
        y = view.py(value)
        lines.append(tag("path.grid", d=f"M{LEFT} {y:.1f}H{WIDTH}"))
        lines.append(tag("text.tick", _tick(value, view.y), x=LEFT - 4, y=f"{y + 4:.1f}", text_anchor="end"))
    return [*lines, tag("path.axis", d=f"M{LEFT} {view.py(0.0):.1f}H{WIDTH}")]


def _tick(value: float, span: tuple[float, float]) -> str:
    wide = span[1] - span[0]
    if abs(value) >= 1e5 or wide < 1e-4:
        return f"{value:.0e}".replace("e+0", "e").replace("e-0", "e-").replace("-", "−") if value else "0"
    decimals = max(0, 1 - math.floor(math.log10(wide / 2.0)))
    text = number(value, decimals)
    return text.rstrip("0").rstrip(".") if "." in text else text


def _path(view: View) -> Markup:
    """Return the curve; where f has no value, and beside poles, it breaks."""
    pieces, pen = [], False
    high = 4.0 * HEIGHT
    for x, y in zip(view.at.tolist(), view.curve.tolist(), strict=True):
        at = view.py(y) if math.isfinite(y) else math.inf
        if not -high < at < high:
            pen = False
            continue
        pieces.append(f"{'L' if pen else 'M'}{view.px(x):.1f} {at:.1f}")
        pen = True
    return tag("path", clip_path=CLIPPED, d="".join(pieces), fill="none", stroke=css(BLUE), stroke_width=2)


def _line(
    view: View, start: tuple[float, float], end: tuple[float, float], colour: str, dash: str, width: float
) -> Markup | None:
    points = (view.px(start[0]), view.py(start[1]), view.px(end[0]), view.py(end[1]))
    if not all(abs(value) < 1e7 for value in points):
        return None
    x1, y1, x2, y2 = (f"{value:.1f}" for value in points)
    looks = {"stroke": colour, "stroke_width": f"{width}", "stroke_dasharray": dash or None}
    return tag("path", clip_path=CLIPPED, d=f"M{x1} {y1}L{x2} {y2}", **looks)


def _dot(view: View, x: float, y: float, radius: float, colour: str) -> Markup | None:
    cx, cy = view.px(x), view.py(y)
    inside = -radius <= cy <= HEIGHT and LEFT - radius <= cx <= WIDTH + radius
    return tag("circle", cx=f"{cx:.1f}", cy=f"{cy:.1f}", r=f"{radius}", fill=colour) if inside else None


def _span(values: Sequence[float]) -> float:
    return max(values) - min(values)
