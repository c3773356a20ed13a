"""The section of an arm, found in pieces, with smaller cells where it is thin, and kept in memory."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.workspace.around import Arcs
from armlab.kin.workspace.crossings import Crossings
from armlab.kin.workspace.ends import Ends
from armlab.kin.workspace.filling import SWEEPS, Filling
from armlab.kin.workspace.first_joint import FirstJoint, first_joint
from armlab.kin.workspace.outline import Outline
from armlab.kin.workspace.section import Section
from armlab.kin.workspace.section_grid import grid_for
from armlab.kin.workspace.section_size import WANTED, is_thin

RESOLUTION = 256
SAMPLES = 262_144
LEAST_RESOLUTION = 16

KEPT = 6
"""Number of finished sections that are kept."""


def sections(
    arm: Arm, resolution: int = RESOLUTION, samples: int = SAMPLES, seed: int = 0, wanted: float = WANTED
) -> Iterator[Section]:
    """Yield the section of an arm, better and better; the last one is finished.

    Between two of them lie at most some 30 ms of work. How many there are depends on the cells that are filled and on
    those at the boundary, each of which is tried a few dozen times; `is_thin` bounds both: an ordinary arm takes a few
    seconds, one that is thin, and so is given the most cells, some twenty. The same arguments give the same sections;
    of an arm that was finished of late only the last is yielded, at once (arms are compared by identity).

    Parameters
    ----------
    arm : Arm
    resolution : int
        Cells along the longer side. It is doubled as often as `is_thin` asks for it.
    samples : int
        Random configurations to begin with; of an arm with joints to spare as many more as there are cells.
    seed : int
    wanted : float
        Error of the size, as a part of it, above which the cells are halved.

    Raises
    ------
    InputError
        A resolution below `LEAST_RESOLUTION`.
    """
    if resolution < LEAST_RESOLUTION:
        raise InputError(f"resolution: expected at least {LEAST_RESOLUTION} cells, got {resolution}")
    kept = _kept(arm, resolution, samples, seed, wanted)
    if not kept.found:
        for found in _sought(arm, resolution, samples, seed, wanted):
            if found.finished:
                kept.found.append(found)
            else:
                yield found
    yield kept.found[-1]


def _sought(arm: Arm, resolution: int, samples: int, seed: int, wanted: float) -> Iterator[Section]:
    """Yield sections until one is finished with `resolution` cells, or with more of them if `is_thin` says so."""
    joint, cells, known = first_joint(arm), resolution, None
    while True:
        for found in _at(joint, cells, samples, seed, known):
            if not found.finished:
                yield found
        yield (known := replace(found, finished=False))
        if not (yield from _showing(known, is_thin(found, resolution, wanted))):
            yield found
            return
        cells *= 2
        # In intervals of s parts are missed where fewer samples tell about a cell; single values lead to each other.
        if not (joint.full or found.grid.single):
            samples *= 2 if found.grid.flat else 4


def _showing(known: Section, work: Generator[None, None, bool]) -> Generator[Section, None, bool]:
    """Yield the known section after each piece of work, and return the result of the work."""
    while True:
        try:
            next(work)
        except StopIteration as done:
            return bool(done.value)
        yield known


def _at(joint: FirstJoint, resolution: int, samples: int, seed: int, known: Section | None) -> Iterator[Section]:
    """Yield sections of a resolution, the last one finished; they start from a coarser one if there is one."""
    rng = np.random.default_rng(seed)
    grid, first = grid_for(joint, resolution, rng)
    if known is not None:
        yield known
    filling = Filling(grid)
    if known is not None:
        yield known
    filling.add(first)
    # The known section is better than a new one at its beginning, and copies of many cells take time.
    yield known or _section(filling, None)
    if known is not None:
        for _ in filling.take(known.at(*np.nonzero(known.filled))):
            yield known
    for _ in _filled(filling, samples, rng):
        yield known or _section(filling, None)
    crossings = Crossings(filling)
    for _ in crossings.find():
        yield known or _section(filling, None)
    ends = None if filling.around is None else Ends(filling, rng)
    for _ in ends.find() if ends is not None else ():
        yield known or _section(filling, None)
    yield _section(filling, crossings, None if ends is None else ends.arcs())


@dataclass(frozen=True)
class _Kept:
    """The finished section of an arm, once there is one."""

    found: list[Section] = field(default_factory=list)


@lru_cache(maxsize=KEPT)
def _kept(arm: Arm, resolution: int, samples: int, seed: int, wanted: float) -> _Kept:
    return _Kept()


def section(
    arm: Arm, resolution: int = RESOLUTION, samples: int = SAMPLES, seed: int = 0, wanted: float = WANTED
) -> Section:
    """Return the finished section of an arm; see `sections` for the arguments."""
    *_, last = sections(arm, resolution, samples, seed, wanted)
    return last


def _filled(filling: Filling, samples: int, rng: np.random.Generator) -> Iterator[None]:
    yield from filling.sample(samples, rng)
    yield from filling.flood()
    yield from filling.centre()
    for _ in range(SWEEPS):
        yield from filling.sweep(rng)
        yield from filling.flood()
        yield from filling.centre()


def _section(filling: Filling, crossings: Crossings | None, arcs: Arcs | None = None) -> Section:
    grid = filling.grid
    # When it is finished nothing is added any more.
    filled, row, q = filling.copies() if crossings is None else filling.finished()
    filled, row = filled.reshape(grid.shape), row.reshape(grid.shape)
    inside = filled if crossings is None else crossings.inside
    rows, columns = grid.shape
    along_u = np.full((rows - 1, columns), 0.5) if crossings is None else crossings.along_u
    along_v = np.full((rows, columns - 1), 0.5) if crossings is None else crossings.along_v
    outline = Outline(grid.u, grid.v, inside, along_u, along_v)
    return Section(grid, filled, row, q, outline, filling.around, arcs, crossings is not None)
