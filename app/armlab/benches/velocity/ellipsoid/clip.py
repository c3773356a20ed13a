"""One joint moves through its whole range and back to where it was; the others stay."""

from __future__ import annotations

from dataclasses import replace

from armlab.benches.velocity.ellipsoid.state_sweep import (
    CLIP_KEY,
    SECONDS,
    Sweep,
    free_start,
    legs,
    put_back,
    singularities,
    value_at,
)
from armlab.kin.easing import eased
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Clip
from armlab.session.state import State

SAME = 1e-4
"""Distance of two stops, in ranges of the joint, below which they are one stop."""

HALVINGS = 40
"""Number of times that the interval is halved in which a time is looked for."""


def at(state: State, time: float) -> State:
    """Return the state with the joint at its value at a time; the first call notes where the joint began."""
    sweep, joints = state[Sweep], state[Joints]
    if sweep.start is None:
        sweep = replace(sweep, start=free_start(joints, sweep.joint))
        state = state.replace(sweep)
    q = joints.q.copy()
    q[sweep.joint] = value_at(legs(state), time)
    moved = joints.moved_to(q)
    return state if moved is joints else state.replace(moved)


def stops(state: State) -> tuple[float, ...]:
    """Return the times when the joint is at its limits, in the middle, and at singularities between the limits."""
    begin, duration, low, high = legs(state)[1]
    values = [low, 0.5 * (low + high), high]
    for singular in state.derived(singularities).places:
        if all(abs(singular - value) > SAME * (high - low) for value in values):
            values.append(singular)
    return tuple(begin + duration * _part(value, low, high) for value in sorted(values))


def _part(value: float, low: float, high: float) -> float:
    """Return the part of a leg's time after which the joint is at a value."""
    if value in (low, high):
        return 0.0 if value == low else 1.0
    wanted = (value - low) / (high - low)
    before, after = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (before + after)
        before, after = (middle, after) if eased(middle) < wanted else (before, middle)
    return 0.5 * (before + after)


CLIP = Clip(CLIP_KEY, "Joint sweep", lambda state: SECONDS, stops, at, tab="velocity", closed=put_back)
