"""Statics: a wrench at the tool, the torques of the joints, virtual work, and what needs no torque."""

from __future__ import annotations

import numpy as np

from armlab.benches.velocity.statics.examples import EXAMPLES, ChooseExample
from armlab.benches.velocity.statics.state import (
    AXES,
    DrawDisplacement,
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
from armlab.content.arithmetic import evaluate
from armlab.errors import InputError
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples_markup
from armlab.ui.fields import Fields
from armlab.ui.format import mathml, readable
from armlab.ui.markup import button, chips, row
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.tried import tried
from armlab.ui.widgets import Gui

AXES_TITLES: dict[str, str] = dict(zip(AXES, ("World", "Tool"), strict=True))
SHOWN = 0.36
"""Length in reaches of the arm that belongs in the picture for what is drawn in full: an arrow with its handle."""

PARTS = (("F", "force", "N"), ("M", "moment", "N m"))


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the fields of the wrench, the torques, and what follows."""
    present = state

    def typed(fields: Fields, cell: str, text: str) -> None:
        if not tried(fields, cell, text, lambda: commands(cell, text), present, post):
            show(present)

    head = gui.fields(lambda cell, text: typed(head, cell, text))
    card, torques = gui.html(), gui.html()
    free = gui.html()
    work = gui.fields(lambda cell, text: typed(work, cell, text))
    duality = gui.html()

    def show(state: State) -> None:
        nonlocal present
        present = state
        head.show(_head(head, state[Statics]))
        card.show(verdict_markup(state))
        torques.show(torques_markup(state))
        free.show(free_markup(state))
        work.show(work_markup(work, state))
        duality.show(duality_markup(state))

    return show


def _head(fields: Fields, part: Statics) -> str:
    """Return the choice of an example, of the axes, and the fields of the wrench."""
    channel = fields.channel_id
    examples = examples_markup(channel, EXAMPLES, part.example)
    axes = chips(channel, AXES_TITLES, part.axes, "Along which axes the wrench is written; the wrench itself stays")
    lines = "".join(_line(fields, part, *each) for each in PARTS)
    release = button(channel, "release", "No wrench", "chip", "Force and moment zero")
    drawn = "Drag the tip of the force in the scene, or type."
    return (
        f"{examples}<h3>Wrench at the tool <small>by the robot on the environment</small></h3>"
        f"{row('Axes', axes + release)}{lines}"
        f'<p class="dim">{drawn}</p>'
    )


def _line(fields: Fields, part: Statics, letter: str, kind: str, unit: str) -> str:
    """Return the three components of force or moment."""
    values = part.force if kind == "force" else part.moment
    cells = "".join(
        fields.field(f"{kind} {axis}", readable(value, 3), f"{kind.capitalize()} along {'xyz'[axis]} in {unit}")
        for axis, value in enumerate(values)
    )
    return f'<div class="st-wrench"><span>{mathml(letter)}, {unit}</span>{cells}</div>'


def commands(cell: str, text: str) -> tuple[Command, ...]:
    """Return what a person asked for; none for what no page of ours sends.

    Raises
    ------
    InputError
        Not a number; the text names the field.
    """
    if cell == "example":
        return (ChooseExample(text),) if text else ()
    if cell == "release":
        return (ReleaseWrench(),)
    if cell == "displacement":
        return (DrawDisplacement(),)
    if cell in AXES:
        return (WriteAlong(cell),)
    kind, _, axis = cell.partition(" ")
    if kind not in ("force", "moment") or axis not in ("0", "1", "2"):
        return ()
    unit = "N" if kind == "force" else "N m"
    plain = text.strip().replace("−", "-").replace(",", ".").removesuffix(unit).replace("Nm", "").strip()
    try:
        value = evaluate(plain)
    except InputError:
        raise InputError(
            f"{kind}, {'xyz'[int(axis)]}: expected a number in {unit}, got {text.strip()[:40]!r}"
        ) from None
    return (SetComponent(kind, int(axis), value),)


def _around(state: State) -> Points:
    """Return the ends of the arrows of force and moment, about."""
    part, joints = state[Statics], state[Joints]
    tool = np.asarray(joints.tool_pose)
    wrench, reach = part.wrench(tool), SHOWN * 2.0 * joints.arm.length_scale
    ends = ((wrench[:3], part.full_force), (wrench[3:], part.full_moment))
    return np.array([tool[:3, 3] + reach / full * vector for vector, full in ends if full > 0.0]).reshape(-1, 3)


PANEL = Panel((Joints, Statics), build, around=_around, rebuilds=(RobotPart, Notation))
