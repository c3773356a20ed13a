"""Compound growth: a quantity that changes by the same fraction every year (notes, section 1.8)."""

from __future__ import annotations

import math

from armlab.errors import InputError


def growth_rate(begin: float, end: float, years: float) -> float:
    """Return the rate a year that leads from one value to another: ``(end / begin)^(1 / years) - 1``.

    Parameters
    ----------
    begin, end : float
        Above zero, in the same unit.
    years : float
        Not zero.

    Returns
    -------
    float
        A fraction: 0.11 for 11 % a year.

    References
    ----------
    Notes, section 1.8, where it is called CAGR, the compound annual growth rate.

    Examples
    --------
    >>> round(growth_rate(3000.0, 4.6e6, 51.0), 4)
    0.1547
    """
    _above_zero("begin", begin)
    _above_zero("end", end)
    if years == 0.0 or not math.isfinite(years):
        raise InputError(f"years: expected a number that is not zero, got {years:g}")
    try:
        return math.expm1(math.log(end / begin) / years)
    except OverflowError:
        raise InputError(f"years: in {years:g} years {begin:g} becomes {end:g} at a rate beyond all numbers") from None


def grown(begin: float, rate: float, years: float) -> float:
    """Return what a value has become after some years: ``begin (1 + rate)^years``; before them for negative ones.

    >>> grown(100.0, 0.1, 2.0)
    121.0
    """
    _above_zero("begin", begin)
    factor = years * math.log1p(_checked_rate(rate))
    try:
        return begin * math.exp(factor)
    except OverflowError:
        raise InputError(f"years: {years:g} years of {100.0 * rate:g} % are beyond all numbers") from None


def years_to_grow(begin: float, end: float, rate: float) -> float:
    """Return the years from one value to another, ``log(end / begin) / log(1 + rate)``; negative when it was earlier.

    Raises
    ------
    InputError
        The rate is zero, and the values are different.

    Examples
    --------
    >>> round(years_to_grow(3000.0, 4.6e6, growth_rate(3000.0, 4.6e6, 51.0)), 9)
    51.0
    """
    _above_zero("begin", begin)
    _above_zero("end", end)
    speed = math.log1p(_checked_rate(rate))
    if speed == 0.0:
        if begin == end:
            return 0.0
        raise InputError(f"rate: with 0 % a year {begin:g} never becomes {end:g}")
    return math.log(end / begin) / speed


def doubling_time(rate: float) -> float:
    """Return the years in which a value doubles, ``log 2 / log(1 + rate)``: of a falling one the years until it halves.

    Infinite for a rate of zero.

    >>> round(doubling_time(0.07), 2), round(doubling_time(-0.5), 2)
    (10.24, 1.0)
    """
    speed = abs(math.log1p(_checked_rate(rate)))
    return math.log(2.0) / speed if speed else math.inf


def _above_zero(where: str, value: float) -> None:
    if not 0.0 < value < math.inf:
        raise InputError(f"{where}: expected a number above zero, got {value:g}")


def _checked_rate(rate: float) -> float:
    if not -1.0 < rate < math.inf:
        raise InputError(f"rate: expected more than -100 % a year, got {100.0 * rate:g} %")
    return rate
