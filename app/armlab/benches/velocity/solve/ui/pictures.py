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
from armlab.ui.form import Marks
from armlab.ui.format import number, trimmed
from armlab.ui.html import Inside, Markup, classes, joined, styles, tag
from armlab.ui.symbols import with_indices
from armlab.ui.units import Units

Array = NDArray[np.float64]

WIDE, HIGH = 296, 216
"""Width and height of a drawing, pixels."""

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
    half = _window(found)
    scale = 0.5 * min(WIDE, HIGH) / half

    def at(point: Array) -> tuple[float, float]:
        return 0.5 * WIDE + scale * float(point[0]), 0.5 * HIGH - scale * float(point[1])

    middle = WIDE / 2, HIGH / 2
    parts = [svg.line("axis", 0, HIGH / 2, WIDE, HIGH / 2), svg.line("axis", WIDE / 2, 0, WIDE / 2, HIGH)]
    for k in (0, 1):
        ends = _ends(found.J[k], float(found.v[k]), half)
        if ends is not None:
            parts.append(svg.line(f"row{k + 1}", *at(ends[0]), *at(ends[1])))
    x, y = at(found.answer.qdot)
    shown = "answer" if found.answer.verdict != "none" else "nearest"
    first, second = (dotted(k, arm, units) for k in pair)
    return svg.drawing(
        "so-lines",
        WIDE,
        HIGH,
        "The two equations of J q̇ = v as lines",
        parts,
        svg.line("shortest", *middle, x, y),
        svg.circle(shown, x, y, 5),
        svg.text("", WIDE - 4, HIGH / 2 - 5, first, "end"),
        svg.text("", WIDE / 2 + 6, 12, second),
        _scale_mark(half, scale, state, units),
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


def _scale_mark(half: float, scale: float, state: State, units: Units) -> Markup:
    """Return a bar of a round length with its size."""
    arm, pair = state[Joints].arm, state[Solve].pair
    kind = bool(arm.revolute[pair[0]])
    length = nice(0.4 * half / units.factor(kind)) * units.factor(kind)
    if kind != bool(arm.revolute[pair[1]]):
        text = f"{trimmed(length, 3)} rad/s, m/s"
    else:
        text = f"{trimmed(length / units.factor(kind), 3)} {units.unit(kind)}/s"
    y = HIGH - 8
    return joined(svg.line("rule", 6, y, 6 + length * scale, y), svg.text("", 6, y - 5, text))


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
        return joined(equations, tag("p", f"The lines meet in one point: q̇ = ({qdot})."))
    else:
        said = "The lines are parallel: det J = 0. "
    if answer.verdict == "many":
        shortest = f"Every point of the one line is an answer; the shortest is nearest to the origin: ({qdot})."
    else:
        shortest = f"No point is on both; of those that come nearest the shortest is ({qdot})."
    return joined(equations, tag("p", said, shortest))


def _equation(row: Array, value: float, name: Markup, pair: tuple[int, int], arm: Arm, units: Units) -> Inside:
    terms = ""
    for k, factor in zip(pair, row.tolist(), strict=True):
        minus = round(factor, 3) < 0.0
        sign = (" − " if minus else " + ") if terms else "−" if minus else ""
        terms += f"{sign}{number(abs(factor), 3)} {dotted(k, arm, units)}"
    return f"{terms} = {number(value, 3)} ", tag("small", "(", name, "; m, rad, s)")


# -- norm against det J ----------------------------------------------------------------------------------------------


def at_all(curve: NormCurve, most: float, top: float, height: float) -> tuple[Array, Array]:
    """Return the pixels of the curve, with NaN where it is too high for the picture."""
    low = np.where(curve.norm <= 1.3 * top, curve.norm, np.nan)
    return 0.5 * WIDE + 0.47 * WIDE * curve.determinant / most, height - 14.0 - (height - 22.0) * low / top


def _path(x: Array, y: Array) -> str:
    """Return the path commands of a line through points in tenths of pixels, broken at NaN."""
    seen = np.isfinite(y)
    begins = seen & ~np.concatenate([[False], seen[:-1]])
    return "".join(
        f"{'M' if first else 'L'}{px} {py}"
        for px, py, first in zip(
            np.round(x[seen], 1).tolist(), np.round(y[seen], 1).tolist(), begins[seen].tolist(), strict=True
        )
    )


def norm_svg(curve: NormCurve, here: tuple[float, float], units: Units) -> Markup:
    """Return the size of the joint speeds over det J; ``here`` is the point of the arm."""
    most = float(np.abs(curve.determinant).max()) or 1.0
    finite = curve.norm[np.isfinite(curve.norm) & (curve.norm > 0.0)]
    top = units.factor(True) * nice(HIGHEST * float(finite.min()) / units.factor(True)) if len(finite) else 1.0
    height = 130.0
    base, below = height - 14.0, height - 3.0
    parts = [
        svg.line("axis", 0, base, WIDE, base),
        svg.line("zero", WIDE / 2, 4, WIDE / 2, base),
        svg.path("curve", _path(*at_all(curve, most, top, height))),
    ]
    if math.isfinite(here[1]):
        x, y = 0.5 * WIDE + 0.47 * WIDE * here[0] / most, base - (height - 22.0) * min(here[1] / top, 1.02)
        parts.append(svg.circle("answer", x, y, 4.5))
    parts += [
        svg.text("", WIDE - 3, below, f"det J: {trimmed(most, 3)} m²", "end"),
        svg.text("", 3, below, f"−{trimmed(most, 3)}"),
        svg.text("", WIDE / 2, below, "0", "middle"),
        svg.text("", 3, 12, speed_text(top, True, units)),
    ]
    return svg.drawing("so-norm", WIDE, height, "Size of the joint speeds against det J", parts)


# -- the square ------------------------------------------------------------------------------------------------------


def square_markup(place: Marks, state: State, found: Square, units: Units) -> Markup:
    """Return the square of the two joint values with the singular set; `place` of a form makes it clickable."""
    arm, pair = state[Joints].arm, state[Solve].pair
    span = found.high - found.low
    pieces = "".join(
        f"M{SIDE * a[0]:.1f} {SIDE * (1.0 - a[1]):.1f}L{SIDE * b[0]:.1f} {SIDE * (1.0 - b[1]):.1f}"
        for a, b in (found.singular - found.low) / span
    )
    ticks = []
    for side, k in enumerate(pair):
        turns = bool(arm.revolute[k])
        for part in (0.0, 0.5, 1.0):
            value = (found.low[side] + part * span[side]) / units.factor(turns)
            text = number(value, 0 if units.in_degrees or not turns else 2)
            ticks.append(tag(classes("i", up=side == 1), text, style=f"--at:{100.0 * part:.0f}%"))
    names = [f"{units.variable(k, bool(arm.revolute[k]))}, {units.unit(bool(arm.revolute[k]))}" for k in pair]
    seen = svg.drawing("so-torus", SIDE, SIDE, "Where det J is zero", svg.path("singular", pieces))
    plane = tag("div.so-map", seen, ticks, tag("b.so-way"), tag("b.so-here"), title=HINT, **place)
    return tag("div.so-square", tag("span.up", names[1]), plane, tag("span", names[0]))


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
