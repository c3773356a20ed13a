"""Common parts of the checks of a motion."""

from __future__ import annotations

from armlab.content.check import signed

NOT_PLANNED = "The motion has not been planned yet."
"""Sentence for a motion that is not planned yet, or is being planned."""


def seconds(value: float) -> str:
    """Return a time with two decimals and its unit."""
    return f"{signed(value, 2)} s"


def percent(share: float) -> str:
    """Return a fraction as a percentage."""
    return f"{100.0 * share:.0f} %"
