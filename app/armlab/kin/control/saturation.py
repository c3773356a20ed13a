"""Saturation of motors: joint speeds beyond their limits are cut or scaled.

References
----------
Notes 5.106, which should read |qdot_i| <= 300 degrees a second.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.checks import as_floats, together
from armlab.registry import known_name

Floats = NDArray[np.float64]

SATURATIONS = {
    "none": "no limit",
    "clip": "each joint by itself",
    "scale": "all joints slowed alike",
}
"""Ways to saturate, by key, in words. ``clip`` changes the direction of the tool's velocity (5.106); ``scale`` keeps
it."""


class Saturated(NamedTuple):
    """Joint speeds within the limits, and whether they had to be changed."""

    qdot: Floats
    changed: bool


def checked_saturation(key: str) -> str:
    """Return the key of a way to saturate; `UnknownName` when there is none."""
    return known_name("saturation", key, SATURATIONS)


def saturate(key: str, qdot: ArrayLike, limits: ArrayLike) -> Saturated:
    """Return joint speeds (n,) within limits (n,), positive or infinite.

    Parameters
    ----------
    key : str
        ``"clip"``: each component by itself; ``"scale"``: all by the same factor, so that the direction of motion is
        kept; ``"none"``: they are left alone.
    qdot : array_like, shape (n,)
        rad/s or m/s.
    limits : array_like, shape (n,)
        Largest magnitudes, in the same units.

    Raises
    ------
    UnknownName
        There is no such way.
    InputError
        Not numbers, or shapes that do not fit.
    """
    speeds, most = as_floats(qdot, "qdot", "joint speeds"), as_floats(limits, "limits", "largest joint speeds")
    together(qdot=speeds.shape, limits=most.shape)
    return limited(checked_saturation(key), speeds, most)


def limited(key: str, qdot: Floats, limits: Floats) -> Saturated:
    """Return the same as `saturate` of arguments that have been checked, as in each step of a simulation."""
    if key == "none":
        return Saturated(qdot, False)
    share = float(np.max(np.abs(qdot) / limits, initial=0.0))
    if share <= 1.0:
        return Saturated(qdot, False)
    return Saturated(np.clip(qdot, -limits, limits) if key == "clip" else qdot / share, True)
