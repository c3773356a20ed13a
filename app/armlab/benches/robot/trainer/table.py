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
    axes is right, counted along the first of them, each d of these rows is right. Where it is not, none is blamed
    alone, but for a wrong unit or a swapped cell, or for its sign if it is the only one that differs. As long as one
    is missing, the others may still become right, and one that differs without such a reason has no verdict.

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
        off = _off(expected, got, run)
        if off is None:
            _leave_open(verdicts, run)
        elif abs(off) > tolerance:
            _blame_sum(verdicts, run, _sum_of(expected, run))
        else:
            _set_free(verdicts, run, _sum_of(expected, run))
            for i in run:
                if verdicts[i]["a"].mistake == "swapped":
                    verdicts[i]["a"] = judge_cell(expected[i].a, got[i].get("a"), "length", tolerance)
    return verdicts


def along_first(rows: Sequence[Row], run: range) -> bool:
    """Return whether the sum of d must be taken along the first of parallel axes, because some point against it."""
    return any(math.cos(rows[i].alpha) < 0.0 for i in run[:-1])


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


def _sum_of(rows: Sequence[Row], run: range) -> str:
    """Return what the sum is called, with z of frame 3 as z3."""
    way = f", taken along z{run[0]}," if along_first(rows, run) else ""
    return f"the sum of d over rows {run[0] + 1} to {run[-1] + 1}{way}"


def _leave_open(verdicts: list[dict[str, CellVerdict]], run: range) -> None:
    """Remove the verdicts on each d that a missing one may still make right."""
    for i in run:
        if verdicts[i]["d"].mistake in ("wrong", "sign"):
            del verdicts[i]["d"]


def _blame_sum(verdicts: list[dict[str, CellVerdict]], run: range, name: str) -> None:
    """Blame the sum where no d alone can be."""
    different = [i for i in run if not verdicts[i]["d"].ok]
    for i in different:
        mistake = verdicts[i]["d"].mistake
        if mistake == "wrong" or (mistake == "sign" and len(different) > 1):
            verdicts[i]["d"] = CellVerdict(False, "wrong", f"only {name} counts, and it is not correct yet")


def _set_free(verdicts: list[dict[str, CellVerdict]], run: range, name: str) -> None:
    """Call each d of a right sum right."""
    for i in run:
        verdicts[i]["d"] = CellVerdict(True, "", f"right: only {name} is defined")


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
