"""Timed knots of one coordinate, as typed: checked, with errors that name the knot."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise

from armlab.errors import InputError

Knot = tuple[float, float]
"""A knot: time in seconds, and the coordinate in its unit."""

MOST_KNOTS = 31
"""Largest number of knots: rounding alone moves one polynomial through more of them, and no one types more."""

LATEST = 1e4
"""Largest time of a knot before or after zero, seconds."""

LARGEST = 1e6
"""Largest absolute value of the coordinate, in its unit."""

SHORTEST = 1e-3
"""Least time between two knots, seconds; derivatives of order 3 are divided by its cube."""


def checked(knots: Iterable[Sequence[float]], unit: str = "") -> tuple[Knot, ...]:
    """Return checked knots; ``unit`` is that of the coordinate, for the sentences.

    Raises
    ------
    InputError
        Fewer than two or more than `MOST_KNOTS`, not two finite numbers each, or times that do not rise.
    """
    rows = [tuple(map(float, knot)) for knot in knots]
    if not 2 <= len(rows) <= MOST_KNOTS:
        few = " (add one)" if len(rows) < 2 else ""
        raise InputError(f"knots: expected 2 to {MOST_KNOTS}, got {len(rows)}{few}")
    found = tuple(_checked_knot(k, row, unit) for k, row in enumerate(rows, start=1))
    for k, (before, now) in enumerate(pairwise(found), start=2):
        step = now[0] - before[0]
        if step <= 0.0:
            raise InputError(f"knot {k}: its time {now[0]:g} s must be later than the {before[0]:g} s of knot {k - 1}")
        if step < SHORTEST * (1.0 - 1e-9):
            raise InputError(
                f"knot {k}: expected at least {1e3 * SHORTEST:g} ms after knot {k - 1}, got {1e3 * step:g} ms"
            )
    return found


def _checked_knot(k: int, row: tuple[float, ...], unit: str) -> Knot:
    if len(row) != 2:
        raise InputError(f"knot {k}: expected two numbers, t and q, got {len(row)}")
    t, q = row
    for name, value, most, of in (("t", t, LATEST, " s"), ("q", q, LARGEST, f" {unit}".rstrip())):
        if not math.isfinite(value):
            raise InputError(f"knot {k}, {name}: expected a finite number, got {value}")
        if abs(value) > most:
            raise InputError(f"knot {k}, {name}: expected at most {most:g}{of} either way, got {value:g}{of}")
    return t + 0.0, q + 0.0


def inserted(knots: tuple[Knot, ...], after: int) -> tuple[Knot, ...]:
    """Return knots with one more after knot ``after`` (0-based): half way to the next, or as far beyond the last."""
    if not 0 <= after < len(knots):
        raise InputError(f"knot: expected 1 to {len(knots)}, got {after + 1}")
    t, q = knots[after]
    if after == len(knots) - 1:
        new = (t + (t - knots[after - 1][0]), q)
    else:
        new = (0.5 * (t + knots[after + 1][0]), 0.5 * (q + knots[after + 1][1]))
    return checked((*knots[: after + 1], new, *knots[after + 1 :]))


def without(knots: tuple[Knot, ...], k: int) -> tuple[Knot, ...]:
    """Return knots without one (0-based)."""
    if not 0 <= k < len(knots):
        raise InputError(f"knot: expected 1 to {len(knots)}, got {k + 1}")
    return checked((*knots[:k], *knots[k + 1 :]))
