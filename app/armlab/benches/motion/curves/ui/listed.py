"""Knots and curves as they are typed and chosen."""

from __future__ import annotations

from armlab.benches.motion.curves.knots import MOST_KNOTS
from armlab.benches.motion.curves.made import Drawn, Made, form, kinds, why_not
from armlab.benches.motion.curves.state import MOST_CURVES, UNITS, Curves
from armlab.benches.motion.curves.ui.words import COLOURS, figures, typed_number, unit
from armlab.errors import InputError
from armlab.kin.field import Field, seen_fields
from armlab.kin.motion.law_types import free_law_types
from armlab.session.chosen import Chosen, Value
from armlab.ui.colours import css
from armlab.ui.fields import Fields
from armlab.ui.format import MINUS, capitalised, dot, escaped, lowered
from armlab.ui.markup import button, chips, options, select
from armlab.ui.option_form import Scale, option_markup, unit_text


def knots_markup(fields: Fields, part: Curves, as_text: bool) -> str:
    """Return the table of knots, or the same as text."""
    channel = fields.channel_id
    names = {f"unit {name}": name for name in UNITS}
    units = chips(channel, names, f"unit {part.unit}", "Unit of the coordinate; the numbers stay")
    switch = button(channel, "as-text", "As table" if as_text else "As text", "copy", "Another way to type the knots")
    head = f'<h3>Knots<span class="copies">{switch}</span></h3><div class="cu-units"><span>q in</span>{units}</div>'
    return head + (_text(fields, part) if as_text else _table(fields, part))


def _table(fields: Fields, part: Curves) -> str:
    channel, full, last = fields.channel_id, len(part.knots) == MOST_KNOTS, len(part.knots) == 2
    rows = []
    for k, (t, q) in enumerate(part.knots):
        below = str(k + 1) if k + 1 < len(part.knots) else ""
        cells = (
            fields.field(f"t {k}", typed_number(t), f"Time of knot {k + 1} in s", below=below and f"t {below}"),
            fields.field(f"q {k}", typed_number(q), f"q of knot {k + 1} in {part.unit}", below=below and f"q {below}"),
        )
        more = button(channel, f"add-knot {k}", "+", "copy", "One more after this", f"Add after knot {k + 1}", off=full)
        less = button(channel, f"remove-knot {k}", "✕", "copy", "Remove", f"Remove knot {k + 1}", off=last)
        rows.append(f"<tr><th>{k + 1}</th>{''.join(f'<td>{cell}</td>' for cell in cells)}<td>{more}{less}</td></tr>")
    heads = f"<tr><th>k</th><th>t<sub>k</sub>, s</th><th>q<sub>k</sub>, {part.unit}</th><th></th></tr>"
    return f'<table class="cu-knots">{heads}{"".join(rows)}</table>'


def _text(fields: Fields, part: Curves) -> str:
    """Return the knots in a field of several lines, where a table can be pasted."""
    own = "\n".join(f"{t:.10g} {q:.10g}" for t, q in part.knots)
    typed = fields.area("rows", own, "Knots: t and q in each line", 6)
    return f'<div class="cu-text">{typed}</div><p class="dim">t in s and q in {part.unit}, one knot a line.</p>'


def curves_markup(fields: Fields, part: Curves) -> str:
    """Return all curves, and a button for one more."""
    full = len(part.curves) == MOST_CURVES
    hint = f"At most {MOST_CURVES}" if full else "One more through the same knots"
    more = button(fields.channel_id, "add-curve", "+ Curve", "chip", hint, off=full)
    curves = "".join(_curve(fields, part, i) for i in range(len(part.curves)))
    return f'<h3>Curves<span class="copies">{more}</span></h3>{curves}'


def _curve(fields: Fields, part: Curves, i: int) -> str:
    drawn, outcome, channel = part.curves[i], part.outcomes[i], fields.channel_id
    mark = f"{dot(css(COLOURS[drawn.colour]))}{i + 1}"
    head = button(
        channel, f"show-{i}", mark, "chip", "Show its options here and its equations below", pressed=i == part.selected
    )
    head += select(channel, f"path-{i}", f"Kind of curve {i + 1}", _kinds(part, drawn))
    last = len(part.curves) == 1
    head += button(channel, f"remove-{i}", "✕", "chip", "Remove this curve", f"Remove curve {i + 1}", off=last)
    chosen = _form(fields, part, i) if i == part.selected else _summary(drawn, Scale(part.unit))
    said = _dropped(drawn) + _said(outcome, part.unit)
    return f'<div class="cu-curve"><div class="cu-head">{head}</div>{chosen}{said}</div>'


def _form(fields: Fields, part: Curves, i: int) -> str:
    """Return the options of a curve, and the law that runs through it."""
    drawn, channel, scales = part.curves[i], fields.channel_id, (Scale(part.unit),)
    typed = option_markup(fields, f"path{i} ", form(kinds()[drawn.path.key]), drawn.path.options, scales)
    laws = {key: law.title for key, law in free_law_types().items()}
    chosen = select(
        channel, f"law-{i}", f"Law of curve {i + 1}", options(laws, drawn.law.key), "How s goes from 0 to 1"
    )
    law = option_markup(fields, f"law{i} ", free_law_types()[drawn.law.key].fields, drawn.law.options, scales)
    run = f'<div class="options"><label class="option wide"><span>Law s(t)</span>{chosen}</label>{law}</div>'
    return (f'<div class="options">{typed}</div>' if typed else "") + run


def _summary(drawn: Drawn, scale: Scale) -> str:
    """Return the options of a curve that are not as they come, in a line."""
    law = free_law_types()[drawn.law.key]
    said = _given(form(kinds()[drawn.path.key]), drawn.path, scale)
    if drawn.law.key != "constant":
        said += [f"law s(t): {lowered(law.title)}", *_given(law.fields, drawn.law, scale)]
    return f'<p class="dim">{escaped(capitalised("; ".join(said)))}</p>' if said else ""


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


def _kinds(part: Curves, drawn: Drawn) -> str:
    """Return the kinds to choose from; those that do not take the knots are off, with the reason."""
    found = []
    for key, kind in kinds().items():
        why = why_not(kind, part.knots)
        marks = f"{' selected' if key == drawn.path.key else ''}{' disabled' if why else ''}"
        text = f"{kind.title} ({why})" if why else kind.title
        found.append(f'<option value="{escaped(key)}"{marks}>{escaped(text)}</option>')
    return "".join(found)


def _dropped(drawn: Drawn) -> str:
    """Return what was changed so that the curve goes through other knots."""
    text = "Its virtual times lay outside the first and last interval, and were left out."
    return f'<p class="warn">◐ {text}</p>' if drawn.dropped else ""


def _said(outcome: Made | InputError, of: str) -> str:
    """Return why there is no curve, or what it does with the knots."""
    if isinstance(outcome, InputError):
        return f'<p class="no">✕ Not drawn: {escaped(str(outcome))}</p>'
    missed = outcome.missed()
    if missed <= 1e-9 * max(1.0, max(abs(q) for _, q in outcome.knots)):
        return ""
    why = "" if outcome.drawn.law.key == "constant" else ": the law decides when it meets them"
    text = f"At the times of the knots it is up to {missed:.3g} {of} away from them{why}."
    return f'<p class="dim">{text.replace("-", MINUS)}</p>'


def limits_markup(fields: Fields, part: Curves) -> str:
    """Return the two limits."""
    cells = []
    for key, symbol, order, words in (
        ("v_max", "v<sub>max</sub>", 1, "Largest rate"),
        ("a_max", "a<sub>max</sub>", 2, "Largest acceleration"),
    ):
        value = getattr(part, key)
        cell = fields.field(key, "" if value is None else typed_number(value), f"{words}; empty for no limit")
        cells.append(f'<label class="option"><span>{symbol}</span>{cell}<i>{unit(order, part.unit)}</i></label>')
    return f'<h3>Limits</h3><div class="options">{"".join(cells)}</div>'
