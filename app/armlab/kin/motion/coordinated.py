"""From one configuration to another: all joints together on a straight line in joint space, or each by itself."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, wrong
from armlab.kin.motion.field import positive, positive_bounds
from armlab.kin.motion.law import Law
from armlab.kin.motion.law_types import law_type
from armlab.kin.motion.path_types import path_type
from armlab.kin.motion.sequence import Separate
from armlab.kin.motion.trajectory import Trajectory

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class JointLimits:
    """Limits of the rates of m joints, infinite where there are none.

    Attributes
    ----------
    velocity, acceleration, jerk : ndarray, shape (m,)
    """

    velocity: Floats
    acceleration: Floats
    jerk: Floats

    @classmethod
    def of(cls, m: int, velocity: Any = math.inf, acceleration: Any = math.inf, jerk: Any = math.inf) -> JointLimits:
        """Return checked limits; one number stands for all joints. `InputError` names the joint."""
        given = (("v_max", velocity), ("a_max", acceleration), ("jerk_max", jerk))
        return cls(*(positive_bounds(values, where, m) for where, values in given))


def coordinated(
    start: ArrayLike,
    end: ArrayLike,
    law: str = "trapezoidal",
    *,
    duration: float | None = None,
    v_max: Any = math.inf,
    a_max: Any = math.inf,
    jerk_max: Any = math.inf,
    **options: Any,
) -> Trajectory:
    """Return the straight line in joint space: all joints start and end together.

    Parameters
    ----------
    start, end : array_like, shape (m,)
        Rad or m.
    law : str
        Key of a timing law.
    duration : float, optional
        Seconds; left out: as fast as the limits allow, the limits of s being the smallest v_i / |Delta q_i| and so on.
    v_max, a_max, jerk_max : array_like, shape (m,) or ()
    **options
        Of the law.

    References
    ----------
    Notes, the list before section 6.1, and 6.25: on a line M_v,i = |Delta q_i| and M_a,i = 0.
    """
    q_i, q_f = _ends(start, end)
    path, kind = path_type("line").path(np.stack([q_i, q_f])), law_type(law)
    if duration is not None:
        return Trajectory(path, kind.law(positive(duration, "duration"), **options))
    limits = JointLimits.of(len(q_i), v_max, a_max, jerk_max)
    way = np.abs(q_f - q_i)
    moving = way > 0.0
    rates = ((each[moving] / way[moving]).min() for each in (limits.velocity, limits.acceleration, limits.jerk))
    return Trajectory(path, kind.within(*map(float, rates), **options))


def independent(
    start: ArrayLike,
    end: ArrayLike,
    law: str = "trapezoidal",
    *,
    v_max: Any = math.inf,
    a_max: Any = math.inf,
    jerk_max: Any = math.inf,
    **options: Any,
) -> Separate:
    """Return the motion with each joint as fast as it can: all start together, each ends by itself.

    The time is the same as when coordinated only if one joint is the slowest in every respect; the way in joint space
    is not straight. Parameters as of `coordinated`.
    """
    q_i, q_f = _ends(start, end)
    limits, kind = JointLimits.of(len(q_i), v_max, a_max, jerk_max), law_type(law)
    laws: list[Law | None] = []
    for way, v, a, j in zip(np.abs(q_f - q_i), limits.velocity, limits.acceleration, limits.jerk, strict=True):
        laws.append(kind.within(float(v / way), float(a / way), float(j / way), **options) if way > 0.0 else None)
    return Separate(q_i, q_f, laws)


def _ends(start: ArrayLike, end: ArrayLike) -> tuple[Floats, Floats]:
    q_i, q_f = as_floats(start, "start", "numbers"), as_floats(end, "end", "numbers")
    if q_i.ndim != 1 or not np.isfinite(q_i).all():
        raise wrong("start", "a list of finite numbers", start)
    if q_f.shape != q_i.shape or not np.isfinite(q_f).all():
        raise wrong("end", f"{len(q_i)} finite numbers", end)
    if np.array_equal(q_i, q_f):
        raise InputError("end: the same as the start, nothing moves")
    return q_i, q_f
