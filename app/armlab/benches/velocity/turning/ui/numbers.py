"""The numbers of turning: omega of the rates, det T, the check with the rotation, the two laws, and small turns."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.turning.commands import SetTurning, TakeToolAngles, WriteAngles
from armlab.benches.velocity.turning.motion import (
    between,
    commuting,
    law_integral,
    law_rotation,
    laws_time,
    tool_angles_of,
    turned_of,
)
from armlab.benches.velocity.turning.state import Turning
from armlab.kin.euler import NAMES, PROPER, SEQUENCES, SINGULAR_SINE, angle_symbols
from armlab.kin.velocity.rates import columns_latex, singular_angles, singular_sentence
from armlab.session.fields import Set
from armlab.session.state import State
from armlab.ui.colours import css, joint_colour
from armlab.ui.form import Form
from armlab.ui.format import capitalised, dot, escaped, mathml, matrix, number, pairs, scientific
from armlab.ui.markup import SIGNS, row
from armlab.ui.units import Units, units_of

Floats = NDArray[np.float64]

SEEN = 1e-6
"""Radians; orientations nearer to each other are the same."""

NEAR = 0.1
"""Absolute det T below which rates are called large."""

OMEGA, RDOT, DOTTED = r"\omega=T\dot{\phi}", r"\dot{R}R^T", r"\dot{%s}"

T_MATRIX = (
    "Notes 5.43 calls T “the roll pitch yaw matrix”: it is no rotation. Its columns are the axes of the three turns "
    "where they stand at present, and φ̇ is not ω."
)

ANALYTIC = r"J_\phi=T^{-1}J_A"
RATES = "Notes 5.51 multiplies J<sub>r</sub> by (q̇₁, q̇₂, φ̇): φ̇ = q̇₁ + q̇₂ is what comes out of it."

WIDE = 5
"""Columns there is room for; more are set closer."""

ORDERS = (
    "The notes (before 5.27) speak of 12 products; three turns have 3! = 6 orders, equal only to first order in dφ."
)


def form_markup(form: Form, state: State) -> str:
    """Return the sequence, the angles and the rates."""
    part, units = state[Turning], units_of(state)
    titles = {axes: axes.upper() for axes in SEQUENCES}
    chooser = form.select("axes", "Sequence of axes", titles, part.axes, WriteAngles)
    about = form.chips(
        "about",
        {"moving": "moving axes", "fixed": "fixed axes"},
        "fixed" if part.fixed else "moving",
        "The same orientation and ω, written in other angles",
        lambda key: WriteAngles(fixed=key == "fixed"),
    )
    take = form.chip("tool", "of the tool", TakeToolAngles(), "Take the angles of the tool in the world")
    name = NAMES.get((part.axes, part.fixed), "")
    told = f'<p class="dim">{escaped(capitalised(name))}.</p>' if name else ""
    names = [mathml(symbol) for symbol in angle_symbols(part.axes, part.fixed)]
    angles = "".join(_field(form, "angles", k, part.angles[k], units) for k in range(3))
    rates = "".join(_field(form, "rates", k, part.rates[k], units) for k in range(3))
    heads = "".join(f"<th>{dot(css(joint_colour(k)))}{name}</th>" for k, name in enumerate(names))
    return (
        f'<div class="kit-head">{chooser}{about}</div>{told}'
        f'<table class="kit-points ve-points"><tr><th></th>{heads}</tr>'
        f"<tr><th>φ, {units.angle_unit}</th>{angles}</tr><tr><th>φ̇, {units.angle_unit}/s</th>{rates}</tr></table>"
        f'<div class="bar">{take}</div>'
    )


def _field(form: Form, what: str, k: int, value: float, units: Units) -> str:
    where = f"{what.removesuffix('s')} {k + 1}"

    def taken(text: str) -> SetTurning:
        return SetTurning(what, k, units.read(text, True, where))

    return f"<td>{form.field(f'{what} {k}', units.entry(value, True), capitalised(where), taken)}</td>"


def columns_of(state: State) -> tuple[str, ...]:
    """Return the heads of the columns of T: the rates."""
    part = state[Turning]
    return tuple(
        f'<b style="color:{css(joint_colour(k))}">{mathml(DOTTED % symbol)}</b>'
        for k, symbol in enumerate(angle_symbols(part.axes, part.fixed))
    )


def columns_markup(state: State) -> str:
    """Return T in symbols."""
    part = state[Turning]
    columns = r"\;|\;".join(columns_latex(part.axes, part.fixed))
    return f'<div class="eq small" title="Notes 5.42-5.43">{mathml(f"T=[{columns}]")}</div>'


def rates_markup(state: State) -> str:
    """Return omega, det T with what it says, and the check with the rotation."""
    part, units, found = state[Turning], units_of(state), state.derived(turned_of)
    sign, function = _determinant(part)
    second = angle_symbols(part.axes, part.fixed)[1]
    away = float(np.abs(found.measured - found.omega).max())
    rows = [
        (f"{mathml(OMEGA)}, {units.angle_unit}/s", _three(found.omega, units)),
        (f"|ω|, and |φ̇|, {units.angle_unit}/s", _sizes(found.omega, np.array(part.rates), units)),
        (mathml(rf"\det T={sign}\{function}{second}"), number(found.determinant, 4)),
        (f"ω from {mathml(RDOT)}, {units.angle_unit}/s", _three(found.measured, units)),
        ("largest difference, rad/s", scientific(away)),
    ]
    return pairs(rows) + _verdict(part, found.determinant, found.lost) + f'<p class="dim">{T_MATRIX}</p>'


def _determinant(part: Turning) -> tuple[str, str]:
    """Return sign and function of the second angle in det T."""
    if part.axes in PROPER:
        return ("" if part.fixed else "-"), "sin "
    follows = part.axes in ("xyz", "yzx", "zxy")
    return ("" if follows else "-"), "cos "


def _verdict(part: Turning, determinant: float, lost: Floats) -> str:
    where = " or ".join(f"{round(np.degrees(angle))}°".replace("-", "−") for angle in singular_angles(part.axes))
    if abs(determinant) < SINGULAR_SINE:
        axis = ", ".join(number(float(value), 3) for value in lost)
        head, kind = "Singular", "no"
        text = f"{capitalised(singular_sentence(part.axes))}: ({axis})."
    elif abs(determinant) < NEAR:
        head, kind = "Nearly singular", "warn"
        text = f"Rates up to 1/|det T| = {number(1.0 / abs(determinant), 1)} times |ω| are needed."
    else:
        head, kind = "Regular", "ok"
        text = f"Every ω has its rates φ̇ = T⁻¹ω; not so at a second angle of {where}."
    return f'<div class="verdict {kind}"><b>{SIGNS[kind]} {head}</b>{text}</div>'


def tool_markup(state: State) -> str:
    """Return the analytic Jacobian of the tool's angles, and what the chosen joint speeds make of them."""
    part, units, found = state[Turning], units_of(state), state.derived(tool_angles_of)
    head = f"<h3>Analytic Jacobian of the tool <small>{mathml(ANALYTIC)} 5.47–5.51</small></h3>"
    rows = [(f"φ of the tool, {units.angle_unit}", _three(found.angles, units))]
    if found.J is None or found.rates is None:
        told = f"{capitalised(singular_sentence(part.axes))}."
        return f'{head}{pairs(rows)}<div class="verdict no"><b>{SIGNS["no"]} There is none here</b>{told}</div>'
    rows += [
        (f"φ̇ = J<sub>φ</sub> q̇, {units.angle_unit}/s", _three(found.rates, units)),
        (f"ω = J<sub>A</sub> q̇, {units.angle_unit}/s", _three(found.omega, units)),
    ]
    wide = " ve-wide" if found.J.shape[1] > WIDE else ""
    shown = f'<div class="scroll{wide}">{matrix(found.J, 3 if not wide else 2)}</div>'
    return f'{head}{shown}{pairs(rows)}<p class="dim">With the joint speeds of “Speeds”. {RATES}</p>'


def laws_markup(state: State) -> str:
    """Return the two time laws, their equal integrals and the orientations they lead to."""
    units, end = units_of(state), laws_time(state)
    quarter = f"{units.text(np.pi / 2, True)} {units.angle_unit}/s"
    told = (f"about z for 1 s, then about x: {quarter}", f"about x for 1 s, then about z: {quarter}")
    halves = []
    for law, words in enumerate(told):
        R = law_rotation(law, end)
        halves.append(
            f'<div class="tu-law"><b>{dot(css(joint_colour(law)))}Law {law + 1}</b><p class="dim">{words}</p>'
            f"{matrix(R, 2)}</div>"
        )
    apart = between(law_rotation(0, end), law_rotation(1, end))
    rows = [
        (f"∫ω¹ dt, {units.angle_unit}", _three(law_integral(end, 0), units)),
        (f"∫ω² dt, {units.angle_unit}", _three(law_integral(end, 1), units)),
        ("angle between them", units.angle(apart)),
    ]
    same = bool(np.allclose(law_integral(end, 0), law_integral(end, 1))) and apart > SEEN
    verdict = (
        '<div class="verdict warn"><b>◐ Same integral, other orientation</b>The integral of ω is no orientation: '
        "the order of the turns counts (notes 5.19–5.21). The sum of two shifts does not know their order.</div>"
        if same
        else ""
    )
    head = f"<h3>Orientations after {number(end, 2)} s <small>starting from I</small></h3>"
    return f'{head}<div class="tu-laws">{"".join(halves)}</div>{pairs(rows)}{verdict}'


def small_markup() -> str:
    """Return how far the six orders of small turns are apart."""
    lines = "".join(
        f"<tr><td>{each.size:g}</td><td>{scientific(each.apart, 2)}</td><td>{scientific(each.from_sum, 2)}</td>"
        f"<td>{number(each.from_sum / each.size**2, 2)}</td></tr>"
        for each in commuting()
    )
    return (
        "<h3>Small turns commute <small>5.22–5.27</small></h3>"
        '<table class="kit-table"><tr><th>dφ, rad</th><th>two orders</th><th>from I + S(dφ)</th><th>/ dφ²</th></tr>'
        f'{lines}</table><p class="dim">Largest difference of an entry, of turns by dφ about x, y and z. '
        f"A tenth of dφ leaves a hundredth. {ORDERS}</p>"
    )


def views_markup(form: Form, state: State) -> str:
    """Return what is looked at."""
    views = {"angles": "φ, φ̇ and ω", "laws": "Two time laws of ω"}
    show = partial(Set, Turning, "shown")
    return row("Look at", form.chips("shown", views, state[Turning].shown, "What is shown", show))


def _three(vector: Floats, units: Units) -> str:
    return "&ensp;".join(units.text(float(value), True) for value in vector)


def _sizes(one: Floats, other: Floats, units: Units) -> str:
    return "&ensp;".join(units.text(float(np.linalg.norm(each)), True) for each in (one, other))
