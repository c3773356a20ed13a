"""Angles and lengths that may be very small, with their units."""

from __future__ import annotations

import math

from armlab.ui.format import number, scientific
from armlab.ui.units import Units

NO_BREAK = "\N{NO-BREAK SPACE}"
"""No-break space between a number and its unit, which belong on one line."""

HUGE = 1e5
"""Least number that is written with a power of ten because it is large."""

LEAST = 0.01
"""Number below which a power of ten is written; larger ones have at least two digits."""


def small(value: float, revolute: bool, units: Units) -> str:
    """Return an angle or a length without its unit, with a power of ten if fixed decimals would not show it."""
    scaled, decimals = value / units.factor(revolute), units.decimals(revolute)
    if not math.isfinite(scaled):
        return "–"
    if scaled == 0.0:
        return "0"
    if LEAST <= abs(scaled) < 10.0 ** (1 - decimals):
        return number(scaled, 1 - math.floor(math.log10(abs(scaled))))
    return number(scaled, decimals) if LEAST <= abs(scaled) < HUGE else scientific(scaled)


def with_unit(value: float, revolute: bool, units: Units) -> str:
    """Return a small angle or length with its unit."""
    unit = units.unit(revolute)
    return f"{small(value, revolute, units)}{'' if unit == '°' else NO_BREAK}{unit}"
