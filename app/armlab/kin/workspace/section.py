"""The section of a workspace: what can be reached in the two coordinates that joint 1 does not change.

All that an arm reaches inside its limits follows from it (see `armlab.kin.workspace.first_joint`): of an arm whose
first joint turns it is the side view of a data sheet, the (rho, z) half-plane. It is filled from samples, then by
inverse kinematics from cell to cell; its boundary is found by inverse kinematics too. What no search came upon counts
as out of reach: a part that no sample hit and that hangs together with nothing that was hit is missing.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats
from armlab.kin.workspace.around import Arcs, Around
from armlab.kin.workspace.boundary import Boundary, To
from armlab.kin.workspace.crossings import Crossings
from armlab.kin.workspace.ends import Ends
from armlab.kin.workspace.filling import SWEEPS, Filling
from armlab.kin.workspace.first_joint import FirstJoint, first_joint
from armlab.kin.workspace.nearest import nearest_configuration
from armlab.kin.workspace.outline import Outline
from armlab.kin.workspace.section_grid import Grid, grid_for
from armlab.kin.workspace.section_size import WANTED, is_thin

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]

RESOLUTION = 256
SAMPLES = 262_144
LEAST_RESOLUTION = 16

KEPT = 6
"""Finished sections that are remembered."""


@dataclass(frozen=True, eq=False)
class Section:
    """What an arm reaches, as a section.

    Attributes
    ----------
    grid : Grid
    filled : ndarray, shape (Nu, Nv)
        Cells with a configuration whose point lies in them.
    row : ndarray, shape (Nu, Nv)
        Where among those configurations it is; -1 for a cell that is not filled.
    configurations : ndarray, shape (rows, n)
        Rad and m, with q_1 = 0 even where joint 1 must not be there.
    outline : Outline
        The region; until it is finished, roughly.
    around : Around or None
        Which s are reached at q_1 = 0; None where joint 1 turns all the way round, and all are. It is counted on while
        the section is not finished.
    arcs : Arcs or None
        What joint 1 makes of it; None where all s are covered, and until it is finished.
    finished : bool
    """

    grid: Grid
    filled: Bools
    row: NDArray[np.int32]
    configurations: Floats
    outline: Outline
    around: Around | None
    arcs: Arcs | None
    finished: bool

    @property
    def joint(self) -> FirstJoint:
        """Coordinates u, v, s and what joint 1 does."""
        return self.grid.joint

    @property
    def u(self) -> Floats:
        """Centres of the cells, shape (Nu,), metres."""
        return self.grid.u

    @property
    def v(self) -> Floats:
        """Centres of the cells, shape (Nv,), metres; one for a planar arm."""
        return self.grid.v

    @property
    def step(self) -> float:
        """Side of a cell, metres."""
        return self.grid.step

    def at(self, i: Indices, j: Indices) -> Floats:
        """Return the configurations (k, n) that fill some filled cells, by their row (k,) and column (k,)."""
        return np.asarray(self.configurations[self.row[i, j]])

    @cached_property
    def covered(self) -> Floats:
        """How much of s is covered at each cell, (Nu, Nv), rad where joint 1 turns and m where it slides."""
        if self.arcs is None:
            return np.where(self.filled, 2.0 * np.pi, 0.0)
        rows, columns = self.filled.shape
        wide = self.grid.coarser
        coarse = self.arcs.covered.reshape(-(-rows // wide), -(-columns // wide))
        return np.where(self.filled, np.repeat(np.repeat(coarse, wide, 0), wide, 1)[:rows, :columns], 0.0)

    @cached_property
    def boundary(self) -> Boundary:
        """Where it ends."""
        return Boundary(self.grid, self.outline, self.arcs, self.filled)

    @property
    def contours(self) -> tuple[Floats, ...]:
        """Closed polylines (k, 2) round what is reached in (u, v), metres; of a planar arm there and back along u."""
        return self.boundary.contours

    def holds(self, points: ArrayLike) -> Bools:
        """Return which points of the world, shape (..., 3), are reached inside the limits.

        Points nearer than a cell to the boundary may be told wrong; where joint 1 is limited and s is counted in cells
        `Grid.coarser` times as large, nearer than one and a half of those.
        """
        return self.boundary.holds(np.asarray(points, dtype=np.float64))

    def distance(self, point: ArrayLike) -> To:
        """Return how far a point of the world, shape (3,), is inside the boundary (+) or outside it (-).

        To about a cell; where joint 1 is limited, and the nearest boundary is where what it covers changes, to about
        one in which s is counted.

        Raises
        ------
        InputError
            Not three finite numbers.
        """
        return self.boundary.distance(finite_floats(point, "point", (3,), "3 finite numbers"))

    def nearest(self, point: ArrayLike) -> Floats:
        """Return a configuration (n,) inside the limits whose tool point is as near to a point as any that was found.

        Joints that do not move the tool point are as near to 0 as they can be.

        Raises
        ------
        InputError
            Not three finite numbers, or nothing has been reached yet.
        """
        given = finite_floats(point, "point", (3,), "3 finite numbers")
        if not self.filled.any():
            raise InputError("section: no cell has been reached yet")
        return nearest_configuration(self, given)


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
    """Yield sections until one is finished with `resolution` cells, or with as many more as `is_thin` asks for."""
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
    """Yield what is known after each piece of work, and return what it returns."""
    while True:
        try:
            next(work)
        except StopIteration as done:
            return bool(done.value)
        yield known


def _at(joint: FirstJoint, resolution: int, samples: int, seed: int, known: Section | None) -> Iterator[Section]:
    """Yield sections with so many cells, the last one finished; begun from one with fewer where there is one."""
    rng = np.random.default_rng(seed)
    grid, first = grid_for(joint, resolution, rng)
    if known is not None:
        yield known
    filling = Filling(grid)
    if known is not None:
        yield known
    filling.add(first)
    # What is there already is better than what is begun anew, and copies of many cells take their time.
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
    """Return the finished section of an arm. Arguments as of `sections`."""
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
