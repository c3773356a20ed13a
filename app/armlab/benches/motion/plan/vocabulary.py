"""Words of lesson files about the planned motion: waypoints, moves, times and limits, and how long it takes."""

from __future__ import annotations

from armlab.benches.motion.plan.actions import READERS
from armlab.benches.motion.plan.seen_motion import KEY, motion_in, seconds
from armlab.benches.motion.plan.words import rounded_up
from armlab.content.check import Words
from armlab.content.live_value import NONE, LiveValue, always
from armlab.content.observation import Observation
from armlab.content.vocabulary import Vocabulary


def _duration(observation: Observation, words: Words) -> str:
    """Return the duration of the planned motion, if it can be run to its end."""
    del words
    motion = motion_in(observation)
    return seconds(motion.duration) if motion is not None and motion.whole else NONE


def _fastest(observation: Observation, words: Words) -> str:
    """Return a duration that the planned motion can have within its limits, the least in hundredths."""
    del words
    motion = motion_in(observation)
    if motion is None or not motion.whole or not motion.fastest:
        return NONE
    return seconds(rounded_up(motion.fastest))


VOCABULARY = Vocabulary(
    KEY,
    actions=READERS,
    plays=("motion",),
    live={"duration": LiveValue(always, _duration), "fastest": LiveValue(always, _fastest)},
)
