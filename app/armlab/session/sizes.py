"""Sizes an arm on screen may have; what lies beyond is a slip of the pen."""

from __future__ import annotations

import math

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.dh import LARGEST_ANGLE, Row

LENGTHS, ANGLES = ("a", "d"), ("alpha", "theta")
LONGEST = 100.0
"""Metres; a longer link is a slip of the pen."""

MOST_TURNED = 20.0 * math.pi
"""Radians: ten turns; more is one, too."""

LEAST_RANGE = {"R": 0.01, "P": 0.001}
"""Radians and metres a joint can move at least: a slider needs some room."""


def check_sizes(arm: Arm) -> None:
    """Refuse an arm with sizes that cannot be meant."""
    for i, row in enumerate(arm.rows):
        for field in LENGTHS + ANGLES:
            check_cell(i, field, getattr(row, field))
        check_limits(i, row, *arm.limits[i].tolist())
    for end, pose in (("base", arm.base), ("tool", arm.tool)):
        for axis, value in zip("xyz", pose[:3, 3].tolist(), strict=True):
            check_size(f"{end}, {axis}", value)


def check_cell(i: int, field: str, value: float) -> None:
    """Refuse a cell of row i (0-based) of the table: an angle beyond a full turn, or a length that cannot be meant."""
    check_size(f"row {i + 1}, {field}", value, LARGEST_ANGLE if field in ANGLES else None)


def check_size(where: str, value: float, turned: float | None = None) -> None:
    """Refuse a length in metres that cannot be meant, or an angle of more than ``turned`` radians."""
    most, turns = LONGEST if turned is None else turned, turned is not None
    if not abs(value) <= most:
        raise InputError(f"{where}: expected at most {_said(most, turns)}, got {_said(value, turns)}")


def check_limits(i: int, row: Row, low: float, high: float) -> None:
    """Refuse limits of joint i (0-based) that a slider cannot show."""
    where, turns = f"limits of joint {i + 1}", row.revolute
    for value in (low, high):
        check_size(where, value, MOST_TURNED if turns else None)
    got = f"got {_said(low, turns)} to {_said(high, turns)}"
    if low > high:
        raise InputError(f"{where}: the smaller comes first, {got}")
    if high - low < LEAST_RANGE[row.kind]:
        raise InputError(f"{where}: expected at least {_said(LEAST_RANGE[row.kind], turns)} between them, {got}")


def _said(value: float, turns: bool) -> str:
    return f"{math.degrees(value):.6g}°" if turns else f"{value:.6g} m"
