"""The lists of knots and curves, with their fields and choices."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from armlab.benches.motion.chosen import Chosen, Value
from armlab.benches.motion.curves.commands import (
    AddCurve,
    AddKnot,
    ChooseLaw,
    ChoosePath,
    Limit,
    RemoveCurve,
    RemoveKnot,
    SetKnot,
    SetKnots,
    SetLimit,
    SetOption,
)
from armlab.benches.motion.curves.knots import MOST_KNOTS
from armlab.benches.motion.curves.made import Drawn, Made, free_options, kinds, why_not
from armlab.benches.motion.curves.state import MOST_CURVES, UNITS, Curves
from armlab.benches.motion.curves.ui.words import COLOURS, figures, read_rows, typed_number, unit
from armlab.errors import InputError
from armlab.kin.field import Field, seen_fields
from armlab.kin.motion.law_types import free_law_types
from armlab.session.fields import Set
from armlab.ui.colours import css
from armlab.ui.form import Form
from armlab.ui.format import MINUS, capitalised, dot, lowered
from armlab.ui.html import Markup, joined, tag
from armlab.ui.option_form import option_form
from armlab.ui.option_text import Scale, unit_text
from armlab.ui.symbols import with_indices
from armlab.ui.tables import head_line, line
from armlab.ui.units import plain_number


def knots_markup(form: Form, part: Curves, as_text: bool, turn: Callable[[], None]) -> Markup:
    """Return the table of knots, or the same as text; ``turn`` switches between both."""
    names = {name: name for name in UNITS}
    hint = "Unit of the coordinate; the numbers stay"
    units = form.chips("unit", names, part.unit, hint, partial(Set, Curves, "unit"))
    switch = form.button(
        "as-text", "As table" if as_text else "As text", turn, "copy", "Another way to enter the knots"
    )
    head = tag("h3", "Knots", tag("span.copies", units, switch))
    return joined(head, _text(form, part) if as_text else _table(form, part))


def _table(form: Form, part: Curves) -> Markup:
    full, last = len(part.knots) == MOST_KNOTS, len(part.knots) == 2
    rows = []
    for k, (t, q) in enumerate(part.knots):
        time = _cell(form, part, k, "t", t, f"Time of knot {k + 1} in s")
        place = _cell(form, part, k, "q", q, f"q of knot {k + 1} in {part.unit}")
        more = form.button(
            f"add-knot {k}",
            "+",
            AddKnot(k),
            "copy",
            "Insert a knot below",
            f"Add after knot {k + 1}",
            off=full,
        )
        less = form.button(f"remove-knot {k}", "✕", RemoveKnot(k), "copy", "Remove", f"Remove knot {k + 1}", off=last)
        rows.append(line(time, place, (more, less), name=f"{k + 1}"))
    heads = head_line("k", with_indices("t_k, s"), with_indices(f"q_k, {part.unit}"), "")
    return tag("table.cu-knots", heads, rows)


def _cell(form: Form, part: Curves, k: int, name: str, value: float, label: str) -> Markup:
    """Return the field of t or q of a knot."""

    def typed(text: str) -> SetKnot:
        unit = "s" if name == "t" else part.unit
        return SetKnot(k, name, plain_number(text, f"knot {k + 1}, {name}", f"a number in {unit}"))

    below = f"{name} {k + 1}" if k + 1 < len(part.knots) else ""
    return form.field(f"{name} {k}", typed_number(value), label, typed, below)


def _text(form: Form, part: Curves) -> Markup:
    """Return the knots in a field of several lines, into which a table can be pasted."""
    own = "\n".join(f"{t:.10g} {q:.10g}" for t, q in part.knots)
    typed = form.area("rows", own, "Knots: t and q in each line", 6, lambda text: SetKnots(read_rows(text)))
    return joined(tag("div.cu-text", typed), tag("p.dim", f"t in s and q in {part.unit}, one knot per line."))


def curves_markup(form: Form, part: Curves) -> Markup:
    """Return all curves, and a button that adds one."""
    full = len(part.curves) == MOST_CURVES
    hint = f"At most {MOST_CURVES}" if full else "Draw another curve through the same knots"
    more = form.button("add-curve", "+ Curve", AddCurve(), "chip", hint, off=full)
    curves = [_curve(form, part, i) for i in range(len(part.curves))]
    return joined(tag("h3", "Curves", tag("span.copies", more)), curves)


def _curve(form: Form, part: Curves, i: int) -> Markup:
    drawn, outcome, chosen = part.curves[i], part.outcomes[i], i == part.selected
    mark, hint = (dot(css(COLOURS[drawn.colour])), f"{i + 1}"), "Show its options here and its equations below"
    show = form.button(f"show-{i}", mark, Set(Curves, "selected", i), "chip", hint, pressed=chosen)
    path = form.bound(f"path-{i}", partial(ChoosePath, i))
    kind = tag("select", _kinds(part, drawn), **path, aria_label=f"Kind of curve {i + 1}")
    last = len(part.curves) == 1
    hint, label = "Remove this curve", f"Remove curve {i + 1}"
    remove = form.button(f"remove-{i}", "✕", RemoveCurve(i), "chip", hint, label, off=last)
    below = _options(form, part, i) if chosen else _summary(drawn, Scale(part.unit))
    head = tag("div.cu-head", show, kind, remove)
    return tag("div.cu-curve", head, below, _dropped(drawn), _said(outcome, part.unit))


def _options(form: Form, part: Curves, i: int) -> Markup:
    """Return the options of a curve, and its timing law."""
    drawn, scales = part.curves[i], (Scale(part.unit),)
    fields = free_options(kinds()[drawn.path.key])
    typed = option_form(form, f"path{i} ", fields, drawn.path.options, partial(SetOption, i, "path"), scales)
    laws = {key: law.title for key, law in free_law_types().items()}
    choose, hint = partial(ChooseLaw, i), "How s goes from 0 to 1"
    chosen = form.select(f"law-{i}", f"Law of curve {i + 1}", laws, drawn.law.key, choose, hint)
    fields = free_law_types()[drawn.law.key].fields
    law = option_form(form, f"law{i} ", fields, drawn.law.options, partial(SetOption, i, "law"), scales)
    run = tag("div.options", tag("label.option.wide", tag("span", "Law s(t)"), chosen), law)
    return joined(tag("div.options", typed) if typed else None, run)


def _summary(drawn: Drawn, scale: Scale) -> Markup | None:
    """Return the options of a curve that are not at their defaults, in a line."""
    law = free_law_types()[drawn.law.key]
    said = _given(free_options(kinds()[drawn.path.key]), drawn.path, scale)
    if drawn.law.key != "constant":
        said += [f"law s(t): {lowered(law.title)}", *_given(law.fields, drawn.law, scale)]
    return tag("p.dim", capitalised("; ".join(said))) if said else None


def _given(fields: tuple[Field, ...], chosen: Chosen, scale: Scale) -> list[str]:
    texts = []
    for field in seen_fields(fields, chosen.options):
        if field.key in chosen.options:
            value = chosen.options[field.key]
            words = dict(field.choices).get(value) if field.kind == "choice" else _numbers(value)
            unit_of = "" if field.kind in ("choice", "flag") else unit_text(field, scale)
            texts.append(f"{field.title.split(';')[0]}: {words} {unit_of}".rstrip())
    return texts


def _numbers(value: Value) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, tuple):
        return ("; " if value and isinstance(value[0], tuple) else " ").join(_numbers(each) for each in value)
    return figures(float(value))


def _kinds(part: Curves, drawn: Drawn) -> list[Markup]:
    """Return the kinds to choose from; those that cannot go through the knots are disabled, with the reason."""
    found = []
    for key, kind in kinds().items():
        why = why_not(kind, part.knots)
        text = f"{kind.title} ({why})" if why else kind.title
        found.append(tag("option", text, value=key, selected=key == drawn.path.key, disabled=bool(why)))
    return found


def _dropped(drawn: Drawn) -> Markup | None:
    """Return a note on options that were removed so that the curve goes through other knots."""
    text = "◐ The times of its virtual knots lay outside the first and last intervals, and were left out."
    return tag("p.warn", text) if drawn.dropped else None


def _said(outcome: Made | InputError, of: str) -> Markup | None:
    """Return why there is no curve, or how near it comes to the knots."""
    if isinstance(outcome, InputError):
        return tag("p.no", f"✕ Not drawn: {outcome}")
    missed = outcome.missed()
    if missed <= 1e-9 * max(1.0, max(abs(q) for _, q in outcome.knots)):
        return None
    why = "" if outcome.drawn.law.key == "constant" else ", because the timing law decides when it reaches them"
    text = f"At the times of the knots the curve is up to {missed:.3g} {of} away from them{why}."
    return tag("p.dim", text.replace("-", MINUS))


def limits_markup(form: Form, part: Curves) -> Markup:
    """Return the fields of both limits."""
    v = _limit(form, part, "v_max", 1, "Largest rate")
    a = _limit(form, part, "a_max", 2, "Largest acceleration")
    return tag("div.options", tag("span.dim", "Limits"), v, a)


def _limit(form: Form, part: Curves, key: Limit, order: int, words: str) -> Markup:
    def typed(text: str) -> SetLimit:
        return SetLimit(key, plain_number(text, key) if text.strip() else None)

    value = getattr(part, key)
    cell = form.field(key, "" if value is None else typed_number(value), f"{words}; empty for no limit", typed)
    return tag("label.option", tag("span", with_indices(key)), cell, tag("i", unit(order, part.unit)))
