"""The numbers of velocities: the sum over the joints, two points of a link, acceleration and jerk."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.speeds.commands import LookAtLink, SetLinkPoint
from armlab.benches.velocity.speeds.motion import (
    Moving,
    higher_of,
    measured_velocity,
    moving_of,
    two_points_of,
)
from armlab.benches.velocity.speeds.state import Velocity, drawn_scales
from armlab.benches.velocity.speeds.ui.sliders import dotted
from armlab.kin.velocity.jacobians import ToolMotion
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.colours import css, joint_colour
from armlab.ui.form import Form
from armlab.ui.format import dot, mathml, number, subscript, trimmed
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import fold
from armlab.ui.symbols import with_indices
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, units_of

Floats = NDArray[np.float64]

ROWS = tuple(with_indices(f"{letter}_{axis}") for letter in ("v", "ω") for axis in "xyz")

JERK = "⟦Notes 5.69 prints J q̈ + 2 J̇ q̇ + J̈ q, one derivative short in each term: corrected. 5.71 lacks the dot of J̇.⟧"
OMEGA = (
    "All points of the link have this one ω.⟦ Notes 5.8 concludes it from two points; it takes a third one off their "
    "line.⟧"
)


def columns_of(state: State) -> tuple[Markup, ...]:
    """Return the heads of the columns of J."""
    arm, units = state[Joints].arm, units_of(state)
    return tuple(
        tag("b.joint", units.variable(i, bool(arm.revolute[i])), style=f"--c:{css(joint_colour(i))}")
        for i in range(arm.n)
    )


def sum_markup(state: State) -> Markup:
    """Return the contributions of the joints to v and omega, and their sum."""
    arm, units, moving = state[Joints].arm, units_of(state), state.derived(moving_of)
    lines = []
    for i in range(arm.n):
        name = dot(css(joint_colour(i))), f"{dotted(arm, i, units)} {subscript('J', i + 1)}"
        lines.append(line(*_six(moving.parts[:, i], units), name=name))
    total = tag("tr.ve-sum", tag("th", "Σ = J q̇"), [tag("td", value) for value in _six(moving.twist, units)])
    aside = tag("small", f"{units.length_unit}/s, {units.angle_unit}/s; world axes")
    return fold(("Parts and their sum ", aside), tag("table.ve-table", head_line(None, *ROWS), lines, total))


def size_markup(state: State) -> Markup:
    """Return |v| and |omega|, the velocity measured from positions, and the scale of the arrows."""
    part, units, moving = state[Velocity], units_of(state), state.derived(moving_of)
    v, turning = (float(np.linalg.norm(half)) for half in (moving.twist[:3], moving.twist[3:]))
    measured = float(np.linalg.norm(state.derived(measured_velocity)))
    scales = drawn_scales(state[Joints].arm, part.qdot)
    drawn = f"1 m/s is {trimmed(scales[0], 6)} m, 1 rad/s is {trimmed(scales[1], 6)} m"
    told = f"From the positions 0.1 ms before and after: {units.text(measured, False)} {units.length_unit}/s."
    sizes = tag(
        "div.ve-size",
        tag("span", "|v| ", tag("b", f"{units.text(v, False)} {units.length_unit}/s")),
        tag("span", "|ω| ", tag("b", f"{units.text(turning, True)} {units.angle_unit}/s")),
    )
    return joined(sizes, tag("p.dim", f"{told} Drawn: {drawn}."))


def points_markup(form: Form, state: State) -> Markup:
    """Return the two points of a link, with fields for them, and their velocities."""
    part, arm, units = state[Velocity], state[Joints].arm, units_of(state)
    links = {str(i): f"link {i}" for i in range(1, arm.n + 1)}
    hint = "Link i moves with joints 1 to i"
    chooser = form.select("link", "Link", links, str(part.link), lambda key: LookAtLink(int(key)), hint)
    typed = [
        line(*[_coordinate(form, part, which, k, units) for k in range(3)], name=f"point {which + 1}")
        for which in range(2)
    ]
    heads = head_line(None, *[f"{axis}, {units.length_unit}" for axis in "xyz"])
    found = state.derived(two_points_of)
    rows = (
        ("v₁", found.v1, False),
        ("ω", found.omega, True),
        ("r₁₂", found.lever, None),
        ("ω × r₁₂", found.across, False),
        ("v₂ = v₁ + ω × r₁₂", found.v2, False),
    )
    lines = [line(*_three(vector, kind, units), name=name) for name, vector, kind in rows]
    along = float(found.across @ found.lever)
    return joined(
        tag("div.kit-head", tag("span.dim", "In the frame of"), chooser),
        tag("table.kit-points.ve-points", heads, typed),
        tag("table.ve-table.ve-three", head_line(None, "x", "y", "z", None), lines),
        tag("p.dim", f"World axes. (ω × r₁₂)·r₁₂ = {number(along, 3)} m²/s: perpendicular to the line. {OMEGA}"),
    )


def _coordinate(form: Form, part: Velocity, which: int, k: int, units: Units) -> Markup:
    x, y, z = part.points[which]

    def taken(text: str) -> SetLinkPoint:
        value = units.read(text, False, f"point {which + 1}, {'xyz'[k]}")
        return SetLinkPoint(which, ((value, y, z), (x, value, z), (x, y, value))[k])

    below = f"point {which + 1} {k}" if which == 0 else ""
    text, label = units.entry((x, y, z)[k], False), f"Point {which + 1}, {'xyz'[k]}"
    return form.field(f"point {which} {k}", text, label, taken, below)


def _three(vector: Floats, kind: bool | None, units: Units) -> list[Inside]:
    """Return three numbers and their unit: a length if kind is None, else an angular (True) or linear velocity."""
    unit = units.length_unit if kind is None else f"{units.unit(kind)}/s"
    return [*(_grey(units.text(float(value), bool(kind))) for value in vector), tag("i", unit)]


def higher_markup(state: State) -> Markup:
    """Return acceleration and jerk of the tool while the joint speeds stay constant."""
    units, found = units_of(state), state.derived(higher_of)
    named = ("ṙ = J q̇", found.twist), ("r̈ = J̇ q̇", found.acceleration), ("jerk = J̈ q̇", found.jerk)
    rows = [line(*_six(vector, units), name=name) for name, vector in named]
    return joined(
        tag("table.ve-table", head_line(None, *"xyzxyz"), rows),
        tag("p.dim", _bends(found, units)),
        tag("div.eq.small", mathml(FORMULA), title="⟦Notes 5.67-5.69⟧"),
        tag("p.dim", JERK),
    )


FORMULA = r"\ddot{r}=J\ddot{q}+\dot{J}\dot{q},\quad r^{(3)}=Jq^{(3)}+2\dot{J}\ddot{q}+\ddot{J}\dot{q}"


def _bends(found: ToolMotion, units: Units) -> str:
    """Return in words the acceleration along v and perpendicular to it."""
    v, a = found.twist[:3], found.acceleration[:3]
    units_text = f"Tool point in {units.length_unit}, turning in {units.angle_unit}, per s, s² and s³; q̈ = 0."
    speed = float(np.linalg.norm(v))
    if speed < 1e-9:
        return f"{units_text} The tool point is at rest, but only for an instant unless r̈ is also 0."
    along = float(a @ v) / speed
    across = float(np.linalg.norm(a - along * v / speed))
    return (
        f"{units_text} Of the acceleration of the point {units.text(along, False)} {units.length_unit}/s² are along v "
        f"and {units.text(across, False)} {units.length_unit}/s² across it."
    )


def _six(twist: Sequence[float] | Floats, units: Units) -> list[Inside]:
    """Return six numbers: three lengths and three angles."""
    return [_grey(units.text(float(value), k >= 3)) for k, value in enumerate(twist)]


def _grey(text: str) -> Inside:
    """Return a number, grey if it is shown as zero."""
    zero = not text.strip("0.")
    return tag("span.zero", "0") if zero else text


def matrix_words(state: State, moving: Moving) -> Inside:
    """Return a note on the columns of J, while nothing is selected in it."""
    arm = state[Joints].arm
    still = [
        str(j + 1)
        for j in range(arm.n)
        if float(np.linalg.norm(moving.J[:3, j])) < 1e-9 * arm.length_scale and arm.revolute[j]
    ]
    if not still:
        return "Select an entry, a row or a column to draw it as a vector in the scene."
    if len(still) == 1:
        axis = f"The tool point is on the axis of joint {still[0]}: J"
        return axis, tag("sub", f"L{still[0]}"), " = 0, and this joint does not move it."
    return f"The tool point is on the axes of joints {' and '.join(still)}: their linear halves are 0."
