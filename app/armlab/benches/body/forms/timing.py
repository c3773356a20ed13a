"""Times of a film of three steps, one after the other with a rest between them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.easing import eased

STEPS = 3

STEP, REST = 1.5, 0.4
"""Duration of a step and of the rest after it, seconds."""

ENDS = tuple((STEP + REST) * k + STEP for k in range(STEPS))
"""Ends of the steps, seconds."""

DURATION = ENDS[-1]


def amounts(time: float) -> NDArray[np.float64]:
    """Return how much of each step is done at a time, shape (3,), from 0 to 1."""
    return np.array([eased((time - end) / STEP + 1.0) for end in ENDS])


def step_at(time: float) -> int:
    """Return the step that is being made, or has just been made, at a time, 0 to 2."""
    return min(int(time / (STEP + REST)), STEPS - 1)
