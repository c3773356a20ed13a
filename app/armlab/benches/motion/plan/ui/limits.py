"""The time and the limits of the motion."""

from __future__ import annotations

from armlab.benches.motion.plan.limits import LastFor, LimitJerk, LimitJoint, LimitTool, UseShare
from armlab.benches.motion.plan.moves import checked_joint
from armlab.benches.motion.plan.state import Plan, last_planned
from armlab.benches.motion.plan.words import rounded_up
from armlab.errors import InputError
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State
from armlab.ui.fields import Fields
from armlab.ui.format import readable
from armlab.ui.markup import chips
from armlab.ui.tried import plain_number
from armlab.ui.units import units_of


def time_markup(fields: Fields, state: State) -> str:
    """Return the choice of the time, and the limits of the whole motion."""
    part, units, channel = state[Plan], units_of(state), fields.channel_id
    plan = last_planned(state)
    how = "time-given" if part.duration is not None else "time-fastest"
    given = ""
    if part.duration is not None:
        given = (
            f'<label class="option">{fields.field("duration", readable(part.duration, 3), "Duration")}<i>s</i></label>'
        )
        if plan is not None and plan.motion is not None:
            k = part.duration / plan.fastest
            given += f'<span class="dim">{k:.2f} times the fastest, {plan.fastest:.2f} s</span>'
    choice = chips(
        channel, {"time-fastest": "As fast as allowed", "time-given": "In a given time"}, how, "Of the whole"
    )
    v, a = part.shares
    speed = "" if part.tool_speed is None else readable(part.tool_speed / units.factor(False), 4)
    jerk = "" if part.jerk_time is None else readable(part.jerk_time, 4)
    return (
        f'<h3>Time</h3><div class="bar">{choice}</div><div class="options">{given}</div>'
        '<h3>Limits</h3><div class="options">'
        + _field(fields, "v", "velocities", readable(100.0 * v, 2), "%", "Share of the limits of velocity that is used")
        + _field(fields, "a", "accelerations", readable(100.0 * a, 2), "%", "Share of the limits of acceleration")
        + _field(
            fields, "speed", "tool speed", speed, f"{units.length_unit}/s", "Largest speed of the tool; empty: any"
        )
        + _field(
            fields, "jerk", "jerk time", jerk, "s", "Time to build up the full acceleration, j = a / t; empty: any jerk"
        )
        + f"</div>{_joints(fields, state)}"
    )


def _field(fields: Fields, cell: str, name: str, value: str, unit: str, hint: str) -> str:
    typed = fields.field(cell, value, hint)
    return f'<label class="option" title="{hint}"><span>{name}</span>{typed}<i>{unit}</i></label>'


def _joints(fields: Fields, state: State) -> str:
    """Return the limits of each joint, folded away."""
    part, arm, units = state[Plan], state[Joints].arm, units_of(state)
    rows = []
    for i in range(arm.n):
        revolute = bool(arm.revolute[i])
        factor, unit = units.factor(revolute), units.unit(revolute)
        v = fields.field(f"vmax {i}", readable(part.velocity[i] / factor, 3), f"Limit of velocity of joint {i + 1}")
        a = fields.field(
            f"amax {i}", readable(part.acceleration[i] / factor, 3), f"Limit of acceleration of joint {i + 1}"
        )
        rows.append(f"<tr><td>{units.variable(i, revolute)}</td><td>{v} {unit}/s</td><td>{a} {unit}/s²</td></tr>")
    return (
        '<details class="mo-joints"><summary>Limits of each joint</summary><table><tr><th></th><th>velocity</th>'
        f"<th>acceleration</th></tr>{''.join(rows)}</table></details>"
    )


def limit_command(state: State, cell: str, text: str) -> tuple[Command, ...] | None:
    """Return what a person asked for; None when no cell here has this name. `InputError`: not a number."""
    part, units = state[Plan], units_of(state)
    plan = last_planned(state)
    now = 1.0 if plan is None or plan.motion is None else plan.duration
    if cell == "time-fastest":
        return (LastFor(None),)
    if cell == "time-given":
        return (LastFor(part.duration or max(rounded_up(now), 0.01)),)
    if cell == "duration":
        return (LastFor(_number(text, "duration")),)
    if cell == "v":
        return (UseShare(velocity=_number(text, "share of the velocities") / 100.0),)
    if cell == "a":
        return (UseShare(acceleration=_number(text, "share of the accelerations") / 100.0),)
    if cell == "speed":
        return (LimitTool(units.read(text, False, "tool speed") if text.strip() else None),)
    if cell == "jerk":
        return (LimitJerk(_number(text, "jerk time") if text.strip() else None),)
    of, _, joint = cell.partition(" ")
    if of in ("vmax", "amax") and joint.isdecimal():
        i = checked_joint(state[Joints].arm, int(joint))
        revolute = bool(state[Joints].arm.revolute[i])
        value = units.read(text, revolute, f"limit of joint {i + 1}")
        return (LimitJoint(i, "velocity" if of == "vmax" else "acceleration", value),)
    return None


def _number(text: str, name: str) -> float:
    try:
        return plain_number(text)
    except InputError as refusal:
        raise InputError(f"{name}: {refusal}") from None
