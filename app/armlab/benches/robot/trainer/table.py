"""Marks for the student's table: each cell by itself, and the offsets along parallel axes by their sum."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from armlab.errors import InputError
from armlab.kin.assignment import LENGTH_TOLERANCE, CellVerdict, judge_cell, judge_row
from armlab.kin.dh import Row
from armlab.kin.relations import is_parallel


def judge_table(
    expected: Sequence[Row], got: Sequence[Mapping[str, float | None]], tolerance: float = LENGTH_TOLERANCE
) -> list[dict[str, CellVerdict]]:
    """Return the verdicts on the cells of all rows; see `judge_row`.

    The place of an origin along parallel axes is free (notes, section 4.1): where the sum of d over rows of parallel
    axes is right, counted along the first of them, each d of these rows is right; where it is not, none is blamed
    alone.

    The tolerance of lengths is in metres.

    Raises
    ------
    InputError
        Another number of rows, and as `judge_row`.
    """
    if len(got) != len(expected):
        raise InputError(f"table: expected {len(expected)} rows, got {len(got)}")
    verdicts = [judge_row(row, cells, tolerance) for row, cells in zip(expected, got, strict=True)]
    for run in parallel_runs(expected):
        rows = f"the sum of d over rows {run[0] + 1} to {run[-1] + 1}"
        off = _off(expected, got, run)
        if off is not None and abs(off) > tolerance:
            for i in run:
                if verdicts[i]["d"].mistake == "wrong":
                    verdicts[i]["d"] = CellVerdict(False, "wrong", f"only {rows} counts, and it is not correct yet")
        elif off is not None:
            free = CellVerdict(True, "", f"right: only {rows} is defined")
            for i in run:
                verdicts[i]["d"] = free
                if verdicts[i]["a"].mistake == "swapped":
                    verdicts[i]["a"] = judge_cell(expected[i].a, got[i].get("a"), "length", tolerance)
    return verdicts


def parallel_runs(rows: Sequence[Row]) -> list[range]:
    """Return the longest runs of two or more rows of a standard table, 0-based, whose joint axes are parallel."""
    runs, start = [], 0
    for i in range(len(rows)):
        # What follows the last joint is no axis.
        if i == len(rows) - 1 or not is_parallel(rows[i].alpha):
            if i > start:
                runs.append(range(start, i + 1))
            start = i + 1
    return runs


def _off(expected: Sequence[Row], got: Sequence[Mapping[str, float | None]], run: range) -> float | None:
    """Return the error of the sum of d along parallel axes, metres, or None if a number is missing."""
    total, sense = 0.0, 1.0
    for i in run:
        value = got[i].get("d")
        if value is None or not math.isfinite(value):
            return None
        total += sense * (value - expected[i].d)
        sense *= math.copysign(1.0, math.cos(expected[i].alpha))
    return total
