"""The fields of the page of coils."""

from __future__ import annotations

import math
from functools import partial

from armlab.benches.drive.power.ui.typed import typed
from armlab.benches.drive.torque.state import MOTIONS, Torque
from armlab.session.fields import Set, fields_of
from armlab.session.state import Command
from armlab.ui.form import Form
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import row
from armlab.ui.option_form import option_form
from armlab.ui.units import Units

COIL = ("B", "current", "length", "radius")
ROTOR = ("inertia", "friction", "duration")
"""Numbers of the coil, and those of a rotor that is let go."""

SWITCHED = {"with": "with commutator", "without": "without"}


def form_markup(form: Form, part: Torque, units: Units) -> Markup:
    """Return the numbers of the coils, the choices, and the fields of the motion."""
    switched = form.chips(
        "switched",
        SWITCHED,
        "with" if part.switched else "without",
        "Whether the current is reversed at every half turn",
        lambda key: Set(Torque, "switched", key == "with"),
    )
    motion = form.chips("motion", MOTIONS, part.motion, "How the rotor turns", partial(Set, Torque, "motion"))
    start = form.field("start", units.entry(part.start, True), "Angle at the start", lambda text: _start(text, units))
    angle = tag("label.option", tag("span", "θ", tag("sub", "0")), start, tag("i", units.angle_unit))
    wound = typed(form, part, "turns", "turns"), typed(form, part, "coils", "coils")
    free = part.motion == "free"
    return joined(
        tag("div.options.to-form", _numbers(form, part, COIL), wound),
        row("Current", switched),
        row("Rotor", motion),
        tag("div.options.to-form", angle, _numbers(form, part, ROTOR) if free else None),
    )


def _numbers(form: Form, part: Torque, names: tuple[str, ...]) -> Markup:
    known = fields_of(Torque)
    values = {name: getattr(part, name) for name in names}
    return option_form(form, "c-", [known[name] for name in names], values, partial(Set, Torque), needed=True)


def _start(text: str, units: Units) -> Command:
    return Set(Torque, "start", units.read(text, True, "θ_0", within=(-2.0 * math.pi, 2.0 * math.pi)))
