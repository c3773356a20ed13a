"""Motion from one configuration to another: all joints together on a line in joint space, or each by itself."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats, wrong
from armlab.kin.motion.law import Law
from armlab.kin.motion.law_types import law_type
from armlab.kin.motion.limits import Limits, limits_of
from armlab.kin.motion.path_types import path_type
from armlab.kin.motion.run_along import run_along
from armlab.kin.motion.sequence import Separate
from armlab.kin.motion.trajectory import Trajectory

Floats = NDArray[np.float64]


def coordinated(
    start: ArrayLike,
    end: ArrayLike,
    law: str = "trapezoidal",
    limits: Limits | Arm | None = None,
    *,
    duration: float | None = None,
    **options: Any,
) -> Trajectory:
    """Return the straight line in joint space: all joints start and end together.

    Parameters
    ----------
    start, end : array_like, shape (m,)
        Rad or m.
    law, limits, duration, **options
        As of `armlab.kin.motion.run_along.run_along`: as fast as the limits allow, or in a duration that keeps them.

    References
    ----------
    Notes, the list before section 6.1, and 6.25: on a line M_v,i = |Delta q_i| and M_a,i = 0.

    Examples
    --------
    >>> round(coordinated([0.0, 0.0], [1.0, 0.5], "quintic", Limits(velocity=1.5)).duration, 9)
    1.25
    """
    path = path_type("line").path(np.stack(_ends(start, end)))
    return run_along(path, law, limits, duration=duration, **options)


def independent(
    start: ArrayLike,
    end: ArrayLike,
    law: str = "trapezoidal",
    limits: Limits | Arm | None = None,
    *,
    shape: Limits | None = None,
    jumps: bool = False,
    **options: Any,
) -> Separate:
    """Return the motion with each joint as fast as it can: all start together, each ends by itself.

    The time is the same as when coordinated only if one joint is the slowest in every respect; the way in joint space
    is not straight. Parameters as of `coordinated`, and as of `armlab.kin.motion.law_types.LawType.along`.
    """
    q_i, q_f = _ends(start, end)
    if limits is None:
        raise InputError("limits: give Limits(velocity=..., acceleration=...) or an arm")
    held, kind = limits_of(limits, len(q_i)), law_type(law)
    forms = held if shape is None else shape.for_joints(len(q_i))
    laws: list[Law | None] = []
    for j, (a, b) in enumerate(zip(q_i, q_f, strict=True)):
        line = None if a == b else path_type("line").path([[a], [b]])
        one, form = held.of_joint(j), forms.of_joint(j)
        laws.append(None if line is None else kind.along(line, one, shape=form, jumps=jumps, **options))
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
