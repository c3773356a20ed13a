"""The pictures of two equations in two joint speeds, as drawings in markup."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.solve.pictures import Flat, NormCurve, Square
from armlab.benches.velocity.solve.state import Solve
from armlab.benches.velocity.solve.ui.torus import HINT
from armlab.benches.velocity.solve.ui.words import dotted, speed_text
from armlab.kin.arm import Arm
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui import svg
from armlab.ui.chart import Chart
from armlab.ui.colours import BLUE, GREEN, ORANGE, css
from armlab.ui.form import Marks
from armlab.ui.format import number
from armlab.ui.html import Inside, Markup, joined, styles, tag
from armlab.ui.symbols import with_indices
from armlab.ui.units import Units

Array = NDArray[np.float64]

WIDE, HIGH = 320, 232
LEFT, BOTTOM = 46, 20
"""Width and height of a chart, and what the numbers take of it, pixels."""

ROWS = (BLUE, ORANGE)
"""Colours of the two equations."""

SIDE = 250
"""Side of the square, pixels."""

FARTHEST = 8.0
"""Largest half width of the picture of the two lines, in multiples of their distance from the origin."""

SHORTEST, LONGEST = 3.0, 0.4
"""Length of the shortest arrow in the square, pixels, and of the longest in sides of it; an arrow shows one second."""

PARALLEL = 1e-9
"""Sine of the angle between two rows of J below which their lines are parallel."""

HIGHEST = 6.0
"""Height of the curve of the norm, in multiples of its least value."""


def nice(value: float) -> float:
    """Return the next number of the series 1, 1.5, 2, 3, 5, 7 that is not smaller.

    >>> nice(0.31), nice(2.0)
    (0.5, 2.0)
    """
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in (1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0) if step * power >= value * (1.0 - 1e-9))


# -- two lines -------------------------------------------------------------------------------------------------------


def lines_svg(state: State, found: Flat, units: Units) -> Markup:
    """Return the two equations as lines in the plane of the joint speeds, with the shortest answer."""
    arm, pair = state[Joints].arm, state[Solve].pair
    turning = [bool(arm.revolute[k]) for k in pair]
    # The same scale in both directions, in rad/s and m/s; the numbers are in the units on screen.
    half, factor = _window(found), np.array([units.factor(each) for each in turning])
    (x, y) = (half * np.array([(WIDE - LEFT) / (HIGH - BOTTOM), 1.0]) / factor).tolist()
    names = [f"{dotted(k, arm, units)}, {units.unit(each)}/s" for k, each in zip(pair, turning, strict=True)]
    chart = Chart("so-lines", (-x, x), (-y, y), WIDE, HIGH, LEFT, BOTTOM, (names[0], names[1]))
    rows = []
    for k in (0, 1):
        ends = _ends(found.J[k], float(found.v[k]), half)
        if ends is not None:
            rows.append(chart.line((ends / factor).tolist(), stroke=css(ROWS[k]), stroke_width=2))
    answer: list[float] = (found.answer.qdot / factor).tolist()
    shown = "answer" if found.answer.verdict != "none" else "nearest"
    return chart.picture(
        "The two equations of J q̇ = v as lines",
        chart.grid(),
        chart.zero(),
        chart.upright(0.0, "axis"),
        rows,
        chart.line([(0.0, 0.0), (answer[0], answer[1])], stroke=css(GREEN), stroke_width="1.5", stroke_dasharray="4 3"),
        svg.circle(shown, chart.px(answer[0]), chart.py(answer[1]), 5),
    )


def _window(found: Flat) -> float:
    """Return half the height of the picture in joint speeds, rounded so that it seldom changes."""
    sizes = np.linalg.norm(found.J, axis=1)
    far = max((abs(float(v)) / float(s) for v, s in zip(found.v, sizes, strict=True) if s > 1e-12), default=0.0)
    wanted = 1.35 * float(np.abs(found.answer.qdot).max(initial=0.0))
    return nice(min(max(wanted, 1.35 * far, 1e-3), max(FARTHEST * far, 1e-3)) or 1.0)


def _ends(row: Array, value: float, half: float) -> Array | None:
    """Return two points of the line row . qdot = value, far outside the picture, or None if the row is zero."""
    size = float(np.linalg.norm(row))
    if size < 1e-12:
        return None
    foot, way = row * (value / size**2), np.array([-row[1], row[0]]) / size
    return np.array([foot - 4.0 * half * way, foot + 4.0 * half * way])


def lines_words(state: State, found: Flat, units: Units) -> Markup:
    """Return both equations in words, and whether their lines meet or are parallel."""
    arm, pair = state[Joints].arm, state[Solve].pair
    sizes = np.linalg.norm(found.J, axis=1)
    names = [with_indices(f"v_{letter}") for letter in found.letters]
    lines = [
        tag("div", tag(f"i.row{k + 1}"), _equation(found.J[k], float(found.v[k]), names[k], pair, arm, units))
        for k in (0, 1)
    ]
    equations = tag("div.so-equations", lines)
    answer = found.answer
    qdot = ", ".join(
        speed_text(float(value), bool(arm.revolute[k]), units) for value, k in zip(answer.qdot, pair, strict=True)
    )
    said: Inside
    if float(sizes.min()) <= PARALLEL * max(float(sizes.max()), 1e-300):
        zero = names[int(np.argmin(sizes))]
        said = "The row of ", zero, " is zero: it is no line, and holds for ", zero, " = 0 alone. "
    elif answer.verdict == "one":
        return joined(equations, tag("p.so-said", f"The lines meet in one point: q̇ = ({qdot})."))
    else:
        said = "The lines are parallel: det J = 0. "
    if answer.verdict == "many":
        shortest = f"Every point of the one line is an answer; the shortest is nearest to the origin: ({qdot})."
    else:
        shortest = f"No point is on both; of those that come nearest the shortest is ({qdot})."
    return joined(equations, tag("p.so-said", said, shortest))


def _equation(row: Array, value: float, name: Markup, pair: tuple[int, int], arm: Arm, units: Units) -> Inside:
    terms = ""
    for k, factor in zip(pair, row.tolist(), strict=True):
        minus = round(factor, 3) < 0.0
        sign = (" − " if minus else " + ") if terms else "−" if minus else ""
        terms += f"{sign}{number(abs(factor), 3)} {dotted(k, arm, units)}"
    return f"{terms} = {number(value, 3)} ", tag("small", "(", name, "; m, rad, s)")


# -- norm against det J ----------------------------------------------------------------------------------------------


def norm_svg(curve: NormCurve, here: tuple[float, float], units: Units) -> Markup:
    """Return the size of the joint speeds over det J; ``here`` is the point of the arm."""
    most, factor = 1.06 * float(np.abs(curve.determinant).max()) or 1.0, units.factor(True)
    size = curve.norm / factor
    finite = size[np.isfinite(size) & (size > 0.0)]
    top = nice(HIGHEST * float(finite.min())) if len(finite) else 1.0
    names = "det J, m²", f"‖q̇‖, {units.unit(True)}/s"
    chart = Chart("so-norm", (-most, most), (0.0, 1.06 * top), WIDE, 150, LEFT, BOTTOM, names)
    low = np.where(size <= 1.3 * top, size, np.nan)
    points = zip(curve.determinant.tolist(), low.tolist(), strict=True)
    mark = chart.px(here[0]), chart.py(min(here[1] / factor, 1.02 * top))
    return chart.picture(
        "Size of the joint speeds against det J",
        chart.grid(),
        chart.zero(),
        chart.upright(0.0, "zero"),
        chart.line(points, stroke=css(BLUE), stroke_width="1.6"),
        svg.circle("answer", *mark, 4.5) if math.isfinite(here[1]) else None,
    )


# -- the square ------------------------------------------------------------------------------------------------------


def square_markup(place: Marks, state: State, found: Square, units: Units) -> Markup:
    """Return the square of the two joint values with the singular set; `place` of a form makes it clickable."""
    arm, pair = state[Joints].arm, state[Solve].pair
    turning = [bool(arm.revolute[k]) for k in pair]
    factor = np.array([units.factor(each) for each in turning])
    x, y = zip((found.low / factor).tolist(), (found.high / factor).tolist(), strict=True)
    across, up = (f"{units.variable(k, each)}, {units.unit(each)}" for k, each in zip(pair, turning, strict=True))
    step_x, step_y = (0.5 * math.pi / units.factor(True) if each else 0.0 for each in turning)
    size = LEFT + SIDE, SIDE + BOTTOM
    chart = Chart("so-torus", x, y, *size, LEFT, BOTTOM, (across, up), (step_x, step_y))
    pieces = "".join(
        f"M{chart.px(a[0]):.1f} {chart.py(a[1]):.1f}L{chart.px(b[0]):.1f} {chart.py(b[1]):.1f}"
        for a, b in (found.singular / factor).tolist()
    )
    seen = chart.picture("Where det J is zero", chart.grid(), chart.cut(pieces, class_="singular"))
    plane = tag("div.so-map", tag("b.so-way"), tag("b.so-here"), title=HINT, **place)
    return tag("div.so-square", seen, plane)


def marks_style(state: State, found: Square, answer: Flat) -> Markup:
    """Return the place of the arm in the square and its velocity, as style."""
    pair = list(state[Solve].pair)
    span = found.high - found.low
    q = np.array(state[Joints].q[pair])
    # The square is a torus cut open: whole turns do not count.
    q = np.where(state[Joints].arm.revolute[pair], (q + math.pi) % (2.0 * math.pi) - math.pi, q)
    x, y = (100.0 * (q - found.low) / span).tolist()
    across, up = (SIDE * answer.answer.qdot / span).tolist()
    length, turn = min(math.hypot(across, up), LONGEST * SIDE), math.degrees(math.atan2(up, across))
    seen = "block" if length > SHORTEST else "none"
    return styles([f".al .so-map{{--x:{x:.2f}%;--y:{y:.2f}%;--len:{length:.1f}px;--turn:{-turn:.2f}deg;--way:{seen}}}"])
