"""The list of waypoints with the moves between them, and the values of the selected one."""

from __future__ import annotations

from armlab.benches.motion.files.commands import BackToWaypoints, MakeWaypoints
from armlab.benches.motion.plan.moves import Stretch, checked_joint
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
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import HandleBy, Target
from armlab.session.state import Command, State
from armlab.ui.fields import Fields
from armlab.ui.format import escaped
from armlab.ui.markup import button, chip
from armlab.ui.pose_fields import pose_fields, typed_component
from armlab.ui.units import Units, units_of

MADE = 12
"""Waypoints that are made of a motion from a file here; the page Files has the choice."""

SPACES = {"joint": "joint", "cartesian": "Cartesian"}


def points_markup(fields: Fields, state: State) -> str:
    """Return the list, and below it the values of the selected waypoint."""
    part, channel = state[Plan], fields.channel_id
    if part.recorded is not None:
        return _recorded_markup(part.recorded, len(part.waypoints), channel)
    add = button(channel, "add", "+ Present pose", "chip", "Add where the arm stands, behind the selected waypoint")
    head = f'<h3>Waypoints<span class="copies">{add}</span></h3>'
    parts = part.parts
    rows = "".join(_row(state, fields, parts, k) for k in range(len(part.waypoints)))
    return f'{head}<div class="mo-list">{rows}</div>{_selected(fields, state)}'


def _recorded_markup(recorded: Recorded, waypoints: int, channel: str) -> str:
    """Return what stands there while a motion from a file is in place of the waypoints."""
    kept = f"The {waypoints} waypoints wait behind it." if waypoints > 1 else ""
    back = chip(channel, "back", "Back to the waypoints", "Take the motion from the file off")
    make = chip(channel, "make", "Make waypoints of it", f"Up to {MADE} places of its way, to edit")
    return (
        f"<h3>Motion from a file</h3><p>{len(recorded.t)} samples in {recorded.t[-1] - recorded.t[0]:.2f} s. {kept}</p>"
        f'<div class="bar">{back}{make}</div>'
    )


def _row(state: State, fields: Fields, parts: tuple[Stretch, ...], k: int) -> str:
    part, channel, units = state[Plan], fields.channel_id, units_of(state)
    last = k == len(part.waypoints) - 1
    name = f"waypoint {k + 1}"
    tools = (
        chip(channel, f"up-{k}", "↑", f"Exchange {name} with the one before", off=k == 0)
        + chip(channel, f"down-{k}", "↓", f"Exchange {name} with the next", off=last)
        + chip(channel, f"remove-{k}", "✕", f"Remove {name}", off=len(part.waypoints) == 1)
    )
    select = button(
        channel,
        f"select-{k}",
        str(k + 1),
        "mo-number",
        f"Show {name}, and drag it in the scene",
        pressed=k == part.selected,
    )
    now = " now" if k == part.selected else ""
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


def _selected(fields: Fields, state: State) -> str:
    part, arm, units, channel = state[Plan], state[Joints].arm, units_of(state), fields.channel_id
    k = part.selected
    point = part.waypoints[k]
    cells = []
    for i, value in enumerate(point.q):
        revolute = bool(arm.revolute[i])
        name = units.variable(i, revolute)
        cell = fields.field(f"q {i}", units.text(value, revolute), f"{name} of waypoint {k + 1}")
        cells.append(f"<label><span>{name}</span>{cell}<i>{units.unit(revolute)}</i></label>")
    take = (
        button(channel, "go", "Go there", "chip", "Move the arm to this waypoint")
        + button(channel, "take", "Take present", "chip", "Put this waypoint where the arm stands")
        + chip(channel, "drag", "Drag it", "A handle at this waypoint instead of at the arm", pressed=part.handled)
    )
    turn = _turning(state, channel) if part.handled else ""
    joints = f'<div class="kit-numbers">{"".join(cells)}</div>'
    pose = pose_fields(fields, arm, point.wanted(arm), units, "pose ")
    short = _shortfall(state)
    return f'<h3>Waypoint {k + 1}<span class="copies">{take}</span></h3>{turn}{joints}{pose}{short}'


def _turning(state: State, channel: str) -> str:
    """Return the choice of what the handle does, where an arm controls both."""
    task, target = state[Joints].arm.task, state[Target]
    if task.rotation == "none" or not task.position:
        return ""
    both = {"move": "Move", "turn": "Turn"}
    chips = "".join(chip(channel, f"handle-{key}", text, pressed=target.handle == key) for key, text in both.items())
    return f'<div class="bar"><span class="dim">Handle</span>{chips}</div>'


def _shortfall(state: State) -> str:
    """Return how far a dragged waypoint is from what the arm reaches."""
    short = shortfall(state[Joints].arm, state[Plan].waypoints[state[Plan].selected])
    return f'<p class="no">✕ {short}</p>' if short else ""


def point_command(state: State, cell: str, text: str) -> tuple[Command, ...] | None:
    """Return what a person asked for in the list; None when no cell of it has this name.

    Raises
    ------
    InputError
        What was typed is no number.
    """
    part, units = state[Plan], units_of(state)
    k = part.selected
    if part.recorded is not None:
        of_file: dict[str, Command] = {"back": BackToWaypoints(), "make": MakeWaypoints(MADE)}
        return (of_file[cell],) if cell in of_file else None
    simple: dict[str, Command] = {
        "add": AddWaypoint(),
        "go": GoToWaypoint(k),
        "take": TakePresent(k),
        "drag": SelectWaypoint(k, not part.handled),
        "handle-move": HandleBy(handle="move"),
        "handle-turn": HandleBy(handle="turn"),
    }
    if cell in simple:
        return (simple[cell],)
    name, _, rest = cell.replace(" ", "-", 1).partition("-")
    if name in ("up", "down", "remove", "select") and rest.isdecimal():
        i = int(rest)
        made: dict[str, Command] = {
            "up": ShiftWaypoint(i, -1),
            "down": ShiftWaypoint(i, 1),
            "remove": RemoveWaypoint(i),
            "select": SelectWaypoint(i),
        }
        return (made[name],)
    if name == "q" and rest.isdecimal():
        i = checked_joint(state[Joints].arm, int(rest))
        value = units.read(text, bool(state[Joints].arm.revolute[i]), f"joint {i + 1} of waypoint {k + 1}")
        return (SetWaypointJoint(k, i, value),)
    if name == "pose":
        arm = state[Joints].arm
        return (SetWaypointPose(k, typed_component(arm, part.waypoints[k].wanted(arm), rest, text, units)),)
    return None
