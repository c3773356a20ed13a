"""The motion of the plan, played by its own clock."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from armlab.session.parts.joints import Joints
from armlab.session.parts.plan import CLIP_KEY, Plan, last_planned
from armlab.session.parts.timeline import Clip, Timeline
from armlab.session.state import State

WAITING = 1.0
"""Seconds of a motion that is still being planned, or that cannot be run."""

UNTOUCHED = 1e-9
"""rad or m from where the motion has put a joint, within which no hand has moved it."""

Floats = NDArray[np.float64]


def duration(state: State) -> float:
    """Return the seconds of the motion."""
    plan = last_planned(state)
    return WAITING if plan is None or plan.motion is None else plan.duration


def stops(state: State) -> tuple[float, ...]:
    """Return the times at which one leg ends and the next begins."""
    plan = last_planned(state)
    return () if plan is None else tuple(leg.start for leg in plan.legs if leg.motion is not None and leg.start > 0.0)


def configuration(state: State, time: float) -> Floats | None:
    """Return the joint values at a time, (n,); None while there is no motion."""
    plan = last_planned(state)
    return None if plan is None or plan.motion is None else plan.motion.at(time)


def at(state: State, time: float) -> State:
    """Return the state with the arm where the motion has it; the first call notes where it stood."""
    part, joints = state[Plan], state[Joints]
    if part.before is None:
        part = replace(part, before=tuple(joints.q.tolist()))
        state = state.replace(part)
    q = configuration(state, time)
    if q is None:
        return state
    moved = joints.moved_to(joints.arm.clip(q))
    return state if moved is joints else state.replace(moved)


def untouched(state: State) -> bool:
    """Return whether the arm stands where the motion has put it."""
    joints, q = state[Joints], configuration(state, state[Timeline].time)
    if q is None:
        return True
    there = np.where(joints.locked, joints.q, joints.arm.clip(q))
    return bool(np.all(np.abs(there - joints.q) <= UNTOUCHED))


def on_motion(state: State) -> State:
    """Return the state with the arm where the motion has it, if it is on; its time is at most its end."""
    timeline = state[Timeline]
    if timeline.clip != CLIP_KEY:
        return state
    time = min(timeline.time, duration(state))
    # A timeline of its own says that no hand has moved the arm, even at the same time.
    return at(state.replace(replace(timeline, time=time)), time)


def put_back(state: State) -> State:
    """Return the state with the arm where it stood before the motion, unless a hand has moved it meanwhile."""
    part, joints = state[Plan], state[Joints]
    if part.before is None or not untouched(state):
        return state
    moved = joints.moved_to(np.array(part.before))
    return state if moved is joints else state.replace(moved)


CLIP = Clip(CLIP_KEY, "Motion", duration, stops, at, closed=put_back)
