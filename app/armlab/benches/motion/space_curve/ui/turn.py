"""Two orientations and the two ways between them, typed and in numbers."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.motion.space_curve.commands import End, SetAngle, TakeOrientation, WriteIn
from armlab.benches.motion.space_curve.state import SpaceCurve, turn_of, turn_place
from armlab.benches.motion.space_curve.ui.words import corrected
from armlab.kin.euler import NAMES, SEQUENCES, angle_symbols
from armlab.session.fields import Set
from armlab.session.state import State
from armlab.ui.colours import AXES, css
from armlab.ui.form import Form
from armlab.ui.format import capitalised, dot, escaped, mathml, number, pairs
from armlab.ui.units import Units, units_of

LETTERS = {r"\varphi": "φ", r"\theta": "θ", r"\psi": "ψ"}

ONE_AXIS = r"R(t)=R_A\,R(r,\theta_{AB}\,s(t)),\quad R(r,\theta_{AB})=R_A^TR_B"
THREE = r"\varphi(s)=\varphi_A+s\,(\varphi_B-\varphi_A),\ldots"

CORRECTED = "Notes 6.152 write R(r, θ), 3.53 R(θ, r): the same matrix. “Starts from θ(t) = 0” means θ(0) = 0."

ABOUT = {"moving": "axes move", "fixed": "axes stay"}

ENDS: tuple[End, ...] = ("A", "B")

SOURCES = {"tool": "the tool as it is", "handle": "the handle of the target"}
"""Where an orientation can be taken from."""

STILL = 1e-9
"""Radians below which there is no turn."""


def turn_form(form: Form, state: State) -> str:
    """Return the sequence, the angles of both orientations, and where else they may come from."""
    part, units = state[SpaceCurve], units_of(state)
    titles = {axes: axes.upper() for axes in SEQUENCES}
    sequence = form.select("axes", "Sequence", titles, part.axes, lambda axes: WriteIn(axes=axes))
    hint, chosen = "Whether the axes are turned along by the turns before", "fixed" if part.fixed else "moving"
    about = form.chips("about", ABOUT, chosen, hint, lambda key: WriteIn(fixed=key == "fixed"))
    name = NAMES.get((part.axes, part.fixed), "")
    kind = f'<p class="dim">{escaped(capitalised(name))}.</p>' if name else ""
    ends = "".join(_end(form, part, end, units) for end in ENDS)
    return (
        f'<h3>From A to B</h3><div class="kit-head">{sequence}{about}</div>{kind}'
        f'<table class="kit-points sc-angles">{_heads(part, units)}{ends}</table>'
    )


def _heads(part: SpaceCurve, units: Units) -> str:
    letters = (LETTERS[letter] for letter in angle_symbols(part.axes, part.fixed))
    heads = "".join(
        f'<th>{letter}, {units.angle_unit} <b class="axis-{axis}">{axis}</b></th>'
        for letter, axis in zip(letters, part.axes, strict=True)
    )
    return f"<tr><th></th>{heads}<th></th></tr>"


def _end(form: Form, part: SpaceCurve, end: End, units: Units) -> str:
    angles = part.start if end == "A" else part.end
    cells = "".join(f"<td>{_angle(form, end, k, angle, units)}</td>" for k, angle in enumerate(angles))
    take = "".join(
        form.button(f"take {end} {source}", source, TakeOrientation(end, source), "copy", f"Take {end} from {words}")
        for source, words in SOURCES.items()
    )
    return f"<tr><th>{end}</th>{cells}<td>{take}</td></tr>"


def _angle(form: Form, end: End, k: int, angle: float, units: Units) -> str:
    def typed(text: str) -> SetAngle:
        return SetAngle(end, k, units.read(text, True, f"angle {k + 1} of {end}"))

    return form.field(f"a {end} {k}", units.entry(angle, True), f"Angle {k + 1} of {end}", typed)


def turn_numbers(form: Form, state: State) -> str:
    """Return both ways as a whole and where the film stands."""
    found, units, part = state.derived(turn_of), units_of(state), state[SpaceCurve]
    s, rate = turn_place(state)
    speeds = [rate * float(np.linalg.norm(each.angular(s)[0])) for each in (found.straight, found.euler)]
    rows = (
        ("whole angle", *(units.angle(angle) for angle in found.swept)),
        ("|ω| now", *(f"{units.text(speed, True)} {units.angle_unit}/s" for speed in speeds)),
    )
    table = "".join(f"<tr><th>{name}</th><td>{one}</td><td>{three}</td></tr>" for name, one, three in rows)
    apart = float(np.interp(s, found.s, found.apart))
    angles = ", ".join(units.angle(float(angle)) for angle in found.euler.angles(s))
    theta = found.straight.angle
    axis = ", ".join(number(float(value), 3) for value in found.straight.axis)
    turning = abs(theta) > STILL
    half = abs(abs(theta) - math.pi) < 1e-7
    cell, text = f"long {'off' if part.other_way else 'on'}", "the other way" if half else "the long way"
    other = Set(SpaceCurve, "other_way", not part.other_way)
    long_way = form.chip(cell, text, other, "About −r by 360° − θ", part.other_way, off=not turning)
    return (
        f'<h3>At s = {number(s, 3)}</h3><table class="sc-table sc-two"><tr><th></th><th>one axis</th>'
        f"<th>three angles</th></tr>{table}</table>"
        + pairs(
            [
                ("r, in A", f"({axis})" if turning else "any: no turn"),
                ("θ<sub>AB</sub>", units.angle(theta)),
                ("θ now", units.angle(s * theta)),
                ("angles now", angles),
                ("apart now", units.angle(apart)),
                ("wandering, at most", units.angle(found.wandering)),
            ]
        )
        + f'<div class="bar">{long_way}</div>'
        + "".join(f'<p class="warn">◐ {escaped(text)}</p>' for text in found.remarks)
    )


def turn_words() -> str:
    """Return the formulas and what is drawn."""
    names = "".join(f"<span>{dot(css(colour))}tip of {axis}</span>" for axis, colour in AXES.items())
    return (
        f'<div class="legend">{names}<span>— one axis</span><span>- - three angles</span></div>'
        f'<div class="eq small"><div title="Notes 6.151–6.155">{mathml(ONE_AXIS)}</div>'
        f'<div title="Notes 6.150">{mathml(THREE)}</div></div>{corrected(CORRECTED)}'
    )
