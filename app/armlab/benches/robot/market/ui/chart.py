"""The chart of the market: the counts over the years, and the growth that is computed."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.robot.market.numbers import STOCK
from armlab.benches.robot.market.state import Market
from armlab.kin.growth import grown
from armlab.ui import svg
from armlab.ui.chart import Chart
from armlab.ui.format import number, trimmed
from armlab.ui.html import Inside, Markup, tag

WIDE, HIGH, LEFT, BOTTOM = 330.0, 200.0, 46.0, 20.0
YEARS = (1970.0, 2035.0)
"""Years at the ends of the chart."""

DECADE = 10.0
"""Years between two lines."""

LEAST, MOST = 1e3, 1e7
"""Robots at the ends of the logarithmic axis."""

EVEN, STEP = (0.0, 5e6), 1e6
"""Ends of the even axis, and the robots between two of its lines."""

POINTS = 80


def robots(value: float) -> str:
    """Return a number of robots, or of something else, with k for thousands, M for millions and G for billions.

    >>> robots(3000.0), robots(4.6e6), robots(12.0)
    ('3 k', '4.6 M', '12')
    """
    for factor, letter in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if abs(value) >= factor:
            return f"{trimmed(value / factor, 3 - len(str(int(abs(value) / factor))))} {letter}"
    return trimmed(value, 2)


def chart_markup(part: Market) -> Markup:
    """Return the chart."""
    span = (math.log10(LEAST), math.log10(MOST)) if part.log else EVEN
    chart = Chart("ma-chart", YEARS, span, WIDE, HIGH, LEFT, BOTTOM)
    shapes: list[Inside] = [*_grid(chart, part.log), _curve(chart, part)]
    for count in STOCK:
        shapes.append(svg.circle("ma-count", chart.px(count.year), chart.py(_level(count.robots, part.log)), 4.0))
        shapes.append(_name(chart, count.year, count.robots, part.log))
    rate = part.found["rate"]
    said = f"Robots at work from {STOCK[0].year} to {STOCK[-1].year}, and growth of {100.0 * rate:.1f} % a year"
    return chart.picture(said, shapes)


def _level(value: float, log: bool) -> float:
    return math.log10(value) if log else value


def _name(chart: Chart, year: float, value: float, log: bool) -> Markup:
    """Return the count beside its point, where the curve is not."""
    first = year < YEARS[0] + DECADE
    across, up = (8.0, -4.0) if first and log else (-2.0, 8.0) if first else (-8.0, 5.0)
    x, y = chart.px(year) + across, chart.py(_level(value, log)) - up
    return svg.text("ma-name", x, y, robots(value), "start" if first else "end")


def _grid(chart: Chart, log: bool) -> list[Markup]:
    lines = []
    for year in np.arange(YEARS[0], YEARS[1], DECADE):
        lines += [chart.upright(year, "grid"), svg.text("tick", chart.px(year), HIGH - 5.0, f"{year:.0f}", "middle")]
    values = 10.0 ** np.arange(*(round(end) + k for k, end in enumerate(chart.y))) if log else np.arange(*EVEN, STEP)
    for value in values[1:] if not log else values:
        y = chart.py(_level(float(value), log))
        lines.append(svg.path("grid", f"M{LEFT:g} {y:.1f}H{WIDE:g}"))
        if y > 10.0:
            lines.append(svg.text("tick", LEFT - 4.0, y + 4.0, robots(float(value)), "end"))
    return lines


def _curve(chart: Chart, part: Market) -> Inside:
    """Return the growth that is computed, dashed outside of its years."""
    found = part.found
    begin, end = sorted((part.start, part.start + found["years"]))
    whole = np.linspace(*YEARS, POINTS)
    inside = np.linspace(max(begin, YEARS[0]), max(min(end, YEARS[1]), YEARS[0]), POINTS)

    def line(years: np.ndarray, kind: str) -> Markup:
        points = ((year, _at(found["begin"], found["rate"], year - part.start, part.log)) for year in years.tolist())
        return chart.line(points, class_=kind)

    return line(whole, "ma-on"), line(inside, "ma-grown")


def _at(begin: float, rate: float, years: float, log: bool) -> float:
    """Return the ordinate of the curve; nothing is drawn where it is beyond all numbers."""
    if log:
        return math.log10(begin) + years * math.log1p(rate) / math.log(10.0)
    exponent = math.log(begin) + years * math.log1p(rate)
    return grown(begin, rate, years) if abs(exponent) < math.log(1e12) else math.nan


def percent(rate: float) -> str:
    """Return a rate as a percentage with one decimal.

    >>> percent(0.15468)
    '15.5 %'
    """
    return f"{number(100.0 * rate, 1)} %"


def shares_markup(shares: tuple[tuple[str, float], ...]) -> Markup:
    """Return shares of a whole as one bar, with their names below."""
    kinds = ("one", "two", "three")
    bar, x = [], 0.0
    for kind, (name, part) in zip(kinds, shares, strict=True):
        wide = WIDE * part
        bar.append(svg.shape(f"rect.ma-{kind}", tag("title", name), x=x, y=0.0, width=wide, height=20.0))
        bar.append(
            svg.text(f"ma-share {kind}".replace(" ", "."), x + 0.5 * wide, 14.5, f"{100.0 * part:.0f} %", "middle")
        )
        x += wide
    said = ", ".join(f"{name} {100.0 * part:.0f} %" for name, part in shares)
    words = tag("p.dim", f"New robots of 2024, from the left: {', '.join(name for name, _ in shares)}.")
    return tag("div", svg.drawing("ma-bar", WIDE, 20.0, said, *bar), words)
