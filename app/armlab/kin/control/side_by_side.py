"""Several inverses of the differential kinematics, compared for the same velocity of the tool."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, finite_floats
from armlab.kin.control.rate_inverse import RateStep, rate_inverse, rate_step

Floats = NDArray[np.float64]

METHODS = ("transpose", "inverse", "pinv", "dls_constant", "dls_variable")
"""Keys of the methods that are compared unless others are asked for."""

STILL = 1e-12
"""Fraction of the wanted velocity: a reached velocity below it has no direction."""


class Compared(NamedTuple):
    """Joint speeds of one method and the velocity of the tool they give, in scaled components.

    Attributes
    ----------
    key, title : str
    step : RateStep
        Its joint speeds are None where the method has no answer.
    reached : ndarray, shape (m,), or None
        ``J qdot``.
    along : float
        Part of the wish that is met: the component of ``reached`` along v over the length of v; 0 without an answer.
    error : float
        ``|reached - v| / |v|``; 1 without an answer, when the tool stays.
    off : float or None
        Angle in radians between ``reached`` and v; None where the tool stays.
    """

    key: str
    title: str
    step: RateStep
    reached: Floats | None
    along: float
    error: float
    off: float | None


def side_by_side(
    J: ArrayLike,
    v: ArrayLike,
    options: Mapping[str, Mapping[str, Any]] | None = None,
    methods: Sequence[str] = METHODS,
) -> tuple[Compared, ...]:
    """Return the joint speeds of each method for a velocity of the tool.

    Parameters
    ----------
    J : array_like, shape (m, n)
        Task Jacobian, scaled (`armlab.kin.control.scaled_task`).
    v : array_like, shape (m,)
        Wanted task velocity, scaled; not zero.
    options : mapping, optional
        Options by key of the method; see `armlab.kin.control.rate_inverse.RateInverse`.
    methods : sequence of str

    Raises
    ------
    InputError
        As of `rate_step`, or v is zero.

    Examples
    --------
    >>> [(one.key, round(one.error, 3)) for one in side_by_side([[2.0, 0.0], [0.0, 0.0]], [1.0, 0.0])][1:3]
    [('inverse', 1.0), ('pinv', 0.0)]
    """
    matrix = as_floats(J, "J", "a matrix of finite numbers")
    rows = matrix.shape[0] if matrix.ndim == 2 else 0
    wish = finite_floats(v, "v", (rows,), f"{rows} finite numbers")
    size = float(np.linalg.norm(wish))
    if size == 0.0:
        raise InputError("v: expected a velocity that is not zero")
    given = options or {}
    return tuple(_compared(key, matrix, wish, size, given.get(key)) for key in methods)


def _compared(key: str, J: Floats, v: Floats, size: float, options: Mapping[str, Any] | None) -> Compared:
    step, title = rate_step(key, J, v, options), rate_inverse(key).title
    if step.qdot is None:
        return Compared(key, title, step, None, 0.0, 1.0, None)
    reached = J @ step.qdot
    along = float(reached @ v) / size**2
    aside = float(np.linalg.norm(reached - along * v)) / size
    off = None if math.hypot(along, aside) < STILL else math.atan2(aside, along)
    return Compared(key, title, step, reached, along, math.hypot(along - 1.0, aside), off)
