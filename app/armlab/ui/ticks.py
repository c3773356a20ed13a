"""Round values along an axis."""

from __future__ import annotations

import math


def ticks(low: float, high: float, most: int = 5) -> list[float]:
    """Return round values inside a range, at most ``most`` of them.

    >>> ticks(0.0, 2.0)
    [0.0, 0.5, 1.0, 1.5, 2.0]
    """
    rough = (high - low) / most
    if not (math.isfinite(rough) and rough > 0.0):
        return []
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(factor * power for factor in (1.0, 2.0, 2.5, 5.0, 10.0, 20.0) if factor * power >= rough)
    return multiples(step, low, high)


def multiples(step: float, low: float, high: float) -> list[float]:
    """Return the multiples of a step inside a range.

    >>> multiples(45.0, -90.0, 30.0)
    [-90.0, -45.0, 0.0]
    """
    first = math.ceil(low / step - 1e-9)
    return [k * step for k in range(first, math.floor(high / step + 1e-9) + 1)]


def powers_of_ten(low: float, high: float, most: int = 7) -> list[float]:
    """Return powers of ten inside a range above zero, at most ``most`` of them, at equal distances.

    >>> powers_of_ten(0.1, 100.0)
    [0.1, 1.0, 10.0, 100.0]
    """
    first, last = math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9)
    return [10.0**power for power in range(first, last + 1, max(1, math.ceil((last - first + 1) / most)))]
