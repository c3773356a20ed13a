"""The numbers of the bench of timing laws: values, peaks and classes, before and after scaling, and bounds."""

from __future__ import annotations

from collections.abc import Callable

from armlab.benches.motion.laws.bounds import FIELDS, Bounded, joint_paths
from armlab.benches.motion.laws.commands import ChooseBoundPath, LowerSpeed, SetBound, SetBoundOption, TakeBounds
from armlab.benches.motion.laws.state import Laws
from armlab.benches.motion.laws.timing import largest
from armlab.benches.motion.laws.ui.form import marked, names
from armlab.benches.motion.laws.words import (
    ENDS,
    NEGATIVE,
    SCALING,
    bounds_text,
    class_words,
    factor,
    gain,
    joint_rows,
    optimal_text,
    stretch_rows,
)
from armlab.kin.motion import Law
from armlab.kin.motion.breaks import ORDERS
from armlab.session.amounts import amount
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import SIGNS, fold
from armlab.ui.option_form import option_form
from armlab.ui.option_text import PLAIN
from armlab.ui.symbols import with_indices
from armlab.ui.tables import head_line, line

Value = Callable[[Law], str]

PEAKS: tuple[tuple[str, str, Value], ...] = (
    ("T", "s", lambda law: amount(law.duration)),
    ("max |ṡ|", "1/s", lambda law: amount(law.peak_speed)),
    ("T max |ṡ| / L", "", lambda law: _factor(law, law.peak_speed, 1)),
    ("max |s̈|", "1/s²", lambda law: amount(largest(law, 2))),
    ("T² max |s̈| / L", "", lambda law: _factor(law, largest(law, 2), 2)),
    ("max |jerk|", "1/s³", lambda law: amount(largest(law, 3))),
    ("T³ max |jerk| / L", "", lambda law: _factor(law, largest(law, 3), 3)),
    ("class inside", "", lambda law: class_words(law.continuity)),
    ("class from rest", "", lambda law: class_words(law.continuity_from_rest)),
    ("ṡ(T) − ṡ(0) = ∫ s̈ dt", "1/s", lambda law: amount(gain(law))),
)
"""Name, unit and value of each row."""


def _factor(law: Law, peak: float, order: int) -> str:
    """Return a peak of the law from 0 to 1 in 1 s, or a dash if the law returns to its start."""
    found = factor(law, peak, order)
    return "–" if found is None else amount(found)


def values_markup(part: Laws, t: float) -> Markup:
    """Return the values at a time, and the peaks and classes, with a column for each law."""
    at = [law.derivatives(t, ORDERS) for law in part.every]
    rows = [
        _row(name, unit, [amount(float(values[order])) for values in at])
        for order, (name, unit) in enumerate((("s", ""), ("ṡ", "1/s"), ("s̈", "1/s²"), ("jerk", "1/s³")))
    ]
    peaks = [_row(name, unit, [value(law) for law in part.every]) for name, unit, value in PEAKS]
    heads = head_line(f"at t = {amount(t, 's')}", *(marked(name, colour) for name, colour in names(part)))
    below = tag("tr", tag("th", "on [0, T]", colspan=1 + len(part.every)))
    return fold("Values, peaks and classes", tag("table.law-table", heads, rows, below, peaks))


def _row(name: str, unit: str, cells: list[str]) -> Markup:
    return line((name, (", ", tag("i", unit)) if unit else None), *cells)


def stretch_markup(part: Laws) -> Markup:
    """Return the effect of the factor k on the chosen law, and the optimal k."""
    rows = [
        _row(name, unit, [amount(before), amount(after), f"× {factor}"])
        for name, unit, before, after, factor in stretch_rows(part)
    ]
    table = tag("table.law-table", head_line(f"k = {amount(part.k)}", "before", "after", ""), rows)
    return joined(table, tag("p", optimal_text(part)), tag("p.dim", SCALING))


def bounds_markup(form: Form, bounded: Bounded) -> Markup:
    """Return the calculator of bounds."""
    kinds, bounds = joint_paths(), bounded.found
    titles = {key: kind.title for key, kind in kinds.items()}
    chooser = form.select("path", "Path", titles, bounded.path.key, ChooseBoundPath)
    given = {
        "knots": bounded.knots,
        "v_max": bounded.v_max,
        "a_max": bounded.a_max or None,
        "speed": bounded.speed,
    }
    scales = PLAIN * bounded.joints
    given_path = bounded.path.options
    path = option_form(form, "p-", kinds[bounded.path.key].fields, given_path, SetBoundOption, scales)
    kind, said = bounds_text(bounded, bounds)
    hint = "Lower V until some acceleration is left"
    lower = form.chip("lower", "Lower V", LowerSpeed(), hint, off=not bounded.a_max)
    take = form.chip("take", "Use as V and A below", TakeBounds(), "Laws from 0 to 1, as fast as these bounds allow")
    notes = [ENDS, *([NEGATIVE] if bounded.a_max and not bounds.possible else [])]
    return joined(
        tag("h3.law-bounds", "Bounds of ṡ and s̈ on a path ", tag("small", "q in rad or m")),
        tag("div.options", option_form(form, "b-", FIELDS, given, SetBound, scales)),
        tag("div.kit-head", tag("span.dim", "Path"), chooser),
        tag("div.options", path),
        _joints(bounded),
        tag(f"div.verdict.{kind}", f"{SIGNS[kind]} {said}"),
        tag("div.bar", lower, take),
        [tag("p.dim", note) for note in notes],
    )


def _joints(bounded: Bounded) -> Markup:
    heads = ["joint", "max |q′|", with_indices("v/M_ν")]
    units = ["", "", "1/s"]
    if bounded.a_max:
        heads += ["max |q″|", with_indices("A_i")]
        units += ["", "1/s²"]
    rows = []
    for row in joint_rows(bounded):
        at = tag("i", f"at s = {amount(row.M_v_at)}")
        cells: list[Inside] = [f"{row.joint}", (f"{amount(row.M_v)} ", at), _deciding(row.V, row.first_speed)]
        if bounded.a_max:
            cells += [amount(row.M_a), _deciding(row.A, row.first_acceleration)]
        rows.append(line(*cells))
    return tag("table.law-table", head_line(*heads), tag("tr.units", [tag("th", unit) for unit in units]), rows)


def _deciding(value: float, first: bool) -> str:
    """Return the bound of a joint, marked if it is the lowest."""
    return f"{amount(value)} ◂" if first else amount(value)
