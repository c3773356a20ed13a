"""Display of the values of a measure: as colours, as figures, and as the scale that explains the colours."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.workspace.measures import measure_named
from armlab.kin.workspace.section_size import Size
from armlab.ui.colours import VIRIDIS_CSS
from armlab.ui.format import capitalised, mathml, number, readable
from armlab.ui.html import Markup, joined, tag

DECADES = 3.0
"""Largest length of a logarithmic scale of colours, in decades down from its bright end."""

SAME = 1e-6
"""Difference, relative to the larger value, below which two values are the same."""

DIGITS = 3
"""Number of significant digits of a measure."""

ROUNDING = 1e-9
"""Rounding of a logarithm, in powers of ten."""


def figure(value: float) -> str:
    """Return the value of a measure without its unit."""
    return readable(float(f"{value:.{DIGITS}g}"), DIGITS)


def with_error(size: Size) -> str:
    """Return a volume or an area with its error, which has one digit, rounded up.

    >>> with_error(Size(6.283233, 0.000096, "m²")), with_error(Size(6.2208, 0.0024, "m³"))
    ('6.2832 ± 0.0001 m²', '6.221 ± 0.003 m³')
    """
    if size.error <= 0.0:
        return f"{figure(size.value)} {size.unit}"
    decimals = max(-math.floor(math.log10(size.error)), 0)
    error = math.ceil(size.error * 10.0**decimals) / 10.0**decimals
    decimals = max(-math.floor(math.log10(error) + ROUNDING), 0)
    return f"{number(size.value, decimals)} ± {number(error, decimals)} {size.unit}"


def parts_of(measure: str, low: float, high: float, values: NDArray[Any]) -> NDArray[np.float64]:
    """Return the places of values of a measure on its scale of colours, 0 to 1 between its ends."""
    values = np.asarray(values, dtype=np.float64)
    if high - low <= SAME * abs(high):
        return np.ones_like(values)
    if measure_named(measure).logarithmic and high > 0.0:
        decades = np.log10(high / _least(low, high))
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 + np.log10(np.maximum(values, 0.0) / high) / decades)
    return np.asarray((values - low) / (high - low))


def scale(arm: Arm, key: str, low: float, high: float) -> Markup:
    """Return the colours and their meaning."""
    measure = measure_named(key)
    if high - low <= SAME * abs(high):
        return tag("div.kit-scale", tag("b", _head(arm, key)), f" the same everywhere: {figure(high)}")
    low = _least(low, high) if measure.logarithmic else low
    middle = (low * high) ** 0.5 if measure.logarithmic else 0.5 * (low + high)
    kind = ", logarithmic" if measure.logarithmic else ""
    least = f"≤ {figure(low)}" if low > 0.0 else figure(low)
    ends = [tag("i", text) for text in (least, figure(middle), f"≥ {figure(high)}")]
    colours = tag("u", style=f"background:{VIRIDIS_CSS}")
    return tag("div.kit-scale", tag("b", _head(arm, key), kind), colours, tag("div", ends))


def _head(arm: Arm, key: str) -> Markup:
    measure = measure_named(key)
    unit = measure.unit(arm)
    return joined(f"{capitalised(measure.title)} ", mathml(measure.symbol), f", {unit}" if unit else None)


def _least(low: float, high: float) -> float:
    """Return the dark end of a logarithmic scale: the least value, but at most `DECADES` down."""
    return max(low, high * math.pow(10.0, -DECADES))
