"""The drives of all joints as a table of fields, with what one count is at each joint."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from armlab.benches.drive.joint.state import (
    NUMBERS,
    SIDES,
    Drives,
    PlaceAllEncoders,
    PlaceEncoder,
    SetAllDrives,
    SetDrive,
    number_of,
)
from armlab.kin.field import Field
from armlab.session.amounts import signed
from armlab.session.state import Command
from armlab.ui.colours import css, joint_colour
from armlab.ui.form import Form
from armlab.ui.format import capitalised, dot, readable
from armlab.ui.html import Markup, tag
from armlab.ui.option_text import PLAIN, Scale, option_value
from armlab.ui.tables import head_line
from armlab.ui.units import Units

DIGITS = 3
"""Number of significant digits of a small quantity."""

NOTHING = 1e-15
"""Angle or length, rad or m, that is a rounding error."""

DECIMALS = 4

MANY = 1e4
"""Least number whose thousands are set apart."""


def small(units: Units, value: float, revolute: bool) -> str:
    """Return a small angle or length with three significant digits and its unit; what is rounding is 0."""
    text = signed(value / units.factor(revolute), DIGITS) if abs(value) > NOTHING else "0"
    return f"{text}°" if revolute and units.in_degrees else f"{text} {units.unit(revolute)}"


def times(factor: float) -> str:
    """Return how many times as large something is drawn, with narrow spaces between thousands.

    >>> times(5000.0), times(20000.0), times(0.5)
    ('5000', '20\u202f000', '0.5')
    """
    text = f"{factor:,.10g}"
    return text.replace(",", "\u202f" if factor >= MANY else "")


def table_markup(form: Form, part: Drives, units: Units) -> Markup:
    """Return a line for each joint, one for all, and one for each screw."""
    arm = part.arm
    kinds = [units.unit(bool(turns)) for turns in dict.fromkeys(arm.revolute.tolist())]
    head = head_line(None, "ratio n", "counts N", "encoder at", ("play, ", " or ".join(kinds)), "may be off by")
    rows = [_line(form, part, units, i) for i in range(arm.n)]
    every = [_every(form, part)] if arm.n > 1 else []
    table = tag("table.kit-points.jd-table", head, every, rows)
    screws = [_screw(form, part, units, i) for i in range(arm.n) if not arm.revolute[i]]
    return tag("div", table, tag("div.kit-numbers", screws) if screws else None)


def _line(form: Form, part: Drives, units: Units, i: int) -> Markup:
    turns = bool(part.arm.revolute[i])
    other = "joint" if part.side[i] == "motor" else "motor"
    side = form.chip(f"side {i}", SIDES[part.side[i]], PlaceEncoder(i, other), f"Put it at the {other}")
    cells = (
        _typed(form, part, units, i, "ratio"),
        _typed(form, part, units, i, "counts"),
        side,
        _typed(form, part, units, i, "backlash"),
        f"± {small(units, float(part.drives.half_width[i]), turns)}",
    )
    name = tag("th", dot(css(joint_colour(i))), units.variable(i, turns))
    return tag("tr", name, [tag("td", cell) for cell in cells])


def _every(form: Form, part: Drives) -> Markup:
    """Return the line that sets all joints at once; a field is empty where they differ."""
    cells = []
    for name in ("ratio", "counts"):
        values, kind = set(getattr(part, name)), NUMBERS[name]
        shown = readable(values.pop(), DECIMALS) if len(values) == 1 else ""
        title = f"{capitalised(kind.title)}, of all joints"
        cells.append(form.field(f"all {name}", shown, title, partial(_for_all, kind)))
    side = "joint" if all(each == "motor" for each in part.side) else "motor"
    here = part.side[0] if len(set(part.side)) == 1 else "both"
    chip = form.chip("all side", SIDES.get(here, here), PlaceAllEncoders(side), f"Put all of them at the {side}")
    return tag("tr", tag("th", "all"), [tag("td", cell) for cell in (*cells, chip)], tag("td"), tag("td"))


def _for_all(kind: Field, text: str) -> Command:
    return SetAllDrives(kind.key, option_value(kind, text, needed=True))


def _typed(form: Form, part: Drives, units: Units, i: int, name: str) -> Markup:
    """Return the field of a number of a joint; angles and lengths are in the units on screen."""
    arm = part.arm
    kind, value = number_of(arm, name, i), getattr(part, name)[i]
    if name in ("ratio", "counts"):
        scales, factor = PLAIN, 1.0
    else:
        turns = name == "backlash" and bool(arm.revolute[i])
        factor = units.factor(turns)
        scales = (Scale(units.unit(turns), factor),)
    titled = capitalised(kind.title)
    title = f"{titled} in {scales[0].unit}" if scales[0].unit else titled
    return form.field(
        f"{name} {i}",
        readable(value / factor, DECIMALS),
        title,
        lambda text: SetDrive(i, name, option_value(replace(kind, key=name), text, value, scales, needed=True)),
    )


def _screw(form: Form, part: Drives, units: Units, i: int) -> Markup:
    name = units.variable(i, False)
    return tag(
        "label", f"Screw of {name}: ", _typed(form, part, units, i, "lead"), tag("i", f"{units.length_unit} a turn")
    )
