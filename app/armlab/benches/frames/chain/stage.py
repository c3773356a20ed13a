"""Size and place of the picture of frames: of their origins and of what else is drawn."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.benches.frames.chain.state import Chain
from armlab.benches.frames.chain.tree import point_of, poses_of
from armlab.session.state import State

Floats = NDArray[np.float64]

SHARE = 0.16
"""Length of the axes of a frame, in the extent of the picture."""

STEP = 10.0**0.1
"""Ratio of two sizes in succession, so that marks keep their size while a hand moves them a little."""

LEAST = 0.5
"""Least extent, metres: frames in one place have a size as well."""


def unit_of(points: Floats) -> float:
    """Return the length of the axes of frames in a picture of points (k, 3), metres; it changes in steps of `STEP`."""
    extent = max(float(np.linalg.norm(np.ptp(points, axis=0))), LEAST)
    return float(STEP ** round(math.log(SHARE * extent) / math.log(STEP)))


def box_of(points: Floats, margin: float) -> Floats:
    """Return the corners (2, 3) of a box around points (k, 3), with a margin on all sides, metres."""
    return np.array([points.min(axis=0) - margin, points.max(axis=0) + margin])


def places_of(state: State) -> Floats:
    """Return the origins of all frames and the place of the point, in the world, (k, 3)."""
    part, p = state[Chain], state.derived(point_of)
    found = [T[:3, 3] for T in state.derived(poses_of).values()]
    found.append(p)
    if part.globe:
        centre = state.derived(poses_of)[part.given][:3, 3]
        radius = float(np.linalg.norm(p - centre))
        found += [centre - radius, centre + radius]
    return np.array(found)


def around(state: State) -> Floats:
    """Return the corners (2, 3) of what belongs in the picture."""
    places = state.derived(places_of)
    return box_of(places, unit_of(places))
