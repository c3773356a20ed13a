"""A sentence on a typed matrix that is no rotation, beside the nearest one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.nearest import NearestRotation, is_rounded
from armlab.ui.format import number, scientific
from armlab.ui.html import Inside, Markup
from armlab.ui.markup import verdict_box

LEAST = 1e-3
"""Distance below which a power of ten is written."""


def nearest_box(typed: NDArray[np.float64], nearest: NearestRotation, *parts: Inside) -> Markup:
    """Return how far a typed matrix is from the nearest rotation, and whether rounding explains it, above parts."""
    away = number(nearest.distance, 4) if nearest.distance >= LEAST else scientific(nearest.distance)
    if is_rounded(typed, nearest):
        return verdict_box("ok", f"A rotation with rounded entries: the exact one is {away} away", *parts)
    return verdict_box("warn", f"Not a rotation: the nearest one is {away} away", *parts)
