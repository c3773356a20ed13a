"""Two rotations in both orders: the angle between the ends, and what is left of the rule of first order."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats
from armlab.kin.rotations import skew

Floats = NDArray[np.float64]


def apart_by_order(first: ArrayLike, second: ArrayLike, one: ArrayLike, other: ArrayLike) -> Floats:
    """Return the angle between R_b R_a and R_a R_b, radians in [0, pi], shape (...).

    With the vector parts eps of both quaternions the two products differ by 2 eps_a x eps_b, so the angle is
    4 asin |eps_a x eps_b|, folded to the shorter way. For small angles this is theta_a theta_b |a x b|, and it keeps
    its digits however small they are, where a difference of matrices loses them.

    Parameters
    ----------
    first, second : array_like, shape (..., 3)
        Axes of both rotations; they need not be of unit length, must not be zero.
    one, other : array_like, shape (...)
        Their angles, radians.

    Raises
    ------
    InputError
        Not vectors, not finite, or zero.

    References
    ----------
    Notes 5.18.

    Examples
    --------
    >>> round(math.degrees(apart_by_order([1, 0, 0], [0, 0, 1], math.pi / 2, math.pi / 2)), 6)
    120.0
    """
    a, b = _unit(first, "first"), _unit(second, "second")
    half, other_half = 0.5 * as_floats(one, "one", "numbers"), 0.5 * as_floats(other, "other", "numbers")
    sine = np.abs(np.sin(half) * np.sin(other_half)) * np.linalg.norm(np.cross(a, b), axis=-1)
    # 1 - sine^2, which is 0 for half turns across each other, without a difference of nearly equal numbers.
    beside, beside_other, along = np.cos(half) ** 2, np.cos(other_half) ** 2, np.sum(a * b, axis=-1) ** 2
    rest = beside + (1.0 - beside) * (beside_other + (1.0 - beside_other) * along)
    angle = 4.0 * np.arctan2(sine, np.sqrt(rest))
    return np.asarray(np.minimum(angle, 2.0 * math.pi - angle))


def across(first: ArrayLike, second: ArrayLike) -> Floats:
    """Return the sine of the angle between two axes (..., 3), shape (...)."""
    return np.asarray(np.linalg.norm(np.cross(_unit(first, "first"), _unit(second, "second")), axis=-1))


def beyond_first_order(first: ArrayLike, second: ArrayLike, one: ArrayLike, other: ArrayLike) -> Floats:
    """Return the largest entry of R_b R_a - (I + S(theta_a a + theta_b b)), shape (...).

    It is of second order in the angles. The terms of first order are left out before anything is added, so that small
    angles keep their digits.

    Parameters
    ----------
    first, second, one, other : array_like
        As of `apart_by_order`.

    References
    ----------
    Notes 5.22-5.27, which print an equality: it holds to first order only.

    Examples
    --------
    >>> round(float(beyond_first_order([1, 0, 0], [0, 0, 1], 1e-6, 1e-6)) / 1e-12, 6)
    1.0
    """
    A, a = _beyond_one(first, "first", one)
    B, b = _beyond_one(second, "second", other)
    rest = a + b + (B + b) @ (A + a)
    return np.asarray(np.abs(rest).max(axis=(-2, -1)))


def _beyond_one(axis: ArrayLike, where: str, angle: ArrayLike) -> tuple[Floats, Floats]:
    """Return theta S(r), and what R - I has besides, (..., 3, 3) each."""
    theta = as_floats(angle, "angle", "numbers")[..., None, None]
    S = np.asarray(skew(_unit(axis, where)), dtype=np.float64)
    # 1 - cos is 2 sin^2 of the half, without cancellation.
    return theta * S, (np.sin(theta) - theta) * S + 2.0 * np.sin(0.5 * theta) ** 2 * (S @ S)


def _unit(axis: ArrayLike, where: str) -> Floats:
    values = as_floats(axis, where, "numbers of shape (..., 3)")
    if values.shape[-1:] != (3,):
        raise InputError(f"{where}: expected shape (..., 3), got {values.shape}")
    length = np.linalg.norm(values, axis=-1, keepdims=True)
    if np.any(length == 0.0) or not np.all(np.isfinite(length)):
        raise InputError(f"{where}: expected a finite axis that is not zero")
    return np.asarray(values / length)
