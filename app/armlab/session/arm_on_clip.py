"""Clips that move the whole arm: it is noted where the arm stood, and it goes back there when the clip is taken off."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State

UNTOUCHED = 1e-9
"""rad or m from where a clip has put a joint, within which no hand has moved it."""

Floats = NDArray[np.float64]


def standing(arm: Arm, q: Floats) -> Floats:
    """Return where the arm can stand for joint values: turned by whole turns into its limits, or at the nearest limit.

    Parameters
    ----------
    arm : Arm
    q : ndarray, shape (n,)
        rad and m, in any turn and outside the limits too.
    """
    low, high = arm.limits.T
    whole, room = 2.0 * math.pi, 1e-12
    up, down = np.ceil((low - room - q) / whole), np.ceil((q - high - room) / whole)
    turned = q + whole * np.where(arm.revolute, np.maximum(up, 0.0) - np.maximum(down, 0.0), 0.0)
    inside = (turned >= low - room) & (turned <= high + room)
    return np.asarray(np.clip(np.where(inside, turned, q), low, high))


@dataclass(frozen=True)
class ArmOnClip:
    """What such a clip does with the arm.

    Parameters
    ----------
    key : str
        Of the clip.
    part : type
        The part of the state with the field ``before``: joint values before the clip, tuple of n floats, or None.
    duration : callable
        Seconds, of a state.
    configuration : callable
        ``configuration(state, time)``: joint values inside the limits, (n,), or None while there is nothing to play.
    """

    key: str
    part: type[Any]
    duration: Callable[[State], float]
    configuration: Callable[[State, float], Floats | None]

    def at(self, state: State, time: float) -> State:
        """Return the state with the arm where the clip has it; the first call notes where it stood."""
        part, joints = state[self.part], state[Joints]
        if part.before is None:
            state = state.replace(replace(part, before=tuple(joints.q.tolist())))
        q = self.configuration(state, time)
        return state if q is None else _moved(state, q)

    def untouched(self, state: State) -> bool:
        """Return whether the clip is on and the arm stands where it has put it."""
        timeline, joints = state[Timeline], state[Joints]
        if timeline.clip != self.key:
            return False
        q = self.configuration(state, timeline.time)
        if q is None:
            return True
        there = np.where(joints.locked, joints.q, q)
        return bool(np.all(np.abs(there - joints.q) <= UNTOUCHED))

    def shown(self, state: State) -> State:
        """Return the state with the arm where the clip has it, if it is on; its time is at most its end."""
        timeline = state[Timeline]
        if timeline.clip != self.key:
            return state
        time = min(timeline.time, self.duration(state))
        # A timeline of its own says that no hand has moved the arm, even at the same time.
        return self.at(state.replace(replace(timeline, time=time)), time)

    def put_back(self, state: State) -> State:
        """Return the state with the arm where it stood before the clip, unless a hand has moved it meanwhile."""
        before = state[self.part].before
        return state if before is None or not self.untouched(state) else _moved(state, np.array(before))


def _moved(state: State, q: Floats) -> State:
    joints = state[Joints]
    moved = joints.moved_to(q)
    return state if moved is joints else state.replace(moved)
