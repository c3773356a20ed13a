"""The student's answers in the assignment trainer, and how they are written."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Self

from armlab.benches.robot.trainer.exercise import DIRECTIONS, Axes
from armlab.errors import InputError
from armlab.kin.assignment import CELLS
from armlab.session.state import Json

FIELDS = tuple(CELLS)
"""The cells of a row: a, alpha, d, theta."""

Cells = tuple[float | None, ...]
Counts = tuple[int, ...]

LARGEST = 1e5
"""Largest value of a cell, metres or radians: values in a wrong unit must pass, so that a hint can say so."""

MOST_COUNTED = 10**6


@dataclass(frozen=True)
class Answers:
    """The answers to an exercise of n joints.

    Attributes
    ----------
    axes : tuple of n + 1 (str, str)
        The directions of z and x of the frames.
    checked_axes : tuple or None
        The axes as they were in the last check.
    axes_checks : int
        How often the axes were checked.
    axes_misses : tuple of n + 1 int
        In how many checks each frame was wrong.
    placed : bool
        Whether all axes are right and the student has gone on to the table.
    cells : tuple of n tuples of 4 float or None
        The table, in the order of `FIELDS`; metres and radians, None where nothing is written.
    checked_cells, table_checks, cell_misses
        As of the axes.
    shown : int
        How many solutions were asked for.
    """

    axes: tuple[Axes, ...]
    checked_axes: tuple[Axes, ...] | None
    axes_checks: int
    axes_misses: Counts
    placed: bool
    cells: tuple[Cells, ...]
    checked_cells: tuple[Cells, ...] | None
    table_checks: int
    cell_misses: tuple[Counts, ...]
    shown: int

    @classmethod
    def empty(cls, n: int) -> Self:
        """Return no answers."""
        axes, cells = (("", ""),) * (n + 1), ((None,) * len(FIELDS),) * n
        return cls(axes, None, 0, (0,) * (n + 1), False, cells, None, 0, ((0,) * len(FIELDS),) * n, 0)

    def to_json(self) -> Json:
        """Return the answers as JSON."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @classmethod
    def from_json(cls, data: Json, n: int) -> Self:
        """Return the answers read from JSON.

        Raises
        ------
        InputError, KeyError, TypeError
            They are not the answers to an exercise of n joints.
        """
        checked_axes, checked_cells = data["checked_axes"], data["checked_cells"]
        return cls(
            axes=_axes(data["axes"], n),
            checked_axes=None if checked_axes is None else _axes(checked_axes, n),
            axes_checks=_count(data["axes_checks"]),
            axes_misses=_counts(data["axes_misses"], n + 1),
            placed=bool(data["placed"]),
            cells=_cells(data["cells"], n),
            checked_cells=None if checked_cells is None else _cells(checked_cells, n),
            table_checks=_count(data["table_checks"]),
            cell_misses=tuple(_counts(row, len(FIELDS)) for row in _sized(data["cell_misses"], n)),
            shown=_count(data["shown"]),
        )


def _axes(data: Json, n: int) -> tuple[Axes, ...]:
    axes = []
    for z, x in _sized(data, n + 1):
        if not {z, x} <= {"", *DIRECTIONS}:
            raise InputError(f"trainer: not a direction: {z!r}, {x!r}")
        axes.append((z, x))
    return tuple(axes)


def _cells(data: Json, n: int) -> tuple[Cells, ...]:
    return tuple(tuple(_value(value) for value in _sized(row, len(FIELDS))) for row in _sized(data, n))


def _value(data: Json) -> float | None:
    if data is None:
        return None
    value = float(data)
    if not (math.isfinite(value) and abs(value) <= LARGEST):
        raise InputError(f"trainer: not a value of a cell: {data}")
    return value


def _counts(data: Json, size: int) -> Counts:
    return tuple(_count(count) for count in _sized(data, size))


def _count(data: Json) -> int:
    if not (isinstance(data, int) and 0 <= data <= MOST_COUNTED):
        raise InputError(f"trainer: not a count: {data!r}")
    return int(data)


def _sized(data: Json, size: int) -> list[Json]:
    if not isinstance(data, (list, tuple)) or len(data) != size:
        raise InputError(f"trainer: expected {size} entries, got {data!r}")
    return list(data)
