"""Curves of the plots of a motion besides its samples: shares of the limits, and the comparison with another one."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.other import other_way
from armlab.benches.motion.plan.question import Limits, Planned, Question
from armlab.benches.motion.plan.state import Plan
from armlab.session.parts.joints import Joints
from armlab.session.state import State

Floats = NDArray[np.float64]
Kind = Literal["joint", "cartesian", "mixed"]

SAME = 1e-4
"""Relative difference of the durations of motions that count as equally long: one follows its path by samples."""


def shares(planned: Planned) -> tuple[Floats, Floats] | None:
    """Return |qdot_i| / v_i and |qddot_i| / a_i at the samples, (k, n) each, or None if the motion cannot be run."""
    if planned.samples is None:
        return None
    limits: Limits = planned.question.limits
    first = np.abs(planned.samples.qdot) / np.array(limits.velocity)
    return first, np.abs(planned.samples.qddot) / np.array(limits.acceleration)


def kind_of(question: Question) -> Kind:
    """Return the space in which the moves of a plan are straight: one, or both."""
    spaces = {move.space for move in question.moves}
    return spaces.pop() if len(spaces) == 1 else "mixed"


def can_compare(state: State) -> bool:
    """Return whether there are moves for a comparison, which a motion read from a file does not have."""
    part = state[Plan]
    return part.recorded is None and bool(part.moves)


def compared(state: State, planned: Planned) -> Planned | None:
    """Return the motion for comparison that belongs to a planned one, or None while it is not wanted or not ready."""
    part = state[Plan]
    if not part.compared or part.other is None or part.other.question.arm is not state[Joints].arm:
        return None
    return part.other if part.other.question == other_way(planned.question) else None


def same_time(one: Planned, other: Planned) -> bool:
    """Return whether two planned motions are equally fast within the limits."""
    return abs(one.fastest - other.fastest) <= SAME * max(one.fastest, other.fastest)
