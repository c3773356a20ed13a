"""The distance of a configuration from a target, as text in units in which the number is readable."""

from __future__ import annotations

import math

LEAST_M, LEAST_RAD = 5e-12, 5e-12
"""Errors, in metres and radians, up to which nothing is said: they are rounding."""

_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def missed_in_words(position: float, rotation: float) -> str:
    """Return both parts of an error that are more than rounding, such as ``"400 nm and 0.02°"``; empty for none.

    Parameters
    ----------
    position, rotation : float
        Metres and radians.

    Examples
    --------
    >>> missed_in_words(4e-7, 0.0), missed_in_words(0.0123, 2e-3)
    ('400 nm', '12.3 mm and 0.11°')
    >>> missed_in_words(0.0, 1e-8)
    '5.7·10⁻⁷°'
    """
    parts = []
    if position > LEAST_M:
        parts.append(_metres(position))
    if rotation > LEAST_RAD:
        parts.append(_degrees(math.degrees(rotation)))
    return " and ".join(parts)


def _metres(value: float) -> str:
    units = ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm"))
    size, unit = next((one for one in units if value >= 0.95 * one[0]), units[-1])
    return f"{value / size:.3g} {unit}"


def _degrees(value: float) -> str:
    mantissa, _, power = f"{value:.2g}".partition("e")
    return f"{mantissa}·10{str(int(power)).translate(_SUPERSCRIPTS)}°" if power else f"{mantissa}°"
