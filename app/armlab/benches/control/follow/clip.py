"""The film of the selected run of kinematic control, played by its own clock."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.control.follow.state import CLIP_KEY, Control, standing_start
from armlab.session.arm_on_clip import ArmOnClip, standing
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Clip, Timeline
from armlab.session.state import State

WAITING = 1.0
"""Duration of a run that is still being made, or has only one instant, seconds."""

Floats = NDArray[np.float64]


def duration(state: State) -> float:
    """Return the duration of the run, seconds."""
    outcome = state[Control].outcome
    return WAITING if outcome is None or outcome.run is None else outcome.run.duration or WAITING


def stops(state: State) -> tuple[float, ...]:
    """Return the times of pushes, and of the fastest instant of each joint."""
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
    """Return the time in the run of a state, or 0 while its film is closed."""
    return state[Timeline].time if state[Timeline].clip == CLIP_KEY else 0.0


ARM = ArmOnClip(
    CLIP_KEY, Control, duration, lambda state, time: standing(state[Joints].arm, configuration(state, time))
)

CLIP = Clip(CLIP_KEY, "Control", duration, stops, ARM.at, tab="control", closed=ARM.put_back)
