"""The choice of an arm, by family, each with a line about it, and the table of the present one."""

from __future__ import annotations

from armlab.content.robots import FAMILIES, Robot, catalogue
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.state import Post, State
from armlab.ui.form import Form
from armlab.ui.format import pairs
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold
from armlab.ui.picks import broken_files, pick
from armlab.ui.plugin import Panel, Show
from armlab.ui.tables import dh_table
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

BOOKS = {"standard": "standard (Paul, Spong, Siciliano)", "modified": "modified (Craig)"}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the list of arms and the description of the present one."""
    present = state[RobotPart].robot
    shown = present.family

    def choose_family(family: str) -> None:
        nonlocal shown
        shown = family
        list_arms()

    gui.dropdown(
        "Family",
        {family: family[0].upper() + family[1:] for family in FAMILIES},
        shown,
        choose_family,
        "Arms grouped by structure; the list below shows one family.",
    )
    arms = gui.form(post)
    gui.html(_description(present, units_of(state)))

    def list_arms() -> None:
        robots = [robot for robot in catalogue().robots.values() if robot.family == shown]
        entries = [_entry(arms, robot, robot is present) for robot in robots]
        arms.show(entries, broken_files("robot", catalogue().problems))

    def show(state: State) -> None:
        # Another arm rebuilds the whole panel; nothing else is watched.
        del state
        list_arms()

    return show


def _entry(form: Form, robot: Robot, present: bool) -> Markup:
    kinds = "".join(row.kind for row in robot.arm.rows)
    return pick(form, robot.key, ChooseRobot(robot.key), robot.name, kinds, robot.summary, present)


def _description(robot: Robot, units: Units) -> Inside:
    arm = robot.arm
    rows = [
        ("convention", BOOKS[arm.convention]),
        ("task", arm.task.title),
        ("sum of all lengths", units.length(arm.reach)),
    ]
    table = tag("h3", "Denavit–Hartenberg table"), dh_table(arm, units)
    source = tag("h3", "Source"), tag("p.dim", robot.source)
    return fold(f"{robot.name}: table, task, source", pairs(rows), table, source, key="present arm")


PANEL = Panel((RobotPart,), build)
