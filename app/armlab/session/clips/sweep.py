"""One joint moves through its whole range and back to where it was; the others stay."""

from __future__ import annotations

from dataclasses import replace

from armlab.session.parts.joints import Joints
from armlab.session.parts.sweep import CLIP_KEY, Sweep, curves, free_start
from armlab.session.parts.timeline import Clip
from armlab.session.state import State

SECONDS = 8.0
SAME = 1e-4
"""Stops closer than this, in ranges of the joint, are one."""

HALVINGS = 40
"""Of the interval in which a time is looked for."""


def at(state: State, time: float) -> State:
    """Return the state with the joint where it is at a time; the first call notes where it began."""
    sweep, joints = state[Sweep], state[Joints]
    if sweep.start is None:
        sweep = replace(sweep, start=free_start(joints, sweep.joint))
        state = state.replace(sweep)
    q = joints.q.copy()
    q[sweep.joint] = _value(_legs(state), time)
    moved = joints.moved_to(q)
    return state if moved is joints else state.replace(moved)


def stops(state: State) -> tuple[float, ...]:
    """Return when the joint is at its limits, in the middle, and at singularities, on the way from limit to limit."""
    legs = _legs(state)
    begin, duration, low, high = legs[1]
    values = [low, 0.5 * (low + high), high]
    for singular in curves(state).singular:
        if all(abs(singular - value) > SAME * (high - low) for value in values):
            values.append(singular)
    return tuple(begin + duration * _part(value, low, high) for value in sorted(values))


Leg = tuple[float, float, float, float]
"""When it begins, how long it lasts, and the joint's value at either end."""


def _legs(state: State) -> tuple[Leg, Leg, Leg]:
    """Return the three legs: from the start to the low limit, to the high limit, and back to the start."""
    joints, sweep = state[Joints], state[Sweep]
    low, high = (float(value) for value in joints.arm.limits[sweep.joint])
    start = float(joints.q[sweep.joint]) if sweep.start is None else min(max(sweep.start, low), high)
    second = SECONDS / (2.0 * (high - low)) if high > low else 0.0
    down, up, back = (start - low) * second, (high - low) * second, (high - start) * second
    return (0.0, down, start, low), (down, up, low, high), (down + up, back, high, start)


def _value(legs: tuple[Leg, ...], time: float) -> float:
    begin, duration, first, last = next((leg for leg in legs if time < leg[0] + leg[1]), legs[-1])
    part = (time - begin) / duration if duration > 0.0 else 1.0
    return first + _eased(min(max(part, 0.0), 1.0)) * (last - first)


def _eased(s: float) -> float:
    """Return the minimum-jerk course from 0 to 1: it rests at both ends."""
    return s * s * s * (10.0 + s * (6.0 * s - 15.0))


def _part(value: float, low: float, high: float) -> float:
    """Return the part of a leg's time after which the joint is at a value."""
    if value in (low, high):
        return 0.0 if value == low else 1.0
    wanted = (value - low) / (high - low)
    before, after = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (before + after)
        before, after = (middle, after) if _eased(middle) < wanted else (before, middle)
    return 0.5 * (before + after)


CLIP = Clip(CLIP_KEY, "Joint sweep", lambda state: SECONDS, stops, at)
