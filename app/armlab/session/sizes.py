"""Largest sizes of an arm on screen; larger ones are typing mistakes."""

from __future__ import annotations

import math

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.dh import LARGEST_ANGLE, Row

LENGTHS, ANGLES = ("a", "d"), ("alpha", "theta")
LONGEST = 100.0
"""Longest link, metres."""

MOST_TURNED = 20.0 * math.pi
"""Largest angle that can be typed, but for those of a row, radians: ten turns."""

LETTERS = {"alpha": "α", "theta": "θ"}
"""Names of the angles of a row in sentences."""

LEAST_RANGE = {"R": 0.01, "P": 0.001}
"""Least range of a joint, radians and metres: a slider needs some room."""


def check_sizes(arm: Arm) -> None:
    """Refuse an arm with impossible sizes."""
    for i, row in enumerate(arm.rows):
        for field in LENGTHS + ANGLES:
            check_cell(i, field, getattr(row, field))
        check_limits(i, row, *arm.limits[i].tolist())
    for end, pose in (("base", arm.base), ("tool", arm.tool)):
        for axis, value in zip("xyz", pose[:3, 3].tolist(), strict=True):
            check_size(f"{end}, {axis}", value)


def check_cell(i: int, field: str, value: float) -> None:
    """Refuse a cell of row i (0-based) of the table: an angle beyond a full turn, or an impossible length."""
    check_size(f"row {i + 1}, {LETTERS.get(field, field)}", value, LARGEST_ANGLE if field in ANGLES else None)


def widest(turns: bool) -> tuple[float, float]:
    """Return the range of an angle of the table, radians, or of a length, metres."""
    most = LARGEST_ANGLE if turns else LONGEST
    return -most, most


def check_size(where: str, value: float, turned: float | None = None, longest: float = LONGEST) -> None:
    """Refuse a length of more than ``longest`` metres either way, or an angle of more than ``turned`` radians."""
    most, turns = longest if turned is None else turned, turned is not None
    if not abs(value) <= most:
        raise InputError(f"{where}: expected at most {_said(most, turns)} either way, got {_said(value, turns)}")


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
