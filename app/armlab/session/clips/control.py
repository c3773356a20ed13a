"""The selected run of kinematic control, played by its own clock."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from armlab.session.clips.iterations import standing
from armlab.session.parts.control import CLIP_KEY, Control, standing_start
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Clip, Timeline
from armlab.session.state import State

WAITING = 1.0
"""Seconds of a run that is still being made, or has no more than one instant."""

UNTOUCHED = 1e-9
"""rad or m from where the run has put a joint, within which no hand has moved it."""

Floats = NDArray[np.float64]


def duration(state: State) -> float:
    """Return the seconds of the run."""
    outcome = state[Control].outcome
    return WAITING if outcome is None or outcome.run is None else outcome.run.duration or WAITING


def stops(state: State) -> tuple[float, ...]:
    """Return the times at which something happens: pushes, and the fastest instant of each joint."""
    outcome = state[Control].outcome
    if outcome is None or outcome.run is None or outcome.figures is None:
        return ()
    times = {*outcome.run.pushed, *(peak.time for peak in outcome.figures.speeds)}
    return tuple(sorted(time for time in times if 0.0 < time < outcome.run.duration))


def configuration(state: State, time: float) -> Floats:
    """Return the joint values at a time, (n,)."""
    outcome = state[Control].outcome
    return standing_start(state) if outcome is None or outcome.run is None else outcome.run.at(time)


def time_of(state: State) -> float:
    """Return where the run of a state stands; its beginning while it is not on."""
    return state[Timeline].time if state[Timeline].clip == CLIP_KEY else 0.0


def at(state: State, time: float) -> State:
    """Return the state with the arm where the run has it; the first call notes where it stood."""
    part, joints = state[Control], state[Joints]
    if part.before is None:
        part = replace(part, before=tuple(joints.q.tolist()))
        state = state.replace(part)
    moved = joints.moved_to(standing(joints.arm, configuration(state, time)))
    return state if moved is joints else state.replace(moved)


def untouched(state: State) -> bool:
    """Return whether the arm stands where the run has put it."""
    joints = state[Joints]
    q = standing(joints.arm, configuration(state, state[Timeline].time))
    there = np.where(joints.locked, joints.q, q)
    return bool(np.all(np.abs(there - joints.q) <= UNTOUCHED))


def on_run(state: State) -> State:
    """Return the state with the arm where the run has it, if it is on; its time is at most its end."""
    timeline = state[Timeline]
    if timeline.clip != CLIP_KEY:
        return state
    time = min(timeline.time, duration(state))
    # A timeline of its own says that no hand has moved the arm, even at the same time.
    return at(state.replace(replace(timeline, time=time)), time)


def put_back(state: State) -> State:
    """Return the state with the arm where it stood before the run, unless a hand has moved it meanwhile."""
    part, joints = state[Control], state[Joints]
    if part.before is None or not untouched(state):
        return state
    moved = joints.moved_to(np.array(part.before))
    return state if moved is joints else state.replace(moved)


CLIP = Clip(CLIP_KEY, "Control", duration, stops, at, closed=put_back)
