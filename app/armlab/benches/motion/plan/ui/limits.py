"""The time and the limits of the motion."""

from __future__ import annotations

from typing import Literal

from armlab.benches.motion.plan.limits import LastFor, LimitJerk, LimitJoint, LimitTool, UseShare
from armlab.benches.motion.plan.state import Plan, last_planned
from armlab.benches.motion.plan.words import rounded_up
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.form import Form, Typed
from armlab.ui.format import readable
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import fold
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, plain_number, units_of

PER = {"velocity": "/s", "acceleration": "/s²"}
"""Ends of the units of limits."""


def time_markup(form: Form, state: State) -> Markup:
    """Return the choice of the time, and the limits of the whole motion."""
    part, units = state[Plan], units_of(state)
    v, a = part.shares
    speed = "" if part.tool_speed is None else readable(part.tool_speed / units.factor(False), 4)
    jerk = "" if part.jerk_time is None else readable(part.jerk_time, 4)

    def velocities(text: str) -> UseShare:
        return UseShare(velocity=plain_number(text, "share of the velocities", "a number of percent") / 100.0)

    def accelerations(text: str) -> UseShare:
        return UseShare(acceleration=plain_number(text, "share of the accelerations", "a number of percent") / 100.0)

    def tool(text: str) -> LimitTool:
        return LimitTool(units.read(text, False, "tool speed", "/s") if text.strip() else None)

    def build_up(text: str) -> LimitJerk:
        return LimitJerk(plain_number(text, "jerk time", "a number of seconds") if text.strip() else None)

    of_v, of_a = readable(100.0 * v, 2), readable(100.0 * a, 2)
    speeds = f"{units.length_unit}/s"
    built = "Time t to build up the full acceleration a: the jerk is at most a / t; leave empty for no limit"
    limits = (
        _field(form, "v", "velocities", of_v, "%", "Percentage of the velocity limits to use", velocities),
        _field(
            form,
            "a",
            "accelerations",
            of_a,
            "%",
            "Percentage of the acceleration limits to use",
            accelerations,
        ),
        _field(form, "speed", "tool speed", speed, speeds, "Limit of the tool speed; leave empty for none", tool),
        _field(form, "jerk", "jerk time", jerk, "s", built, build_up),
    )
    within = fold("Limits", tag("div.options", limits), _joints(form, state))
    return joined(tag("h3", "Time"), _duration(form, state), within)


def _duration(form: Form, state: State) -> Markup:
    """Return the choice whether the motion is as fast as allowed or takes a given time, and that time."""
    part, planned = state[Plan], last_planned(state)
    now = 1.0 if planned is None or planned.motion is None else planned.duration
    as_given = LastFor(part.duration or max(rounded_up(now), 0.01))
    fastest = part.duration is None
    choice = (
        form.chip(
            "time-fastest",
            "As fast as allowed",
            LastFor(None),
            "Let the limits decide how long the motion takes",
            fastest,
        ),
        form.chip("time-given", "In a given time", as_given, "Type how long the whole motion takes", not fastest),
    )
    given: Inside = None

    def seconds(text: str) -> LastFor:
        return LastFor(plain_number(text, "duration", "a number of seconds"))

    if part.duration is not None:
        shown = readable(part.duration, 3)
        typed = form.field("duration", shown, "Duration", seconds)
        told = None
        if planned is not None and planned.least > 0.0:
            k = part.duration / planned.least
            least = f"{rounded_up(planned.least):.2f} s{planned.with_ramps}"
            told = tag("span.dim", f"{k:.2f} times the shortest time, {least}")
        given = tag("label.option", typed, tag("i", "s")), told
    return joined(tag("div.bar", choice), tag("div.options", given))


def _field(form: Form, cell: str, name: str, value: str, unit: str, hint: str, action: Typed) -> Markup:
    typed = form.field(cell, value, hint, action)
    return tag("label.option", tag("span", name), typed, tag("i", unit), title=hint)


def _joints(form: Form, state: State) -> Markup:
    """Return the limits of each joint, folded away."""
    part, arm, units = state[Plan], state[Joints].arm, units_of(state)
    rows = []
    for i in range(arm.n):
        turns = bool(arm.revolute[i])
        unit = units.unit(turns)
        v = _limit(form, f"vmax {i}", i, "velocity", part.velocity[i], turns, units)
        a = _limit(form, f"amax {i}", i, "acceleration", part.acceleration[i], turns, units)
        rows.append(line(units.variable(i, turns), (v, f" {unit}/s"), (a, f" {unit}/s²")))
    table = tag("table", head_line("", "velocity", "acceleration"), rows)
    return tag("details.mo-joints", tag("summary", "Limits of each joint"), table)


def _limit(
    form: Form, cell: str, i: int, of: Literal["velocity", "acceleration"], value: float, turns: bool, units: Units
) -> Markup:
    def typed(text: str) -> LimitJoint:
        return LimitJoint(i, of, units.read(text, turns, f"limit of {of} of joint {i + 1}", PER[of]))

    return form.field(cell, readable(value / units.factor(turns), 3), f"Limit of {of} of joint {i + 1}", typed)
