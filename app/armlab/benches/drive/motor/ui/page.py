"""The page of the DC motor: its run, its block diagram and poles, its powers, and its state."""

from __future__ import annotations

from functools import partial

from armlab.benches.drive.motor.examples import EXAMPLES, ChooseMotorExample
from armlab.benches.drive.motor.facts import moment_of
from armlab.benches.drive.motor.state import CLIP_KEY, SHOWN, Motor
from armlab.benches.drive.motor.ui.blocks import diagram
from armlab.benches.drive.motor.ui.form import constants_markup, inputs_markup
from armlab.benches.drive.motor.ui.model import around_motors
from armlab.benches.drive.motor.ui.plots import Plots, Responses
from armlab.benches.drive.motor.ui.poles import functions_markup, poles_markup
from armlab.benches.drive.motor.ui.powers import powers_markup, units_markup
from armlab.benches.drive.motor.ui.twins import field_markup, state_markup
from armlab.benches.drive.power.ui.typed import typed
from armlab.benches.drive.quantities import prefixed, rpm
from armlab.benches.drive.torque.ui.page import HIDES
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold
from armlab.ui.playing import clock
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

WITHOUT_L = "Without inductance the model is of first order: the current follows the voltage at once."


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the constants, the inputs, the choice of what is shown, and that."""
    units = units_of(state)
    head, body = gui.form(post), gui.form(post)
    plots, responses = Plots(gui, units), Responses(gui)

    def show(state: State) -> None:
        part = state[Motor]
        if not head.shows(part):
            head.show(
                examples(head, EXAMPLES, part.example, ChooseMotorExample),
                constants_markup(head, part),
                tag("p.dim", WITHOUT_L) if part.motor.reduced else None,
                inputs_markup(head, part),
                _views(head, part),
            )
        body.show(_clock(body, state), _markup(body, state, units))
        plots.show(state)
        responses.show(state)

    return show


def _views(form: Form, part: Motor) -> Markup:
    chips = form.chips("shown", SHOWN, part.shown, "What is shown", partial(Set, Motor, "shown"))
    return tag("div.cases.mo-views", chips)


def _clock(form: Form, state: State) -> Markup:
    part = state[Motor]
    return tag("div.mo-clock", clock(form, state, CLIP_KEY, part.end, part.end), typed(form, part, "end"))


def _markup(form: Form, state: State, units: Units) -> Inside:
    part, now = state[Motor], moment_of(state)
    if part.shown == "blocks":
        return diagram(part.motor, now, units), functions_markup(part)
    if part.shown == "poles":
        return poles_markup(part)
    if part.shown == "power":
        return powers_markup(state), fold("k in other units", units_markup(state))
    if part.shown == "state":
        return field_markup(form, part), state_markup(state)
    values = (
        ("i", prefixed(now.i, "A")),
        ("ω", f"{prefixed(now.omega, 'rad/s')} = {rpm(now.omega)}"),
        ("θ", units.angle(now.theta)),
    )
    current, speed = part.motor.steady(now.v, now.load)
    return (
        tag("p.mo-now", [tag("span", tag("i", name), f" = {value}") for name, value in values]),
        tag(
            "p.dim",
            f"With {prefixed(now.v, 'V')} and {prefixed(now.load, 'N m')} it ends at "
            f"{prefixed(float(current), 'A')} and {prefixed(float(speed), 'rad/s')}.",
        ),
    )


PANEL = Panel(
    (Motor, Timeline),
    build,
    rebuilds=(Notation,),
    hides=HIDES,
    around=around_motors,
    looks=lambda state: state[Motor].shown == "state",
)
