"""The residuals of a run as dots on a logarithmic axis, printed above and correct below."""

from __future__ import annotations

import math

from armlab.benches.lessons.errata.state import Found
from armlab.kin.errata.trial import POINTS, Trial
from armlab.ui import svg
from armlab.ui.chart import Chart
from armlab.ui.format import scientific
from armlab.ui.html import Markup

LOW, HIGH = 1e-17, 1e6
"""Ends of the axis; what is smaller or larger stands at the end."""

WIDTH, HEIGHT, LEFT, BOTTOM = 330.0, 96.0, 50.0, 16.0

DECADES = tuple(10.0**k for k in range(-15, 6, 5))
"""Values with a line and a number."""

CROSS = 3.2
"""Half the size of a cross, pixels."""

END = WIDTH - 4 * CROSS
"""Place of what has no value, pixels."""


def dots(found: Found, trial: Trial) -> Markup:
    """Return the picture of the residuals so far."""
    chart = Chart("er-dots", (LOW, HIGH), (0.0, 2.0), WIDTH, HEIGHT, LEFT, BOTTOM, log=True)
    shapes = [
        *(chart.upright(value, "grid") for value in DECADES),
        *(svg.text("tick", chart.px(value), HEIGHT - 4.0, power(value), "middle") for value in DECADES),
        chart.upright(trial.tolerance, "er-limit"),
        svg.text("er-name", 2.0, chart.py(1.5) + 4.0, "printed"),
        svg.text("er-name", 2.0, chart.py(0.5) + 4.0, "correct"),
        svg.line("grid", LEFT, chart.py(1.0), WIDTH, chart.py(1.0)),
        *(_cross(chart, value, k) for k, value in enumerate(found.printed)),
        svg.text("er-name", END - 2 * CROSS, chart.py(1.5) + 4.0, "no value", "end")
        if math.inf in found.printed
        else None,
        *(svg.circle("er-right", *_at(chart, value, k, 0.0), 2.6) for k, value in enumerate(found.correct)),
    ]
    seen = sum(value > trial.tolerance for value in found.printed)
    label = (
        f"Residuals at {len(found.printed)} points on a logarithmic axis: of the printed form {seen} are above the "
        f"tolerance, of the correct form {sum(value > trial.tolerance for value in found.correct)}"
    )
    return chart.picture(label, *shapes)


def power(value: float) -> str:
    """Return a power of ten, written as one."""
    return scientific(value, 0).replace("1·", "")


def _at(chart: Chart, value: float, k: int, row: float) -> tuple[float, float]:
    """Return the place of a dot; those of a row stand one below the other, so that equal ones are all seen."""
    part = (k + 0.5) / POINTS
    shown = min(max(value, LOW * 1.5), HIGH / 1.5)
    return chart.px(shown), chart.py(row + 0.12 + 0.76 * part)


def _cross(chart: Chart, value: float, k: int) -> Markup:
    x, y = _at(chart, value, k, 1.0)
    if math.isinf(value):  # a triangle at the end of the axis: there is no number
        return svg.path("er-none", f"M{END:.1f} {y - CROSS:.1f}v{2 * CROSS:.1f}l{2 * CROSS:.1f} {-CROSS:.1f}z")
    wide = 2 * CROSS
    return svg.path("er-wrong", f"M{x - CROSS:.1f} {y - CROSS:.1f}l{wide} {wide}m0 {-wide}l{-wide} {wide}")
