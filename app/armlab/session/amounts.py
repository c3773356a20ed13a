"""Numbers in sentences: a few significant digits, a true minus sign, powers of ten."""

from __future__ import annotations

import math

_RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


def signed(value: float, digits: int) -> str:
    """Return a number with this many significant digits, a true minus sign, and a power of ten where needed."""
    mantissa, _, exponent = f"{value + 0.0:.{digits}g}".partition("e")
    power = f"·10{str(int(exponent)).translate(_RAISED)}" if exponent else ""
    return mantissa.replace("-", "−") + power


DIGITS = 4
"""Significant digits of amounts."""


def amount(value: float, unit: str = "") -> str:
    """Return a number with four significant digits and its unit."""
    if math.isinf(value):
        return "∞"
    return f"{signed(value, DIGITS)} {unit}".rstrip()
