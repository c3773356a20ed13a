"""The cut through a sampled workspace, and the one it has until a person chooses: the one that shows most of it.

Left alone, a workspace is cut by the points it has, so that the same seed gives the same picture:

* A planar workspace is drawn whole.
* Of a body the half in front of the arm is left out, so that its inside and the arm are seen, as long as a good part
  of its points lies behind the cut: about half of them, for an arm that turns all the way round. Where joint 1 does not
  reach behind the arm, as on a SCARA, most points would go; such a body is drawn whole.
* A slice begins where a slice of its thickness holds most points. It can be moved as far as there are points.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.workspace.cloud.samples import Sampled
from armlab.benches.workspace.cloud.state import AUTO, Workspace
from armlab.kin.arm import Arm

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

FRONT = math.radians(-50.0)
"""Azimuth of the first view of an arm, radians: the half that is cut away lies in front of it."""

BEHIND = 0.4
"""Least share of the drawn points behind the cut with which the half in front is left out."""

SLICE = 0.02
"""Half thickness of a slice, in reaches of the arm."""

AXES = ("x", "y", "z")


def cut_of(part: Workspace) -> str:
    """Return the cut that is drawn, a key of `CUTS`: the chosen one, or the one that suits the points."""
    if part.cut != AUTO:
        return part.cut
    found = part.found
    if found is None or found.planar:
        return "none"
    return _suiting(found)


def place_of(part: Workspace) -> float:
    """Return where a slice across an axis is, metres from the origin of frame 0: where a person put it, or most is."""
    cut = cut_of(part)
    if part.offset is not None or part.found is None or cut not in AXES:
        return part.offset or 0.0
    return _fullest(part.found, AXES.index(cut))


def range_of(part: Workspace) -> tuple[float, float]:
    """Return between which places there are points for a slice across the axis of the cut, metres."""
    cut = cut_of(part)
    if part.found is None or cut not in AXES:
        return 0.0, 0.0
    along = _local(part.found.question.arm, part.found.shown.points)[:, AXES.index(cut)]
    return float(along.min()), float(along.max())


def left_by_cut(part: Workspace, found: Sampled, points: ArrayLike) -> Mask:
    """Return which points (k, 3) in the world remain after the cut, shape (k,)."""
    arm, cut = found.question.arm, cut_of(part)
    if cut == "front" and not found.planar:
        return behind(arm, points)
    if cut in AXES:
        along = _local(arm, points)[:, AXES.index(cut)]
        return np.asarray(np.abs(along - place_of(part)) <= SLICE * arm.reach)
    return np.ones(len(np.asarray(points)), dtype=bool)


def across(base: Floats, axis: int) -> tuple[Floats, Floats]:
    """Return the directions right and up of a picture of the plane across an axis of frame 0, each (3,)."""
    if axis == 1:
        return base[:3, 0], base[:3, 2]  # x to the right and z up, as from the front
    return base[:3, (axis + 1) % 3], base[:3, (axis + 2) % 3]


@lru_cache(maxsize=8)
def _suiting(found: Sampled) -> str:
    return "front" if opens(found.question.arm, found.shown.points) else "none"


@lru_cache(maxsize=8)
def _fullest(found: Sampled, axis: int) -> float:
    """Return the place of the slice with most of the drawn points; the lowest of several."""
    arm = found.question.arm
    along = np.sort(_local(arm, found.shown.points)[:, axis])
    last = np.searchsorted(along, along + 2.0 * SLICE * arm.reach, side="right") - 1
    first = int(np.argmax(last - np.arange(len(along))))
    return 0.5 * float(along[first] + along[last[first]])


def opens(arm: Arm, points: ArrayLike) -> bool:
    """Return whether a body of points (k, 3) in the world is well seen without its half in front."""
    return bool(np.mean(behind(arm, points)) >= BEHIND)


def behind(arm: Arm, points: ArrayLike) -> Mask:
    """Return which points (k, 3) in the world lie in the half behind the arm, shape (k,)."""
    local = _local(arm, points)
    return np.asarray(local[:, 0] * math.cos(FRONT) + local[:, 1] * math.sin(FRONT) <= 0.0)


def _local(arm: Arm, points: ArrayLike) -> Floats:
    """Return points (k, 3) of the world in frame 0."""
    return np.asarray((np.asarray(points, dtype=np.float64) - arm.base[:3, 3]) @ arm.base[:3, :3])
