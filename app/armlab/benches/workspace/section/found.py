"""The section of a workspace as found for the page: cells, size, reach, and the values that colour them."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import wraps
from typing import TypeVar
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.work import Work
from armlab.kin.workspace.measures import measure_named
from armlab.kin.workspace.section import Section
from armlab.kin.workspace.section_grid import random_configurations
from armlab.kin.workspace.section_size import Reach, Size, reaching, sizing
from armlab.kin.workspace.sections import sections

Floats = NDArray[np.float64]
T = TypeVar("T")

REACH = "reach"
"""Key of the colour that shows only the reached region."""

USUAL = 160
"""Number of pieces of work for most arms, which the progress is measured by."""

SHOWN, SELDOM = 8, 32
"""Number of pieces of work between two pictures at first, and later."""

SAMPLES, PIECE = 393_216, 8_192
"""Number of random configurations over which a measure is averaged, and of those in one piece of work."""

TOGETHER = 1 << 18
"""Number of cells whose means are taken in one piece of work."""

QUANTILES = (0.01, 0.99)
"""Quantiles of the values of a measure at which its scale of colours begins and ends."""


@dataclass(frozen=True, eq=False)
class Question:
    """Request for a section.

    Attributes
    ----------
    arm : Arm
    colour : str
        `REACH`, or the key of a measure.
    known : Found or None
        What there is of this arm.
    """

    arm: Arm
    colour: str
    known: Found | None


@dataclass(frozen=True, eq=False)
class Found:
    """Results for a section so far.

    Attributes
    ----------
    arm : Arm
    section : Section
    done : float
        0 to 1; about.
    size : Size or None
    reach : Reach or None
        None until the section is finished.
    colour : str
    values : ndarray, shape (Nu, Nv), or None
        Mean of the measure over random configurations in and beside each cell; nan where there are none. None with
        `REACH`.
    low, high : float
        Ends of the scale of colours.
    coloured : bool
        Whether the values are all there will be.
    """

    arm: Arm
    section: Section
    done: float
    size: Size | None = None
    reach: Reach | None = None
    colour: str = REACH
    values: Floats | None = None
    low: float = 0.0
    high: float = 1.0
    coloured: bool = False

    @property
    def finished(self) -> bool:
        """Whether the section is finished, and its size known."""
        return self.size is not None


def once_each(follows: Callable[[Found], T]) -> Callable[[Found], T]:
    """Return a function that computes a result of what was found once, and keeps it as long as the latter.

    A whole class looks at sections at the same time, each with findings of their own.
    """
    known: WeakKeyDictionary[Found, T] = WeakKeyDictionary()

    @wraps(follows)
    def kept(found: Found) -> T:
        if found not in known:
            known[found] = follows(found)
        return known[found]

    return kept


def finding(question: Question) -> Iterator[Found | None]:
    """Yield the results so far, None if there is nothing new, in pieces of work of some 30 ms."""
    found = question.known
    if found is None or not found.finished:
        for found in _sought(question.arm):
            yield found
    assert found is not None
    yield from _coloured(replace(found, colour=question.colour, values=None, coloured=False), question.colour)


def _sought(arm: Arm) -> Iterator[Found | None]:
    # The formulas of an arm are made when they are first used.
    arm.jacobian(np.zeros((1, arm.n)))
    yield None
    arm.position(np.zeros((1, arm.n)))
    yield None
    following = 0
    for piece, section in enumerate(sections(arm)):
        if piece < following and not section.finished:
            yield None
            continue
        # Often at first, when much is filled with every piece; each picture costs all who are in the lab some time.
        following = piece + min(max(SHOWN, piece // 4), SELDOM)
        _ = section.contours  # kept: what shows them must not compute them in the time of everybody
        yield None
        if section.finished:
            volume = yield from sizing(section)
            yield from section.boundary.preparing()
            yield Found(arm, section, 1.0, volume, (yield from reaching(section)))
        else:
            yield Found(arm, section, min(piece / USUAL, 0.98))


def _coloured(found: Found, colour: str) -> Iterator[Found | None]:
    if colour == REACH:
        yield replace(found, coloured=True)
        return
    section, measure, arm = found.section, measure_named(colour), found.arm
    rows, columns = section.filled.shape
    # With an empty cell on each side, so that neighbours are summed without copies.
    total, count = (np.zeros((rows + 2, columns + 2)) for _ in range(2))
    for k, q in enumerate(itertools.chain(_filled(section), _random(section))):
        cells, on = section.grid.cell_of(section.joint.split(arm.position(q))[:, :2])
        at = (cells // columns + 1) * (columns + 2) + cells % columns + 1
        for begin in range(0, len(q), measure.piece):
            some = slice(begin, begin + measure.piece)
            values = measure.values(arm, q[some])[on[some]].astype(np.float64)
            np.add.at(total.reshape(-1), at[some][on[some]], values)
            np.add.at(count.reshape(-1), at[some][on[some]], 1.0)
            yield None
        if k % SHOWN == 0:
            yield (yield from _with_means(found, colour, total, count))
    yield replace((yield from _with_means(found, colour, total, count)), coloured=True)


def _filled(section: Section) -> Iterator[Floats]:
    i, j = np.nonzero(section.filled)
    for first in range(0, len(i), PIECE):
        yield section.at(i[first : first + PIECE], j[first : first + PIECE])


def _random(section: Section) -> Iterator[Floats]:
    rng = np.random.default_rng(0)
    for _ in range(SAMPLES // PIECE):
        yield random_configurations(section.joint, PIECE, rng)


def _with_means(found: Found, colour: str, total: Floats, count: Floats) -> Work[Found]:
    """Return, after pieces of work, the results with the mean of a measure in and beside each cell."""
    filled = found.section.filled
    values, height = np.empty(filled.shape), max(TOGETHER // filled.shape[1], 1)
    for first in range(0, len(filled), height):
        some, wide = slice(first, first + height), slice(first, first + height + 2)
        counted = _summed(count[wide])
        values[some] = np.where(counted > 0.0, _summed(total[wide]) / np.maximum(counted, 1.0), np.nan)
        yield
    known = values[filled & ~np.isnan(values)]
    low, high = (float(end) for end in np.quantile(known, QUANTILES)) if len(known) else (0.0, 1.0)
    return replace(found, colour=colour, values=values, low=low, high=high)


def _summed(wide: Floats) -> Floats:
    """Return the sums over each cell and its neighbours, without the cells at the edge."""
    rows = wide[:-2] + wide[1:-1] + wide[2:]
    return np.asarray(rows[:, :-2] + rows[:, 1:-1] + rows[:, 2:])
