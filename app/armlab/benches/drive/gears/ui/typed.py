"""Fields of lengths in the unit on screen, and of whole numbers, for pages of this tab."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from armlab.kin.field import Field
from armlab.session.fields import FieldPart, Set, fields_of
from armlab.ui.form import Form, Wish
from armlab.ui.format import capitalised
from armlab.ui.html import Markup
from armlab.ui.option_form import option_form
from armlab.ui.option_text import Scale, option_value
from armlab.ui.units import Units


def typed_length(form: Form, part: FieldPart, name: str, units: Units) -> Markup:
    """Return the field of a declared number that is in metres, in the unit of lengths on screen."""
    kind = replace(fields_of(type(part))[name], unit="q")
    scale = Scale(units.length_unit, units.factor(False))
    return option_form(form, "", [kind], {name: getattr(part, name)}, partial(Set, type(part)), [scale], needed=True)


def whole_field(form: Form, cell: str, kind: Field, value: int, action: Callable[[int], Wish]) -> Markup:
    """Return the field of a whole number; the action gets it."""
    return form.field(
        cell, str(value), capitalised(kind.title), lambda text: action(option_value(kind, text, needed=True))
    )
