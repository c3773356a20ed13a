"""A load that is held still: by a motor, by a brake, on a shut valve."""

from __future__ import annotations

import math
from functools import partial

from armlab.benches.drive.power.state import Power
from armlab.benches.drive.power.ui.sankey import bars
from armlab.benches.drive.quantities import prefixed
from armlab.session.amounts import amount
from armlab.session.fields import Set, fields_of
from armlab.ui.form import Form
from armlab.ui.format import mathml, pairs
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import row, verdict_box
from armlab.ui.option_form import option_form
from armlab.ui.units import Units

FIELDS = {
    "Load": ("mass", "arm"),
    "Motor": ("ratio", "k", "R"),
    "Heat": ("thermal", "limit"),
    "Brake": ("brake",),
    "Valve": ("pressure", "leak"),
}
"""Fields of the part that are typed, by what they belong to."""

MINUTE, HOUR = 60.0, 3600.0

HEAT = r"P=R\,i^2=R\left(\frac{m\,g\,l}{n\,k}\right)^2"


def fields_markup(form: Form, part: Power) -> Markup:
    """Return the fields of load, motor, brake and valve."""
    known = fields_of(Power)

    def group(names: tuple[str, ...]) -> Markup:
        values = {name: getattr(part, name) for name in names}
        return option_form(form, "h-", [known[name] for name in names], values, partial(Set, Power), needed=True)

    return joined(row(title, tag("div.options.pw-hold", group(names))) for title, names in FIELDS.items())


def holding_markup(part: Power, units: Units) -> Inside:
    """Return the powers as bars, what the motor does meanwhile, and whether it lasts."""
    held = part.held
    sinks = part.sinks
    down = f"0 W; sinks {units.angle(MINUTE * sinks)} a minute" if sinks > 0.0 else "0 W"
    rows = [
        ("Electric motor, controlled", held.heat, f"{prefixed(held.heat, 'W')}, all of it heat"),
        ("Brake closed by its spring", 0.0, f"0 W; {prefixed(part.brake, 'W')} to keep it open on the way"),
        ("Hydraulic, valve shut", 0.0, down),
    ]
    return (
        tag("div.eq.small", mathml(HEAT)),
        pairs(
            [
                ("torque of the load, m g l", prefixed(part.load, "N m")),
                ("torque, current of the motor", f"{prefixed(held.torque, 'N m')}, {prefixed(held.current, 'A')}"),
                ("its mechanical power τ ω, since ω = 0", "0 W"),
                ("heat in an hour", prefixed(held.heat * HOUR, "J")),
            ]
        ),
        bars(rows),
        _verdict(part),
    )


def _verdict(part: Power) -> Markup:
    rise = part.held.rise
    if not math.isfinite(rise):
        return verdict_box(
            "no",
            "The winding burns",
            tag(
                "p",
                "Warm copper has more resistance, which makes more heat than the housing can give off: the copper "
                "melts before both are equal.",
            ),
        )
    says = (
        f"The winding ends {amount(rise)} K above the air, {'inside' if part.endures else 'beyond'} the "
        f"{amount(part.limit)} K it stands. Its growing resistance is counted."
    )
    if part.endures:
        return verdict_box("ok", "It may hold for ever", tag("p", says))
    return verdict_box("no", "The winding gets too hot", tag("p", says))


def why_markup() -> Markup:
    """Return why the others need no power."""
    return joined(
        tag(
            "p.dim",
            "Oil behind a shut valve cannot flow, so p Q = 0; what leaks past the seals lets the load sink, and the "
            "load itself pays p Q = τ ω for that. The cylinder is taken to be of the size at which this load makes the "
            "pressure p: with the same p and Q, a heavier load has a larger cylinder and sinks more slowly. "
            "⟦The notes say that hydraulic motors need no torque to hold: they need the torque, but no power.⟧",
        )
    )
