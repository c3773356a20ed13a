"""Easing of movements on the screen: how they start and stop."""

from __future__ import annotations


def eased(s: float) -> float:
    """Return the minimum-jerk course from 0 to 1, at rest at both ends and constant before and after.

    Source: Flash and Hogan, *The coordination of arm movements*, Journal of Neuroscience 5 (1985), appendix.

    Examples
    --------
    >>> eased(0.5), eased(2.0)
    (0.5, 1.0)
    """
    s = min(max(s, 0.0), 1.0)
    return s * s * s * (10.0 + s * (6.0 * s - 15.0))
