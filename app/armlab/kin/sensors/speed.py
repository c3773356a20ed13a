"""Speed from an incremental encoder: by the counts in a window of time, or by the time between two counts.

    omega = C AR / T                 C counts in a window of T seconds
    omega = AR f / n                 n ticks of a clock of f Hz between two counts

Both are whole numbers of something: the first is coarse when few counts come, the second when few ticks do. Angles are
in radians.

References
----------
Notes 2.42-2.43, which have the first one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats
from armlab.kin.field import positive
from armlab.kin.sensors.absolute import TURN
from armlab.kin.sensors.quadrature import Decoder, angular_resolution, checked_pulses

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]

ROUNDING = 1e-9
"""Part of a count, or of a tick, by which it may be missed and still is there: rounding."""


def speed_by_counts(counts: ArrayLike, resolution: float, window: float) -> Floats:
    """Return the speed in rad/s for counts in a window of time: ``C / T AR``.

    Parameters
    ----------
    counts : array_like
        C, negative in the other direction.
    resolution : float
        AR, radians.
    window : float
        T, seconds.

    Raises
    ------
    InputError
        Resolution or window is not positive.

    References
    ----------
    Notes 2.42-2.43.

    Examples
    --------
    >>> math.degrees(float(speed_by_counts(200, math.radians(0.36), 0.1)))
    720.0
    """
    return np.asarray(as_floats(counts, "counts", "numbers") * positive(resolution, "AR") / positive(window, "window"))


def speed_by_time(ticks: ArrayLike, resolution: float, clock: float) -> Floats:
    """Return the speed in rad/s for ticks between two counts: ``AR f / n``; infinite where there is no tick.

    Parameters
    ----------
    ticks : array_like
        n, not negative.
    resolution : float
        AR, radians.
    clock : float
        f, hertz.

    Raises
    ------
    InputError
        Resolution or clock is not positive, or ticks are negative.

    Examples
    --------
    >>> math.degrees(float(speed_by_time(500, math.radians(0.36), 1e6)))
    720.0
    """
    n = as_floats(ticks, "ticks", "numbers")
    if np.any(n < 0.0):
        raise InputError("ticks: expected no negative number")
    with np.errstate(divide="ignore"):
        return np.asarray(positive(resolution, "AR") * positive(clock, "clock") / n)


@dataclass(frozen=True)
class Meter:
    """An encoder whose speed is measured in both ways.

    Parameters
    ----------
    pulses : int
        PPR, periods in a turn.
    decoder : Decoder
    window : float
        T, seconds.
    clock : float
        f, hertz.

    Raises
    ------
    InputError
        The numbers are not positive.
    """

    pulses: int
    decoder: Decoder
    window: float
    clock: float

    def __post_init__(self) -> None:
        checked_pulses(self.pulses)
        positive(self.window, "window")
        positive(self.clock, "clock")

    @property
    def resolution(self) -> float:
        """AR, the angle of a count, radians."""
        return angular_resolution(self.pulses, self.decoder.per_period)

    @property
    def quantum(self) -> float:
        """Speed of one count in a window, rad/s: the step of the first reading."""
        return self.resolution / self.window

    def error_by_counts(self, speed: ArrayLike) -> Floats:
        """Return the largest relative error of the first reading at constant speeds: one count, ``AR / (T omega)``.

        The window holds up to a count more, or less, than its length; where the counts are not even, up to as many as
        the largest gap between them has room for.
        """
        return np.asarray((1.0 + self.decoder.unevenness) * self.quantum / np.abs(speed))

    def error_by_time(self, speed: ArrayLike) -> Floats:
        """Return the largest relative error of the second reading at constant speeds: one tick, and uneven counts.

        Between counts that are g apart there are x = g f / omega ticks on average, and up to one more or less: for even
        counts ``1 / (x - 1)``. Where there may be no tick at all, x <= 1, the error is infinite.
        """
        gaps = np.array(self.decoder.gaps)
        mean = gaps / self.pulses * self.clock / np.abs(np.asarray(speed, dtype=np.float64))[..., None]
        # Of huge x, x / (x - 1) - 1 would be 0 by rounding, which no logarithmic axis takes.
        even = TURN / (self.decoder.per_period * gaps)
        above = np.where(mean > 1.0, even / np.maximum(mean - 1.0, ROUNDING), math.inf)
        off = (even - 1.0) + np.stack([above, -even / (mean + 1.0)])
        return np.asarray(np.abs(off).max(axis=(0, -1)))

    @property
    def crossover(self) -> float:
        """Speed at which both readings have the same largest error, of even counts, rad/s.

        There ``n / (f T) = 1 / (n - 1)`` with n ticks between two counts, so that ``n = (1 + sqrt(1 + 4 f T)) / 2``,
        and the speed is ``AR f / n``: about ``AR sqrt(f / T)`` with many ticks. Below it the time between counts is
        finer, above it the number of counts.
        """
        ticks = 0.5 * (1.0 + math.sqrt(1.0 + 4.0 * self.clock * self.window))
        return self.resolution * self.clock / ticks

    def delay_by_counts(self) -> float:
        """Return by how many seconds the first reading is old at the end of a window: it is the mean over that."""
        return 0.5 * self.window

    def delay_by_time(self, speed: float) -> float:
        """Return by how many seconds the second reading is old at a count: half the time between two."""
        return 0.5 * self.resolution / abs(speed)

    def number(self, angles: ArrayLike) -> Whole:
        """Return the number of the last counted edge at or before angles, any shape; edges are numbered in order."""
        periods = np.asarray(angles, dtype=np.float64) * (self.pulses / TURN) + ROUNDING
        whole = np.floor(periods)
        passed = (np.asarray(self.decoder.phases) <= (periods - whole)[..., None]).sum(axis=-1)
        return np.asarray(self.decoder.per_period * whole.astype(np.int64) + passed)

    def place(self, numbers: ArrayLike) -> Floats:
        """Return the angles of counted edges by number, radians; the inverse of `number`."""
        number = np.asarray(numbers, dtype=np.int64) - 1
        D = self.decoder.per_period
        phases = np.asarray(self.decoder.phases)[number % D]
        return np.asarray((number // D + phases) * (TURN / self.pulses))


@dataclass(frozen=True)
class RunUp:
    """A shaft that speeds up evenly, turns at one speed, and slows down evenly to a stop.

    Parameters
    ----------
    speed : float
        rad/s, positive.
    ramp, hold : float
        Seconds of speeding up and of slowing down, and between them.
    start : float
        Angle at the start, radians.
    rest : float
        Seconds for which it stands still in the end.
    """

    speed: float
    ramp: float
    hold: float
    start: float = 0.0
    rest: float = 0.0

    @property
    def moving(self) -> float:
        """Seconds until it stands still."""
        return 2.0 * self.ramp + self.hold

    @property
    def duration(self) -> float:
        """Seconds."""
        return self.moving + self.rest

    def speed_at(self, time: ArrayLike) -> Floats:
        """Return the true speed in rad/s at times, any shape."""
        ends = [0.0, self.ramp, self.ramp + self.hold, self.moving]
        return np.asarray(np.interp(np.asarray(time, dtype=np.float64), ends, [0.0, self.speed, self.speed, 0.0]))

    def angle(self, time: ArrayLike) -> Floats:
        """Return the angle in radians at times, any shape."""
        t = np.clip(np.asarray(time, dtype=np.float64), 0.0, self.moving)
        up, level = np.minimum(t, self.ramp), np.clip(t - self.ramp, 0.0, self.hold)
        down = np.maximum(t - self.ramp - self.hold, 0.0)
        rise = up**2 / (2.0 * self.ramp)
        return np.asarray(self.start + self.speed * (rise + level + down - down**2 / (2.0 * self.ramp)))

    def time_of(self, angles: ArrayLike) -> Floats:
        """Return the times at which angles are passed; those beyond an end are those of the end."""
        way = (np.asarray(angles, dtype=np.float64) - self.start) / self.speed
        whole = self.ramp + self.hold
        way = np.clip(way, 0.0, whole)
        up = np.sqrt(2.0 * self.ramp * way)
        down = self.moving - np.sqrt(2.0 * self.ramp * np.maximum(whole - way, 0.0))
        level = way + 0.5 * self.ramp
        return np.asarray(np.where(way < 0.5 * self.ramp, up, np.where(way > whole - 0.5 * self.ramp, down, level)))


@dataclass(frozen=True)
class Readings:
    """Both readings during a run, as a controller gets them.

    Parameters
    ----------
    meter : Meter
    run : RunUp
    """

    meter: Meter
    run: RunUp

    @cached_property
    def _first(self) -> int:
        return int(self.meter.number(self.run.start))

    def counts(self, time: ArrayLike) -> Whole:
        """Return the counts in the last whole window before times; 0 before the first is over."""
        T = self.meter.window
        ends = np.floor(np.asarray(time, dtype=np.float64) / T + ROUNDING) * T
        inside = self.meter.number(self.run.angle(ends)) - self.meter.number(self.run.angle(ends - T))
        return np.asarray(np.where(ends >= T * (1.0 - ROUNDING), inside, 0))

    def by_counts(self, time: ArrayLike) -> Floats:
        """Return the first reading in rad/s at times; nan before the first window is over."""
        done = np.asarray(time, dtype=np.float64) >= self.meter.window * (1.0 - ROUNDING)
        return np.asarray(np.where(done, self.meter.quantum * self.counts(time), math.nan))

    def ticks(self, time: ArrayLike) -> Whole:
        """Return the ticks between the last two counts before times; -1 where there have not been two."""
        last = self.meter.number(self.run.angle(time))
        ends = [self.run.time_of(self.meter.place(last - back)) for back in (0, 1)]
        late, early = (np.floor(end * self.meter.clock + ROUNDING).astype(np.int64) for end in ends)
        return np.asarray(np.where(last - self._first >= 2, late - early, -1))

    def by_time(self, time: ArrayLike) -> Floats:
        """Return the second reading in rad/s at times; nan before the second count, infinite without a tick.

        It stays as it was while no count comes, also when the shaft stands still.
        """
        ticks = self.ticks(time)
        found = speed_by_time(np.maximum(ticks, 0), self.meter.resolution, self.meter.clock)
        return np.asarray(np.where(ticks >= 0, found, math.nan))
