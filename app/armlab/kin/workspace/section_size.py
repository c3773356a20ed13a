"""The size of a workspace and its reach, from its section."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.work import Work, result_of
from armlab.kin.workspace.boundary import lonely, with_axis
from armlab.kin.workspace.crossings import fineness
from armlab.kin.workspace.extremes import Objective, climbed
from armlab.kin.workspace.first_joint import FirstJoint
from armlab.kin.workspace.outline import Outline
from armlab.kin.workspace.section import Section
from armlab.kin.workspace.section_grid import PLANAR_FINER, random_configurations

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

STARTS = 2
"""Number of cells from which the way to an extreme begins."""

LOOKED_AT = 256
FINEST, FINEST_OF_ONE = 1e-3, 5e-6
"""Least stated relative error of the size, and of one that follows from a single number: less could not be verified."""

SAFETY = 1.0
"""Factor from the change of the size, when three of four places are left out, to its error."""

WANTED = 0.01
"""Relative error of the size above which smaller cells are used."""

MOST_FILLED, MOST_CELLS = 4.0, 64.0
"""Largest number of filled cells and of all cells at which they are halved, as multiples of the resolution squared."""

RANK = 1e-9
"""Singular value, relative to the reach, below which it counts as zero."""


@dataclass(frozen=True)
class Size:
    """Volume of a workspace, or the area of a planar one.

    Attributes
    ----------
    value, error : float
        Value and estimated error, in the unit (see `size`).
    unit : "m³" or "m²"
    """

    value: float
    error: float
    unit: Literal["m³", "m²"]


@dataclass(frozen=True)
class Reach:
    """The reach of an arm, metres.

    Attributes
    ----------
    inner, outer : float
        Least and largest u: distances from the axis of a joint 1 that turns.
    low, high : float
        Least and largest v: heights along that axis, from the point of it that is nearest to frame 0.
    farthest : float
        Largest distance from that point in the section.
    """

    inner: float
    outer: float
    low: float
    high: float
    farthest: float


def size(section: Section) -> Size:
    """Return the volume that an arm reaches; of a planar arm the area.

    Pappus: V = integral of (length of the path on which joint 1 carries a place of the section) over the section, with
    the boundary inside cells found by inverse kinematics, and what joint 1 covers at one place of each coarse cell.

    The error is an estimate, not a bound: the root mean square of what changes when the outline is known at every
    second centre alone, and s at every second place, for all such choices, which is some three times what one expects;
    what the crossings of the boundary may be off; and filled cells that lie too much by themselves to be counted. It
    says nothing of parts that no search came upon. ``python3 benchmarks volume`` holds it against a judge.

    The time it takes grows with the cells of the grid, filled or not; `MOST_CELLS` bounds them.
    """
    return result_of(sizing(section))


def sizing(section: Section) -> Work[Size]:
    """Do the same as `size` in pieces of at most some 30 ms."""
    grid = section.grid
    unit: Literal["m³", "m²"] = "m²" if grid.flat else "m³"
    if has_no_size(section):
        return Size(0.0, 0.0, unit)
    yield
    pieces = _pieces(section, section.outline)
    yield
    covered = section.covered
    yield
    value = pieces.times(covered)
    yield
    _ = section.contours
    yield
    error = _edges(section)
    yield
    error += _alone(section)
    yield
    error += yield from _outlined(section, value)
    if section.arcs is not None:
        error += yield from _turning(section, pieces, value)
    one = grid.flat and section.arcs is None
    error = max(error, (FINEST_OF_ONE if one else FINEST) * value)
    return Size(value, error, unit)


def is_thin(section: Section, resolution: int, wanted: float) -> Work[bool]:
    """Return, after pieces of work, whether cells of half the side are wanted, and few enough.

    They would make the error smaller, which is too large.

    A thin section fills few cells, and needs smaller ones to have as many as an ordinary arm. The cost is bounded by
    numbers of cells: when these are reached, the error stays as large as `size` states.

    Parameters
    ----------
    section : Section
        Finished.
    resolution : int
        Resolution with which the section was begun.
    wanted : float
        Error as a part of the size that is small enough.
    """
    across = resolution * (PLANAR_FINER if section.grid.flat else 1)
    usual = across if section.grid.flat else across**2
    more = 2 if section.grid.flat else 4
    if more * section.filled.sum() > MOST_FILLED * usual or more * section.filled.size > MOST_CELLS * usual:
        return False
    found = yield from sizing(section)
    return found.error > wanted * found.value


def reach(section: Section) -> Reach:
    """Return the reach of an arm: maxima over its configurations, begun from the outermost cells."""
    return result_of(reaching(section))


def reaching(section: Section) -> Work[Reach]:
    """Do the same as `reach` in pieces of at most some 30 ms."""
    i, j = np.nonzero(section.filled)
    q = section.at(i, j)
    uv = section.joint.split(section.joint.arm.position(q))[:, :2]
    yield
    ends, found = section.grid.extremes, []
    for side, sign in ((0, -1.0), (0, 1.0), (1, -1.0), (1, 1.0)):
        yield
        found.append(_farthest(section, q, uv, _along(side, sign)) * sign)
    yield
    farthest = _farthest(section, q, uv, lambda uv: np.hypot(uv[:, 0], uv[:, 1]))
    inner, outer, low, high = found
    return Reach(
        min(inner, float(ends[0, 0])),
        max(outer, float(ends[0, 1])),
        min(low, float(ends[1, 0])),
        max(high, float(ends[1, 1])),
        farthest,
    )


def _along(side: int, sign: float) -> Objective:
    return lambda uv: np.asarray(sign * uv[:, side])


def _farthest(section: Section, q: Floats, uv: Floats, objective: Objective) -> float:
    """Return the largest value of an objective, begun from configurations (k, n) at places (k, 2)."""
    joint = section.joint
    starts = q[np.argsort(-objective(uv))[:STARTS]]
    ends = np.array([climbed(joint, start, objective) for start in starts])
    return float(objective(joint.split(joint.arm.position(ends))[:, :2]).max())


def has_no_size(section: Section) -> bool:
    """Return whether the tool stays on a line, where areas are measured, or on a surface, where volumes are."""
    return dimension(section.joint) < (2 if section.grid.flat else 3)


def dimension(joint: FirstJoint) -> int:
    """Return the dimension of what the tool point reaches, 0 to 3; a joint between equal limits adds nothing to it."""
    arm = joint.arm
    q = random_configurations(joint, LOOKED_AT, np.random.default_rng(0))
    # Joint 1 stands at 0 there, inside its limits or not: it turns the whole Jacobian and changes no rank.
    scale = np.where(arm.revolute, 1.0, arm.length_scale) * (np.ptp(arm.limits, axis=1) > 0.0)
    values = np.linalg.svd(arm.jacobian(q)[:, :3] * scale, compute_uv=False).max(axis=0)
    return int((values > RANK * (arm.reach or 1.0)).sum())


class _Pieces(NamedTuple):
    """The pieces of the region in each square between four centres that is not empty.

    Attributes
    ----------
    sizes : ndarray, shape (k,)
        Its size, or its moment about a joint 1 that turns.
    some : (ndarray, ndarray)
        The squares.
    """

    sizes: Floats
    some: tuple[Indices, Indices]
    inside: NDArray[np.bool_]
    flat: bool
    at_axis: bool

    def times(self, covered: Floats) -> float:
        """Return the sum over the squares of (path of joint 1) times (piece of the region)."""
        if self.flat:
            covered = np.tile(covered, (1, 2))
        if self.at_axis:
            covered = np.concatenate([np.zeros((1, covered.shape[1])), covered[:1], covered])
        return float((self.sizes * _mean_inside(covered, self.inside, self.some)).sum())


def _pieces(section: Section, outline: Outline) -> _Pieces:
    grid = section.grid
    if grid.flat:
        # A strip of height 1.
        twice = (1, 2)
        outline = Outline(
            outline.u,
            np.array([0.0, 1.0]),
            np.tile(outline.inside, twice),
            np.tile(outline.along_u, twice),
            np.full((len(outline.inside), 1), 0.5),
        )
    whole = with_axis(outline, grid)
    found = whole.pieces
    sizes = found.moment if section.joint.revolute else found.area
    return _Pieces(sizes, (found.i, found.j), whole.inside, grid.flat, grid.at_axis)


def _mean_inside(covered: Floats, inside: NDArray[np.bool_], some: tuple[Indices, Indices]) -> Floats:
    """Return the mean covered range at the inner corners of some squares."""
    i, j = some
    total, count = np.zeros(len(i)), np.zeros(len(i))
    for corner in ((i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)):
        here = inside[corner]
        total += np.where(here, covered[corner], 0.0)
        count += here
    return np.asarray(total / np.maximum(count, 1.0))


def _outlined(section: Section, value: float) -> Work[float]:
    """Return the change when the outline is given only at every second centre, as a root mean square of all choices."""
    outline, flat, changes = section.outline, section.grid.flat, []
    for i in range(2):
        for j in range(1 if flat else 2):
            some = Outline(
                outline.u[i:], outline.v[j:], outline.inside[i:, j:], outline.along_u[i:, j:], outline.along_v[i:, j:]
            )
            covered = section.covered[i::2, j :: 1 if flat else 2]
            coarse = _pieces(section, _halved(some, flat))
            yield
            changes.append(coarse.times(covered) - value)
            yield
    return float(np.sqrt(np.mean(np.square(changes))))


def _halved(outline: Outline, flat: bool) -> Outline:
    if not flat:
        return outline.coarser()
    twice = Outline(
        outline.u,
        np.array([0.0, 1.0, 2.0]),
        np.tile(outline.inside, (1, 3)),
        np.tile(outline.along_u, (1, 3)),
        np.full((len(outline.u), 2), 0.5),
    ).coarser()
    one = twice.inside[:, :1]
    return Outline(twice.u, outline.v, one, twice.along_u[:, :1], np.full((len(twice.u), 0), 0.5))


def _edges(section: Section) -> float:
    """Return the error of the crossings times the length of the boundary."""
    a, b = section.boundary.edges
    u = 0.5 * (a[:, 0] + b[:, 0]) if section.joint.revolute else np.ones(len(a))
    length = np.ones(len(a)) if section.grid.flat else np.linalg.norm(b - a, axis=1)
    covered = 2.0 * np.pi if section.arcs is None else section.arcs.covered[section.boundary.edge_cells]
    return float((u * length * covered).sum() * 0.5 * fineness(section.grid) * section.step)


def _alone(section: Section) -> float:
    """Return the size of the filled cells that have no neighbour with a centre inside."""
    i, j = np.nonzero(lonely(section.filled, section.outline.inside))
    cell = section.step if section.grid.flat else section.step**2
    return float((section.joint.measure(section.u)[i] * section.covered[i, j]).sum() * cell)


def _turning(section: Section, pieces: _Pieces, value: float) -> Work[float]:
    """Return the change when s is known only in every second coarse cell each way, as a root mean square of all.

    A cell that is left out is told by one beside it: that moves all by half a cell, always to one side, an error of the
    first order which the whole has not. Intervals of s grow evenly from cell to cell, so that it would be most of what
    is found; there the cells on both sides count as well, for half. Single values begin and end abruptly.
    """
    assert section.arcs is not None
    rows, columns = section.filled.shape
    side = section.grid.coarser
    shape = (-(-rows // side), -(-columns // side))
    covered = section.arcs.covered.reshape(shape)
    changes = []
    for i in range(2):
        for j in range(1 if section.grid.flat else 2):
            wide = _spread(covered, i, j, section.grid.flat)
            if not section.grid.single:
                wide = 0.5 * (wide + _between(covered, i, j, section.grid.flat))
            fine = np.repeat(np.repeat(wide, side, 0), side, 1)[:rows, :columns]
            yield
            changes.append(pieces.times(np.where(section.filled, fine, 0.0)) - value)
            yield
    return SAFETY * float(np.sqrt(np.mean(np.square(changes))))


def _spread(covered: Floats, i: int, j: int, flat: bool) -> Floats:
    """Return the covered range in cells of twice the side, as one of their cells has it where it is reached."""
    rows, columns = covered.shape
    wide = np.zeros((rows + rows % 2, columns + (0 if flat else columns % 2)))
    wide[:rows, :columns] = covered
    step = 1 if flat else 2
    here = wide[i::2, j::step]
    found = np.repeat(np.repeat(here, 2, 0), step, 1)
    return np.asarray(np.where(found > 0.0, found, wide)[:rows, :columns])


def _between(covered: Floats, i: int, j: int, flat: bool) -> Floats:
    """Return the covered range in every second cell each way, with means of both neighbours in between."""
    some = np.zeros(covered.shape, dtype=bool)
    some[i::2, j :: 1 if flat else 2] = True
    known = some & (covered > 0.0)
    values = np.where(known, covered, 0.0)
    for axis in range(1 if flat else 2):
        beside, count = _sum_beside(values, axis), _sum_beside(known.astype(np.float64), axis)
        values = np.where(known, values, beside / np.maximum(count, 1.0))
        known = known | (count > 0.0)
    return np.asarray(np.where(known, values, covered))


def _sum_beside(values: Floats, axis: int) -> Floats:
    """Return the sums of the two neighbours of each value along an axis, with zeros beyond the ends."""
    wide = np.pad(values, [(1, 1) if k == axis else (0, 0) for k in range(2)])
    return np.asarray(wide[2:] + wide[:-2] if axis == 0 else wide[:, 2:] + wide[:, :-2])
