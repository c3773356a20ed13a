"""Times of a film of steps, usually three, one after the other with a rest between them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.easing import eased

STEPS = 3

STEP, REST = 1.5, 0.4
"""Duration of a step and of the rest after it, seconds."""


def ends_of(steps: int) -> tuple[float, ...]:
    """Return the ends of so many steps, seconds."""
    return tuple((STEP + REST) * k + STEP for k in range(steps))


ENDS = ends_of(STEPS)
"""Ends of the steps, seconds."""

DURATION = ENDS[-1]


def amounts(time: float, steps: int = STEPS) -> NDArray[np.float64]:
    """Return how much of each step is done at a time, shape (steps,), from 0 to 1."""
    return np.array([eased((time - end) / STEP + 1.0) for end in ends_of(steps)])


def step_at(time: float, steps: int = STEPS) -> int:
    """Return the step that is being made, or has just been made, at a time, 0-based."""
    return min(int(time / (STEP + REST)), steps - 1)
