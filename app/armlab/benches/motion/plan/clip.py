"""The film of the planned motion, played by its own clock."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.state import CLIP_KEY, Plan, last_planned
from armlab.session.arm_on_clip import ArmOnClip
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Clip
from armlab.session.state import State

WAITING = 1.0
"""Duration of a motion that is still being planned, or that cannot be run, seconds."""

Floats = NDArray[np.float64]


def duration(state: State) -> float:
    """Return the duration of the motion, seconds."""
    planned = last_planned(state)
    return WAITING if planned is None or planned.motion is None else planned.duration


def stops(state: State) -> tuple[float, ...]:
    """Return the times at which a leg or a wait ends and the next begins."""
    planned = last_planned(state)
    return () if planned is None else planned.boundaries


def configuration(state: State, time: float) -> Floats | None:
    """Return the joint values at a time, (n,), inside the limits, or None while there is no motion."""
    planned = last_planned(state)
    if planned is None or planned.motion is None:
        return None
    return np.asarray(state[Joints].arm.clip(planned.motion.at(time)))


ARM = ArmOnClip(CLIP_KEY, Plan, duration, configuration)

CLIP = Clip(CLIP_KEY, "Motion", duration, stops, ARM.at, tab="motion", closed=ARM.put_back)
