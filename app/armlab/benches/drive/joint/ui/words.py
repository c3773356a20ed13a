"""The page of joint drives in words: the worst case, what each joint causes, both ways to it, and the motors."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.drive.joint.errors import ToolErrors, compared, errors_of, magnified
from armlab.benches.drive.joint.state import Drives
from armlab.benches.drive.joint.ui.table import NOTHING, small, times
from armlab.benches.drive.quantities import prefixed, rpm
from armlab.benches.velocity.api import balance, speeds_of
from armlab.kin.arm import Arm
from armlab.session.state import State
from armlab.ui.colours import css, joint_colour
from armlab.ui.format import dot, mathml, number
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold, verdict_box
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units

ALIKE = 1e-9
"""Relative difference of the contributions of joints that are alike."""


def worst_markup(state: State, units: Units) -> Markup:
    """Return the worst case of position and of orientation, and the joint that contributes most."""
    found, arm = state.derived(errors_of), state[Drives].arm
    position, turned = found.position, found.orientation
    head = f"The tool is known within {small(units, position.size, False)} and {small(units, turned.size, True)}"
    return verdict_box("ok", head, tag("p", _where(found, arm)), _most(found, arm, units), sign="±")


def _joints(numbers: list[str]) -> str:
    return f"joint{'s' if len(numbers) > 1 else ''} {', '.join(numbers)}"


def _err(numbers: list[str]) -> str:
    return f"{_joints(numbers)} err{'' if len(numbers) > 1 else 's'}"


def _where(found: ToolErrors, arm: Arm) -> str:
    if found.position.size <= NOTHING:
        return "No joint moves the tool point here: its position is known exactly."
    towards = ", ".join(number(float(each) / found.position.size, 2) for each in found.position.vector)
    moving = found.position_shares > NOTHING
    one = [str(i + 1) for i in range(arm.n) if moving[i] and found.position.signs[i] > 0]
    other = [str(i + 1) for i in range(arm.n) if moving[i] and found.position.signs[i] < 0]
    if not one or not other:
        every = "all joints err" if moving.all() and arm.n > 1 else _err(one or other)
        sides = f"{every} in one sense"
    else:
        sides = f"{_err(one)} in one sense and {_joints(other)} in the other"
    return f"The position is off most along ({towards}) or the opposite direction, when {sides}."


def _most(found: ToolErrors, arm: Arm, units: Units) -> Markup | None:
    """Return which joint contributes most by itself, to the position and to the orientation."""
    if arm.n == 1 or found.position_shares.max() <= NOTHING:
        return None
    position = _leader(found.position_shares, "position", units, False)
    return tag("p", position, _leader(found.orientation_shares, "orientation", units, True))


def _leader(shares: NDArray[np.float64], what: str, units: Units, revolute: bool) -> str:
    most = float(shares.max())
    leaders = np.flatnonzero(shares >= most * (1.0 - ALIKE))
    if most <= NOTHING:
        return ""
    if len(leaders) > 1:
        return f"{len(leaders)} joints contribute most to the {what}, {small(units, most, revolute)} each. "
    return f"Joint {leaders[0] + 1} contributes most to the {what}, {small(units, most, revolute)}. "


def shares_markup(state: State, units: Units) -> Inside:
    """Return what each joint causes by itself, with bars relative to the largest error of the position."""
    found, arm = state.derived(errors_of), state[Drives].arm
    most = max(float(found.position_shares.max()), NOTHING)
    rows = []
    for i in range(arm.n):
        wide, colour = 100.0 * float(found.position_shares[i]) / most, css(joint_colour(i))
        rows.append(
            (
                tag("span", dot(colour), units.variable(i, bool(arm.revolute[i]))),
                tag("u", style=f"--width:{wide:.1f}%;--c:{colour}"),
                tag("b", small(units, float(found.position_shares[i]), False)),
                tag("b", small(units, float(found.orientation_shares[i]), True)),
            )
        )
    title = tag("h3", "Each joint by itself ", tag("small", mathml(r"|J_i|\,\Delta q_i")))
    return title, tag("div.jd-bars", rows)


def compared_markup(state: State, units: Units) -> Markup:
    """Return the worst case by J beside what forward kinematics finds."""
    found, both, n = state.derived(errors_of), state.derived(compared), state[Drives].arm.n
    rows = [
        line(
            small(units, found.position.size, False), small(units, found.orientation.size, True), name="by J: exactly"
        ),
        line(
            small(units, both.largest_position, False),
            small(units, both.largest_orientation, True),
            name="by forward kinematics: at least",
        ),
        line(
            small(units, both.position_apart, False),
            small(units, both.orientation_apart, True),
            name="largest difference of a point",
        ),
    ]
    factor = magnified(state[Drives])
    drawn = f" Drawn {times(factor)} times as large at the tool." if factor else ""
    corners = f"2{str(n).translate(str.maketrans('0123456789', '⁰¹²³⁴⁵⁶⁷⁸⁹'))} = {both.corners} corners"
    return fold(
        "By J and by forward kinematics",
        tag("table.kit-points.jd-both", head_line(None, "position", "orientation"), rows),
        tag(
            "p.dim",
            f"All {corners} of the box of joint errors, and {both.inside} points inside it. To first order the largest "
            f"error is at a corner, since a length is convex. The difference is of second order.{drawn}",
        ),
        box_markup(units),
    )


def motors_markup(state: State, units: Units) -> Markup:
    """Return speeds and torques of the motors at the present joint speeds and wrench."""
    part = state[Drives]
    speeds = part.drives.motor_speeds(state.derived(speeds_of)).tolist()
    torques = part.drives.motor_torques(state.derived(balance).torques).tolist()
    rows = [
        line(
            rpm(speeds[i]),
            prefixed(torques[i], "N m"),
            prefixed(speeds[i] * torques[i], "W"),
            name=tag("span", dot(css(joint_colour(i))), f"motor {i + 1}"),
        )
        for i in range(part.arm.n)
    ]
    return fold(
        ("Motors ", tag("small", mathml(r"\dot\theta_m=n\,\dot q,\quad\tau_m=\tau/n"))),
        tag("table.kit-points.jd-both", head_line(None, "speed", "torque", "power"), rows),
        tag(
            "p.dim",
            "For the joint speeds of the page Jacobian and the wrench of the page Statics, without losses and without "
            "the masses of the arm. A screw with lead p turns 1/p times a metre.",
        ),
        key="motors",
    )


def box_markup(units: Units) -> Inside:
    """Return what a joint may be off by."""
    turn = "360°" if units.in_degrees else "2π"
    said = (
        f"A joint that turns is within {turn}/(n N) with the encoder at the motor, within {turn}/N at the joint.",
        "A joint that slides is within p/(n N) with the encoder at the motor, within p/N at the joint.",
        "At the motor half the backlash is added, which the encoder does not see.",
    )
    return [tag("p.dim", each) for each in said]
