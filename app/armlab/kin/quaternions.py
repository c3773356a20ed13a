"""Algebra of quaternions: product, inverse, exponential, logarithm and the way from one to another.

Quaternions are ``(w, x, y, z)``, scalar first: eta and eps of the notes. Every function takes leading batch dimensions,
which broadcast. How a unit quaternion and a rotation matrix belong together is in `armlab.kin.rotations`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats
from armlab.kin.rotations import skew

Floats = NDArray[np.float64]

NO_AXIS = np.array([0.0, 0.0, 1.0])
"""Axis taken where a quaternion has none: of the logarithm of a negative number, and between q and -q."""

ROUNDING = 2e-15
"""Length of the vector part of a quotient of unit quaternions up to which it is made of rounding errors."""


def product(p: ArrayLike, q: ArrayLike) -> Floats:
    """Return the quaternion p q; of unit quaternions it is that of the rotation R(p) R(q).

    Parameters
    ----------
    p, q : array_like, shape (..., 4)

    References
    ----------
    Notes 3.74.

    Examples
    --------
    >>> product([0, 1, 0, 0], [0, 0, 1, 0]).tolist()
    [0.0, 0.0, 0.0, 1.0]
    """
    one, other = _quaternions(p, "p"), _quaternions(q, "q")
    a, u, b, v = one[..., :1], one[..., 1:], other[..., :1], other[..., 1:]
    scalar = a * b - np.sum(u * v, axis=-1, keepdims=True)
    cross = (skew(u) @ v[..., None])[..., 0]
    return np.concatenate([scalar, a * v + b * u + cross], axis=-1)


def conjugate(q: ArrayLike) -> Floats:
    """Return (w, -x, -y, -z), shape (..., 4): of a unit quaternion the inverse."""
    return _quaternions(q, "q") * [1.0, -1.0, -1.0, -1.0]


def inverse(q: ArrayLike) -> Floats:
    """Return the quaternion whose product with q, on either side, is 1.

    Raises
    ------
    InputError
        Not of shape (..., 4), not finite, or zero, which has no inverse.
    """
    values, length = _with_length(q)
    # Divided twice: the square of a small length may be zero.
    return conjugate(values / length) / length


def unit(q: ArrayLike) -> Floats:
    """Return q divided by its length, shape (..., 4).

    Raises
    ------
    InputError
        As of `inverse`: zero has no direction.
    """
    values, length = _with_length(q)
    return values / length


def exponential(q: ArrayLike) -> Floats:
    """Return e^q = e^w (cos |v|, sin |v| v / |v|) with v = (x, y, z), shape (..., 4).

    With w = 0 it is the unit quaternion of a turn by 2 |v| about v.

    Examples
    --------
    >>> exponential([0, 0, 0, np.pi / 2]).round(6).tolist()
    [0.0, 0.0, 0.0, 1.0]
    """
    values = _quaternions(q, "q")
    v = values[..., 1:]
    length = _norm(v)
    # sinc(x / pi) is sin(x) / x, also at zero.
    turned = np.concatenate([np.cos(length), np.sinc(length / math.pi) * v], axis=-1)
    return np.asarray(np.exp(values[..., :1]) * turned)


def logarithm(q: ArrayLike) -> Floats:
    """Return the quaternion whose exponential is q: (ln |q|, theta / 2 r), with theta / 2 in [0, pi].

    The vector part of that of a unit quaternion is half of the rotation vector. A negative number has a logarithm about
    every axis; that about z is returned.

    Raises
    ------
    InputError
        As of `inverse`: zero has no logarithm.

    Examples
    --------
    >>> logarithm([0.0, 0.0, 0.0, 2.0]).round(6).tolist()
    [0.693147, 0.0, 0.0, 1.570796]
    """
    values, length = _with_length(q)
    w, v = values[..., :1] / length, values[..., 1:] / length
    size = _norm(v)
    real = size == 0.0
    axis = np.where(real, NO_AXIS, v / np.where(real, 1.0, size))
    return np.concatenate([np.log(length), np.arctan2(size, w) * axis], axis=-1)


def slerp(p: ArrayLike, q: ArrayLike, s: ArrayLike, *, shorter: bool = True) -> Floats:
    """Return the unit quaternions on the way from p to q about one axis at an even rate: p (p^-1 q)^s.

    Parameters
    ----------
    p, q : array_like, shape (..., 4)
        Not zero; they are normalised.
    s : array_like, shape (...)
        0 gives p, 1 gives q.
    shorter : bool
        q and -q are the same rotation; whether to go to the nearer one, which of q = -p is p itself. Otherwise the turn
        may be up to 2 pi; that from p to -p, a whole turn about no axis in particular, is made about z of the body. At
        half a turn q and -q are as near, and q is taken as it is given, up to rounding.

    Returns
    -------
    ndarray, shape (..., 4)

    Raises
    ------
    InputError
        As of `inverse`.

    Examples
    --------
    >>> slerp([1, 0, 0, 0], [0, 0, 0, 1], 0.5).round(6).tolist()
    [0.707107, 0.0, 0.0, 0.707107]
    """
    start, end = unit(p), unit(q)
    share = as_floats(s, "s", "numbers")
    between = product(conjugate(start), end)
    if shorter:
        between = np.where(between[..., :1] < 0.0, -between, between)
    none = _norm(between[..., 1:]) < ROUNDING
    between = np.where(none & (between[..., :1] < 0.0), [-1.0, 0.0, 0.0, 0.0], between)
    return product(start, exponential(share[..., None] * logarithm(between)))


def _quaternions(q: ArrayLike, where: str) -> Floats:
    values = as_floats(q, where, "numbers of shape (..., 4)")
    if values.shape[-1:] != (4,):
        raise InputError(f"{where}: expected shape (..., 4), got {values.shape}")
    return values


def _with_length(q: ArrayLike) -> tuple[Floats, Floats]:
    """Return quaternions (..., 4) and their lengths (..., 1), of which none is zero."""
    values = _quaternions(q, "q")
    length = _norm(values)
    if np.any(length == 0.0) or not np.all(np.isfinite(length)):
        raise InputError("q: expected a finite quaternion that is not zero")
    return values, length


def _norm(values: Floats) -> Floats:
    """Return lengths (..., 1), also of numbers whose squares are too small or too large."""
    largest = np.max(np.abs(values), axis=-1, keepdims=True)
    return np.asarray(largest * np.linalg.norm(values / np.where(largest == 0.0, 1.0, largest), axis=-1, keepdims=True))
