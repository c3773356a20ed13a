"""Quantities of drives on screen, with the prefix of the unit that leaves the number readable."""

from __future__ import annotations

import math

from armlab.session.amounts import amount

PREFIXES = {1e9: "G", 1e6: "M", 1e3: "k", 1.0: "", 1e-3: "m", 1e-6: "µ"}
"""Letters of the prefixes, by their factors, the largest first."""

RPM = 2.0 * math.pi / 60.0
"""Angular speed of one turn per minute, rad/s."""


def prefixed(value: float, unit: str) -> str:
    """Return a quantity with four significant digits, its unit and the prefix that fits.

    >>> prefixed(8800.0, "W"), prefixed(-0.0032, "N m"), prefixed(0.0, "W")
    ('8.8 kW', '−3.2 mN m', '0 W')
    """
    if value == 0.0 or not math.isfinite(value):
        return amount(value, unit)
    # What would be rounded up to the next prefix has that already.
    size = abs(float(f"{value:.4g}"))
    factor = next((each for each in PREFIXES if size >= each), min(PREFIXES))
    return amount(value / factor, f"{PREFIXES[factor]}{unit}")


def rpm(omega: float) -> str:
    """Return an angular speed in turns per minute, with the unit."""
    return amount(omega / RPM, "rpm")
