"""The state of the motor: two motors run, and two vectors are compared."""

from __future__ import annotations

from armlab.benches.drive.motor.facts import moment_of
from armlab.benches.drive.motor.state import Motor, present_time
from armlab.benches.drive.motor.twins import twins_of
from armlab.benches.drive.power.ui.typed import typed
from armlab.session.amounts import amount
from armlab.session.state import State
from armlab.ui.form import Form
from armlab.ui.format import mathml, scientific
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.tables import head_line, line
from armlab.ui.units import units_of

SYSTEM = (
    r"\dot x=\begin{bmatrix}-R_a/L_a&-k/L_a&0\\k/I_m&-F_m/I_m&0\\0&1&0\end{bmatrix}x",
    r"{}+\begin{bmatrix}1/L_a&0\\0&-1/I_m\\0&0\end{bmatrix}\begin{bmatrix}v_a\\\tau_{load}\end{bmatrix}",
)
"""The equation in two lines."""

PRINTED, RIGHT = r"(\dot i_a,\ddot\theta,\dot\theta)", r"(i_a,\omega,\theta)"

SMALL = 1e-3
"""Residual, relative to that of the other vector, that is a difference quotient's own."""


def field_markup(form: Form, part: Motor) -> Markup:
    """Return the field of the angle by which the second motor is turned on."""
    return tag("div.options", tag("span.dim", "Second motor, turned on by"), typed(form, part, "twin"))


def state_markup(state: State) -> Inside:
    """Return both motors now, the comparison of the vectors, and what a state has to be."""
    part, units = state[Motor], units_of(state)
    one, other = moment_of(state), part.second.at(present_time(state))
    rows = [
        line(amount(each.i), amount(each.omega), units.angle(each.theta), name=name)
        for name, each in (("first", one), ("second", other))
    ]
    return (
        tag("div.eq.small.mo-system", mathml(SYSTEM[0]), tag("br"), mathml(SYSTEM[1])),
        tag("table.kit-points", head_line("motor", "i, A", "ω, rad/s", "θ"), rows),
        _compared(state),
        _verdict(state),
    )


def _compared(state: State) -> Markup:
    found = state.derived(twins_of)
    rows = [
        line(amount(found.printed), scientific(found.printed_rest), name=mathml(PRINTED)),
        line(amount(found.right), scientific(found.right_rest), name=mathml(RIGHT)),
    ]
    head = head_line("x, in SI", "largest difference", "largest |ẋ − A x − B u|")
    return tag("table.kit-points.mo-twins", head, rows)


def _verdict(state: State) -> Markup:
    found, units = state.derived(twins_of), units_of(state)
    if found.position == 0.0:
        return verdict_box("warn", "Both motors are one", tag("p", "Type an angle by which the second is turned on."))
    return verdict_box(
        "ok",
        "The state is (i, ω, θ)",
        tag(
            "p",
            f"The motors are {units.angle(found.position)} apart, and the vector of derivatives is the same for both: "
            "who knows it does not know where the rotor is. It also leaves B u over in dx/dt = A x + B u.⟦ 2.12 prints "
            "it as the state; it is dx/dt.⟧",
        ),
    )
