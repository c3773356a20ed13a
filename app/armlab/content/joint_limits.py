"""A sentence on the joints that are outside their limits."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from armlab.kin.arm import Arm


def outside(arm: Arm, q: ArrayLike, room: float = 1e-9) -> str:
    """Return which joints are outside their limits, with their values; empty when none is.

    >>> from armlab.kin.arm import Arm
    >>> arm = Arm.from_dh([["R", 1, 0, 0, 0]] * 2, limits=[[-1, 1]] * 2)
    >>> outside(arm, [0.5, 2])
    'joint 2 is at 114.6°, outside its limits of -57.3° to 57.3°'
    """
    values, (low, high) = np.asarray(q, dtype=np.float64), arm.limits.T
    found = []
    for j in np.flatnonzero((values < low - room) | (values > high + room)):
        at, least, most = (_shown(value, bool(arm.revolute[j])) for value in (values[j], low[j], high[j]))
        found.append(f"joint {j + 1} is at {at}, outside its limits of {least} to {most}")
    return "; ".join(found)


def _shown(value: float, turns: bool) -> str:
    return f"{np.degrees(value):.4g}°" if turns else f"{value:.4g} m"
