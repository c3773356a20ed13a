"""One verdict on how well a Jacobian is conditioned, for all who give one.

Two verdicts on the same configuration can differ only where they are about different matrices: the whole task, with
lengths divided by half the reach, or the rows of the tool's translation or rotation alone. Whoever gives one says of
which.
"""

from __future__ import annotations

from typing import Literal

SINGULAR = 1e-9
"""Inverse condition up to which a configuration is singular."""

POOR = 0.1
"""Inverse condition below which it is poorly conditioned."""

NEAR = 0.03
"""Inverse condition below which it is called near a singularity: a joint of a poorly conditioned arm then needs a speed
some thirty times as large for the worst direction as for the best."""

Conditioning = Literal["singular", "poor", "good"]

TITLES: dict[Conditioning, str] = {
    "singular": "Singular",
    "poor": "Poorly conditioned",
    "good": "Well conditioned",
}


def conditioning(inverse: float, singular: bool | None = None) -> Conditioning:
    """Return the verdict on a Jacobian.

    Parameters
    ----------
    inverse : float
        Its smallest singular value over its largest.
    singular : bool or None
        Whether its rank is below the usual one, where that was found in another way.

    Examples
    --------
    >>> conditioning(0.0), conditioning(0.05), conditioning(0.4)
    ('singular', 'poor', 'good')
    """
    if inverse <= SINGULAR if singular is None else singular:
        return "singular"
    return "poor" if inverse < POOR else "good"
