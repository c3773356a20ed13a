"""Where the power of the motor goes, and the constant k in the units of data sheets."""

from __future__ import annotations

from armlab.benches.drive.motor.facts import balance_of, moment_of
from armlab.benches.drive.motor.sheets import KRPM, in_units
from armlab.benches.drive.motor.state import Motor
from armlab.benches.drive.quantities import prefixed
from armlab.session.amounts import amount
from armlab.session.state import State
from armlab.ui.colours import BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILLION, Rgb, css
from armlab.ui.format import mathml, scientific
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.symbols import with_indices
from armlab.ui.tables import head_line, line

BAR = 74.0
"""Length of the bar of the largest power, pixels."""

FILLS = 1e-6
"""Part of the power supplied from which on the field is said to be filled."""

ELECTRICAL = r"v\,i=R_ai^2+\frac{d}{dt}\frac{L_ai^2}{2}+k\,\omega\,i"
MECHANICAL = r"k\,i\,\omega=\frac{d}{dt}\frac{I_m\omega^2}{2}+F_m\omega^2+\tau_{load}\,\omega"


def powers_markup(state: State) -> Inside:
    """Return both equations of power with the present numbers, and the verdict on them."""
    found = balance_of(state)
    rows: tuple[tuple[Inside, float, Rgb], ...] = (
        ("supply, v i", found.supplied, BLUE),
        ("heat of the winding, R i²", found.copper, VERMILLION),
        ("into the field, L i di/dt", found.magnetic, SKY),
        (("converted, v", tag("sub", "emf"), " i"), found.converted, PURPLE),
        (("converted, τ", tag("sub", "m"), " ω"), found.converted, PURPLE),
        ("into the motion, I ω dω/dt", found.kinetic, GREEN),
        ("heat of friction, F ω²", found.friction, ORANGE),
        (("to the load, τ", tag("sub", "load"), " ω"), found.load, GREY),
    )
    most = max(abs(watts) for _, watts, _ in rows) or 1.0

    def lines(part: slice) -> list[Markup]:
        return [_line(name, watts, colour, most) for name, watts, colour in rows[part]]

    return (
        tag("div.eq.small", mathml(ELECTRICAL)),
        tag("table.kit-points.mo-powers", lines(slice(0, 4))),
        tag("div.eq.small", mathml(MECHANICAL)),
        tag("table.kit-points.mo-powers", lines(slice(4, 8))),
        _verdict(state),
    )


def _line(name: Inside, watts: float, colour: Rgb, most: float) -> Markup:
    wide = BAR * abs(watts) / most
    bar = tag("u", style=f"width:{max(wide, 1.0):.1f}px;background:{css(colour)}")
    return line(tag("span.mo-bar", bar), tag("b", prefixed(watts, "W")), name=name)


def _verdict(state: State) -> Markup:
    found, now = balance_of(state), moment_of(state)
    largest = max(abs(found.electrical_rest), abs(found.mechanical_rest))
    said = f"What is left of both equations is rounding, {scientific(largest)} W. "
    if now.omega == 0.0 and found.supplied > 0.0:
        ends = (
            "all of v i is heat"
            if abs(found.magnetic) <= FILLS * found.supplied
            else "v i becomes heat and fills the field"
        )
        return verdict_box("warn", f"The rotor stands: {ends}", said)
    if found.supplied < 0.0 < -found.load:
        share = 100.0 * found.supplied / found.load
        head = f"Generator: {amount(share)} % of the load's power go to the supply"
        return verdict_box("ok", head, said)
    if found.load > 0.0 and found.supplied > 0.0:
        share = 100.0 * found.load / found.supplied
        return verdict_box("ok", f"{amount(share)} % of v i reach the load now", said)
    return verdict_box("ok", "The powers balance", said)


def units_markup(state: State) -> Inside:
    """Return k in the units of data sheets, and what happens to the balance of power with them."""
    part, now = state[Motor], moment_of(state)
    found = in_units(part.k)
    power = part.k * now.i * now.omega
    krpm = f"{amount(found['V/krpm'])} V/krpm"
    head = head_line("", with_indices("k_v"), "ω in", joined(with_indices("v_emf"), " i"))
    rows = [
        line(f"{amount(part.k)} V s/rad", "rad/s", prefixed(power, "W"), name="SI"),
        line(krpm, "rad/s", prefixed(KRPM * power, "W"), name="mixed"),
        line(krpm, "krpm", prefixed(power, "W"), name="consistent"),
    ]
    return (
        tag(
            "p",
            f"k = {amount(part.k)} N m/A = {amount(part.k)} V s/rad, because 1 V A = 1 N m/s: only in SI are both one "
            f"number. Data sheets say {amount(found['V/krpm'])} V/krpm, or its inverse {amount(found['rpm/V'])} rpm/V.",
        ),
        tag("table.kit-points.mo-units", head, rows),
        tag(
            "p.dim",
            f"The mechanical side, torque times speed, is {prefixed(power, 'W')}. With k in V/krpm and the speed in "
            f"rad/s the electrical side is {amount(KRPM)} times as large: power from nothing, a mistake of units.",
        ),
    )
