"""The planned motion can be run to its end within its limits, perhaps in a given time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.motion.plan.seen_motion import (
    KEY,
    MOST_WAYPOINTS,
    NOT_PLANNED,
    SeenMotion,
    motion_in,
    percent,
    seconds,
)
from armlab.benches.motion.plan.words import rounded_up
from armlab.content.check import PLAIN, CheckType, Words, tolerance
from armlab.content.lesson_fields import Fields
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot

ROUNDING_S = 5e-3
"""Difference from the required time, seconds, that is rounding: two decimals are shown."""

ROUNDING = 5e-4
"""Excess over a fraction of a limit that is ignored: a tenth of a percent is shown."""


@dataclass(frozen=True)
class MotionRuns:
    """Conditions besides running to the end: ``most`` and ``least`` in s, ``deviation`` in m, fractions; None: any."""

    observes: ClassVar[tuple[str, ...]] = (KEY,)

    most: float | None = None
    least: float | None = None
    waypoints: int = 0
    deviation: float | None = None
    velocity: float | None = None
    acceleration: float | None = None

    def is_met(self, observation: Observation) -> bool:
        """Return whether all conditions are met."""
        motion = motion_in(observation)
        return motion is not None and not self._missing(motion)

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on the first condition that is not met."""
        motion = motion_in(observation)
        if motion is None:
            return NOT_PLANNED
        return self._missing(motion, words) or (
            f"The motion runs to its end in {seconds(motion.duration)}, within all limits."
        )

    def _missing(self, motion: SeenMotion, words: Words = PLAIN) -> str:
        if not motion.planned:
            return NOT_PLANNED
        if not motion.whole:
            return f"The motion cannot be run to its end{f': {motion.trouble}' if motion.trouble else ''}."
        if motion.raised:
            return f"{motion.raised} The lesson counts with the limits of the arm itself."
        if not motion.within and not motion.fastest:
            return "The motion exceeds a limit that these moves keep in no time: choose another path or law."
        if not motion.within:
            least = seconds(rounded_up(motion.fastest))
            return f"The motion exceeds a limit; within all limits it takes at least {least}."
        if motion.waypoints < self.waypoints:
            return f"The motion has {motion.waypoints} waypoints; at least {self.waypoints} are required."
        return self._wrong_time(motion) or self._too_much(motion, words)

    def _wrong_time(self, motion: SeenMotion) -> str:
        takes = f"The motion takes {seconds(motion.duration)};"
        if self.most is not None and motion.duration > self.most + ROUNDING_S:
            return f"{takes} at most {seconds(self.most)} is required."
        if self.least is not None and motion.duration < self.least - ROUNDING_S:
            return f"{takes} at least {seconds(self.least)} is required."
        return ""

    def _too_much(self, motion: SeenMotion, words: Words) -> str:
        if self.deviation is not None and motion.deviation > self.deviation:
            return (
                f"The tool leaves its path by {words.length(motion.deviation)}; at most "
                f"{words.length(self.deviation)} is required."
            )
        shares = (
            ("velocity", motion.velocity, self.velocity),
            ("acceleration", motion.acceleration, self.acceleration),
        )
        for name, share, most in shares:
            if most is not None and share > most + ROUNDING:
                used = percent(math.ceil(1000.0 * share - 1e-6) / 1000.0)
                return f"A joint uses {used} of its limit of {name}; at most {percent(most)} is required."
        return ""


def read(table: Table, robot: Robot) -> MotionRuns:
    """Read what is optional: ``at_most_s``, ``at_least_s``, ``waypoints`` (at least), ``deviation_m`` (at most).

    Then ``velocity_percent`` and ``acceleration_percent``, the largest share of the limits of the joints.
    """
    fields = Fields.of(table)
    most, least = _optional(table, "at_most_s"), _optional(table, "at_least_s")
    if most is not None and least is not None and least > most:
        raise table.fail("at_least_s", f"expected at most {most:g} s as in at_most_s, got {least:g}")
    count = fields.whole("waypoints", 2, MOST_WAYPOINTS) if table.has("waypoints") else 0
    return MotionRuns(
        most, least, count, _optional(table, "deviation_m"), _share(table, "velocity"), _share(table, "acceleration")
    )


def _optional(table: Table, key: str) -> float | None:
    return tolerance(table, key) if table.has(key) else None


def _share(table: Table, of: str) -> float | None:
    value = _optional(table, f"{of}_percent")
    if value is not None and value > 100.0:
        raise table.fail(f"{of}_percent", f"expected at most 100, got {value:g}")
    return None if value is None else value / 100.0


CHECK = CheckType("motion_runs", 70, read)
