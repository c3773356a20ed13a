"""The joints move with the chosen speeds until the first of them is at a limit."""

from __future__ import annotations

from dataclasses import replace

from armlab.benches.velocity.speeds.motion import speeds_of, time_left
from armlab.benches.velocity.speeds.state import CLIP_KEY, Velocity
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Clip
from armlab.session.state import State

LONGEST = 120.0
"""Longest duration of the drive, seconds; slow joints with wide limits are shown no longer."""


def duration(state: State) -> float:
    """Return the time at which the first joint is at a limit: the time driven so far, plus the time left."""
    return min((state[Velocity].reached or 0.0) + time_left(state), LONGEST)


def at(state: State, time: float) -> State:
    """Return the state with the joints moved on by the time since the last picture.

    If the student moves a joint or changes a speed, the drive continues from there.
    """
    part, joints = state[Velocity], state[Joints]
    passed = 0.0 if part.reached is None else time - part.reached
    if part.reached != time:
        state = state.replace(replace(part, reached=time))
    if passed == 0.0:
        return state
    moved = joints.moved_to(joints.q + passed * state.derived(speeds_of))
    return state if moved is joints else state.replace(moved)


CLIP = Clip(CLIP_KEY, "Drive with these speeds", duration, lambda state: (), at, tab="velocity")
