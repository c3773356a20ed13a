"""The numbers of velocities: the sum of what the joints give, two points of a link, acceleration and jerk."""

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
from armlab.ui.units import Units, units_of

Floats = NDArray[np.float64]

ROWS = tuple(f"{letter}<sub>{axis}</sub>" for letter in ("v", "ω") for axis in "xyz")

JERK = "Notes 5.69 prints J q̈ + 2 J̇ q̇ + J̈ q, one derivative short in each term: corrected. 5.71 lacks the dot of J̇."
OMEGA = (
    "All points of the link have this one ω. Notes 5.8 concludes it from two points; it takes a third one off their "
    "line."
)


def columns_of(state: State) -> tuple[str, ...]:
    """Return the heads of the columns of J."""
    arm, units = state[Joints].arm, units_of(state)
    return tuple(
        f'<b style="color:{css(joint_colour(i))}">{units.variable(i, bool(arm.revolute[i]))}</b>' for i in range(arm.n)
    )


def sum_markup(state: State) -> str:
    """Return what each joint gives to v and omega, and their sum."""
    arm, units, moving = state[Joints].arm, units_of(state), state.derived(moving_of)
    lines = [
        f"<tr><th>{dot(css(joint_colour(i)))}{dotted(arm, i, units)} {subscript('J', i + 1)}</th>"
        f"{_cells(moving.parts[:, i], units)}</tr>"
        for i in range(arm.n)
    ]
    total = f'<tr class="ve-sum"><th>Σ = J q̇</th>{_cells(moving.twist, units)}</tr>'
    heads = "".join(f"<th>{name}</th>" for name in ROWS)
    title = f"Parts and their sum <small>{units.length_unit}/s, {units.angle_unit}/s; world axes</small>"
    return f'<h3>{title}</h3><table class="ve-table"><tr><th></th>{heads}</tr>{"".join(lines)}{total}</table>'


def size_markup(state: State) -> str:
    """Return |v| and |omega|, what positions say, and the scale of the arrows."""
    part, units, moving = state[Velocity], units_of(state), state.derived(moving_of)
    v, turning = (float(np.linalg.norm(half)) for half in (moving.twist[:3], moving.twist[3:]))
    measured = float(np.linalg.norm(state.derived(measured_velocity)))
    scales = drawn_scales(state[Joints].arm, part.qdot)
    drawn = f"1 m/s is {trimmed(scales[0], 6)} m, 1 rad/s is {trimmed(scales[1], 6)} m"
    return (
        '<div class="ve-size">'
        f"<span>|v| <b>{units.text(v, False)} {units.length_unit}/s</b></span>"
        f"<span>|ω| <b>{units.text(turning, True)} {units.angle_unit}/s</b></span></div>"
        f'<p class="dim">From the positions 0.1 ms before and after: {units.text(measured, False)} '
        f"{units.length_unit}/s. Drawn: {drawn}.</p>"
    )


def points_markup(form: Form, state: State) -> str:
    """Return the two points of a link, to be typed, and their velocities."""
    part, arm, units = state[Velocity], state[Joints].arm, units_of(state)
    links = {str(i): f"link {i}" for i in range(1, arm.n + 1)}
    hint = "Link i moves with joints 1 to i"
    chooser = form.select("link", "Link", links, str(part.link), lambda key: LookAtLink(int(key)), hint)
    typed = "".join(
        f"<tr><th>point {which + 1}</th>{''.join(_coordinate(form, part, which, k, units) for k in range(3))}</tr>"
        for which in range(2)
    )
    heads = "".join(f"<th>{axis}, {units.length_unit}</th>" for axis in "xyz")
    found = state.derived(two_points_of)
    rows = (
        ("v₁", found.v1, False),
        ("ω", found.omega, True),
        ("r₁₂", found.lever, None),
        ("ω × r₁₂", found.across, False),
        ("v₂ = v₁ + ω × r₁₂", found.v2, False),
    )
    lines = "".join(f"<tr><th>{name}</th>{_three(vector, kind, units)}</tr>" for name, vector, kind in rows)
    along = float(found.across @ found.lever)
    return (
        f'<div class="kit-head"><span class="dim">In the frame of</span>{chooser}</div>'
        f'<table class="kit-points ve-points"><tr><th></th>{heads}</tr>{typed}</table>'
        f'<table class="ve-table ve-three"><tr><th></th><th>x</th><th>y</th><th>z</th><th></th></tr>{lines}</table>'
        f'<p class="dim">World axes. (ω × r₁₂)·r₁₂ = {number(along, 3)} m²/s: across the line. {OMEGA}</p>'
    )


def _coordinate(form: Form, part: Velocity, which: int, k: int, units: Units) -> str:
    x, y, z = part.points[which]

    def taken(text: str) -> SetLinkPoint:
        value = units.read(text, False, f"point {which + 1}, {'xyz'[k]}")
        return SetLinkPoint(which, ((value, y, z), (x, value, z), (x, y, value))[k])

    below = f"point {which + 1} {k}" if which == 0 else ""
    text, label = units.entry((x, y, z)[k], False), f"Point {which + 1}, {'xyz'[k]}"
    return f"<td>{form.field(f'point {which} {k}', text, label, taken, below)}</td>"


def _three(vector: Floats, kind: bool | None, units: Units) -> str:
    """Return three numbers and their unit; kind None is a length, else an angular (True) or linear velocity."""
    cells = "".join(f"<td>{_grey(units.text(float(value), bool(kind)))}</td>" for value in vector)
    unit = units.length_unit if kind is None else f"{units.unit(kind)}/s"
    return f"{cells}<td><i>{unit}</i></td>"


def higher_markup(state: State) -> str:
    """Return acceleration and jerk of the tool while the joint speeds stay what they are."""
    units, found = units_of(state), state.derived(higher_of)
    rows = "".join(
        f"<tr><th>{name}</th>{_cells(vector, units)}</tr>"
        for name, vector in (("ṙ = J q̇", found.twist), ("r̈ = J̇ q̇", found.acceleration), ("jerk = J̈ q̇", found.jerk))
    )
    heads = "".join(f"<th>{axis}</th>" for axis in "xyz" * 2)
    return (
        f'<table class="ve-table"><tr><th></th>{heads}</tr>{rows}</table>'
        f'<p class="dim">{_bends(found, units)}</p>'
        f'<div class="eq small" title="Notes 5.67-5.69">{mathml(FORMULA)}</div><p class="dim">{JERK}</p>'
    )


FORMULA = r"\ddot{r}=J\ddot{q}+\dot{J}\dot{q},\quad r^{(3)}=Jq^{(3)}+2\dot{J}\ddot{q}+\ddot{J}\dot{q}"


def _bends(found: ToolMotion, units: Units) -> str:
    """Return the acceleration along v and across it, in words."""
    v, a = found.twist[:3], found.acceleration[:3]
    units_text = f"Tool point in {units.length_unit}, turning in {units.angle_unit}, per s, s² and s³; q̈ = 0."
    speed = float(np.linalg.norm(v))
    if speed < 1e-9:
        return f"{units_text} The tool point stands still, but not for long unless r̈ is 0, too."
    along = float(a @ v) / speed
    across = float(np.linalg.norm(a - along * v / speed))
    return (
        f"{units_text} Of the acceleration of the point {units.text(along, False)} {units.length_unit}/s² are along v "
        f"and {units.text(across, False)} {units.length_unit}/s² across it."
    )


def _cells(twist: Sequence[float] | Floats, units: Units) -> str:
    """Return six numbers: three lengths and three angles."""
    return "".join(f"<td>{_grey(units.text(float(value), k >= 3))}</td>" for k, value in enumerate(twist))


def _grey(text: str) -> str:
    """Return a number, grey where it is zero on screen."""
    zero = not text.strip("0.")
    return '<span class="zero">0</span>' if zero else text


def matrix_words(state: State, moving: Moving) -> str:
    """Return what there is to know of the columns, while nothing is selected in J."""
    arm = state[Joints].arm
    still = [
        str(j + 1)
        for j in range(arm.n)
        if float(np.linalg.norm(moving.J[:3, j])) < 1e-9 * arm.length_scale and arm.revolute[j]
    ]
    if not still:
        return "Press an entry, a row or a column: it is drawn in the scene as the vector it is."
    if len(still) == 1:
        return f"The tool point is on the axis of joint {still[0]}: J<sub>L{still[0]}</sub> = 0, it does not move it."
    return f"The tool point is on the axes of joints {' and '.join(still)}: their linear halves are 0."
