"""The arm moves through its self-motion and back, or once around; its tool stays still."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from armlab.benches.velocity.solve.motion import at_part, begun, key_of, way_of
from armlab.benches.velocity.solve.state import CLIP_KEY, Solve
from armlab.errors import InputError
from armlab.kin.easing import eased
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Clip
from armlab.session.state import State

SECONDS = 8.0


def at(state: State, time: float) -> State:
    """Return the state with the arm at its place at a time; the first call notes where the motion began."""
    if begun(state) is None:
        key = key_of(state)
        if way_of(key) is None:
            raise InputError(
                "self-motion: no motion of the joints leaves the tool where it is, so there is nothing to play"
            )
        state = state.replace(replace(state[Solve], start=tuple(state[Joints].q.tolist())))
    return at_part(state, part_at(state, time))


def part_at(state: State, time: float) -> float:
    """Return the place of the arm along the curve at a time, as a part from 0 to 1.

    Around a closed one; else from where it began to one end, to the other, and back.
    """
    way = begun(state)
    start = state[Solve].start
    assert way is not None
    assert start is not None
    question, motion = way
    first = motion.part(question.arm, np.array(start))
    if motion.closed:
        return (first + eased(min(time / SECONDS, 1.0))) % 1.0
    # The three legs last as long as they are.
    legs = ((first, 0.0), (0.0, 1.0), (1.0, first))
    left = 2.0 * min(max(time / SECONDS, 0.0), 1.0)
    for begin, end in legs:
        length = abs(end - begin)
        if left <= length:
            return begin + (end - begin) * (eased(left / length) if length else 0.0)
        left -= length
    return first


CLIP = Clip(CLIP_KEY, "Self-motion", lambda state: SECONDS, lambda state: (), at, tab="velocity")
