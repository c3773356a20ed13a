"""A piecewise constant acceleration, given as rows."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion.law import Law, PolynomialLaw
from armlab.kin.motion.law_types import LawType
from armlab.kin.motion.piecewise import Piecewise, integrated

Rows = tuple[tuple[float, float, float], ...]

PLUS_MINUS_ONE: Rows = ((0, 1, 1), (1, 3, -1), (3, 4, 1), (4, 5, -1), (5, 7, 1), (7, 8, -1))
"""Rows (from, to, acceleration) of the profile of 1.41. The notes print 3/8, 5/8, 7/8 for 3, 5, 7, which overlap;
with these, speed and place at t = 8 are zero as 1.42 says."""

BANG_COAST_BANG: Rows = ((0, 1, 1), (1, 2, 0), (2, 3, -1))

PRESETS: Mapping[str, Rows] = MappingProxyType({"plus_minus_one": PLUS_MINUS_ONE, "bang_coast_bang": BANG_COAST_BANG})
"""Ready tables, by name."""


def acceleration_law(rows: Any, sdot_first: float = 0.0) -> PolynomialLaw:
    """Return s(t) from rows (from, to, acceleration), as typed: not scaled, and free to go back.

    Raises
    ------
    InputError
        A row that ends before it begins, or does not begin where the row before ends; the text names the row.

    References
    ----------
    Notes 1.40-1.42.

    Examples
    --------
    >>> law = acceleration_law(PLUS_MINUS_ONE)
    >>> law.duration, [round(s, 9) for s in law.span]
    (8.0, [-1.0, 1.0])
    """
    table = _checked(rows)
    return PolynomialLaw(
        integrated(np.diff(table[:, :2], axis=1)[:, 0].tolist(), table[:, 2].tolist(), [0.0, sdot_first])
    )


def _checked(rows: Any) -> Any:
    try:
        table = np.array(rows, dtype=float)
    except (TypeError, ValueError):
        table = np.zeros(0)
    if table.ndim != 2 or table.shape[1] != 3 or len(table) == 0 or not np.isfinite(table).all():
        raise InputError("rows: expected rows of three numbers: from (s), to (s), acceleration")
    for k, (start, end, _) in enumerate(table):
        if not end > start:
            raise InputError(f"row {k + 1}: it must end after {start:g} s where it begins, got {end:g} s")
        due = table[k - 1, 1] if k else 0.0
        if abs(start - due) > 1e-9 * max(table[-1, 1], 1.0):
            raise InputError(f"row {k + 1}: it must begin at {due:g} s where the row before ends, got {start:g} s")
    return table


def make(duration: float, distance: float, options: dict[str, Any]) -> Law:
    """Return the table stretched to a duration and scaled to a distance.

    Raises
    ------
    InputError
        The table comes back to where it began, or ends behind it: no scale makes it end at the distance.
    """
    typed = acceleration_law(options["rows"], options["sdot_first"])
    end = float(typed.at(typed.duration))
    if end <= 1e-9 * max(map(abs, typed.span)):
        raise InputError(
            f"rows: the table ends at s = {end:.4g}, so it cannot be scaled to end at {distance:g}; it can be looked "
            "at as it is, or change the rows"
        )
    curve = typed.curve.local(duration / typed.duration)
    scaled = Piecewise(curve.knots, curve.coefficients * (distance / end))
    final = abs(float(typed.at(typed.duration, 1)))
    remarks = () if final <= 1e-9 * typed.peak_speed else ("The speed at the end is not zero.",)
    return PolynomialLaw(scaled, remarks)


LAW = LawType(
    "table",
    "Table of accelerations",
    9,
    make,
    fields=(
        Field("rows", "s̈", "from, to, acceleration", "rows", BANG_COAST_BANG),
        Field("sdot_first", "ṡ_i", "speed of s at the start of the table", "number", 0.0, was="v_start"),
    ),
)
