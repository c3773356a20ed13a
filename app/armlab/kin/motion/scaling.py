"""Uniform time scaling: as fast as the limits allow, without touching the path (section 6.3.4 of the notes)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.motion.field import positive_bounds
from armlab.kin.motion.law_types import SMOOTH_ENOUGH
from armlab.kin.motion.peaks import peaks
from armlab.kin.motion.sequence import Slowed
from armlab.kin.motion.trajectory import Motion, Trajectory

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Scaling:
    """The factor that makes a motion as fast as its limits allow.

    Attributes
    ----------
    k : float
        The new time is k times the old: more than 1 slows down, less speeds up.
    joint : int
        The joint (1-based) that meets its limit then.
    quantity : str
        ``"velocity"``, ``"acceleration"`` or ``"jerk"``.
    """

    k: float
    joint: int
    quantity: str

    @property
    def explanation(self) -> str:
        """The same in words."""
        change = "slower" if self.k > 1.0 else "faster" if self.k < 1.0 else "as fast"
        return f"{change}: k = {self.k:.4g}, and joint {self.joint} meets its limit of {self.quantity}"


def optimal_scaling(
    v_peak: Any, a_peak: Any, v_max: Any, a_max: Any = math.inf, jerk_peak: Any = 0.0, jerk_max: Any = math.inf
) -> Scaling:
    """Return the k at which one limit is met and none exceeded.

    Parameters
    ----------
    v_peak, a_peak, jerk_peak : array_like, shape (m,)
        Largest absolute values of each joint.
    v_max, a_max, jerk_max : array_like, shape (m,) or ()

    Raises
    ------
    InputError
        A limit that is not positive, or nothing that holds the motion back.

    References
    ----------
    Notes 6.161-6.163, with the cube root for the jerk.

    Examples
    --------
    >>> optimal_scaling([3.75, 1.875], [11.547, 5.774], [2.0, 2.0], [8.0, 8.0]).k
    1.875
    """
    v = np.atleast_1d(np.asarray(v_peak, dtype=float))
    m = len(v)
    quotients = []
    for order, (where, peak, limits) in enumerate(
        (("v_max", v, v_max), ("a_max", a_peak, a_max), ("jerk_max", jerk_peak, jerk_max)), start=1
    ):
        high = positive_bounds(limits, where, m)
        quotients.append((np.broadcast_to(np.asarray(peak, dtype=float), (m,)) / high) ** (1.0 / order))
    table = np.array(quotients)
    kind, joint = np.unravel_index(int(np.argmax(table)), table.shape)
    if table[kind, joint] == 0.0:
        raise InputError("v_max, a_max: no limit holds this motion back")
    return Scaling(float(table[kind, joint]), int(joint) + 1, ("velocity", "acceleration", "jerk")[kind])


def scaled(motion: Motion, k: float) -> Motion:
    """Return the motion k times as slow; the path stays. A trajectory stays one, with its law stretched."""
    if isinstance(motion, Trajectory):
        return Trajectory(motion.path, motion.law.stretched(k))
    return Slowed(motion, k)


def as_fast_as_allowed(
    motion: Motion, v_max: Any, a_max: Any = math.inf, jerk_max: Any = math.inf
) -> tuple[Motion, Scaling]:
    """Return the motion at its uniform scaling that meets one limit, and the scaling.

    Raises
    ------
    InputError
        A limit that is not positive, nothing that holds the motion back, or a limit of jerk where accelerations jump.
    """
    finite_jerk = bool(np.isfinite(np.asarray(jerk_max, dtype=float)).any())
    if finite_jerk and motion.continuity_from_rest < SMOOTH_ENOUGH:
        raise InputError("jerk_max: the acceleration of this motion jumps, so its jerk is infinite at any speed")
    jerk = peaks(motion, 3).peak if finite_jerk else 0.0
    scaling = optimal_scaling(peaks(motion, 1).peak, peaks(motion, 2).peak, v_max, a_max, jerk, jerk_max)
    return scaled(motion, scaling.k), scaling
