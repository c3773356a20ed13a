"""The fields of the motor: its constants in the units of data sheets, and voltage and load over time."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from armlab.benches.drive.motor.commands import ChooseProfile
from armlab.benches.drive.motor.profile import ENDING, KINDS, Rows
from armlab.benches.drive.motor.sheets import UNITS, read
from armlab.benches.drive.motor.state import Motor
from armlab.benches.drive.power.ui.typed import typed
from armlab.session.fields import Set, fields_of
from armlab.ui.form import Form
from armlab.ui.format import readable
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import fold
from armlab.ui.option_text import option_value

STARTS = ("i0", "omega0", "theta0")
"""Fields of the start."""

DECIMALS = 5


def constants_markup(form: Form, part: Motor) -> Markup:
    """Return the fields of the constants."""
    fields = [typed(form, part, name, read=_in_units(name)) for name in UNITS]
    hint = "Units of data sheets may be typed, too: 0.082 mH, 142 g cm², 5.24 V/krpm, 191 rpm/V"
    return tag("div.options.mo-form", fields, title=hint)


def _in_units(name: str) -> Callable[[str], float]:
    field = fields_of(Motor)[name]

    def taken(text: str) -> float:
        value = read(name, f"{field.symbol} ({field.title.split(',')[0]})", text)
        return float(option_value(field, repr(value), needed=True))

    return taken


def inputs_markup(form: Form, part: Motor) -> Markup:
    """Return the choices and fields of voltage and load, and the start."""
    voltage = _profile(form, part, "v", "Voltage", part.v_kind, part.v_rows)
    load = _profile(form, part, "load", "Load", part.load_kind, part.load_rows)
    start = [typed(form, part, name) for name in STARTS]
    return joined(voltage, load, fold("Start", tag("div.options.mo-form", start)))


def _profile(form: Form, part: Motor, name: str, title: str, kind: str, rows: Rows) -> Markup:
    chosen = form.select(
        f"{name}_kind", f"{title} over time", KINDS, kind, partial(ChooseProfile, name), f"{title} over time"
    )
    head = tag("label.option", tag("span", title), chosen)
    if kind == "own":
        unit = "V" if name == "v" else "N m"
        text = "\n".join(f"{readable(time, DECIMALS)}  {readable(value, DECIMALS)}" for time, value in rows)
        typed_rows = form.area(
            f"{name}_rows",
            text,
            f"{title}: lines of a time in s and {unit} from then on",
            max(2, min(len(rows), 5)),
            partial(Set, Motor, f"{name}_rows"),
        )
        below = tag("div.mo-rows", typed_rows, tag("i", f"time in s, then {unit}"))
        return joined(tag("div.options.mo-form", head), below)
    names = [name, f"{name}_start", *([f"{name}_stop"] if kind in ENDING else [])]
    return tag("div.options.mo-input", head, [typed(form, part, each) for each in names])
