"""The page of a table beside the arm: where the tool has to be above an object, and what that asks of the arm."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.frames.chain.ui.posed import length_row
from armlab.benches.frames.chain.ui.symbols import point_name, transform_name
from armlab.benches.frames.table.commands import (
    FollowObject,
    GoAboveObject,
    SetHeight,
    SetObject,
    SetTable,
    SpinTool,
    TurnTable,
)
from armlab.benches.frames.table.examples import EXAMPLES, ChooseTableExample
from armlab.benches.frames.table.reach import Asked, asked_of
from armlab.benches.frames.table.state import FARTHEST, HIGHEST, NONE, TableTask, Task, corner_of, task_of
from armlab.benches.frames.table.ui.scene import corners
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import unparted, verdict_box
from armlab.ui.matrices import MatrixView
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

HANDLED = {"table": "table {T}", "object": "object"}

NEAR, ALIGNED = 1e-3, math.radians(0.1)
"""Distance, metres, and angle, radians, up to which the tool is called there: what the numbers on screen tell."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the fields of table, object and tool, the equation, and the pose that is asked of the arm."""
    top = gui.form(post)
    view = MatrixView(gui, post)
    rest = gui.form(post)

    def show(state: State) -> None:
        found, asked = state.derived(task_of), state.derived(asked_of)
        top.show(
            examples(top, EXAMPLES, state[TableTask].example, ChooseTableExample),
            _table(top, state),
            _object(top, state),
            _equation(found, units_of(state)),
        )
        view.show(state, _title(), asked.T_be, 4, 3)
        rest.show(_actions(rest, state), _verdict(state, asked))

    return show


def _table(form: Form, state: State) -> Inside:
    part, units = state[TableTask], units_of(state)
    chips = [
        form.chip(
            f"handle {key}",
            title,
            Set(TableTask, "selected", NONE if part.selected == key else key),
            "",
            part.selected == key,
        )
        for key, title in HANDLED.items()
    ]

    def turned(text: str) -> Command:
        return TurnTable(units.read(text, True, "angle", within=(-MOST_TURNED, MOST_TURNED)))

    turn = form.field("turn", units.entry(part.turn, True), f"Angle of the table in {units.angle_unit}", turned)
    return (
        tag("h3", "The table {T} in the world ", tag("span.copies", tag("small", "handle at the "), chips)),
        length_row(form, "table", "x y z", corner_of(state), units, SetTable, FARTHEST),
        tag("div.kit-numbers", tag("label", unparted(f"turned about z, {units.angle_unit} "), turn)),
    )


def _object(form: Form, state: State) -> Inside:
    part, units = state[TableTask], units_of(state)

    def raised(text: str) -> Command:
        return SetHeight(units.read(text, False, "h", within=(0.0, HIGHEST)))

    def spun(text: str) -> Command:
        return SpinTool(units.read(text, True, "angle", within=(-MOST_TURNED, MOST_TURNED)))

    height = form.field("height", units.entry(part.height, False), f"Height h in {units.length_unit}", raised)
    spin = form.field(
        "spin", units.entry(part.spin, True), f"Angle of the tool about its z axis in {units.angle_unit}", spun
    )
    return (
        tag("h3", "The object P on the table, the tool {E} above it"),
        length_row(
            form,
            "object",
            ("p", tag("sub", "x"), " p", tag("sub", "y")),
            part.place,
            units,
            SetObject,
            FARTHEST,
            ("p x", "p y"),
        ),
        tag(
            "div.kit-numbers",
            tag("label", unparted(f"h, {units.length_unit} "), height),
            tag("label", unparted(f"about z of the tool, {units.angle_unit} "), spin),
        ),
    )


def _equation(found: Task, units: Units) -> Inside:
    """Return 3.120 in symbols and numbers."""
    sides = (
        (("", point_name("T")), found.p_t),
        (("− ", transform_name("T", "E", "R"), " ", point_name("E")), -(found.R_te @ found.p_e)),
    )
    rows = [
        tag("tr", tag("th", name), [tag("td", units.text(float(value), False)) for value in values])
        for name, values in sides
    ]
    result = tag(
        "tr.fr-sum",
        tag("th", "= ", tag("sup", "T"), "p", tag("sub", "TE")),
        [tag("td", units.text(float(value), False)) for value in found.p_te],
    )
    return (
        tag("h3", "Where the tool is on the table"),
        tag("table.kit-points.fr-change", rows, result),
        tag(
            "p.dim",
            "The tool points down: ",
            transform_name("T", "E", "R"),
            " turns by half a turn about x, and is its own inverse⟦ (3.119)⟧.",
        ),
    )


def _title() -> Inside:
    return (
        transform_name("B", "E"),
        " = ",
        transform_name("B", tag("s", "w")),
        " ",
        transform_name(tag("s", "w"), tag("s", "T")),
        " ",
        transform_name(tag("s", "T"), "E"),
        " ",
        tag("small", "asked of the arm"),
    )


def _actions(form: Form, state: State) -> Markup:
    part = state[TableTask]
    go = form.button("go", "Put the target there", GoAboveObject(), "main", "The arm goes above the object")
    follow = form.chip(
        "follow", "Follow", FollowObject(not part.follows), "The arm follows what is changed here", part.follows
    )
    return tag("div.bar", go, follow)


def _verdict(state: State, asked: Asked) -> Markup:
    units, task = units_of(state), state[Joints].arm.task
    told = f"It is {units.length(asked.away)} from there, and its orientation differs by {units.angle(asked.turned)}."
    partial_ = task.rotation != "full" or task.position != "xyz"
    free = tag("p", f"This arm controls {task.title} of its tool; the rest cannot be chosen.") if partial_ else None
    if asked.away < NEAR and asked.turned < ALIGNED:
        return verdict_box("ok", "The tool is above the object", tag("p", told), free)
    if asked.away < NEAR:
        return verdict_box("warn", "The tool is at the place, and turned otherwise", tag("p", told), free)
    return verdict_box("todo", "The tool is elsewhere", tag("p", told), free)


def around(state: State) -> Points:
    """Return the points that belong in the picture beside the arm: the table and the tool above it."""
    return np.vstack([corners(state), state.derived(task_of).T_we[:3, 3]])


PANEL = Panel(
    (TableTask, Joints, Target),
    build,
    around=around,
    looks=lambda state: state[TableTask].example,
)
