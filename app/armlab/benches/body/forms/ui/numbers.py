"""The fields of a rotation in all its forms, and what is said of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from armlab.benches.body.forms.commands import (
    PLACES,
    FlipQuaternion,
    PlaceBody,
    SetBodyAngle,
    SetBodyAxis,
    SetBodyEntry,
    SetBodyMatrix,
    SetBodyQuaternion,
    SetBodyTurn,
    SetWholeAxis,
    SetWholeQuaternion,
    TakeOtherAngles,
    UnitQuaternion,
    WriteBody,
)
from armlab.benches.body.forms.rotation import Forms, Triples, forms_of
from armlab.benches.body.forms.state import MOST, Body
from armlab.benches.body.forms.ui.rings import COLOURS
from armlab.benches.body.forms.ui.words import LETTERS, turn_names
from armlab.errors import InputError
from armlab.kin.conditioning import conditioning
from armlab.kin.euler import NAMES, SEQUENCES, angle_symbols, product_latex
from armlab.session.fields import Set
from armlab.session.state import Command, State
from armlab.ui.colours import AXES, css
from armlab.ui.factors import turns
from armlab.ui.form import Form
from armlab.ui.format import MINUS, capitalised, components, dot, mathml, number, readable
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.nearest import nearest_box
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, typed_numbers, units_of

UNIT = 1e-9
"""Difference of a length from 1 up to which a quaternion is of unit length."""

TINY = 1e-3
"""Size below which an entry is written with four significant digits, which four decimals would not show."""

BEYOND = ": two whole turns are all there is, q returns after them"
"""End of the sentence on an angle about the axis that is too large."""

HALF = 1e-6
"""Distance from half a turn, radians, within which both axes are as good."""


def places_markup(form: Form) -> Markup:
    """Return the orientations to begin with."""
    chips = [form.chip(f"place {key}", title, PlaceBody(key)) for key, (title, *_) in PLACES.items()]
    return tag("div.cases", chips)


def angles_markup(form: Form, state: State, with_rings: bool = True) -> Markup:
    """Return the sequence, the three angles to type, the other triple, and what a singularity leaves open.

    ``with_rings`` offers the gimbal rings, which not every page draws.
    """
    part, units, found = state[Body], units_of(state), state.derived(forms_of)
    chooser = form.select("axes", "Sequence of axes", {axes: axes.upper() for axes in SEQUENCES}, part.axes, WriteBody)
    about = form.chips(
        "about",
        {"moving": "moving axes", "fixed": "fixed axes"},
        "fixed" if part.fixed else "moving",
        "The same orientation, written in other angles",
        lambda key: WriteBody(fixed=key == "fixed"),
    )
    rings = form.chip(
        "rings", "Rings", Set(Body, "rings", not part.rings), "The gimbal rings of this sequence", part.rings
    )
    name = NAMES.get((part.axes, part.fixed), "")
    told = tag("p.dim", f"{capitalised(name)}.") if name else None
    symbols = angle_symbols(part.axes, part.fixed)
    axes = turn_names(part.axes, part.fixed)
    heads = head_line(
        None,
        *[
            (dot(css(COLOURS[k])), mathml(symbol), tag("small", f" about {axis}"))
            for k, (symbol, axis) in enumerate(zip(symbols, axes, strict=True))
        ],
    )
    rows = [line(*_angle_fields(form, found.triples, symbols, units), name=units.angle_unit)]
    if not found.triples.singular:
        take = form.button("other", "or", TakeOtherAngles(), "chip", "Take these: the same orientation by other turns")
        rows.append(line(*[units.text(float(angle), True) for angle in found.triples.other], name=take))
    table = tag("table.kit-points.bo-angles", heads, rows)
    written = [units.angle(float(angle)) for angle in found.triples.shown]
    product = mathml("R=" + product_latex(part.axes, part.fixed))
    equation = tag("div.eq.small", product, " = ", turns(part.axes, part.fixed, written))
    head = tag("div.kit-head", chooser, about, rings if with_rings else None)
    return joined(head, told, table, equation, _lock(part, found.triples, units))


def _angle_fields(form: Form, triples: Triples, symbols: Sequence[str], units: Units) -> list[Markup]:
    def field(k: int) -> Markup:
        name = LETTERS[symbols[k]]

        def taken(text: str) -> Command:
            return SetBodyAngle(k, units.read(text, True, name))

        return form.field(f"angle {k}", units.entry(float(triples.shown[k]), True), f"{name}, angle {k + 1}", taken)

    return [field(k) for k in range(3)]


def _lock(part: Body, triples: Triples, units: Units) -> Markup | None:
    """Return what is lost and what is defined at a singularity, or a warning near one."""
    first, middle, third = (LETTERS[symbol] for symbol in angle_symbols(part.axes, part.fixed))
    if triples.singular:
        plus = triples.combination > 0
        what, other = ("sum", "difference") if plus else ("difference", "sum")
        written = f"{first} {'+' if plus else MINUS} {third}"
        head = f"Gimbal lock: only {written} = {units.orientation(triples.defined)} is determined"
        said = (
            f"At {middle} = {units.orientation(float(triples.shown[1]))} the first and the third axis are one line, so "
            f"the {what} of {first} and {third} decides and their {other} is free. No turn about "
            f"({components(triples.lost, 3)}) can be begun by the three angles."
        )
        return verdict_box("warn", head, tag("p", said))
    if conditioning(triples.inverse_condition) != "good":
        most = number(1.0 / abs(triples.determinant), 0)
        return verdict_box(
            "warn", "Nearly gimbal lock", tag("p", f"The angles turn up to {most} times as fast as the body.")
        )
    return None


def axis_markup(form: Form, state: State) -> Markup:
    """Return the axis and the angle to type, and the opposite pair."""
    part, units, found = state[Body], units_of(state), state.derived(forms_of)
    typed = np.array(part.axis)
    same = float(np.abs(typed / np.linalg.norm(typed) - found.axis).max()) < UNIT
    values = typed if same else found.axis
    fields = _fields(form, "axis", ("r x", "r y", "r z"), values.tolist(), "an axis", SetBodyAxis, SetWholeAxis)

    def turned(text: str) -> Command:
        return SetBodyTurn(units.read(text, True, "θ", within=(-2.0 * math.pi, 2.0 * math.pi), why=BEYOND))

    angle = form.field("turn", units.entry(found.angle, True), "Angle θ", turned)
    heads = head_line("θ, " + units.angle_unit, *(("r", tag("sub", axis)) for axis in AXES))
    table = tag("table.kit-points.bo-angles", heads, line(angle, *fields))
    return joined(tag("h3", "Axis and angle"), table, tag("p.dim", _of_the_turn(found, units)))


def _of_the_turn(found: Forms, units: Units) -> Inside:
    if found.still:
        whole = " after a whole turn" if found.angle else ""
        return f"No rotation{whole}: r may be any axis."
    if abs(abs(found.angle) - math.pi) < HALF:
        return f"Half a turn: the same with {MINUS}r = ({components(-found.axis, 3)})."
    rest = math.copysign(2.0 * math.pi, found.angle) - found.angle
    return f"The same: {units.angle(rest)} about {MINUS}r = ({components(-found.axis, 3)})."


def quaternion_markup(form: Form, state: State) -> Markup:
    """Return the quaternion to type, its length, and the other one of the same rotation."""
    part, found = state[Body], state.derived(forms_of)
    names = ("q w", "q x", "q y", "q z")
    fields = _fields(form, "q", names, part.q, "a quaternion", SetBodyQuaternion, SetWholeQuaternion)
    flip = form.chip("flip", f"{MINUS}q", FlipQuaternion(), "The other quaternion of the same rotation")
    away = abs(found.length - 1.0) > UNIT
    unit = form.chip("unit", "q / |q|", UnitQuaternion(), "Divide by the length") if away else None
    length = f"|q| = {number(found.length, 4)}: the rotation is that of q / |q|." if away else None
    said = tag("p.dim", length or f"q = (cos θ/2, r sin θ/2); {MINUS}q is the same rotation.")
    head = tag("h3", "Quaternion ", tag("small", "w, x, y, z"), tag("span.copies", unit, flip))
    return joined(head, tag("table.kit-points", line(*fields)), said)


def matrix_markup(form: Form, state: State) -> Markup:
    """Return the nine fields of the matrix, and how far the typed one is from the rotation that the body takes."""
    part, found = state[Body], state.derived(forms_of)
    shown = found.R if found.nearest is None else np.array(part.matrix)
    lines = [tag("tr", [tag("td", _entry(form, shown, i, j)) for j in range(3)]) for i in range(3)]
    head = tag("h3", "Matrix R ", tag("small", "columns are x′, y′, z′ in the base frame"))
    return joined(head, tag("table.kit-points.bo-matrix", lines), _distance(form, found, shown))


def _entry(form: Form, shown: np.ndarray, i: int, j: int) -> Markup:
    where = f"R row {i + 1}, column {j + 1}"

    def taken(text: str) -> Command:
        values = typed_numbers(text, where, 9, "the matrix")
        return SetBodyMatrix(tuple(values)) if len(values) == 9 else SetBodyEntry(i, j, values[0])

    return form.field(f"R {i}{j}", _written(float(shown[i, j])), where, taken)


def _distance(form: Form, found: Forms, typed: np.ndarray) -> Inside:
    if found.nearest is None:
        return tag(
            "p.dim",
            mathml("R^TR=I"),
            ", ",
            mathml(r"\det R=+1"),
            ". Whatever is typed, the body takes the nearest rotation.",
        )
    if found.nearest.distance < UNIT:
        return tag("p.dim", "The typed matrix M is a rotation.")
    take = form.chip("rounded", "Take it", SetBodyMatrix(tuple(found.R.ravel().tolist())), "Write the nearest rotation")
    rows = [tag("tr", [tag("td", number(float(value), 4)) for value in line]) for line in found.R]
    return nearest_box(
        typed,
        found.nearest,
        tag("p", "‖M − R‖, root of the sum of the squares of all entries. The body takes R: ", take),
        tag("table.mat", rows),
    )


def _written(value: float) -> str:
    """Return an entry with four decimals, as its neighbours have; a whole or a tiny one in few digits."""
    return readable(value, 4) if abs(value) < TINY or value == round(value) else number(value, 4)


def _fields(
    form: Form,
    cell: str,
    names: Sequence[str],
    values: Sequence[float],
    of: str,
    one: Callable[[int, float], Command],
    all_: Callable[[tuple[float, ...]], Command],
) -> list[Markup]:
    """Return the fields of a vector, of which any takes one number or all."""

    def field(k: int) -> Markup:
        def taken(text: str) -> Command:
            found = typed_numbers(text, names[k], len(names), of)
            for name, value in zip(names if len(found) > 1 else names[k:], found, strict=False):
                if abs(value) > MOST:
                    raise InputError(f"{name}: expected at most {MOST:g} either way, got {value:.6g}")
            return all_(tuple(found)) if len(found) > 1 else one(k, found[0])

        return form.field(f"{cell} {k}", _written(float(values[k])), names[k], taken)

    return [field(k) for k in range(len(names))]
