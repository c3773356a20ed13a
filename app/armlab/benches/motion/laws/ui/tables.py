"""The numbers of the bench of timing laws: values, peaks and classes, before and after scaling, and bounds."""

from __future__ import annotations

from collections.abc import Callable

from armlab.benches.motion.laws.bounds import FIELDS, Bounded, joint_paths
from armlab.benches.motion.laws.commands import ChooseBoundPath, LowerSpeed, SetBound, SetBoundOption, TakeBounds
from armlab.benches.motion.laws.state import Laws
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
from armlab.ui.format import escaped
from armlab.ui.markup import SIGNS
from armlab.ui.option_form import PLAIN, option_form

Value = Callable[[Law], str]

PEAKS: tuple[tuple[str, str, Value], ...] = (
    ("T", "s", lambda law: amount(law.duration)),
    ("max |ṡ|", "1/s", lambda law: amount(law.peak_speed)),
    ("T max |ṡ| / L", "", lambda law: _factor(law, law.peak_speed, 1)),
    ("max |s̈|", "1/s²", lambda law: amount(law.peak_acceleration)),
    ("T² max |s̈| / L", "", lambda law: _factor(law, law.peak_acceleration, 2)),
    ("max |jerk|", "1/s³", lambda law: amount(law.peak_jerk)),
    ("T³ max |jerk| / L", "", lambda law: _factor(law, law.peak_jerk, 3)),
    ("class inside", "", lambda law: class_words(law.continuity)),
    ("class from rest", "", lambda law: class_words(law.continuity_from_rest)),
    ("ṡ(T) − ṡ(0) = ∫ s̈ dt", "1/s", lambda law: amount(gain(law))),
)
"""Name, unit and value of each row; the names are markup."""


def _factor(law: Law, peak: float, order: int) -> str:
    """Return a peak of the law that goes from 0 to 1 in 1 s; a dash where it comes back to where it began."""
    found = factor(law, peak, order)
    return "–" if found is None else amount(found)


def values_markup(part: Laws, t: float) -> str:
    """Return the values at a time, and the peaks and classes, a column a law."""
    heads = "".join(f"<th>{marked(name, colour)}</th>" for name, colour in names(part))
    at = [law.derivatives(t, ORDERS) for law in part.every]
    rows = [
        _row(name, unit, [amount(float(values[order])) for values in at])
        for order, (name, unit) in enumerate((("s", ""), ("ṡ", "1/s"), ("s̈", "1/s²"), ("jerk", "1/s³")))
    ]
    peaks = [_row(name, unit, [value(law) for law in part.every]) for name, unit, value in PEAKS]
    return (
        f'<table class="law-table"><tr><th>at t = {amount(t, "s")}</th>{heads}</tr>{"".join(rows)}'
        f'<tr><th colspan="{1 + len(part.every)}">on [0, T]</th></tr>{"".join(peaks)}</table>'
    )


def _row(name: str, unit: str, cells: list[str]) -> str:
    said = f"{name}{f', <i>{unit}</i>' if unit else ''}"
    return f"<tr><td>{said}</td>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>"


def stretch_markup(part: Laws) -> str:
    """Return what the factor k does to the chosen law, and which k is the optimal one."""
    rows = "".join(
        f"<tr><td>{name}, <i>{unit}</i></td><td>{amount(before)}</td><td>{amount(after)}</td><td>× {factor}</td></tr>"
        for name, unit, before, after, factor in stretch_rows(part)
    )
    heads = f"<th>k = {amount(part.k)}</th><th>before</th><th>after</th><th></th>"
    return (
        f'<table class="law-table"><tr>{heads}</tr>{rows}</table>'
        f'<p>{escaped(optimal_text(part))}</p><p class="dim">{escaped(SCALING)}</p>'
    )


def bounds_markup(form: Form, bounded: Bounded) -> str:
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
    return (
        '<h3 class="law-bounds">Bounds of ṡ and s̈ on a path <small>q in rad or m</small></h3>'
        f'<div class="options">{option_form(form, "b-", FIELDS, given, SetBound, scales)}</div>'
        f'<div class="kit-head"><span class="dim">Path</span>{chooser}</div>'
        f'<div class="options">{path}</div>{_joints(bounded)}'
        f'<div class="verdict {kind}">{SIGNS[kind]} {escaped(said)}</div>'
        f'<div class="bar">{lower}{take}</div>' + "".join(f'<p class="dim">{escaped(note)}</p>' for note in notes)
    )


def _joints(bounded: Bounded) -> str:
    heads = "<th>joint</th><th>max |q′|</th><th>v/M<sub>ν</sub></th>"
    if bounded.a_max:
        heads += "<th>max |q″|</th><th>A<sub>i</sub></th>"
    rows = []
    for row in joint_rows(bounded):
        cells = [
            f"{row.joint}",
            f"{amount(row.M_v)} <i>at s = {amount(row.M_v_at)}</i>",
            f"{amount(row.V)}{' ◂' if row.first_speed else ''}",
        ]
        if bounded.a_max:
            cells += [f"{amount(row.M_a)}", f"{amount(row.A)}{' ◂' if row.first_acceleration else ''}"]
        rows.append(f"<tr>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>")
    units = "<th></th><th>1/s</th>" if not bounded.a_max else "<th></th><th>1/s</th><th></th><th>1/s²</th>"
    return f'<table class="law-table"><tr>{heads}</tr><tr class="units"><th></th>{units}</tr>{"".join(rows)}</table>'
