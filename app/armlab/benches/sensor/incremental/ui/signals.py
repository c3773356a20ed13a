"""A, B and Z over time, with the edges that are counted."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.sensor.incremental.counting import Now, counts_of, steps
from armlab.benches.sensor.incremental.state import Incremental
from armlab.kin.sensors.quadrature import index_of
from armlab.ui import svg
from armlab.ui.chart import Chart, value_text
from armlab.ui.colours import BLUE, GREEN, ORANGE, Rgb, css
from armlab.ui.curve import Curve
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.ticks import ticks
from armlab.ui.tray_picture import Drawn, Picture

Floats = NDArray[np.float64]

WIDTH, HEIGHT, LEFT, BOTTOM = 330.0, 128.0, 16.0, 16.0
"""Size of the picture, and room for the names of the rows and for the times, pixels."""

COLOURS: dict[str, Rgb] = {"A": BLUE, "B": ORANGE, "Z": GREEN}

FOOT = {"A": 2.75, "B": 1.75, "Z": 0.75}
"""Height of the low level of each row; the rows are 1 apart, and counted edges are marked below the last one."""

HIGH, TOP, MARK = 0.7, 3.6, 0.3
"""Height of the high level over the low one, upper end of the picture, and height of the marks."""

MOST_SEEN = 48
"""Largest number of edges that are seen at once; of more, those around the present time."""


def span_of(part: Incremental, time: float) -> tuple[float, float]:
    """Return the times between which the signals are seen."""
    end, edges = part.motion.duration, len(part.signals.times)
    if edges <= MOST_SEEN:
        return 0.0, end
    wide = end * MOST_SEEN / edges
    begin = min(max(time - 0.5 * wide, 0.0), end - wide)
    return begin, begin + wide


def rows_of(part: Incremental, low: float, high: float) -> dict[str, tuple[Floats, Floats]]:
    """Return the corners of A, B and Z between two times: times and levels of 0 or 1."""
    a, b = part.signals.levels.T
    z = index_of(part.signals.quarters, part.pulses)
    return {name: steps(part, row, low, high) for name, row in zip(COLOURS, (a, b, z.astype(int)), strict=True)}


def signals(part: Incremental, found: Now) -> Markup:
    """Return the picture, with the present time."""
    if part.motion.duration == 0.0:
        return tag("p.dim", "The disk has not been turned yet: drag its tracks, or type moves.")
    low, high = span_of(part, found.time)
    chart = Chart("in-signals", (low, high), (0.0, TOP), WIDTH, HEIGHT, LEFT, BOTTOM)
    shapes: list[Inside] = [_times(chart)]
    for name, (times, levels) in rows_of(part, low, high).items():
        points = zip(times.tolist(), (FOOT[name] + HIGH * levels).tolist(), strict=True)
        shapes.append(chart.line(points, stroke=css(COLOURS[name]), stroke_width="1.8"))
        shapes.append(svg.text("name", 2.0, chart.py(FOOT[name] + 0.2), name))
    shapes.append(_marks(part, chart, low, high))
    shapes.append(chart.upright(found.time, "here", stroke="currentColor"))
    label = f"A, B and Z from {low:.3g} s to {high:.3g} s; triangles mark edges that are counted up or down"
    return chart.picture(label, shapes)


def _times(chart: Chart) -> list[Markup]:
    """Return upright lines at round times, with the times below."""
    found = [svg.text("", 2.0, HEIGHT - 4.0, "t, s")]
    for value in ticks(*chart.x):
        found.append(chart.upright(value, "grid"))
        x = chart.px(value)
        if x > LEFT + 16.0:
            anchor = "end" if x > WIDTH - 16.0 else "middle"
            found.append(svg.text("tick", x, HEIGHT - 4.0, value_text(value, chart.x), anchor))
    return found


def _marks(part: Incremental, chart: Chart, low: float, high: float) -> list[Markup]:
    """Return a triangle at each counted edge: upwards where 1 is added, downwards where it is taken away."""
    times, changes = part.signals.times, part.decoder_of(part.decoder).steps(part.signals.levels)
    found = []
    for k in np.flatnonzero((changes != 0) & (times >= low) & (times <= high)).tolist():
        x, y, up = chart.px(float(times[k])), chart.py(MARK), changes[k] > 0
        found.append(
            svg.path("in-up" if up else "in-down", f"M{x:.1f} {y - 5 if up else y + 5:.1f}l-4 {8 if up else -8}h8z")
        )
    return found


def large(part: Incremental) -> Picture:
    """Return the signals of all moves as the tray shows them, one over the other, and the count."""
    end = part.motion.duration
    drawn = [
        Drawn(
            Curve(f"{name} (from {FOOT[name]:g} to {FOOT[name] + HIGH:g})", COLOURS[name]),
            times,
            FOOT[name] + HIGH * levels,
        )
        for name, (times, levels) in rows_of(part, 0.0, end).items()
    ]
    return Picture("A, B and Z", "t, s", drawn, y="level")


def count_curve(part: Incremental) -> tuple[Floats, Floats]:
    """Return the corners of the count over all moves: times and counts."""
    return steps(part, counts_of(part, part.decoder), 0.0, part.motion.duration)
