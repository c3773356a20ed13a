"""The largest errors of both readings over the speed, on logarithmic axes."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.benches.sensor.speed.state import EncoderSpeed
from armlab.session.amounts import amount
from armlab.ui import svg
from armlab.ui.chart import Chart
from armlab.ui.colours import BLUE, VERMILLION, css
from armlab.ui.curve import Curve
from armlab.ui.html import Inside, Markup
from armlab.ui.tray_picture import Drawn, Picture
from armlab.ui.units import Units

Floats = NDArray[np.float64]

WIDTH, HEIGHT, LEFT, BOTTOM = 330.0, 150.0, 40.0, 18.0

COUNTS, TIME = VERMILLION, BLUE
"""Colours of what is read by counts and by the time between them."""

POINTS = 201

AROUND = 1.6
"""Decades that are seen below the lower and above the higher of the crossover and the true speed."""

UP, LEAST = 300.0, 1e-6
"""Largest error that is seen, and least one, in percent."""


def speeds(part: EncoderSpeed) -> Floats:
    """Return the speeds of the curves, rad/s."""
    seen = [math.log10(part.meter.crossover), math.log10(part.speed)]
    return np.geomspace(10.0 ** (min(seen) - AROUND), 10.0 ** (max(seen) + AROUND), POINTS)


def percents(part: EncoderSpeed, at: Floats) -> tuple[Floats, Floats]:
    """Return the largest errors by counts and by time at speeds, in percent; nan where there is no reading."""
    time = part.meter.error_by_time(at)
    return 100.0 * part.meter.error_by_counts(at), 100.0 * np.where(np.isfinite(time), time, np.nan)


def errors(part: EncoderSpeed, units: Units) -> Markup:
    """Return the picture, with the true speed and the crossover marked."""
    at, factor = speeds(part), units.factor(True)
    counts, time = percents(part, at)
    low = max(LEAST, float(np.nanmin(np.concatenate([counts, time]))))
    unit = f"{units.angle_unit}/s"
    names = f"ω, {unit}", "%"
    x = float(at[0]) / factor, float(at[-1]) / factor
    chart = Chart("sp-errors", x, (low, UP), WIDTH, HEIGHT, LEFT, BOTTOM, names, log=True, log_y=True)
    cross, here = part.meter.crossover / factor, part.speed / factor
    side, beside = ("end", chart.px(cross) - 3.0) if chart.px(cross) > 0.6 * WIDTH else ("start", chart.px(cross) + 3.0)
    shapes: list[Inside] = [
        chart.grid(),
        chart.upright(cross, "cut"),
        svg.text("tick", beside, 11.0, f"as fine: {amount(cross, unit)}", side),
        chart.line(zip((at / factor).tolist(), counts.tolist(), strict=True), stroke=css(COUNTS), stroke_width="1.8"),
        chart.line(
            zip((at / factor).tolist(), time.tolist(), strict=True),
            stroke=css(TIME),
            stroke_width="1.8",
            stroke_dasharray="6 3",
        ),
        chart.upright(here, "here"),
    ]
    for colour, error in zip((COUNTS, TIME), percents(part, np.array([part.speed])), strict=True):
        if low <= float(error[0]) <= UP:
            shapes.append(svg.shape("circle", cx=chart.px(here), cy=chart.py(float(error[0])), r=4, fill=css(colour)))
    label = f"Largest errors over the speed; both readings are as fine at {amount(cross, unit)}"
    return chart.picture(label, shapes)


def large(part: EncoderSpeed, units: Units) -> Picture:
    """Return both curves as the tray shows them, with logarithms of the errors."""
    at, factor = speeds(part), units.factor(True)
    unit = f"{units.angle_unit}/s"
    curves = (Curve("by counts", COUNTS, 2.0), Curve("by time between counts", TIME, 2.0, dash=(6, 3)))
    drawn = [
        Drawn(curve, at / factor, np.log10(error)) for curve, error in zip(curves, percents(part, at), strict=True)
    ]
    cross = part.meter.crossover / factor
    marks = ((f"as fine: {amount(cross, unit)}", cross),)
    title = "Largest error, log₁₀ of percent"
    return Picture(
        title, f"ω, {unit}", drawn, marks=marks, across=(drawn[0].x[0], drawn[0].x[-1]), log=True, y="log₁₀ %"
    )
