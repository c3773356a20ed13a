"""One field of a part with its symbol and unit, for pages of this tab that set fields in places of their own."""

from __future__ import annotations

from collections.abc import Callable

from armlab.session.fields import FieldPart, Set, fields_of
from armlab.session.state import Command
from armlab.ui.form import Form
from armlab.ui.format import capitalised, readable
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.option_text import option_value
from armlab.ui.symbols import named

DECIMALS = 4


def typed(
    form: Form, part: FieldPart, name: str, symbol: str = "", read: Callable[[str], float] | None = None
) -> Markup:
    """Return a field of a part.

    Parameters
    ----------
    form : Form
    part : FieldPart
    name : str
        Of the field, and of its cell.
    symbol : str
        What stands before it, with an index after an underscore; the declared symbol if empty.
    read : callable, optional
        Returns the number of a text that has units of its own.
    """
    field = fields_of(type(part))[name]
    value = getattr(part, name)
    title = capitalised(field.title)

    def taken(text: str) -> Command:
        return Set(type(part), name, option_value(field, text, value, needed=True) if read is None else read(text))

    shown = form.field(name, readable(float(value), DECIMALS), title, taken)
    unit: Inside = tag("i", field.unit) if field.unit not in ("", "1") else None
    return tag("label.option", named(symbol or field.symbol), shown, unit, title=title)
