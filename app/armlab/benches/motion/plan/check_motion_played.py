"""The planned motion was played to its end."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.motion.plan.seen_motion import KEY, NOT_PLANNED, motion_in, seconds
from armlab.content.check import PLAIN, CheckType, Words
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot


@dataclass(frozen=True)
class MotionPlayed:
    """Playback of the motion as planned at present: a change of the plan requires another playback."""

    observes: ClassVar[tuple[str, ...]] = (KEY,)
    noted: ClassVar[tuple[str, ...]] = ("that the motion was played",)

    def is_met(self, observation: Observation) -> bool:
        """Return whether the motion can be run to its end and was played to it."""
        motion = motion_in(observation)
        return motion is not None and motion.planned and motion.whole and motion.played

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on how far it was played."""
        motion = motion_in(observation)
        if motion is None or not motion.planned:
            return NOT_PLANNED
        if not motion.whole:
            return f"The motion cannot be run to its end{f': {motion.trouble}' if motion.trouble else ''}."
        if motion.played:
            return "You have played the motion to its end."
        if motion.time is None:
            return "Play the motion to its end."
        return f"Play the motion to its end: it is at {seconds(motion.time)} of {seconds(motion.duration)}."


def read(table: Table, robot: Robot) -> MotionPlayed:
    """Read the check, which has no fields."""
    return MotionPlayed()


CHECK = CheckType("motion_played", 74, read)
