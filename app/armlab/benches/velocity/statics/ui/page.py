"""The page of statics: a wrench at the tool, the torques of the joints, virtual work, and forces without torque."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.velocity.statics.examples import EXAMPLES, ChooseExample
from armlab.benches.velocity.statics.state import (
    AXES,
    ReleaseWrench,
    SetComponent,
    Statics,
    WriteAlong,
)
from armlab.benches.velocity.statics.ui.words import (
    duality_markup,
    free_markup,
    torques_markup,
    verdict_markup,
    work_markup,
)
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import mathml, readable
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import row
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.units import plain_number
from armlab.ui.widgets import Gui

AXES_TITLES: dict[str, str] = dict(zip(AXES, ("World", "Tool"), strict=True))
SHOWN = 0.36
"""Length of an arrow drawn in full with its handle, in reaches of the arm, that must be inside the picture."""

PARTS = (("F", "force", "N"), ("M", "moment", "N m"))


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the fields of the wrench, the torques, and the results below them."""
    head = gui.form(post)
    card, torques, free = gui.html(), gui.html(), gui.html()
    work, duality = gui.form(post), gui.html()

    def show(state: State) -> None:
        head.show(head_markup(head, state[Statics]))
        card.show(verdict_markup(state))
        torques.show(torques_markup(state))
        free.show(free_markup(state))
        work.show(work_markup(work, state))
        duality.show(duality_markup(state))

    return show


def head_markup(form: Form, part: Statics) -> Markup:
    """Return the choices of an example and of the axes, and the fields of the wrench."""
    chooser = examples(form, EXAMPLES, part.example, ChooseExample)
    hint = "Along which axes the wrench is written; the wrench itself stays"
    axes = [form.chip(key, title, WriteAlong(key), hint, key == part.axes) for key, title in AXES_TITLES.items()]
    release = form.button("release", "No wrench", ReleaseWrench(), "chip", "Force and moment zero")
    return joined(
        chooser,
        tag("h3", "Wrench at the tool ", tag("small", "by the robot on the environment")),
        row("Axes", (axes, release)),
        [_line(form, part, *each) for each in PARTS],
        tag("p.dim", "Drag the tip of the force in the scene, or type."),
    )


def _line(form: Form, part: Statics, letter: str, kind: str, unit: str) -> Markup:
    """Return the three components of force or moment."""
    values = part.force if kind == "force" else part.moment
    cells = [
        form.field(
            f"{kind} {axis}",
            readable(value, 3),
            f"{kind.capitalize()} along {'xyz'[axis]} in {unit}",
            partial(_component, kind, axis, unit),
        )
        for axis, value in enumerate(values)
    ]
    return tag("div.st-wrench", tag("span", mathml(letter), f", {unit}"), cells)


def _component(kind: str, axis: int, unit: str, text: str) -> SetComponent:
    """Return the command of a typed component; `InputError` names the field."""
    typed = text.strip().removesuffix(unit)
    if kind == "moment":
        typed = typed.removesuffix("Nm")
    return SetComponent(kind, axis, plain_number(typed, f"{kind}, {'xyz'[axis]}", f"a number in {unit}"))


def _around(state: State) -> Points:
    """Return the approximate ends of the arrows of force and moment."""
    part, joints = state[Statics], state[Joints]
    tool = np.asarray(joints.tool_pose)
    wrench, reach = part.wrench(tool), SHOWN * 2.0 * joints.arm.length_scale
    ends = ((wrench[:3], part.full_force), (wrench[3:], part.full_moment))
    return np.array([tool[:3, 3] + reach / full * vector for vector, full in ends if full > 0.0]).reshape(-1, 3)


PANEL = Panel((Joints, Statics), build, around=_around, rebuilds=(RobotPart, Notation))
