"""The verdict on pick and place, in words: which box is taken, by how far the hand misses it, and where it is put."""

from __future__ import annotations

import numpy as np

from armlab.benches.motion.pick.course import Course, Try
from armlab.benches.motion.pick.state import Pick, course_of, from_goal, name_of, placed
from armlab.benches.motion.plan.state import Plan, last_planned
from armlab.benches.motion.plan.words import Said
from armlab.session.state import State
from armlab.ui.units import Units, units_of


def told(state: State) -> Said:
    """Return the verdict on the boxes of a motion."""
    part, units, found = state[Pick], units_of(state), state.derived(course_of)
    if not part.boxes:
        return Said("dim", "no boxes yet", ())
    lines = (*(tried(each, units) for each in found.tries), *_missing(state, found), *_released(state, units))
    count, goal = len(part.boxes), placed(state)
    missed = any(not each.taken for each in found.tries)
    kind = "ok" if goal and not missed else "no" if missed else "warn"
    return Said(kind, f"{goal} of {count} {'box' if count == 1 else 'boxes'} at the goal at the end", lines)


def tried(found: Try, units: Units) -> str:
    """Return a sentence on a gripper that closes."""
    at = f"waypoint {found.grip.waypoint + 1}, at {found.grip.time:.2f} s"
    if found.shut:
        return f"{at}: the gripper is closed already; let it open first"
    if found.nearest is None:
        return f"{at}: the gripper closes on nothing; there are no boxes"
    if found.taken:
        return f"{at}: the gripper closes on {name_of(found.nearest)} and carries it"
    away = units.length(found.distance)
    return f"{at}: the gripper closes on nothing: the middle of {name_of(found.nearest)} is {away} away"


def _missing(state: State, found: Course) -> tuple[str, ...]:
    """Return a sentence if the gripper never closes, or never opens again."""
    planned = last_planned(state)
    if planned is None or planned.motion is None:
        return ("there is no motion yet that could carry a box",) if state[Plan].planned is not None else ()
    if planned.question.recorded is not None:
        return ()
    if not any(grip.closes for grip in found.grips):
        return ("the gripper never closes: let it close at the waypoint at a box",)
    held = found.held(planned.duration)
    return () if held is None else (f"{name_of(held)} is still in the gripper at the end: let it open at the goal",)


def _released(state: State, units: Units) -> tuple[str, ...]:
    """Return a sentence on each box that has been carried and released: how far it is from the goal."""
    planned, found = last_planned(state), state.derived(course_of)
    if planned is None:
        return ()
    apart = from_goal(state)
    moved = [k for k, spans in enumerate(found.spans) if len(spans) > 1 and not spans[-1].carried]
    return tuple(f"{name_of(k)} is put down {_away(float(apart[k]), units)}" for k in moved if apart)


def _away(distance: float, units: Units) -> str:
    return "at the goal" if np.round(distance, 4) == 0.0 else f"{units.length(distance)} from the goal"
