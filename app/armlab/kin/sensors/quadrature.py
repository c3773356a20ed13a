"""Incremental encoders: tracks A and B a quarter of a period apart, an index track Z, and what a counter makes of them.

A turn has P periods. Angles are in radians, positive in the direction in which A leads B. A quarter of a period, 90
electrical degrees, is the smallest step that can be seen: quarter k begins at k / (4 P) turns, and there (A, B) is
`LEVELS` [k mod 4].

References
----------
Notes, sections 2.3.1 and 2.3.2. There A before B and B before A are both called clockwise: they are opposite
directions. The rising edges of A and of B, counted for D = 2, lie 90 and 270 electrical degrees apart; both edges of A
lie 180 apart. AR is degrees for one count (2.45), not counts for a turn.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import whole_number, wrong
from armlab.kin.sensors.absolute import TURN
from armlab.registry import Registry

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]

LEVELS: Whole = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
"""A and B in the four quarters of a period, in the order in which A leads."""

MOST_PULSES = 1_000_000
"""Largest number of periods of a turn."""

ON_THE_EDGE = 1e-9
"""Part of a quarter by which an angle may lie below an edge and still belong to the quarter above: rounding."""


def checked_pulses(pulses: object) -> int:
    """Return the periods of a turn; `InputError` when they are not 1 to `MOST_PULSES`."""
    if whole_number(pulses, "PPR", 1) > MOST_PULSES:
        raise wrong("PPR", f"at most {MOST_PULSES}", pulses)
    return int(pulses)  # type: ignore[call-overload, no-any-return]


def angular_resolution(pulses: int, per_period: int = 1) -> float:
    """Return the angle of one count in radians: ``AR = 2 pi / (PPR D)``.

    Parameters
    ----------
    pulses : int
        PPR, periods in a turn.
    per_period : int
        D, counts in a period.

    Raises
    ------
    InputError
        Not positive whole numbers.

    References
    ----------
    Notes 2.44-2.45. The text before 2.44 calls AR a number of pulses for a round, which is PPR.

    Examples
    --------
    >>> [round(math.degrees(angular_resolution(1000, D)), 2) for D in (1, 2, 4)]
    [0.36, 0.18, 0.09]
    """
    return TURN / (checked_pulses(pulses) * whole_number(per_period, "D", 1))


def electrical(angle: ArrayLike, pulses: int) -> Floats:
    """Return electrical angles in radians, PPR of which are one mechanical one (notes 2.41)."""
    return np.asarray(np.asarray(angle, dtype=np.float64) * checked_pulses(pulses))


def quarter_of(angle: ArrayLike, pulses: int) -> Whole:
    """Return the number of the quarter in which angles lie, of any shape; it goes on over whole turns."""
    quarters = np.asarray(angle, dtype=np.float64) * (4 * checked_pulses(pulses) / TURN)
    return np.asarray(np.floor(quarters + ON_THE_EDGE)).astype(np.int64)


def levels_of(quarters: ArrayLike) -> Whole:
    """Return A and B in quarters (...), shape (..., 2)."""
    return np.asarray(LEVELS[np.asarray(quarters) % 4])


def index_of(quarters: ArrayLike, pulses: int) -> NDArray[np.bool_]:
    """Return whether Z is high: in one quarter of a turn, that at angle zero."""
    return np.asarray(np.asarray(quarters) % (4 * checked_pulses(pulses)) == 0)


@dataclass(frozen=True)
class Decoder:
    """A rule that counts by the order of the edges of A and B.

    Parameters
    ----------
    key, title : str
    up, down : tuple of int
        What is added at the edge from each quarter of a period to the next one, and on the way back over it.

    Attributes
    ----------
    per_period : int
        D, the number of counts in a period.
    """

    key: str
    title: str
    up: tuple[int, int, int, int]
    down: tuple[int, int, int, int]

    @property
    def per_period(self) -> int:
        """D: how many counts a period makes in the direction in which A leads."""
        return sum(self.up)

    @property
    def phases(self) -> tuple[float, ...]:
        """Places of the counted edges in a period, parts of it, in the direction in which A leads."""
        return tuple(0.25 * (k + 1) for k, step in enumerate(self.up) if step)

    @property
    def gaps(self) -> tuple[float, ...]:
        """Electrical angles from each counted edge to the next one, radians."""
        first, *_ = at = self.phases
        return tuple(TURN * (after - before) for before, after in zip(at, (*at[1:], first + 1.0), strict=True))

    @property
    def unevenness(self) -> float:
        """Largest gap, relative to equal gaps, minus 1; zero when the counts divide the period evenly."""
        return max(self.gaps) * self.per_period / TURN - 1.0

    def steps(self, levels: ArrayLike) -> Whole:
        """Return what is added from each pair of levels to the next one.

        Parameters
        ----------
        levels : array_like, shape (N, 2)
            A and B, 0 or 1, one after the other.

        Returns
        -------
        ndarray, shape (N - 1,)
            A change of both at once tells nothing of the direction and adds nothing; see `lost`.

        Raises
        ------
        InputError
            Not levels.

        Examples
        --------
        >>> DECODERS["x4"].steps([[0, 0], [1, 0], [1, 1], [1, 0]]).tolist()
        [1, 1, -1]
        """
        quarter = _quarters(levels)
        before, change = quarter[:-1], np.diff(quarter) % 4
        up, down = np.array(self.up)[before], np.array(self.down)[before - 1]
        return np.asarray(np.where(change == 1, up, np.where(change == 3, down, 0)))

    def count(self, levels: ArrayLike, index: ArrayLike | None = None) -> Whole:
        """Return the counter after each pair of levels, (N,), from 0 at the first.

        Parameters
        ----------
        levels : array_like, shape (N, 2)
        index : array_like of bool, shape (N,), optional
            Z beside them: where it rises the counter is set to 0.
        """
        counted = np.concatenate([[0], np.cumsum(self.steps(levels))])
        if index is None:
            return counted
        high = np.asarray(index, dtype=bool)
        rises = np.flatnonzero(high[1:] & ~high[:-1]) + 1
        last = np.searchsorted(rises, np.arange(len(counted)), side="right")
        return np.asarray(counted - np.concatenate([[0], counted[rises]])[last])

    def one_way(self) -> Decoder:
        """Return the rule of the notes, to which both orders of the edges are the same direction."""
        return replace(self, down=(abs(self.down[0]), abs(self.down[1]), abs(self.down[2]), abs(self.down[3])))

    def true_count(self, quarters: ArrayLike) -> Whole:
        """Return what a rule that counts back over the same edges has counted in quarters, from 0 at quarter 0.

        This is the number of its edges between there and here; no levels are looked at.
        """
        quarter = np.asarray(quarters)
        within = np.concatenate([[0], np.cumsum(self.up)[:-1]])
        return np.asarray(self.per_period * (quarter // 4) + within[quarter % 4])


def lost(levels: ArrayLike) -> int:
    """Return how many changes of A and B at once are among levels (N, 2): edges that were too fast for the counter."""
    return int(np.count_nonzero(np.diff(_quarters(levels)) % 4 == 2))


def lead(levels: ArrayLike) -> int:
    """Return 1 where A leads B in levels (N, 2), -1 where B leads A, 0 where that is not to be seen.

    A leads when its rising edges come while B is low. The majority of the rising edges of A decides.
    """
    seen = _checked_levels(levels)
    rises = (seen[1:, 0] > seen[:-1, 0]) & (seen[1:, 1] == seen[:-1, 1])
    return int(np.sign(np.sum(1 - 2 * seen[1:, 1][rises])))


DECODERS = Registry(
    "decoder",
    (
        Decoder("x1", "×1: one edge of A", (1, 0, 0, 0), (-1, 0, 0, 0)),
        Decoder("x2", "×2: both edges of A", (1, 0, 1, 0), (-1, 0, -1, 0)),
        Decoder("x2_notes", "×2: rising edges of A and of B", (1, 1, 0, 0), (-1, -1, 0, 0)),
        Decoder("x4", "×4: all edges of A and B", (1, 1, 1, 1), (-1, -1, -1, -1)),
        # A rises from quarter 0 to 1 forwards, and from 3 to 2 on the way back: two different places of the disk.
        Decoder("rising", "rising edges of A, direction by B", (1, 0, 0, 0), (0, 0, -1, 0)),
        Decoder("alone", "rising edges of A alone", (1, 0, 0, 0), (0, 0, 1, 0)),
    ),
)
"""Rules by key: four that count back over the edges over which they came, and two that many beginners write."""

HONEST = ("x1", "x2", "x2_notes", "x4")
"""Keys of the rules whose count depends only on where the disk is."""


@dataclass(frozen=True)
class Signals:
    """A, B and Z over time, as edges.

    Attributes
    ----------
    times : ndarray, shape (M,)
        Of the edges, seconds, in order.
    quarters : ndarray, shape (M + 1,)
        Quarter before the first edge, and after each.
    """

    times: Floats
    quarters: Whole

    @cached_property
    def levels(self) -> Whole:
        """A and B, (M + 1, 2)."""
        return levels_of(self.quarters)


@dataclass(frozen=True)
class Motion:
    """A disk that is turned back and forth at one speed.

    Parameters
    ----------
    start : float
        Angle at the start, radians.
    moves : tuple of float
        Angles by which it is turned one after the other, radians.
    speed : float
        rad/s, positive.

    Raises
    ------
    InputError
        The speed is not positive, or a number is not finite.
    """

    start: float
    moves: tuple[float, ...]
    speed: float

    def __post_init__(self) -> None:
        if not all(map(math.isfinite, (self.start, *self.moves))):
            raise wrong("moves", "finite angles", self.moves)
        if not (math.isfinite(self.speed) and self.speed > 0.0):
            raise wrong("speed", "a positive number", self.speed)

    @cached_property
    def angles(self) -> Floats:
        """Angles between the moves, and at both ends, radians."""
        return np.asarray(self.start + np.concatenate([[0.0], np.cumsum(self.moves)]))

    @cached_property
    def times(self) -> Floats:
        """Times of `angles`, seconds."""
        return np.concatenate([[0.0], np.cumsum(np.abs(self.moves)) / self.speed])

    @property
    def duration(self) -> float:
        """Seconds."""
        return float(self.times[-1])

    def at(self, time: ArrayLike) -> Floats:
        """Return the angle in radians at times in seconds, of any shape."""
        return np.asarray(np.interp(np.asarray(time, dtype=np.float64), self.times, self.angles))

    def edges(self, pulses: int) -> int:
        """Return how many edges of A and B come by."""
        return int(np.abs(np.diff(quarter_of(self.angles, pulses))).sum())

    def signals(self, pulses: int) -> Signals:
        """Return A, B and Z of an encoder with so many periods in a turn."""
        quarters, at = quarter_of(self.angles, pulses), self.angles * (4 * pulses / TURN)
        times, passed = [np.empty(0)], [quarters[:1]]
        for k in range(len(self.moves)):
            here, there = quarters[k], quarters[k + 1]
            if here == there:
                continue
            # Up, edge j lies at the beginning of quarter j; down, at the beginning of the quarter that is left.
            step = 1 if there > here else -1
            edges = np.arange(here + 1, there + 1) if step > 0 else np.arange(here, there, -1)
            part = np.clip((edges - at[k]) / (at[k + 1] - at[k]), 0.0, 1.0)
            # Rounding must not put an edge behind the move in which it comes by.
            at_edges = self.times[k] + part * (self.times[k + 1] - self.times[k])
            times.append(np.minimum(at_edges, self.times[k + 1]))
            passed.append(edges if step > 0 else edges - 1)
        return Signals(np.concatenate(times), np.concatenate(passed))


def turned_on(moves: Sequence[float], by: float) -> tuple[float, ...]:
    """Return moves with one more; as a part of the last one where it goes on in the same direction.

    >>> turned_on((2.0, -1.0), -0.5), turned_on((2.0, -1.0), 0.5)
    ((2.0, -1.5), (2.0, -1.0, 0.5))
    """
    if by == 0.0:
        return tuple(moves)
    if moves and moves[-1] * by > 0.0:
        return (*moves[:-1], moves[-1] + by)
    return (*moves, by)


def _checked_levels(levels: ArrayLike) -> Whole:
    seen = np.asarray(levels)
    if seen.ndim != 2 or seen.shape[1] != 2 or not len(seen) or not np.isin(seen, (0, 1)).all():
        raise InputError("levels: expected rows of A and B, each 0 or 1")
    return seen.astype(np.int64)


def _quarters(levels: ArrayLike) -> Whole:
    """Return the quarters of a period, 0 to 3, of levels (N, 2)."""
    a, b = _checked_levels(levels).T
    return np.asarray(np.where(b == 1, 3 - a, a))
