"""A direction perpendicular to a chord, chosen when none is given."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError

Floats = NDArray[np.float64]

ALONG = 1e-9
"""Sine of the angle with the chord below which a given direction is along it."""


def across(chord: Floats, given: Floats | None, where: str) -> Floats:
    """Return the unit normal of a unit chord nearest to a direction, shape (3,).

    Without one: nearest to z, or to x where the chord is along z.

    Raises
    ------
    InputError
        The direction is zero, along the chord, or not three numbers.
    """
    if given is None:
        upright = abs(chord[2]) > 0.999
        given = np.array([1.0, 0.0, 0.0]) if upright else np.array([0.0, 0.0, 1.0])
    if given.shape != (3,):
        raise InputError(f"{where}: expected three numbers, got {given.size}")
    length = float(np.linalg.norm(given))
    beside = given - (given @ chord) * chord
    if float(np.linalg.norm(beside)) <= ALONG * length or length == 0.0:
        raise InputError(f"{where}: expected a direction across the way from waypoint 1 to 2, got {given.tolist()}")
    return np.asarray(beside / np.linalg.norm(beside))
