"""Round numbers for scales: 1, 2 and 5 times powers of ten."""

from __future__ import annotations

import math

ROUNDING = 1e-9
"""Relative difference from a round number that is ignored."""


def round_below(value: float) -> float:
    """Return the largest round number not above a positive one; 0 for 0.

    >>> round_below(7.0), round_below(0.05), round_below(0.0)
    (5.0, 0.05, 0.0)
    """
    if value == 0.0:
        return 0.0
    power = 10.0 ** math.floor(math.log10(value))
    return max(step * power for step in (0.5, 1.0, 2.0, 5.0, 10.0) if step * power <= value * (1.0 + ROUNDING))


def round_above(value: float) -> float:
    """Return the smallest round number not below a positive one; 0 for 0.

    >>> round_above(7.0), round_above(0.05), round_above(0.0)
    (10.0, 0.05, 0.0)
    """
    if value == 0.0:
        return 0.0
    power = 10.0 ** math.floor(math.log10(value))
    return min(step * power for step in (0.5, 1.0, 2.0, 5.0, 10.0, 20.0) if step * power >= value * (1.0 - ROUNDING))
