"""The page of two robots: both bases and the joints of A to set, the pose that B has to reach, and its solutions."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.frames.chain.stage import box_of
from armlab.benches.frames.chain.ui.page import HIDES
from armlab.benches.frames.chain.ui.posed import angle_row
from armlab.benches.frames.chain.ui.symbols import transform_name
from armlab.benches.frames.two.examples import EXAMPLES, ChooseTwoExample
from armlab.benches.frames.two.reach import Meeting, meeting_of
from armlab.benches.frames.two.state import (
    FARTHEST,
    LINK_A,
    LONGEST,
    NONE,
    ROBOTS,
    SHORTEST,
    VERSIONS,
    SetJointOfA,
    SetRobotBase,
    TurnRobotBase,
    TwoRobots,
)
from armlab.benches.frames.two.ui.solutions import MORE, numbers_markup, solutions_markup, verdict
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples
from armlab.ui.eye import Facing
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import row, unparted
from armlab.ui.matrices import MatrixView
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

PRODUCT = (("B", "w"), ("w", "A"), ("A", "EA"), ("EA", "EB"))
"""Factors of the pose that B has to reach, by reference and frame (notes 3.133)."""

TITLE = transform_name("B", "EB"), " ", tag("small", "p in m")
"""Title of the pose of the tool of B in its base."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the fields of both robots, the pose that B has to reach, and the table of solutions."""
    top = gui.form(post)
    view = MatrixView(gui, post)
    rest = gui.form(post)

    def show(state: State) -> None:
        part, found = state[TwoRobots], state.derived(meeting_of)
        top.show(
            examples(top, EXAMPLES, part.example, ChooseTwoExample),
            _robot_a(top, state),
            _robot_b(top, state),
            _product(found, units_of(state)),
        )
        view.show(state, TITLE, found.T_b_eb, 4, 3)
        rest.show(verdict(state), solutions_markup(rest, state), numbers_markup(state))

    return show


def _robot_a(form: Form, state: State) -> Inside:
    part, units = state[TwoRobots], units_of(state)
    return (
        tag("h3", "Robot A ", tag("small", f"two links of {units.length(LINK_A)}")),
        _base(form, part, "A", units),
        angle_row(form, "joint", "joints q₁ q₂", part.q_a, units, SetJointOfA, ("q₁", "q₂")),
    )


def _robot_b(form: Form, state: State) -> Inside:
    part, units = state[TwoRobots], units_of(state)
    chips = form.chips(
        "version", VERSIONS, part.version, "What robot B is, and what is asked", partial(Set, TwoRobots, "version")
    )

    def link(text: str) -> Command:
        return Set(TwoRobots, "link", units.read(text, False, "l", within=(SHORTEST, LONGEST)))

    def between(text: str) -> Command:
        typed = units.read(text, True, "angle", within=(-MOST_TURNED, MOST_TURNED))
        return Set(TwoRobots, "between", typed)

    length = form.field("link", units.entry(part.link, False, MORE), "Length of the links of B", link)
    turn = form.field("between", units.entry(part.between, True), "Angle from the tool of A to that of B", between)
    fields = (
        tag("label", unparted(f"links, {units.length_unit} "), length),
        tag("label", unparted(f"EA to EB, {units.angle_unit} "), turn),
    )
    handle = [_handle(form, part, key) for key in ROBOTS]
    return (
        tag("h3", "Robot B ", tag("span.copies", tag("small", "handle at the base of "), handle)),
        tag("div.bar", chips),
        _base(form, part, "B", units),
        tag("div.kit-numbers", fields),
    )


def _handle(form: Form, part: TwoRobots, robot: str) -> Markup:
    on = part.selected == robot
    return form.chip(
        f"handle {robot}",
        robot,
        Set(TwoRobots, "selected", NONE if on else robot),
        f"Handle of the base of {ROBOTS[robot]}",
        on,
    )


def _base(form: Form, part: TwoRobots, robot: str, units: Units) -> Markup:
    (x, y), turn = (part.base_a, part.turn_a) if robot == "A" else (part.base_b, part.turn_b)

    def field(cell: str, name: str, value: float, turns: bool) -> Markup:
        def taken(text: str) -> Command:
            most = MOST_TURNED if turns else FARTHEST
            typed = units.read(text, turns, name, within=(-most, most))
            return TurnRobotBase(robot, typed) if turns else SetRobotBase(robot, "xy".index(name), typed)

        label = f"{name} of the base of {ROBOTS[robot]} in {units.unit(turns)}"
        return form.field(f"base {robot} {cell}", units.entry(value, turns), label, taken)

    cells = [field("0", "x", x, False), field("1", "y", y, False), field("turn", "angle", turn, True)]
    return row(f"base x y {units.length_unit}, {units.angle_unit}", cells, wide=True, cells=True)


def _product(found: Meeting, units: Units) -> Inside:
    last = len(PRODUCT) - 1
    factors = joined(
        [
            transform_name(tag("s", i) if k > 0 else i, tag("s", j) if k < last else j)
            for k, (i, j) in enumerate(PRODUCT)
        ],
        between=" ",
    )
    return (
        tag("h3", "What B has to reach, in its own base"),
        tag("div.eq.fr-product", transform_name("B", "EB"), " = ", factors),
        tag("p.dim", f"{units.length(found.distance)} away, turned by {units.orientation(found.angle)}"),
    )


def around(state: State) -> Points:
    """Return the corners (2, 3) of what belongs in the picture: both robots, and the place where they meet."""
    found, part = state.derived(meeting_of), state[TwoRobots]
    middle, corner = found.T_wb[:3, 3], 0.6 * found.reach * np.array([1.0, 1.0, 0.0])
    places = np.array(
        [
            found.T_wa[:3, 3],
            found.T_w_eb[:3, 3],
            middle - corner,
            middle + corner,
            np.zeros(3),
        ]
    )
    return box_of(places, 0.5 * part.link)


def faces(state: State) -> Facing:
    """Return the plane in which both robots move."""
    return Facing(np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0]), "two robots")


PANEL = Panel(
    (TwoRobots,),
    build,
    rebuilds=(Notation,),
    hides=HIDES,
    around=around,
    faces=faces,
    looks=lambda state: state[TwoRobots].example,
)
