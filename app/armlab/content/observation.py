"""What the check of a lesson may look at."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm


@dataclass(frozen=True, eq=False)
class Observation:
    """The arm as it is on screen.

    Attributes
    ----------
    arm : Arm
    q : ndarray, shape (n,)
        Radians and metres.
    tool_pose : ndarray, shape (4, 4)
        The tool in the world.
    """

    arm: Arm
    q: NDArray[np.float64]
    tool_pose: NDArray[np.float64]

    @classmethod
    def of(cls, arm: Arm, q: ArrayLike) -> Observation:
        """Return what is seen of an arm at q, shape (n,)."""
        values = np.array(q, dtype=np.float64)
        return cls(arm, values, np.array(arm.fk(values), dtype=np.float64))
