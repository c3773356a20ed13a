"""Weights of task components: their importance where not all can be reached."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats, wrong

Weights = tuple[float, ...]

LEAST = 1e-6
"""Smallest weight, relative to the largest, that is not lost in rounding with 16 digits."""


def checked_weights(arm: Arm, weights: ArrayLike | None) -> Weights | None:
    """Return one weight for each component of an arm's task, the largest being 1; None where all are the same.

    Raises
    ------
    InputError
        They are not m positive numbers, differ by more than `LEAST`, or differ between the components of the
        orientation.
    """
    if weights is None:
        return None
    m, places = arm.task.m, len(arm.task.position)
    values = positive_factors(weights, "weights", m)
    one_for_the_orientation(values[places:], "weights")
    values /= values.max(initial=0.0)
    if np.any(values < LEAST):
        raise InputError(f"weights: expected a ratio of at most {1.0 / LEAST:g}, got {weights}")
    return None if np.all(values == 1.0) else tuple(values.tolist())


def positive_factors(values: ArrayLike, where: str, m: int) -> NDArray[np.float64]:
    """Return m positive, finite numbers (m,), one for each task component; `InputError` otherwise."""
    found = as_floats(values, where, f"{m} positive numbers")
    if found.shape != (m,) or not np.all(np.isfinite(found) & (found > 0.0)):
        raise wrong(where, f"{m} positive numbers", values)
    return found


def one_for_the_orientation(values: Sequence[float] | NDArray[np.float64], where: str) -> None:
    """Refuse different factors for the components of one rotation, for which the slope would not be J^T e."""
    if len(values) and not all(value == values[0] for value in values):
        listed = [float(value) for value in values]
        raise InputError(f"{where}: expected one number for all components of the orientation, got {listed}")
