"""Fields of a part in the units of the person, and a drag that begins where it takes hold."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import Any

from armlab.kin.field import Field
from armlab.session.fields import FieldPart, Set, fields_of
from armlab.ui.form import Form, Wish
from armlab.ui.format import capitalised, readable
from armlab.ui.html import Markup, tag
from armlab.ui.option_form import option_form
from armlab.ui.option_text import DECIMALS, PLAIN, Scale, factor_of, option_value, unit_text
from armlab.ui.units import Units


def scaled(field: Field, units: Units) -> tuple[Field, tuple[Scale, ...]]:
    """Return a field whose angle or length is shown in the unit of the person, and the scale of that unit."""
    for unit, revolute in (("rad", True), ("m", False)):
        if field.unit == unit or field.unit.startswith(f"{unit}/"):
            scale = Scale(units.unit(revolute), units.factor(revolute))
            return replace(field, unit=f"q{field.unit.removeprefix(unit)}"), (scale,)
    return field, PLAIN


def numbers(form: Form, part: FieldPart, names: Iterable[str], units: Units) -> Markup:
    """Return fields for some numbers of a part, with their symbols; their cells are the names of the fields."""
    known, found = fields_of(type(part)), []
    for name in names:
        field, scales = scaled(known[name], units)
        given = {name: getattr(part, name)}
        found.append(option_form(form, "", (field,), given, partial(Set, type(part)), scales, needed=True))
    return tag("div.options", found)


def typed(form: Form, part: FieldPart, name: str, units: Units, action: Callable[[Any], Wish] | None = None) -> Markup:
    """Return the field of one number of a part alone, for a sentence of the caller's; ``action`` gets the value."""
    field, scales = scaled(fields_of(type(part))[name], units)
    value, unit = getattr(part, name), unit_text(field, scales[0])

    def taken(text: str) -> Wish:
        read = option_value(field, text, value, scales, needed=True)
        return action(read) if action else Set(type(part), name, read)

    title = f"{capitalised(field.title)}{f' in {unit}' if unit else ''}"
    return form.field(name, readable(value / factor_of(field, scales[0]), DECIMALS), title, taken)


class Grip:
    """A picture that a hand drags sideways: it goes on from where it was when the hand took hold of it."""

    def __init__(self) -> None:
        self._drag, self._from, self._value = 0, 0.0, 0.0

    def moved(self, x: float, drag: int, value: float) -> float:
        """Return how far the hand has gone since it took hold, in widths of the picture.

        Parameters
        ----------
        x : float
            Place of the hand, in widths of the picture.
        drag : int
            Number of the drag.
        value : float
            Where the picture stands now; see `value`.
        """
        if drag != self._drag:
            self._drag, self._from, self._value = drag, x, value
        return x - self._from

    @property
    def value(self) -> float:
        """Where the picture stood when the hand took hold."""
        return self._value
