"""The page of joint drives: gear and encoder of each joint, and the error that they leave at the tool."""

from __future__ import annotations

import numpy as np

from armlab.benches.drive.joint.errors import errors_of, magnified
from armlab.benches.drive.joint.examples import EXAMPLES, ChooseDriveExample
from armlab.benches.drive.joint.state import Drives
from armlab.benches.drive.joint.ui.table import table_markup
from armlab.benches.drive.joint.ui.words import (
    compared_markup,
    motors_markup,
    shares_markup,
    worst_markup,
)
from armlab.benches.velocity.api import Statics, Velocity
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.html import tag
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the table of drives, and what comes of it."""
    form, numbers = gui.form(post), gui.html()
    units = units_of(state)

    def show(state: State) -> None:
        part = state[Drives]
        if not form.shows(part):
            points = form.chip(
                "points", "Points", Set(Drives, "points", not part.points), "Points in the scene", part.points
            )
            form.show(
                examples(form, EXAMPLES, part.example, ChooseDriveExample, said=units.said),
                table_markup(form, part, units),
                tag("div.bar", points),
            )
        numbers.show(
            worst_markup(state, units),
            shares_markup(state, units),
            compared_markup(state, units),
            motors_markup(state, units),
        )

    return show


def _around(state: State) -> Points:
    """Return the ends of what is drawn at the tool."""
    part, joints = state[Drives], state[Joints]
    tool = np.asarray(joints.arm.position(joints.q), dtype=np.float64)
    reach = magnified(part) * np.abs(state.derived(errors_of).generators).sum(axis=1)
    return np.array([tool - reach, tool + reach])


PANEL = Panel(
    (Drives, Joints, Velocity, Statics),
    build,
    rebuilds=(RobotPart, Notation),
    around=_around,
    looks=lambda state: magnified(state[Drives]),
)
