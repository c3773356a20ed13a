"""Fields for declared numbers of a part: symbol, field and unit, with refusals that name the range."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from armlab.kin.field import Field
from armlab.session.fields import FieldPart, Set, fields_of
from armlab.ui.form import Form, Wish
from armlab.ui.format import capitalised, readable
from armlab.ui.html import Markup, tag
from armlab.ui.option_text import PLAIN, Scale, factor_of, option_value, scale_of, unit_text
from armlab.ui.symbols import with_indices
from armlab.ui.units import Units

DECIMALS = 4


def length_scale(units: Units) -> tuple[Scale, ...]:
    """Return the scale with which a field in metres has the unit of lengths on screen."""
    return (Scale(units.length_unit, units.factor(False)),)


def typed(form: Form, part: FieldPart, name: str, scales: tuple[Scale, ...] = PLAIN, label: bool = True) -> Markup:
    """Return the field of a declared number, after its symbol unless ``label`` is False, and with its unit."""
    field = fields_of(type(part))[name]
    if scales is not PLAIN:
        field = replace(field, unit="q")
    value = getattr(part, name)
    factor = factor_of(field, scale_of(field, scales, 0))
    title = capitalised(field.title)
    cell = form.field(
        name,
        readable(value / factor, DECIMALS),
        _named(title, unit_text(field, scales[0])),
        lambda text: Set(type(part), name, option_value(field, text, value, scales, needed=True)),
    )
    unit = tag("i", unit_text(field, scales[0]))
    return tag("label", tag("span", with_indices(field.symbol), " = ") if label else None, cell, unit, title=title)


def whole_field(form: Form, cell: str, kind: Field, value: int, action: Callable[[int], Wish]) -> Markup:
    """Return the field of a whole number; the action gets it."""
    return form.field(
        cell, str(value), capitalised(kind.title), lambda text: action(option_value(kind, text, needed=True))
    )


def _named(title: str, unit: str) -> str:
    return f"{title} in {unit}" if unit else title
