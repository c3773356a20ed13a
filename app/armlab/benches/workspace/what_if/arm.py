"""A supposed arm: numbers of the table, of the limits or of the tool changed, without editing the real one."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, cast

import numpy as np

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.task_choice import default_task
from armlab.registry import known_name
from armlab.session.sizes import ANGLES, LEAST_RANGE, LENGTHS, check_sizes

LIMITS = ("low", "high")
TOOL = ("x", "y", "z")

NAMED = {
    "a": "link length",
    "alpha": "link twist",
    "d": "link offset",
    "theta": "joint angle",
    "low": "lower limit",
    "high": "upper limit",
    **{axis: f"tool along {axis} of frame n" for axis in TOOL},
}
"""Names of the fields in words."""

SHORT = 0.05
"""Length, in reaches of the arm, below which its slider may also go to negative values."""


@dataclass(frozen=True)
class Change:
    """One number with another value.

    Parameters
    ----------
    row : int
        0-based; n for the tool.
    field : str
        ``a``, ``alpha``, ``d``, ``theta``, ``low`` or ``high`` of a row; ``x``, ``y`` or ``z`` of the tool in frame n.
    value : float
        Metres or radians.
    """

    row: int
    field: str
    value: float


def fields_of(arm: Arm, row: int) -> tuple[str, ...]:
    """Return the fields of a row (0-based), or of the tool (n), that can be changed: those that no joint varies.

    Raises
    ------
    InputError
        There is no such row.
    """
    if not 0 <= row <= arm.n:
        raise InputError(f"joint: expected 1 to {arm.n}, or {arm.n + 1} for the tool, got {row + 1}")
    if row == arm.n:
        return TOOL
    return ("a", "alpha", "d" if arm.rows[row].revolute else "theta", *LIMITS)


def value_of(arm: Arm, row: int, field: str) -> float:
    """Return a number of an arm in metres or radians.

    Raises
    ------
    InputError
        There is no such row, or it has no such number; the text lists those it has.
    """
    known = fields_of(arm, row)
    known_name("quantity", field, known)
    if field in TOOL:
        return float(arm.tool[TOOL.index(field), 3])
    if field in LIMITS:
        return float(arm.limits[row, LIMITS.index(field)])
    return float(getattr(arm.rows[row], field))


def turns(arm: Arm, row: int, field: str) -> bool:
    """Return whether a number is an angle."""
    return field in ANGLES or (field in LIMITS and bool(arm.revolute[row]))


def altered(arm: Arm, changes: Iterable[Change]) -> Arm:
    """Return the arm with some numbers changed; its task is that of the edited table (`session.edits`).

    Raises
    ------
    InputError
        An unknown quantity, or sizes no arm on screen may have.
    """
    rows, limits, tool = list(arm.rows), np.array(arm.limits), np.array(arm.tool)
    geometry = False
    for change in changes:
        value_of(arm, change.row, change.field)
        if not math.isfinite(change.value):
            raise InputError(f"{change.field}: expected a number, got {change.value}")
        geometry |= change.field not in LIMITS
        if change.field in TOOL:
            tool[TOOL.index(change.field), 3] = change.value
        elif change.field in LIMITS:
            limits[change.row, LIMITS.index(change.field)] = change.value
        else:
            rows[change.row] = replace(rows[change.row], **cast(Any, {change.field: change.value}))
    # Limits do not matter to the choice of a task, which takes a look at the whole geometry.
    task = default_task(rows, arm.convention, tool) if geometry and not _task_is_given(arm) else arm.task
    limits.setflags(write=False)
    tool.setflags(write=False)
    other = replace(arm, rows=tuple(rows), limits=limits, tool=tool, task=task)
    check_sizes(other)
    return other


@lru_cache(maxsize=64)
def _task_is_given(arm: Arm) -> bool:
    """Return whether the task differs from the one that follows from the geometry (arms are compared by identity)."""
    return arm.task != default_task(arm.rows, arm.convention, arm.tool)


def span_of(arm: Arm, other: Arm, row: int, field: str) -> tuple[float, float]:
    """Return the range of the slider of a number: from nothing to twice its value, or half a reach each way.

    Parameters
    ----------
    arm, other : Arm
        As it is, and as it is thought to be.
    row : int
    field : str
    """
    was, now = value_of(arm, row, field), value_of(other, row, field)
    if field in LIMITS:
        low, high = _limit_span(arm, other, row, field)
    elif field in LENGTHS or field in TOOL:
        long = abs(was) > SHORT * arm.reach
        half = (arm.reach or 1.0) / 2
        low, high = (min(0.0, 2 * was), max(0.0, 2 * was)) if long else (-half, half)
    else:
        low, high = -math.pi, math.pi
    return min(low, now), max(high, now)


def _limit_span(arm: Arm, other: Arm, row: int, field: str) -> tuple[float, float]:
    least, most = arm.limits[row].tolist()
    low, high = other.limits[row].tolist()
    gap = 2.0 * LEAST_RANGE[arm.rows[row].kind]
    wide = math.pi if arm.revolute[row] else most - least
    if field == "low":
        return min(least, -wide if arm.revolute[row] else least - wide), high - gap
    return low + gap, max(most, wide if arm.revolute[row] else most + wide)
