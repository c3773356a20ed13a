"""The page of pick and place: boxes and goal, what the gripper does at each waypoint, and whether it takes a box."""

from __future__ import annotations

import itertools

import numpy as np

from armlab.benches.motion.pick.course import GRASP
from armlab.benches.motion.pick.state import (
    GOAL,
    AddBox,
    MoveBox,
    Pick,
    PickAndPlace,
    RemoveBox,
    SelectBox,
    name_of,
)
from armlab.benches.motion.pick.table import MOST_BOXES, edge_of
from armlab.benches.motion.pick.ui.words import told
from armlab.benches.motion.plan.state import CLIP_KEY, Plan, last_planned, planned_now
from armlab.benches.motion.plan.ui.around import HANDLE, way_around, while_on
from armlab.benches.motion.plan.ui.points import at_waypoint
from armlab.benches.motion.plan.words import judged
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.form import Form
from armlab.ui.format import capitalised
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.playing import play_button
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

CORNERS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
"""Corners of a space that a box takes in the picture, in edges."""

MOST_LINES = 5
"""Largest number of sentences on the boxes that are shown."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the verdict, the boxes, and the list of what is done at the waypoints."""
    blocks = tuple((gui.form(post), markup) for markup in (head_markup, boxes_markup, waypoints_markup))

    def show(state: State) -> None:
        for form, markup in blocks:
            form.show(markup(form, state))

    return show


def head_markup(form: Form, state: State) -> Markup:
    """Return the button that sets all up, that of the film, and the verdict."""
    runs, boxes = planned_now(state) or last_planned(state), bool(state[Pick].boxes)
    hint = "Boxes within reach of this arm, and four waypoints that bring one to the goal; undo restores the plan"
    setup = form.button("pick-place", "Set up pick and place", PickAndPlace(), "chip" if boxes else "main", hint)
    off = runs is None or runs.motion is None
    play = play_button(form, state, CLIP_KEY, "motion", kind="main" if boxes else "chip", off=off)
    buttons = (play, setup) if boxes else (setup, play)
    return joined(tag("div.bar", buttons), _verdict(state))


def _verdict(state: State) -> Markup:
    if not state[Pick].boxes:
        text = (
            "One press puts boxes on the table and four waypoints in the plan: above a box, at it, above the goal and "
            "at the goal. The gripper takes the box where it closes, and lets go of it where it opens."
        )
        return tag("p.kit-look", text)
    planned = planned_now(state)
    if planned is None:
        return verdict_box("dim", "… planning", sign="")
    said, run = told(state), judged(planned)
    stopped = (f"the plan {run.head}",) if run.kind == "no" else ()
    lines = [tag("p", f"{capitalised(line)}.") for line in (*stopped, *said.lines)[:MOST_LINES]]
    return verdict_box(said.kind, capitalised(said.head), lines)


def boxes_markup(form: Form, state: State) -> Markup | None:
    """Return the places of boxes and goal, to be typed or dragged."""
    part, units = state[Pick], units_of(state)
    if not part.boxes:
        return None
    add = form.button(
        "add-box", "+ Box", AddBox(), "chip", "One more box within reach", off=len(part.boxes) == MOST_BOXES
    )
    there = [*range(len(part.boxes)), *([GOAL] if part.goal is not None else [])]
    grasp = units.length(GRASP * edge_of(state[Joints].arm))
    says = f"The gripper takes the box whose middle is within {grasp} of the tool point."
    head = tag("tr", tag("th"), [tag("th", axis) for axis in "xyz"], tag("th", units.length_unit))
    table = tag("table.pk-boxes", head, [_box(form, state, which) for which in there])
    return joined(tag("h3", "Boxes", tag("span.copies", add)), table, tag("p.dim", says))


def _box(form: Form, state: State, which: int) -> Markup:
    """Return the row of a box or of the goal."""
    part, units, name = state[Pick], units_of(state), name_of(which)
    place = part.place(which)
    assert place is not None

    def cell(axis: int) -> Markup:
        title = f"{'xyz'[axis]} of {name}"

        def typed(text: str) -> MoveBox:
            return MoveBox(which, axis, units.read(text, False, title))

        return tag("td", form.field(f"box-{which} {axis}", units.text(place[axis], False), title, typed))

    held = part.selected == which
    drag = form.chip(f"drag-{which}", "Drag", SelectBox(None if held else which), f"Put a handle on {name}", held)
    gone = form.chip(f"remove-box-{which}", "✕", RemoveBox(which), f"Remove {name}") if which != GOAL else None
    return tag("tr", tag("th", capitalised(name)), [cell(axis) for axis in range(3)], tag("td", drag, gone))


def waypoints_markup(form: Form, state: State) -> Markup | None:
    """Return the list of waypoints with what is done at each."""
    part = state[Plan]
    if part.recorded is not None:
        return tag(
            "p.dim", "The motion was read from a file. It has no waypoints at which the gripper could open or close."
        )
    if not state[Pick].boxes:
        return None
    rows = [_waypoint(form, state, k) for k in range(len(part.waypoints))]
    return joined(tag("h3", "At each waypoint"), tag("div.mo-list", rows))


def _waypoint(form: Form, state: State, k: int) -> Inside:
    number = tag("b", str(k + 1))
    return tag("div.pk-row", number, tag("div.options.mo-doing", at_waypoint(form, k, state[Plan].waypoints[k])))


def around(state: State) -> Points:
    """Return the boxes, the goal, the waypoints and the path, (k, 3), world."""
    part, edge = state[Pick], edge_of(state[Joints].arm)
    places = [*part.boxes, *([part.goal] if part.goal is not None else [])]
    corners = np.array(places).reshape(-1, 1, 3) + edge * CORNERS
    return np.vstack([way_around(state), corners.reshape(-1, 3)])


def looks(state: State) -> bool:
    """Return whether there are boxes to look at."""
    return bool(state[Pick].boxes)


def hides(state: State) -> tuple[str, ...]:
    """Return the layers in the way: the arm's handle while a box has one, and while the motion plays."""
    return HANDLE if state[Pick].selected is not None else while_on(state)


PANEL = Panel((Pick, Plan, Timeline, Joints, Notation, RobotPart), build, hides_then=hides, around=around, looks=looks)
