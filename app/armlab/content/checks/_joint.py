"""Mistakes that explain the value of one joint."""

from __future__ import annotations

import math

CONFUSED = 0.02
"""Relative tolerance for recognising a value in the wrong unit: two digits agree."""


def joint_mistake(now: float, asked: float, within: float, revolute: bool) -> str:
    """Return a sentence, with a space before it, on a joint that is not where it should be; empty without a reason.

    Parameters
    ----------
    now, asked, within : float
        Radians or metres.
    revolute : bool
    """
    if abs(now + asked) <= within:
        sign = ": positive angles turn counter-clockwise about the joint's axis" if revolute else ""
        return f" The sign is wrong{sign}."
    if revolute and _nearly(now, math.radians(asked)):
        return " That is the number of radians, taken for degrees."
    return ""


def _nearly(value: float, other: float) -> bool:
    return other != 0.0 and abs(value / other - 1.0) <= CONFUSED
