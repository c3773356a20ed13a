"""Measures of the curves: a table, the limits in words, and the fastest intervals."""

from __future__ import annotations

import math
from collections.abc import Callable

from armlab.benches.motion.curves.commands import FindFastest, TakeFastest
from armlab.benches.motion.curves.fastest import Fastest
from armlab.benches.motion.curves.made import Made
from armlab.benches.motion.curves.state import Curves
from armlab.benches.motion.curves.ui.words import COLOURS, SYMBOLS, figures, unit
from armlab.kin.motion.breaks import class_text
from armlab.kin.motion.peaks import Violation
from armlab.ui.colours import css
from armlab.ui.form import Form
from armlab.ui.format import dot, number, subscript
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import fold
from armlab.ui.symbols import with_indices
from armlab.ui.tables import head_line, line

MOST_SPANS = 3
"""Largest number of intervals of one violation that are listed."""


def facts(part: Curves) -> Markup | None:
    """Return the table of facts, with a column for each computed curve."""
    every = [(i, made) for i, made in enumerate(part.outcomes) if isinstance(made, Made)]
    if not every:
        return None
    of = part.unit
    heads = [(dot(css(COLOURS[made.drawn.colour])), f"{i + 1}") for i, made in every]
    rows: list[tuple[str, str, Callable[[Made], str]]] = [
        (
            "Class",
            "Of continuity, between the first and the last knot",
            lambda made: class_text(made.trajectory.continuity),
        ),
        (
            "Class from rest",
            "Of continuity, if the joint is at rest before and after",
            lambda made: class_text(made.trajectory.continuity_from_rest),
        ),
        (f"max |{SYMBOLS[1]}|, {unit(1, of)}", "", lambda made: _peak(made, 1)),
        (f"max |{SYMBOLS[2]}|, {unit(2, of)}", "∞ where the velocity jumps", lambda made: _peak(made, 2)),
        (f"max |{SYMBOLS[3]}|, {unit(3, of)}", "∞ where the acceleration jumps", lambda made: _peak(made, 3)),
        (
            f"Overshoot, {of}",
            "How far it goes beyond the range of the knots",
            lambda made: figures(made.overshoot, 3),
        ),
        (f"∫{SYMBOLS[2]}² dt, {of}²/s³", "Least for a natural spline", _bending),
    ]
    lines = [
        tag("tr", tag("th", name, title=hint), [tag("td", _short(value(made))) for _, made in every])
        for name, hint, value in rows
    ]
    return fold("Classes, peaks and overshoot", tag("table.cu-facts", head_line("", *heads), lines))


def _peak(made: Made, order: int) -> str:
    """Return the largest value of a derivative between the first and the last knot."""
    return _figures(made.largest(order))


def _short(text: str) -> str:
    return {"C3 or smoother": "≥ C3", "not continuous": "jumps"}.get(text, text)


def _bending(made: Made) -> str:
    return _figures(made.bending)


def _figures(value: float) -> str:
    return "∞" if math.isinf(value) else figures(value)


def verdicts(part: Curves) -> Markup | None:
    """Return in words which limits are exceeded, when, and by how much."""
    if part.v_max is None and part.a_max is None:
        return None
    lines = []
    for i, made in enumerate(part.outcomes):
        if isinstance(made, Made):
            found = made.beyond(part.v_max, part.a_max)
            lines += [
                _exceeded(i, made, part, order, [v for v in found if v.quantity == quantity])
                for order, quantity in ((1, "velocity"), (2, "acceleration"))
                if any(v.quantity == quantity for v in found)
            ] or [tag("p.ok", f"✓ Curve {i + 1} keeps the limits.")]
    return joined(lines)


def _exceeded(i: int, made: Made, part: Curves, order: int, found: list[Violation]) -> Markup:
    limit = (part.v_max, part.a_max)[order - 1]
    said = "velocity" if order == 1 else "acceleration"
    spans = [_span(made.start + v.start, made.start + v.end) for v in found]
    more = f" and {len(spans) - MOST_SPANS} more" if len(spans) > MOST_SPANS else ""
    of = unit(order, part.unit)
    peak = f"; up to {figures(made.peaks[order - 1])} {of}" if any(v.end > v.start for v in found) else ""
    above = f"{said} above {figures(limit or 0.0)} {of} {', '.join(spans[:MOST_SPANS])}{more}{peak}"
    return tag("p.no", f"✕ Curve {i + 1}: {above}.")


def _span(start: float, end: float) -> str:
    if start == end:
        return f"at {number(start, 2)} s, where the velocity jumps"
    return f"from {number(start, 2)} to {number(end, 2)} s"


def fastest_markup(form: Form, part: Curves) -> Markup:
    """Return the button that looks for the fastest intervals, and the result."""
    ends = {"clamped": "from rest to rest", "natural": "with natural ends", "both": "with two virtual knots"}[part.ends]
    find = form.button(
        "fastest",
        "Fastest intervals",
        FindFastest(),
        "main",
        "Find the times of the knots that make T as small as possible",
    )
    said = tag("span.dim", "searching …") if part.asked is not None else None
    return joined(
        tag("h3", "Minimum time by the intervals ", with_indices("h_k")),
        tag("p.dim", f"For a spline {ends} through these ", with_indices("q_k"), ", within both limits."),
        tag("div.bar", find, said),
        _found(form, part, part.fastest) if part.fastest is not None else None,
    )


def _found(form: Form, part: Curves, found: Fastest) -> Markup:
    before = [later[0] - first[0] for first, later in zip(found.asked.knots, found.asked.knots[1:], strict=False)]
    taken = part.knots != found.asked.knots
    hint = "Enter them in the table of knots"
    take = None if taken else form.button("take-fastest", "Use these times", TakeFastest(), "chip", hint)
    rows = [
        line(figures(old), figures(new), name=subscript("h", k + 1))
        for k, (old, new) in enumerate(zip(before, found.intervals, strict=True))
    ]
    total = line(figures(found.before), tag("b", figures(found.duration)), name="T = Σh")
    return joined(
        tag("table.cu-facts", head_line("", "before, s", "fastest, s"), rows, total),
        tag("p.dim", "With ", with_indices("h_k"), f" in proportion to the distances: {figures(found.by_distance)} s."),
        tag("div.bar", take),
    )
