"""Numbers of a sentence in which one misses the other."""

from __future__ import annotations

FEWEST, MOST = 3, 15
"""Decimals."""

NEAR = 0.01
"""Largest relative error of a limit as it is written."""


def compared(value: float, limit: float) -> tuple[str, str]:
    """Return a value and its limit with as many decimals, three or more, as tell them apart and the limit from zero.

    >>> compared(0.342, 0.5), compared(0.8497, 0.85), compared(1.0, 0.0004)
    (('0.342', '0.500'), ('0.8497', '0.8500'), ('1.0000', '0.0004'))
    """
    for decimals in range(FEWEST, MOST + 1):
        texts = f"{value:.{decimals}f}", f"{limit:.{decimals}f}"
        if texts[0] != texts[1] and abs(float(texts[1]) - limit) <= NEAR * abs(limit):
            break
    return texts
