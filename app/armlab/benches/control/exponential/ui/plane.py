"""The picture of xdot = A x in the plane: the curve from the start, the place at t, and real eigenvectors."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.benches.control.exponential.state import Exponential
from armlab.ui import svg
from armlab.ui.colours import BLUE, GREY, ORANGE, VERMILLION, css
from armlab.ui.format import number
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.ticks import ticks

WIDTH, HEIGHT = 320, 200
LEFT, BOTTOM = 30, 16
MARGIN = 0.08
"""Room on each side of the curve, as a part of what it spans."""

EIGEN = (ORANGE, GREY)
"""Colours of the lines along the first and the second eigenvector."""

SAME = 1e-6
"""Sine of the angle between eigenvectors below which they are drawn as one."""

Array = NDArray[np.float64]


class _View:
    """The part of the plane that is drawn, with the same scale both ways."""

    def __init__(self, points: Array) -> None:
        low, high = points.min(axis=0), points.max(axis=0)
        middle = 0.5 * (low + high)
        wide, tall = WIDTH - LEFT, HEIGHT - BOTTOM
        room = (1.0 + 2.0 * MARGIN) * (high - low)
        self.unit = max(room[0] / wide, room[1] / tall, 1e-9)
        half = 0.5 * self.unit * np.array([wide, tall])
        self.x = (float(middle[0] - half[0]), float(middle[0] + half[0]))
        self.y = (float(middle[1] - half[1]), float(middle[1] + half[1]))

    def at(self, point: Array) -> tuple[float, float]:
        """Return the pixel of a point."""
        return LEFT + (float(point[0]) - self.x[0]) / self.unit, (self.y[1] - float(point[1])) / self.unit


def plane(part: Exponential) -> Markup:
    """Return the picture as SVG."""
    curve, here = part.curve, part.found.whole @ np.array(part.x0)
    view = _View(np.vstack([curve.x, np.zeros(2), here]))
    done = np.vstack([curve.x[curve.t < part.t], here])
    start, end = (view.at(point) for point in (curve.x[0], here))
    seen = tag("rect", x=LEFT, y=0, width=WIDTH - LEFT, height=HEIGHT - BOTTOM)
    return svg.drawing(
        "exp-plane",
        WIDTH,
        HEIGHT,
        "The curve of x(t) in the plane of x1 and x2",
        tag("clipPath", seen, id="exp-clip"),
        _axes(view),
        _eigenvectors(part, view),
        _line(view, curve.x, css(BLUE), 1.2, 0.4),
        _line(view, done, css(BLUE), 2.2, 1.0),
        _name(*start, "x(0)", css(BLUE), 3.0),
        _name(*end, "x(t)" if part.t > 0.0 else "", css(VERMILLION), 4.5),
    )


def _axes(view: _View) -> list[Markup]:
    lines = []
    for value in ticks(*view.x):
        x, _ = view.at(np.array([value, 0.0]))
        anchor = "end" if x > WIDTH - 14 else "middle"
        lines.append(svg.path("grid", f"M{x:.1f} 0V{HEIGHT - BOTTOM}"))
        lines.append(svg.text("tick", x, HEIGHT - 4, _tick(value), anchor))
    for value in ticks(*view.y):
        _, y = view.at(np.array([0.0, value]))
        lines.append(svg.path("grid", f"M{LEFT} {y:.1f}H{WIDTH}"))
        if y > 18.0:
            lines.append(svg.text("tick", LEFT - 4, y + 3.5, _tick(value), "end"))
    return [*lines, svg.text("", 2, 11, "x₂"), svg.text("", 2, HEIGHT - 4, "x₁")]


def _tick(value: float) -> str:
    if value != 0.0 and not 1e-3 <= abs(value) < 1e4:
        return f"{value:.0e}".replace("e+0", "e").replace("e-0", "e-").replace("-", "−")
    text = number(value, 3)
    return text.rstrip("0").rstrip(".")


def _eigenvectors(part: Exponential, view: _View) -> list[Markup]:
    """Return the lines on which x(t) stays, where there are such lines."""
    basis = part.found.basis
    if not basis.real:
        return []
    vectors = basis.T.real
    if abs(vectors[0, 0] * vectors[1, 1] - vectors[1, 0] * vectors[0, 1]) < SAME:
        vectors = vectors[:, :1]
    lines = []
    reach = 2.0 * view.unit * math.hypot(WIDTH, HEIGHT) + max(map(abs, (*view.x, *view.y)))
    for i, (dx, dy) in enumerate(vectors.T):
        ends = (view.at(side * reach * np.array([dx, dy])) for side in (-1.0, 1.0))
        (x1, y1), (x2, y2) = ends
        way, clip = f"M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}", "url(#exp-clip)"
        lines.append(
            svg.shape("path", d=way, clip_path=clip, stroke=css(EIGEN[i]), stroke_width=1.4, stroke_dasharray="5 3")
        )
    return lines


def _line(view: _View, points: Array, colour: str, width: float, opacity: float) -> Markup:
    text = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(view.at, points))
    return svg.shape("polyline", points=text, fill="none", stroke=colour, stroke_width=width, opacity=opacity)


def _name(x: float, y: float, text: str, colour: str, radius: float) -> Inside:
    side, at = ("end", x - 7) if x > WIDTH - 40 else ("start", x + 7)
    above = y - 6 if y > 16 else y + 14
    name = svg.text("", at, above, text, side) if text else None
    return svg.shape("circle", cx=x, cy=y, r=radius, fill=colour), name
