"""Counts of every rule over time, and how far each is from the truth at the present time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.sensor.incremental.state import Incremental, present_time
from armlab.kin.sensors.absolute import TURN
from armlab.kin.sensors.quadrature import DECODERS, ON_THE_EDGE, angular_resolution, index_of, lead, quarter_of
from armlab.session.state import State

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]


@dataclass(frozen=True)
class Counted:
    """The count of one rule at one time.

    Attributes
    ----------
    key : str
        Of the rule.
    per_period : int
        D.
    resolution : float
        AR, radians.
    count : int
    missed : int
        How many counts it is above those that the same edges give when each is counted back on the way back.
    """

    key: str
    per_period: int
    resolution: float
    count: int
    missed: int

    @property
    def angle(self) -> float:
        """The angle that the count stands for, radians."""
        return self.count * self.resolution


@dataclass(frozen=True)
class Now:
    """The encoder at the present time.

    Attributes
    ----------
    time, angle : float
        Seconds, radians.
    quarter : int
        Number of the quarter in which the disk stands.
    counted : dict of str to Counted
        By the key of the rule.
    direction : int
        1 if A led B at the last edge, -1 if B led A, 0 before the first.
    found : bool
        Whether Z has come by.
    """

    time: float
    angle: float
    quarter: int
    counted: dict[str, Counted]
    direction: int
    found: bool


def counts_of(part: Incremental, key: str) -> Whole:
    """Return the counter of a rule before the first edge and after each, (M + 1,)."""
    index = index_of(part.signals.quarters, part.pulses) if part.index else None
    return part.decoder_of(key).count(part.signals.levels, index)


def _every_count(state: State) -> dict[str, Whole]:
    return {key: counts_of(state[Incremental], key) for key in DECODERS}


def now(state: State) -> Now:
    """Return what there is at the present time."""
    part, time = state[Incremental], present_time(state)
    signals = part.signals
    passed = int(np.searchsorted(signals.times, time, side="right"))
    quarters = signals.quarters[: passed + 1]
    high = index_of(quarters, part.pulses)
    rises = np.flatnonzero(high[1:] & ~high[:-1]) + 1
    found = bool(len(rises))
    counted = {}
    for key, counts in state.derived(_every_count).items():
        decoder = part.decoder_of(key)
        place = decoder.true_count(quarters[-1])
        turn = part.pulses * decoder.per_period
        if part.index and found:
            # The count is that of the place; whole turns do not count.
            missed = (int(counts[passed] - place) + turn // 2) % turn - turn // 2
        else:
            missed = int(counts[passed] - (place - decoder.true_count(quarters[0])))
        resolution = angular_resolution(part.pulses, decoder.per_period)
        counted[key] = Counted(key, decoder.per_period, resolution, int(counts[passed]), missed)
    direction = int(np.sign(quarters[-1] - quarters[-2])) if passed else 0
    return Now(time, float(part.motion.at(time)), int(quarters[-1]), counted, direction, found)


def led(part: Incremental) -> int:
    """Return 1 where A leads B at most of its rising edges in all moves, -1 where B leads A, 0 for neither."""
    return lead(part.signals.levels)


def electrical_angle(part: Incremental, angle: float) -> float:
    """Return the electrical angle within a period, radians, 0 up to less than a turn."""
    found = float(angle * part.pulses % TURN)
    # An angle that is below an edge by rounding only belongs to the period above, as its quarter does.
    return 0.0 if TURN - found <= 0.25 * TURN * ON_THE_EDGE else found


def steps(part: Incremental, values: Floats | Whole, low: float, high: float) -> tuple[Floats, Floats]:
    """Return the corners of what is constant between edges, (k,) times and values, from one time to another."""
    times = part.signals.times
    first, last = (int(np.searchsorted(times, at, side="right")) for at in (low, high))
    at = np.concatenate([[low], np.repeat(times[first:last], 2), [high]])
    return at, np.repeat(np.asarray(values[first : last + 1], dtype=float), 2)


def quarter_at(part: Incremental, angle: float) -> int:
    """Return the number of the quarter at an angle."""
    return int(quarter_of(angle, part.pulses))
