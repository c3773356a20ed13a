"""Clips that move the whole arm: its position is noted before, and restored when the clip is closed."""

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
"""Difference from the joint value of a clip, rad or m, within which nobody has moved the joint."""

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
    """The effect of such a clip on the arm.

    Parameters
    ----------
    key : str
        Key of the clip.
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
        """Return the state with the arm as in the clip at a time; the first call notes its position before."""
        part, joints = state[self.part], state[Joints]
        if part.before is None:
            state = state.replace(replace(part, before=tuple(joints.q.tolist())))
        q = self.configuration(state, time)
        return state if q is None else _moved(state, q)

    def untouched(self, state: State) -> bool:
        """Return whether the clip is open and the arm stands as in the clip."""
        timeline, joints = state[Timeline], state[Joints]
        if timeline.clip != self.key:
            return False
        q = self.configuration(state, timeline.time)
        if q is None:
            return True
        there = np.where(joints.locked, joints.q, q)
        return bool(np.all(np.abs(there - joints.q) <= UNTOUCHED))

    def shown(self, state: State) -> State:
        """Return the state with the arm as in the clip, if that is open, at its time or at most its end."""
        timeline = state[Timeline]
        if timeline.clip != self.key:
            return state
        time = min(timeline.time, self.duration(state))
        # A timeline of its own says that no hand has moved the arm, even at the same time.
        return self.at(state.replace(replace(timeline, time=time)), time)

    def put_back(self, state: State) -> State:
        """Return the state with the arm as before the clip, unless somebody has moved it meanwhile."""
        before = state[self.part].before
        return state if before is None or not self.untouched(state) else _moved(state, np.array(before))


def _moved(state: State, q: Floats) -> State:
    joints = state[Joints]
    moved = joints.moved_to(q)
    return state if moved is joints else state.replace(moved)
