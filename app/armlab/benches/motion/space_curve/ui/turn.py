"""Two orientations and the two turns between them, in fields and numbers."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.motion.space_curve.commands import End, SetAngle, TakeOrientation, WriteIn
from armlab.benches.motion.space_curve.state import SpaceCurve, turn_of, turn_place
from armlab.benches.motion.space_curve.ui.words import corrected, said
from armlab.kin.euler import NAMES, SEQUENCES, angle_symbols
from armlab.session.fields import Set
from armlab.session.state import State
from armlab.ui.colours import AXES, css
from armlab.ui.form import Form
from armlab.ui.format import capitalised, dot, mathml, number, pairs
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import fold
from armlab.ui.symbols import with_indices
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, units_of

LETTERS = {r"\varphi": "φ", r"\theta": "θ", r"\psi": "ψ"}

ONE_AXIS = r"R(t)=R_A\,R(r,\theta_{AB}\,s(t)),\quad R(r,\theta_{AB})=R_A^TR_B"
THREE = r"\varphi(s)=\varphi_A+s\,(\varphi_B-\varphi_A),\ldots"

CORRECTED = "⟦Notes 6.152 write R(r, θ), 3.53 R(θ, r): the same matrix. “Starts from θ(t) = 0” means θ(0) = 0.⟧"

ABOUT = {"moving": "current axes", "fixed": "fixed axes"}

ENDS: tuple[End, ...] = ("A", "B")

SOURCES = {"tool": "the tool as it is", "handle": "the handle of the target"}
"""Sources from which an orientation can be taken, in words."""

STILL = 1e-9
"""Angle below which there is no turn, radians."""


def turn_form(form: Form, state: State) -> Markup:
    """Return the sequence, the angles of both orientations, and the buttons for other sources."""
    part, units = state[SpaceCurve], units_of(state)
    titles = {axes: axes.upper() for axes in SEQUENCES}
    sequence = form.select("axes", "Sequence", titles, part.axes, lambda axes: WriteIn(axes=axes))
    hint, chosen = "Rotations about the current axes, or about the fixed ones", "fixed" if part.fixed else "moving"
    about = form.chips("about", ABOUT, chosen, hint, lambda key: WriteIn(fixed=key == "fixed"))
    name = NAMES.get((part.axes, part.fixed), "")
    kind = tag("p.dim", f"{capitalised(name)}.") if name else None
    ends = [_end(form, part, end, units) for end in ENDS]
    return joined(
        tag("h3", "From A to B"),
        tag("div.kit-head", sequence, about),
        kind,
        tag("table.kit-points.sc-angles", _heads(part, units), ends),
    )


def _heads(part: SpaceCurve, units: Units) -> Markup:
    letters = (LETTERS[letter] for letter in angle_symbols(part.axes, part.fixed))
    heads = [
        (f"{letter}, {units.angle_unit} ", tag(f"b.axis-{axis}", axis))
        for letter, axis in zip(letters, part.axes, strict=True)
    ]
    return head_line("", *heads, "")


def _end(form: Form, part: SpaceCurve, end: End, units: Units) -> Markup:
    angles = part.start if end == "A" else part.end
    cells = [_angle(form, end, k, angle, units) for k, angle in enumerate(angles)]
    take = [
        form.button(f"take {end} {source}", source, TakeOrientation(end, source), "copy", f"Take {end} from {words}")
        for source, words in SOURCES.items()
    ]
    return line(*cells, take, name=end)


def _angle(form: Form, end: End, k: int, angle: float, units: Units) -> Markup:
    def typed(text: str) -> SetAngle:
        return SetAngle(end, k, units.read(text, True, f"angle {k + 1} of {end}"))

    return form.field(f"a {end} {k}", units.entry(angle, True), f"Angle {k + 1} of {end}", typed)


def turn_numbers(form: Form, state: State) -> Markup:
    """Return both turns as a whole and at the time of the film."""
    found, units, part = state.derived(turn_of), units_of(state), state[SpaceCurve]
    s, rate = turn_place(state)
    speeds = [abs(rate) * float(np.linalg.norm(each.angular(s)[0])) for each in (found.straight, found.euler)]
    rows = [
        line(*(units.angle(angle) for angle in found.swept), name="total angle"),
        line(*(f"{units.text(speed, True)} {units.angle_unit}/s" for speed in speeds), name="|ω| now"),
    ]
    apart = float(np.interp(s, found.s, found.apart))
    angles = ", ".join(units.angle(float(angle)) for angle in found.euler.angles(s))
    theta = found.straight.angle
    axis = ", ".join(number(float(value), 3) for value in found.straight.axis)
    turning = abs(theta) > STILL
    half = abs(abs(theta) - math.pi) < 1e-7
    cell, text = f"long {'off' if part.other_way else 'on'}", "the other way" if half else "the long way"
    other = Set(SpaceCurve, "other_way", not part.other_way)
    long_way = form.chip(cell, text, other, "About −r by 360° − θ", part.other_way, off=not turning)
    numbers = [
        ("r, in A", f"({axis})" if turning else "any: no rotation"),
        (with_indices("θ_AB"), units.angle(theta)),
        ("θ now", units.angle(s * theta)),
        ("angles now", angles),
        ("apart now", units.angle(apart)),
        ("largest deviation", units.angle(found.wandering)),
    ]
    return joined(
        tag("h3", f"At s = {number(s, 3)}"),
        tag("table.sc-table.sc-two", head_line("", "one axis", "three angles"), rows),
        pairs(numbers),
        tag("div.bar", long_way),
        [said("warn", text) for text in found.remarks],
    )


def turn_words() -> Markup:
    """Return the formulas and the legend of the drawing."""
    names = [tag("span", dot(css(colour)), f"tip of {axis}") for axis, colour in AXES.items()]
    one_axis = tag("div", mathml(ONE_AXIS), title="⟦Notes 6.151–6.155⟧")
    three = tag("div", mathml(THREE), title="⟦Notes 6.150⟧")
    return joined(
        tag("div.legend", names, tag("span", "— one axis"), tag("span", "- - three angles")),
        fold("Formulas", tag("div.eq.small", one_axis, three), corrected(CORRECTED)),
    )
