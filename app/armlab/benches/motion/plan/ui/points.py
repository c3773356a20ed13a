"""The list of waypoints with the moves between them, and the values of the selected one."""

from __future__ import annotations

from functools import partial

from armlab.benches.motion.files.commands import BackToWaypoints, MakeWaypoints
from armlab.benches.motion.plan.moves import AT_WAYPOINT, Waypoint
from armlab.benches.motion.plan.paths import shortfall
from armlab.benches.motion.plan.points import (
    AddWaypoint,
    CopyWaypoint,
    GoToWaypoint,
    RemoveWaypoint,
    SelectWaypoint,
    SetAtWaypoint,
    SetWaypointJoint,
    SetWaypointPose,
    ShiftWaypoint,
    TakePresent,
)
from armlab.benches.motion.plan.question import Recorded
from armlab.benches.motion.plan.state import Plan
from armlab.benches.motion.plan.ui.move import industrial
from armlab.kin.transforms import inverse
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target
from armlab.session.state import State
from armlab.ui.form import Form
from armlab.ui.format import lowered
from armlab.ui.html import Markup, classes, joined, tag
from armlab.ui.option_form import option_form
from armlab.ui.pose_fields import frame_of_places, pose_form, reference_of
from armlab.ui.units import Units, units_of

MADE = 12
"""Number of waypoints that are made here from a motion of a file; the page Export has the choice."""

GRIPPER_SIGNS = {"open": "⟨ ⟩", "close": "⟩⟨"}
"""Small pictures of what the gripper does."""

SPACES = {"joint": "joint", "cartesian": "Cartesian"}


def points_markup(form: Form, state: State) -> Markup:
    """Return the list, and below it the values of the selected waypoint."""
    part = state[Plan]
    if part.recorded is not None:
        return _recorded_markup(form, part.recorded, len(part.waypoints))
    hint = "Add the current pose of the arm after the selected waypoint"
    add = form.button("add", "+ Current pose", AddWaypoint(), "chip", hint)
    rows = [_row(form, state, k) for k in range(len(part.waypoints))]
    where = frame_of_places(state[Joints].arm)
    title = f"Waypoints{f' {where}' if where else ''}, {units_of(state).length_unit}"
    return joined(tag("h3", title, tag("span.copies", add)), tag("div.mo-list", rows), _selected(form, state))


def _recorded_markup(form: Form, recorded: Recorded, waypoints: int) -> Markup:
    """Return the content of the list while a motion from a file replaces the waypoints."""
    kept = f"The {waypoints} waypoints are kept." if waypoints > 1 else ""
    back = form.chip(
        "back", "Back to the waypoints", BackToWaypoints(), "Remove this motion and plan with the waypoints again"
    )
    make = form.chip(
        "make",
        "Convert to waypoints",
        MakeWaypoints(MADE),
        f"Replace it by up to {MADE} waypoints, which can be edited",
    )
    return joined(
        tag("h3", "Motion from a file"),
        tag("p", f"{len(recorded.t)} samples in {recorded.t[-1] - recorded.t[0]:.2f} s. {kept}"),
        tag("div.bar", back, make),
    )


def _row(form: Form, state: State, k: int) -> Markup:
    """Return the line of a waypoint, below that of the move to it."""
    part, units = state[Plan], units_of(state)
    last, selected = k == len(part.waypoints) - 1, k == part.selected
    name = f"waypoint {k + 1}"
    tools = (
        form.chip(f"up-{k}", "↑", ShiftWaypoint(k, -1), f"Move {name} before the previous one", off=k == 0),
        form.chip(f"down-{k}", "↓", ShiftWaypoint(k, 1), f"Move {name} after the next one", off=last),
        form.chip(f"copy-{k}", "Copy", CopyWaypoint(k), f"Insert a copy of {name} after it"),
        form.chip(f"remove-{k}", "✕", RemoveWaypoint(k), f"Remove {name}", off=len(part.waypoints) == 1),
    )
    hint = f"Show {name}, and drag it in the scene"
    select = form.button(f"select-{k}", str(k + 1), SelectWaypoint(k), "mo-number", hint, pressed=selected)
    short = shortfall(state[Joints].arm, part.waypoints[k])
    bad = tag("b.no", "✕", title="The arm does not reach it") if short else None
    place = tag("span.mo-at", _place(state, k, units))
    row = tag(classes("div.mo-row", now=selected), select, place, bad, tools)
    return joined(_move_line(part, k) if k else None, row, does_markup(part.waypoints[k]))


def does_markup(point: Waypoint) -> Markup | None:
    """Return a line on what is done at a waypoint, or nothing if nothing is."""
    sign = GRIPPER_SIGNS.get(point.gripper)
    gripper = (tag("b", sign, aria_hidden="true"), f"gripper {point.gripper}s") if sign else None
    wait = f"{' · ' if sign else ''}waits {point.wait:g} s" if point.wait else None
    return tag("div.mo-move.mo-does", gripper, wait) if point.rests else None


def _place(state: State, k: int, units: Units) -> str:
    """Return the place of the tool at a waypoint, in one line, in the unit and the frame of the heading."""
    arm = state[Joints].arm
    place = (inverse(reference_of(arm)) @ state[Plan].waypoints[k].wanted(arm))[:3, 3]
    return ", ".join(units.text(float(value), False) for value in place)


def _move_line(part: Plan, k: int) -> Markup:
    stretch = next(each for each in part.parts if each.first < k <= each.last)
    move = stretch.move
    goes_on = "" if k - 1 == stretch.first else "… "
    stop = " · stop" if part.moves[k - 1].stop else ""
    named = industrial(move)
    name = f" · {named.name}" if named is not None else ""
    return tag("div.mo-move", f"↓ {goes_on}{SPACES[move.space]}: {lowered(move.kind.title)}{name}{stop}")


def _selected(form: Form, state: State) -> Markup:
    part, arm, units = state[Plan], state[Joints].arm, units_of(state)
    k = part.selected
    point = part.waypoints[k]
    cells = [_joint(form, k, i, value, bool(arm.revolute[i]), units) for i, value in enumerate(point.q)]
    handle, hint = SelectWaypoint(k, not part.handled), "Put the handle on this waypoint instead of on the arm"
    take = (
        form.button("go", "Go there", GoToWaypoint(k), "chip", "Move the arm to this waypoint"),
        form.button(
            "take", "Set to current pose", TakePresent(k), "chip", "Move this waypoint to the arm's current pose"
        ),
        form.chip("drag", "Drag it", handle, hint, part.handled),
    )
    short = shortfall(arm, point)
    return joined(
        tag("h3", f"Waypoint {k + 1}", tag("span.copies", take)),
        _turning(form, state) if part.handled else None,
        tag("div.kit-numbers", cells),
        pose_form(form, arm, point.wanted(arm), units, partial(SetWaypointPose, k), "pose "),
        tag("p.no", f"✕ {short}") if short else None,
        tag("div.options.mo-doing", at_waypoint(form, k, point)),
    )


def at_waypoint(form: Form, k: int, point: Waypoint) -> Markup:
    """Return the choice of what the gripper does at a waypoint, and the field of the wait there."""
    return option_form(form, f"at-{k} ", tuple(AT_WAYPOINT.values()), point.does, partial(SetAtWaypoint, k))


def _joint(form: Form, k: int, i: int, value: float, revolute: bool, units: Units) -> Markup:
    """Return the field of one joint of a waypoint."""

    def typed(text: str) -> SetWaypointJoint:
        return SetWaypointJoint(k, i, units.read(text, revolute, f"joint {i + 1} of waypoint {k + 1}"))

    name = units.variable(i, revolute)
    cell = form.field(f"q {i}", units.text(value, revolute), f"{name} of waypoint {k + 1}", typed)
    return tag("label", tag("span", name), cell, tag("i", units.unit(revolute)))


def _turning(form: Form, state: State) -> Markup | None:
    """Return the choice whether the handle moves or turns, if the arm controls both."""
    task, target = state[Joints].arm.task, state[Target]
    if task.rotation == "none" or not task.position:
        return None
    move = form.chip("handle-move", "Move", Set(Target, "handle", "move"), pressed=target.handle == "move")
    turn = form.chip("handle-turn", "Turn", Set(Target, "handle", "turn"), pressed=target.handle == "turn")
    return tag("div.bar", tag("span.dim", "Handle"), move, turn)
