"""The picture of xdot = A x in the plane: the curve from the start, the point at t, and real eigenvectors."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.control.exponential.state import Exponential
from armlab.ui import svg
from armlab.ui.chart import Chart
from armlab.ui.colours import BLUE, GREY, ORANGE, VERMILLION, css
from armlab.ui.html import Inside, Markup

WIDTH, HEIGHT = 320, 200
LEFT, BOTTOM = 30, 16
"""Size of the picture, and room for numbers at its left and bottom edges, pixels."""

LEAST = 1e-9
"""Units of x in a pixel, for a curve that stands still."""

MARGIN = 0.08
"""Room on each side of the curve, as a share of its extent."""

EIGEN = (ORANGE, GREY)
"""Colours of the lines along the first and the second eigenvector."""

SAME = 1e-6
"""Sine of the angle between eigenvectors below which they are drawn as one."""

Array = NDArray[np.float64]


def _chart(points: Array) -> Chart:
    """Return the part of the plane that is drawn, with the same scale in both directions."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, room = 0.5 * (low + high), (1.0 + 2.0 * MARGIN) * (high - low)
    box = np.array([WIDTH - LEFT, HEIGHT - BOTTOM])
    half = 0.5 * box * max(float((room / box).max()), LEAST)
    (x0, y0), (x1, y1) = (middle - half).tolist(), (middle + half).tolist()
    return Chart("exp-plane", (x0, x1), (y0, y1), WIDTH, HEIGHT, LEFT, BOTTOM, ("x₁", "x₂"))


def plane(part: Exponential) -> Markup:
    """Return the picture as SVG."""
    curve, here = part.curve, part.found.whole @ np.array(part.x0)
    chart = _chart(np.vstack([curve.x, np.zeros(2), here]))
    done = np.vstack([curve.x[curve.t < part.t], here])
    start, end = ((chart.px(float(x)), chart.py(float(y))) for x, y in (curve.x[0], here))
    return chart.picture(
        "The curve of x(t) in the plane of x1 and x2",
        chart.grid(),
        _eigenvectors(part, chart),
        chart.line(curve.x.tolist(), stroke=css(BLUE), stroke_width="1.2", opacity="0.4"),
        chart.line(done.tolist(), stroke=css(BLUE), stroke_width="2.2"),
        _name(*start, "x(0)", css(BLUE), 3.0),
        _name(*end, "x(t)" if part.t > 0.0 else "", css(VERMILLION), 4.5),
    )


def eigenvectors(part: Exponential) -> Array:
    """Return the real eigenvectors, one in each row, (k, 2); one of two that are the same."""
    basis = part.found.basis
    if not basis.real:
        return np.zeros((0, 2))
    vectors = basis.T.real
    if abs(vectors[0, 0] * vectors[1, 1] - vectors[1, 0] * vectors[0, 1]) < SAME:
        vectors = vectors[:, :1]
    return np.asarray(vectors.T)


def _eigenvectors(part: Exponential, chart: Chart) -> list[Markup]:
    """Return the lines on which x(t) stays, if there are any."""
    vectors = eigenvectors(part)
    reach = 2.0 * (abs(chart.x[0]) + abs(chart.x[1]) + abs(chart.y[0]) + abs(chart.y[1]))
    return [
        chart.line(
            [(side * reach * dx, side * reach * dy) for side in (-1.0, 1.0)],
            stroke=css(EIGEN[i]),
            stroke_width="1.4",
            stroke_dasharray="5 3",
        )
        for i, (dx, dy) in enumerate(vectors.tolist())
    ]


def _name(x: float, y: float, text: str, colour: str, radius: float) -> Inside:
    side, at = ("end", x - 7) if x > WIDTH - 40 else ("start", x + 7)
    above = y - 6 if y > 16 else y + 14
    name = svg.text("", at, above, text, side) if text else None
    return svg.shape("circle", cx=x, cy=y, r=radius, fill=colour), name
