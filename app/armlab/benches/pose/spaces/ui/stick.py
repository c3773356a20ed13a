"""The pendulum by the place of its end and by its angle, and other representations with their constraints."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from armlab.benches.pose.spaces.state import BY, DragEnd, MoveEnd, Represent, SetLength, Spaces, TurnStick
from armlab.kin.representations import stick_end
from armlab.kin.rotations import quaternion_from_rotation
from armlab.session.amounts import amount
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State
from armlab.ui import svg
from armlab.ui.form import Form, Wish
from armlab.ui.format import mathml, readable, scientific
from armlab.ui.html import Inside, Markup, classes, tag
from armlab.ui.markup import fold, verdict_box
from armlab.ui.small_numbers import with_unit
from armlab.ui.symbols import with_indices
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, units_of

WIDE, HIGH = 330.0, 230.0
"""Size of the picture, pixels."""

CIRCLE = 84.0
"""Radius of the circle of the end, pixels."""

ARC, BOB, PIVOT = 30.0, 7.0, 4.0
"""Radii of the arc of the angle, of the end and of the pivot, pixels."""

FULFILLED = 1e-9
"""Residual, in squares of the length, below which the constraint counts as fulfilled: rounding."""


def stick_markup(form: Form, state: State) -> Inside:
    """Return the choice of numbers, the picture, the fields and what they mean."""
    part, units = state[Spaces], units_of(state)
    chips = form.chips("by", BY, part.by, "Numbers that represent the stick", Represent)
    return (
        tag("div.bar", tag("span.dim", "the stick by"), chips),
        picture(form, part),
        tag("div.kit-numbers", _fields(form, part, units)),
        _card(form, part, units),
        fold("Other representations", others_markup(state)),
    )


def picture(form: Form, part: Spaces) -> Markup:
    """Return the stick, the circle of its end, and the angle; the end is dragged."""
    middle = 0.5 * WIDE, 0.5 * HIGH
    scale = CIRCLE / part.length

    def at(x: float, y: float) -> tuple[float, float]:
        return middle[0] + scale * x, middle[1] - scale * y

    end = at(part.x, part.y)
    theta = part.theta
    shapes: list[Inside] = [
        svg.line("sp-axis", 6.0, middle[1], WIDE - 6.0, middle[1]),
        svg.line("sp-axis", middle[0], 6.0, middle[0], HIGH - 6.0),
        svg.text("tick", WIDE - 6.0, middle[1] - 5.0, "x", "end"),
        svg.text("tick", middle[0] + 5.0, 14.0, "y"),
        svg.circle("sp-circle", *middle, CIRCLE),
    ]
    if part.by == "theta":
        arc = [at(*stick_end(theta * k / 24.0, ARC / scale)) for k in range(25)]
        shapes.append(svg.path("sp-arc", "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in arc)))
        shapes.append(svg.text("", *at(*stick_end(0.5 * theta, 1.5 * ARC / scale)), "θ", "middle"))
    else:
        shapes += [svg.line("sp-part", end[0], end[1], end[0], middle[1]), svg.line("sp-part", *end, middle[0], end[1])]
        shapes.append(svg.text("", end[0], middle[1] + (14.0 if part.y > 0.0 else -6.0), _sub("x"), "middle"))
        shapes.append(svg.text("", middle[0] - 6.0, end[1] + 4.0, _sub("y"), "end"))
    on = fulfilled(part)
    shapes.append(svg.line("sp-stick" if on else "sp-stick.off", *middle, *end))
    shapes.append(svg.circle("sp-pivot", *middle, PIVOT))
    shapes.append(svg.circle(classes("sp-bob", off=not on), *end, BOB))
    said = f"A stick that hangs from the origin; its end {'is' if on else 'is not'} on the circle of its length"
    where = form.place("stick", partial(_dragged, part.length), drag=True)
    return svg.drawing("chart.sp-picture", WIDE, HIGH, said, *shapes, **where)


def _sub(axis: str) -> Inside:
    return "p", tag("tspan", axis, dy="3", font_size="9")


def _dragged(length: float, x: float, y: float, drag: int) -> Wish:
    """Return the command for a place in parts of the picture from its upper left."""
    scale = CIRCLE / length
    end = (x - 0.5) * WIDE / scale, (0.5 - y) * HIGH / scale
    return DragEnd(*end, drag) if drag else MoveEnd(*end)


def fulfilled(part: Spaces) -> bool:
    """Return whether the end is where the stick can end."""
    return abs(part.residual) <= FULFILLED * part.length**2


def _fields(form: Form, part: Spaces, units: Units) -> Inside:
    def typed(name: str, text: str) -> Command:
        value = units.read(text, False, f"p_{name}")
        return MoveEnd(value, part.y) if name == "x" else MoveEnd(part.x, value)

    def field(cell: str, name: Inside, value: float, label: str, action: object, turns: bool) -> Markup:
        shown = readable(value / units.factor(turns), units.decimals(turns))
        typed_in = form.field(cell, shown, label, action)  # type: ignore[arg-type]
        return tag("label", tag("span", name), typed_in, tag("i", units.unit(turns)))

    length = field("length", "L", part.length, "Length", lambda text: SetLength(units.read(text, False, "L")), False)
    if part.by == "theta":
        return (
            field("theta", "θ", part.theta, "Angle", lambda text: TurnStick(units.read(text, True, "θ")), True),
            length,
        )
    return (
        field("x", with_indices("p_x"), part.x, "p x", partial(typed, "x"), False),
        field("y", with_indices("p_y"), part.y, "p y", partial(typed, "y"), False),
        length,
    )


def _card(form: Form, part: Spaces, units: Units) -> Markup:
    if part.by == "theta":
        said = "One number, no constraint: 1 − 0 = 1 degree of freedom. Every θ is a configuration."
        return verdict_box("ok", "θ: a minimal representation", tag("p", said))
    residual = "0" if fulfilled(part) else amount(part.residual, "m²")
    equation = tag("p", mathml(r"p_x^2+p_y^2-L^2"), f" = {residual}")
    count = "Two numbers and one constraint: 2 − 1 = 1 degree of freedom."
    if fulfilled(part):
        return verdict_box("ok", "A configuration", equation, tag("p", count))
    needed = with_unit(math.hypot(part.x, part.y), False, units)
    said = f"The stick would have to be {needed} long, and it is {with_unit(part.length, False, units)}. {count}"
    nearest = form.chip("nearest", "nearest point", _nearest(part), "The nearest place where it can end")
    return verdict_box("no", "No configuration", equation, tag("p", said), tag("div.bar", nearest))


def _nearest(part: Spaces) -> tuple[Command, ...]:
    end = stick_end(part.theta, part.length)
    return (Set(Spaces, "x", end[0]), Set(Spaces, "y", end[1]))


def others_markup(state: State) -> Inside:
    """Return representations of an orientation with their numbers, constraints, and the residual at the tool."""
    R = np.asarray(state[Joints].tool_pose[:3, :3], dtype=np.float64)
    quaternion = np.asarray(quaternion_from_rotation(R))
    rows = (
        ("rotation matrix", 9, 6, float(np.abs(R.T @ R - np.eye(3)).max())),
        ("unit quaternion", 4, 1, abs(float(quaternion @ quaternion) - 1.0)),
        ("unit axis and angle", 4, 1, None),
        ("three angles", 3, 0, None),
    )
    table = [
        line(str(numbers), str(constraints), str(numbers - constraints), _residual(residual, constraints), name=name)
        for name, numbers, constraints, residual in rows
    ]
    return (
        tag("table.kit-points", head_line("orientation", "numbers", "constraints", "left", "residual"), table),
        tag(
            "p.dim",
            "Three are left in each: an orientation has three degrees of freedom, and only three angles are "
            "minimal. The residuals are those of the tool as it stands.",
        ),
    )


def _residual(value: float | None, constraints: int) -> str:
    if not constraints:
        return "none"
    return "" if value is None else scientific(value) if value else "0"
