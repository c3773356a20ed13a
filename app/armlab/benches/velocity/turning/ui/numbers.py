"""The numbers of turning: omega from the rates, det T, the check with the rotation, the two laws, and small turns."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.turning.commands import SetTurning, TakeToolAngles, WriteAngles
from armlab.benches.velocity.turning.motion import (
    Turned,
    between,
    commuting,
    law_integral,
    law_rotation,
    laws_time,
    tool_angles_of,
    turned_of,
)
from armlab.benches.velocity.turning.state import Turning
from armlab.kin.conditioning import TITLES, conditioning
from armlab.kin.euler import NAMES, PROPER, SEQUENCES, SINGULAR_SINE, angle_symbols
from armlab.kin.velocity.rates import columns_latex, singular_angles, singular_sentence
from armlab.session.fields import Set
from armlab.session.state import State
from armlab.ui.colours import css, joint_colour
from armlab.ui.form import Form
from armlab.ui.format import capitalised, dot, mathml, matrix, number, pairs, scientific
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import fold, row, verdict_box
from armlab.ui.symbols import with_indices
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, units_of

Floats = NDArray[np.float64]

SEEN = 1e-6
"""Difference of two orientations, radians, below which they are the same."""

OMEGA, RDOT, DOTTED = r"\omega=T\dot{\phi}", r"\dot{R}R^T", r"\dot{%s}"

T_MATRIX = (
    "T is not a rotation matrix⟦, although notes 5.43 call it “the roll pitch yaw matrix”⟧. Its columns are the "
    "present axes of the three rotations, and φ̇ is not ω. The scene shows the body beside the arm, with the three axes "
    "in the colours of their angles and with ω; the fixed frame is pale."
)

ANALYTIC = r"J_\phi=T^{-1}J_A"
RATES = joined("⟦Notes 5.51 multiplies J", tag("sub", "r"), " by (q̇₁, q̇₂, φ̇): φ̇ = q̇₁ + q̇₂ is what comes out of it.⟧")

EN_SPACE = "\N{EN SPACE}"
"""Space between the components of a vector."""

WIDE = 5
"""Largest number of columns with usual spacing; more are set closer."""

ORDERS = "Three rotations have 3! = 6 orders, equal only to first order in dφ⟦; the notes (before 5.27) speak of 12⟧."


def form_markup(form: Form, state: State) -> Markup:
    """Return the sequence, the angles and the rates."""
    part, units = state[Turning], units_of(state)
    titles = {axes: axes.upper() for axes in SEQUENCES}
    chooser = form.select("axes", "Sequence of axes", titles, part.axes, WriteAngles)
    about = form.chips(
        "about",
        {"moving": "current axes", "fixed": "fixed axes"},
        "fixed" if part.fixed else "moving",
        "The same orientation and ω, written in other angles",
        lambda key: WriteAngles(fixed=key == "fixed"),
    )
    take = form.chip("tool", "Angles of the tool", TakeToolAngles(), "Take the angles of the tool in the world")
    name = NAMES.get((part.axes, part.fixed), "")
    told = tag("p.dim", f"{capitalised(name)}.") if name else None
    symbols = enumerate(angle_symbols(part.axes, part.fixed))
    heads = head_line(None, *[(dot(css(joint_colour(k))), mathml(symbol)) for k, symbol in symbols])
    angles = [_field(form, "angles", k, part.angles[k], units) for k in range(3)]
    rates = [_field(form, "rates", k, part.rates[k], units) for k in range(3)]
    rows = line(*angles, name=f"φ, {units.angle_unit}"), line(*rates, name=f"φ̇, {units.angle_unit}/s")
    table = tag("table.kit-points.ve-points", heads, rows)
    return joined(tag("div.kit-head", chooser, about), told, table, tag("div.bar", take))


def _field(form: Form, what: str, k: int, value: float, units: Units) -> Markup:
    where = f"{what.removesuffix('s')} {k + 1}"

    def taken(text: str) -> SetTurning:
        return SetTurning(what, k, units.read(text, True, where, "/s" if what == "rates" else ""))

    return form.field(f"{what} {k}", units.entry(value, True), capitalised(where), taken)


def columns_of(state: State) -> tuple[Markup, ...]:
    """Return the heads of the columns of T: the rates."""
    part = state[Turning]
    return tuple(
        tag("b.joint", mathml(DOTTED % symbol), style=f"--c:{css(joint_colour(k))}")
        for k, symbol in enumerate(angle_symbols(part.axes, part.fixed))
    )


def columns_markup(state: State) -> Markup:
    """Return T in symbols."""
    part = state[Turning]
    columns = r"\;|\;".join(columns_latex(part.axes, part.fixed))
    return tag("div.eq.small", mathml(f"T=[{columns}]"), title="⟦Notes 5.42-5.43⟧")


def rates_markup(state: State) -> Markup:
    """Return omega, det T with its meaning, and the check with the rotation."""
    part, units, found = state[Turning], units_of(state), state.derived(turned_of)
    sign, function = _determinant(part)
    second = angle_symbols(part.axes, part.fixed)[1]
    away = float(np.abs(found.measured - found.omega).max())
    rows: list[tuple[Inside, Inside]] = [
        ((mathml(OMEGA), f", {units.angle_unit}/s"), _three(found.omega, units)),
        (f"|ω|, and |φ̇|, {units.angle_unit}/s", _sizes(found.omega, np.array(part.rates), units)),
        (mathml(rf"\det T={sign}\{function}{second}"), number(found.determinant, 4)),
        (("ω from ", mathml(RDOT), f", {units.angle_unit}/s"), _three(found.measured, units)),
        ("largest difference, rad/s", scientific(away)),
    ]
    return joined(pairs(rows), _verdict(part, found), tag("p.dim", T_MATRIX))


def _determinant(part: Turning) -> tuple[str, str]:
    """Return sign and function of the second angle in det T."""
    if part.axes in PROPER:
        return ("" if part.fixed else "-"), "sin "
    follows = part.axes in ("xyz", "yzx", "zxy")
    return ("" if follows else "-"), "cos "


def _verdict(part: Turning, found: Turned) -> Markup:
    inverse = 1.0 / float(np.linalg.cond(found.T))
    verdict = conditioning(inverse, abs(found.determinant) < SINGULAR_SINE)
    where = " or ".join(f"{round(np.degrees(angle))}°".replace("-", "−") for angle in singular_angles(part.axes))
    if verdict == "singular":
        axis = ", ".join(number(float(value), 3) for value in found.lost)
        return verdict_box("no", TITLES[verdict], f"{capitalised(singular_sentence(part.axes))}: ({axis}).")
    ratio = with_indices(f"Of T, σ_min/σ_max = {number(inverse, 3)}. ")
    if verdict == "poor":
        large = f"One rate may have to be 1/|det T| = {number(1.0 / abs(found.determinant), 1)} times as large as |ω|."
        return verdict_box("warn", TITLES[verdict], ratio, large)
    every = f"Every ω has its rates φ̇ = T⁻¹ω, except at a second angle of {where}, where T is singular."
    return verdict_box("ok", TITLES[verdict], ratio, every)


def tool_markup(state: State) -> Markup:
    """Return the analytic Jacobian of the tool's angles, and the rates that the chosen joint speeds cause."""
    part, units, found = state[Turning], units_of(state), state.derived(tool_angles_of)
    head = "Analytic Jacobian of the tool ", tag("small", mathml(ANALYTIC), "⟦ 5.47–5.51⟧")
    rows: list[tuple[Inside, Inside]] = [(f"φ of the tool, {units.angle_unit}", _three(found.angles, units))]
    if found.J is None or found.rates is None:
        told = f"{capitalised(singular_sentence(part.axes))}."
        return fold(head, pairs(rows), verdict_box("no", "It does not exist here", told))
    rows += [
        (("φ̇ = J", tag("sub", "φ"), f" q̇, {units.angle_unit}/s"), _three(found.rates, units)),
        (("ω = J", tag("sub", "A"), f" q̇, {units.angle_unit}/s"), _three(found.omega, units)),
    ]
    wide = found.J.shape[1] > WIDE
    shown = tag("div.scroll.tu-wide" if wide else "div.scroll", matrix(found.J, 2 if wide else 3))
    return fold(head, shown, pairs(rows), tag("p.dim", "With the joint speeds of “Jacobian”. ", RATES))


def laws_markup(state: State) -> Markup:
    """Return the two time laws, their equal integrals and the resulting orientations."""
    units, end = units_of(state), laws_time(state)
    quarter = f"{units.text(np.pi / 2, True)} {units.angle_unit}/s"
    told = (f"about z for 1 s, then about x: {quarter}", f"about x for 1 s, then about z: {quarter}")
    halves = []
    for law, words in enumerate(told):
        head = tag("b", dot(css(joint_colour(law))), f"Law {law + 1}")
        halves.append(tag("div.tu-law", head, tag("p.dim", words), matrix(law_rotation(law, end), 2)))
    apart = between(law_rotation(0, end), law_rotation(1, end))
    rows = [
        (f"∫ω¹ dt, {units.angle_unit}", _three(law_integral(end, 0), units)),
        (f"∫ω² dt, {units.angle_unit}", _three(law_integral(end, 1), units)),
        ("angle between them", units.angle(apart)),
    ]
    same = bool(np.allclose(law_integral(end, 0), law_integral(end, 1))) and apart > SEEN
    why = (
        "The integral of ω is no orientation: the order of the turns counts⟦ (notes 5.19–5.21)⟧. "
        "The sum of two translations does not depend on their order. Laws of your own: tab Rotation, page Integral."
    )
    verdict = verdict_box("warn", "Same integral, other orientation", why) if same else None
    title = tag("h3", f"Orientations after {number(end, 2)} s ", tag("small", "starting from I"))
    return joined(title, tag("div.tu-laws", halves), pairs(rows), verdict)


def small_markup() -> Markup:
    """Return the differences between the six orders of small turns."""
    lines = []
    for each in commuting():
        ratio = number(each.from_sum / each.size**2, 2)
        lines.append(line(f"{each.size:g}", scientific(each.apart, 2), scientific(each.from_sum, 2), ratio))
    said = (
        "Largest difference of an entry, for rotations by dφ about x, y and z. A tenth of dφ leaves a hundredth of it."
    )
    return joined(
        tag("h3", "Small rotations commute ", tag("small", "⟦5.22–5.27⟧")),
        tag("table.kit-table", head_line("dφ, rad", "two orders", "from I + S(dφ)", "/ dφ²"), lines),
        tag("p.dim", f"{said} {ORDERS}"),
    )


def views_markup(form: Form, state: State) -> Markup:
    """Return the choice of the view."""
    views = {"angles": "φ, φ̇ and ω", "laws": "Two time laws of ω"}
    show = partial(Set, Turning, "shown")
    return row("Look at", form.chips("shown", views, state[Turning].shown, "What is shown", show))


def _three(vector: Floats, units: Units) -> str:
    return EN_SPACE.join(units.text(float(value), True) for value in vector)


def _sizes(one: Floats, other: Floats, units: Units) -> str:
    return EN_SPACE.join(units.text(float(np.linalg.norm(each)), True) for each in (one, other))
