"""What the checks of a motion have in common."""

from __future__ import annotations

from armlab.content.check import signed

NOT_PLANNED = "The motion is not worked out yet."
"""Said while there is no plan, or the plan is still under way."""


def seconds(value: float) -> str:
    """Return a time with two decimals and its unit."""
    return f"{signed(value, 2)} s"


def percent(share: float) -> str:
    """Return a share as a percentage."""
    return f"{100.0 * share:.0f} %"
