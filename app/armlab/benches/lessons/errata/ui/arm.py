"""The erratum on the arm on the table, in words: what is drawn, by how much both differ, or why there is nothing."""

from __future__ import annotations

from armlab.benches.lessons.errata.on_arm import Drawn, Unfit, on_arm
from armlab.benches.lessons.errata.state import Errata
from armlab.content.robots import catalogue
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.state import State
from armlab.ui.form import Form
from armlab.ui.format import number
from armlab.ui.html import Inside, tag
from armlab.ui.markup import verdict_box
from armlab.ui.units import units_of


def drawn_on(state: State) -> Drawn | Unfit | None:
    """Return what is drawn of the chosen erratum in a state."""
    part, joints = state[Errata], state[Joints]
    return on_arm(part.chosen, joints.arm, joints.q) if part.view == "look" else None


def on_this_arm(form: Form, state: State) -> Inside:
    """Return the words on the present arm; nothing for an erratum that is no matter of an arm."""
    found, name = state.derived(drawn_on), state[RobotPart].robot.name
    if found is None:
        return None
    head = f"On the {name}"
    if isinstance(found, Unfit):
        take = None
        if found.robot:
            other = catalogue()[found.robot].name
            take = form.chip("take", f"Take the {other}", ChooseRobot(found.robot))
        return verdict_box("warn", head, tag("p", found.why), take)
    if not found.seen:
        return verdict_box("warn", head, tag("p", found.unseen))
    return verdict_box("no", f"{head}: {_away(found, state)} off", tag("p", found.says))


def _away(found: Drawn, state: State) -> str:
    """Return the difference in the person's units."""
    units, per = units_of(state), "/s" if found.unit.endswith("/s") else ""
    if found.unit.startswith("rad"):
        return f"{units.text(found.away, True)}{'' if units.in_degrees else ' '}{units.angle_unit}{per}"
    value = found.away * (1000.0 if units.length_unit == "mm" else 1.0)
    return f"{number(value, 0 if units.length_unit == 'mm' else 3)} {units.length_unit}{per}"
