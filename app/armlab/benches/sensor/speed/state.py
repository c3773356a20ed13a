"""The speed of a shaft as an encoder tells it: its counts, the window, the clock, and the true speed."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.kin.sensors.absolute import TURN
from armlab.kin.sensors.quadrature import DECODERS, HONEST
from armlab.kin.sensors.speed import Meter, Readings, RunUp, speed_by_counts, speed_by_time
from armlab.session.fields import FieldPart, choice, number, text, whole
from armlab.session.state import PartType

Floats = NDArray[np.float64]

SLOWEST, FASTEST = 1e-4, 1e5
"""Bounds of the speed, rad/s."""

RAMP, HOLD, REST = 4.0, 4.0, 2.0
"""Durations of speeding up and slowing down, of the steady speed, and of rest in the end, in windows."""

BEGUN = 0.5
"""Part of a count that has gone by when the first window begins."""


READINGS = {"counts": "the number of counts", "time": "the time between counts"}
"""Ways to the speed, in words."""


@dataclass(frozen=True)
class EncoderSpeed(FieldPart):
    """One encoder and how its speed is measured, which do not depend on the arm.

    Attributes
    ----------
    pulses : int
        PPR, periods in a turn.
    decoder : str
        Some of `HONEST`.
    window, clock, speed : float
        s, Hz, rad/s.
    example : str
        Key of the example it still is; empty when something has been changed.
    """

    key: ClassVar[str] = "encoder_speed"

    pulses: int = whole("periods in a turn, PPR", 1000, 1, 1_000_000)
    decoder: str = choice("rule of counting", "x1", {key: DECODERS[key].title for key in HONEST})
    window: float = number("T", "window in which counts are counted", 0.1, 1e-5, 100.0, "s")
    clock: float = number("f", "clock that times counts", 1e6, 1.0, 1e10, "Hz")
    speed: float = number("ω", "true speed", 2.0 * TURN, SLOWEST, FASTEST, "rad/s")
    example: str = text("example", "notes")

    @cached_property
    def meter(self) -> Meter:
        """The encoder with its window and its clock."""
        return Meter(self.pulses, DECODERS[self.decoder], self.window, self.clock)

    @property
    def start(self) -> float:
        """The angle at which the first window begins, radians."""
        return BEGUN * self.meter.resolution

    @cached_property
    def counts(self) -> int:
        """C: the counts in the first window at the true speed."""
        ends = self.meter.number([self.start, self.start + self.speed * self.window])
        return int(ends[1] - ends[0])

    @cached_property
    def ticks(self) -> tuple[int, ...]:
        """n: the ticks between the first counts at the true speed, one number for each gap of a period."""
        first = int(self.meter.number(self.start)) + 1
        places = self.meter.place(np.arange(first, first + self.meter.decoder.per_period + 1))
        ticks = np.floor((places - self.start) / self.speed * self.clock + 1e-9)
        return tuple(int(each) for each in np.diff(ticks))

    @property
    def by_counts(self) -> float:
        """The speed by the counts, rad/s."""
        return float(speed_by_counts(self.counts, self.meter.resolution, self.window))

    @property
    def by_time(self) -> Floats:
        """The speeds by the times between the first counts, rad/s; infinite where there was no tick."""
        return speed_by_time(self.ticks, self.meter.resolution, self.clock)

    @cached_property
    def run(self) -> Readings:
        """Both readings while the shaft speeds up, turns at the true speed, and stops."""
        T = self.window
        return Readings(self.meter, RunUp(self.speed, RAMP * T, HOLD * T, self.start, REST * T))

    @property
    def finer(self) -> str:
        """Which reading has the smaller error at the true speed: ``"counts"`` or ``"time"``."""
        counts, time = (float(each(self.speed)) for each in (self.meter.error_by_counts, self.meter.error_by_time))
        return "counts" if counts < time else "time"

    def speed_of(self, counts: int) -> float:
        """Return the speed in rad/s at which so many counts come in a window."""
        return counts * self.meter.resolution / self.window


PART = PartType(EncoderSpeed, order=142)
