"""The list of waypoints with the moves between them, and the values of the selected one."""

from __future__ import annotations

from functools import partial

from armlab.benches.motion.files.commands import BackToWaypoints, MakeWaypoints
from armlab.benches.motion.plan.moves import Stretch
from armlab.benches.motion.plan.paths import shortfall
from armlab.benches.motion.plan.points import (
    AddWaypoint,
    GoToWaypoint,
    RemoveWaypoint,
    SelectWaypoint,
    SetWaypointJoint,
    SetWaypointPose,
    ShiftWaypoint,
    TakePresent,
)
from armlab.benches.motion.plan.question import Recorded
from armlab.benches.motion.plan.state import Plan
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target
from armlab.session.state import State
from armlab.ui.form import Form
from armlab.ui.format import escaped
from armlab.ui.pose_fields import pose_form
from armlab.ui.units import Units, units_of

MADE = 12
"""Waypoints that are made of a motion from a file here; the page Files has the choice."""

SPACES = {"joint": "joint", "cartesian": "Cartesian"}


def points_markup(form: Form, state: State) -> str:
    """Return the list, and below it the values of the selected waypoint."""
    part = state[Plan]
    if part.recorded is not None:
        return _recorded_markup(form, part.recorded, len(part.waypoints))
    hint = "Add where the arm stands, behind the selected waypoint"
    add = form.button("add", "+ Present pose", AddWaypoint(), "chip", hint)
    head = f'<h3>Waypoints<span class="copies">{add}</span></h3>'
    parts = part.parts
    rows = "".join(_row(form, state, parts, k) for k in range(len(part.waypoints)))
    return f'{head}<div class="mo-list">{rows}</div>{_selected(form, state)}'


def _recorded_markup(form: Form, recorded: Recorded, waypoints: int) -> str:
    """Return what stands there while a motion from a file is in place of the waypoints."""
    kept = f"The {waypoints} waypoints wait behind it." if waypoints > 1 else ""
    back = form.chip("back", "Back to the waypoints", BackToWaypoints(), "Take the motion from the file off")
    make = form.chip("make", "Make waypoints of it", MakeWaypoints(MADE), f"Up to {MADE} places of its way, to edit")
    return (
        f"<h3>Motion from a file</h3><p>{len(recorded.t)} samples in {recorded.t[-1] - recorded.t[0]:.2f} s. {kept}</p>"
        f'<div class="bar">{back}{make}</div>'
    )


def _row(form: Form, state: State, parts: tuple[Stretch, ...], k: int) -> str:
    part, units = state[Plan], units_of(state)
    last, selected = k == len(part.waypoints) - 1, k == part.selected
    name = f"waypoint {k + 1}"
    tools = (
        form.chip(f"up-{k}", "↑", ShiftWaypoint(k, -1), f"Exchange {name} with the one before", off=k == 0)
        + form.chip(f"down-{k}", "↓", ShiftWaypoint(k, 1), f"Exchange {name} with the next", off=last)
        + form.chip(f"remove-{k}", "✕", RemoveWaypoint(k), f"Remove {name}", off=len(part.waypoints) == 1)
    )
    hint = f"Show {name}, and drag it in the scene"
    select = form.button(f"select-{k}", str(k + 1), SelectWaypoint(k), "mo-number", hint, pressed=selected)
    now = " now" if selected else ""
    bad = (
        '<b class="no" title="The arm does not reach it">✕</b>'
        if shortfall(state[Joints].arm, part.waypoints[k])
        else ""
    )
    return (
        _move_line(part, parts, k) if k else ""
    ) + f'<div class="mo-row{now}">{select}<span class="mo-at">{_place(state, k, units)}</span>{bad}{tools}</div>'


def _place(state: State, k: int, units: Units) -> str:
    """Return where the tool is at a waypoint, in one line."""
    place = state[Plan].waypoints[k].wanted(state[Joints].arm)[:3, 3]
    return ", ".join(units.text(float(value), False) for value in place) + f" {units.length_unit}"


def _move_line(part: Plan, parts: tuple[Stretch, ...], k: int) -> str:
    stretch = next(each for each in parts if each.first < k <= each.last)
    move = stretch.move
    goes_on = "" if k - 1 == stretch.first else "… "
    stop = " · stop" if part.moves[k - 1].stop else ""
    title = escaped(move.kind.title[:1].lower() + move.kind.title[1:])
    return f'<div class="mo-move">↓ {goes_on}{SPACES[move.space]}: {title}{stop}</div>'


def _selected(form: Form, state: State) -> str:
    part, arm, units = state[Plan], state[Joints].arm, units_of(state)
    k = part.selected
    point = part.waypoints[k]
    cells = "".join(_joint(form, k, i, value, bool(arm.revolute[i]), units) for i, value in enumerate(point.q))
    handle, hint = SelectWaypoint(k, not part.handled), "A handle at this waypoint instead of at the arm"
    take = (
        form.button("go", "Go there", GoToWaypoint(k), "chip", "Move the arm to this waypoint")
        + form.button("take", "Take present", TakePresent(k), "chip", "Put this waypoint where the arm stands")
        + form.chip("drag", "Drag it", handle, hint, part.handled)
    )
    turn = _turning(form, state) if part.handled else ""
    joints = f'<div class="kit-numbers">{cells}</div>'
    pose = pose_form(form, arm, point.wanted(arm), units, partial(SetWaypointPose, k), "pose ")
    short = _shortfall(state)
    return f'<h3>Waypoint {k + 1}<span class="copies">{take}</span></h3>{turn}{joints}{pose}{short}'


def _joint(form: Form, k: int, i: int, value: float, revolute: bool, units: Units) -> str:
    """Return the field of one joint of a waypoint."""

    def typed(text: str) -> SetWaypointJoint:
        return SetWaypointJoint(k, i, units.read(text, revolute, f"joint {i + 1} of waypoint {k + 1}"))

    name = units.variable(i, revolute)
    cell = form.field(f"q {i}", units.text(value, revolute), f"{name} of waypoint {k + 1}", typed)
    return f"<label><span>{name}</span>{cell}<i>{units.unit(revolute)}</i></label>"


def _turning(form: Form, state: State) -> str:
    """Return the choice of what the handle does, where an arm controls both."""
    task, target = state[Joints].arm.task, state[Target]
    if task.rotation == "none" or not task.position:
        return ""
    chips = form.chip("handle-move", "Move", Set(Target, "handle", "move"), pressed=target.handle == "move")
    chips += form.chip("handle-turn", "Turn", Set(Target, "handle", "turn"), pressed=target.handle == "turn")
    return f'<div class="bar"><span class="dim">Handle</span>{chips}</div>'


def _shortfall(state: State) -> str:
    """Return how far a dragged waypoint is from what the arm reaches."""
    short = shortfall(state[Joints].arm, state[Plan].waypoints[state[Plan].selected])
    return f'<p class="no">✕ {short}</p>' if short else ""
