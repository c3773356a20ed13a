"""Rotations as matrices, and their other representations.

Matrices act on columns: ``R_ab @ p_b`` is p in the axes of a. Quaternions are ``(w, x, y, z)``, scalar first. Angles
are radians. Every function takes leading batch dimensions. SciPy's `Rotation` does the conversions it has; what is here
are the definitions of the notes with their singular cases spelled out.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, together, wrong
from armlab.kin.nearest import nearest_rotation

Array = NDArray[np.floating]

SMALL = 1e-15
"""Component of a unit quaternion that counts as zero when its sign would decide."""

EXACT = 1e-12
"""Deviation of R^T R from the identity below which a matrix is not changed: the rounding of long products."""

ROUNDED = 2e-3
"""Largest difference of an entry from the nearest rotation that is taken for rounding. Entries with three decimals are
off by up to 5e-4, or 1.5e-3 in the root of the sum of squares, and the nearest rotation is not farther away."""

_PERMUTED = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}


def rotation_about(axis: str, angle: ArrayLike) -> Array:
    """Return the elementary rotation about a coordinate axis.

    Parameters
    ----------
    axis : "x", "y" or "z"
    angle : array_like, shape (...)
        Radians; positive counter-clockwise seen against the axis.

    Returns
    -------
    ndarray, shape (..., 3, 3)

    References
    ----------
    Notes 3.16-3.17. The unnumbered line before them prints sin alpha for sin theta.
    """
    if not isinstance(axis, str) or axis not in _PERMUTED:
        raise InputError(f"axis: expected 'x', 'y' or 'z', got {axis!r}")
    angle = as_floats(angle, "angle", "numbers")
    i, j = _PERMUTED[axis]
    R = np.zeros((*angle.shape, 3, 3))
    R[...] = np.eye(3)
    R[..., i, i] = R[..., j, j] = np.cos(angle)
    R[..., j, i] = np.sin(angle)
    R[..., i, j] = -R[..., j, i]
    return R


def rotation_from_sequence(axes: str, angles: ArrayLike, *, fixed: bool = False) -> Array:
    """Return the product of elementary rotations about moving axes, or about fixed ones.

    Parameters
    ----------
    axes : str
        One to three letters of ``"xyz"``, such as ``"zyx"`` or ``"zxz"``; case does not matter.
    angles : array_like, shape (..., len(axes))
        Radians, in the order of ``axes``.
    fixed : bool
        About fixed axes the product is written in the reverse order (notes, theorem 2).

    Returns
    -------
    ndarray, shape (..., 3, 3)

    Examples
    --------
    >>> R = rotation_from_sequence("zyx", [0.1, 0.2, 0.3])
    >>> bool(np.allclose(R, rotation_from_sequence("xyz", [0.3, 0.2, 0.1], fixed=True)))
    True
    """
    if not isinstance(axes, str) or not axes or not set(axes.lower()) <= set(_PERMUTED):
        raise wrong("axes", "letters of 'xyz', such as 'zyx'", axes)
    angles = as_floats(angles, "angles", "numbers")
    if angles.shape[-1:] != (len(axes),):
        raise InputError(f"angles: expected {len(axes)} for the sequence {axes!r}, got shape {angles.shape}")
    R = np.broadcast_to(np.eye(3), (*angles.shape[:-1], 3, 3))
    for k, axis in enumerate(axes.lower()):
        turn = rotation_about(axis, angles[..., k])
        R = turn @ R if fixed else R @ turn
    return np.array(R)


def rotation_from_axis_angle(axis: ArrayLike, angle: ArrayLike) -> Array:
    """Return Rodrigues' rotation: r r^T + (I - r r^T) cos(theta) + S(r) sin(theta).

    Parameters
    ----------
    axis : array_like, shape (..., 3)
        Need not be of unit length, must not be zero.
    angle : array_like, shape (...)
        Radians.

    Raises
    ------
    InputError
        No axis, or shapes that do not fit.

    References
    ----------
    Notes 3.46-3.56.
    """
    r: Array = as_floats(axis, "axis", "numbers of shape (..., 3)")
    if r.shape[-1:] != (3,):
        raise InputError(f"axis: expected shape (..., 3), got {r.shape}")
    length = np.linalg.norm(r, axis=-1, keepdims=True)
    if np.any(length == 0.0) or not np.all(np.isfinite(length)):
        raise InputError(f"axis: expected a finite vector that is not zero, got {axis!r}")
    r = r / length
    theta: Array = as_floats(angle, "angle", "numbers")[..., None, None]
    together(axis=r.shape[:-1], angle=theta.shape[:-2])
    outer: Array = r[..., :, None] * r[..., None, :]
    return outer + (np.eye(3) - outer) * np.cos(theta) + skew(r) * np.sin(theta)


def skew(v: ArrayLike) -> Array:
    """Return S(v) with S(v) u = v x u, shape (..., 3, 3) from (..., 3). Notes, definition 3."""
    v = as_floats(v, "v", "numbers of shape (..., 3)")
    if v.shape[-1:] != (3,):
        raise InputError(f"v: expected shape (..., 3), got {v.shape}")
    S = np.zeros((*v.shape, 3))
    S[..., 2, 1], S[..., 0, 2], S[..., 1, 0] = v[..., 0], v[..., 1], v[..., 2]
    S[..., 1, 2], S[..., 2, 0], S[..., 0, 1] = -v[..., 0], -v[..., 1], -v[..., 2]
    return S


def as_rotation(R: ArrayLike, where: str = "R") -> NDArray[np.float64]:
    """Return a matrix as a rotation: as it is when it is one to rounding, else the nearest one within `ROUNDED`.

    Raises
    ------
    InputError
        Not a 3 x 3 matrix of finite numbers, a reflection, or farther off: the text says how far.
    """
    matrix = as_floats(R, where, "a 3 x 3 matrix of numbers")
    if matrix.shape == (3, 3) and _orthonormal(matrix.ravel().tolist(), EXACT):
        return matrix
    nearest = nearest_rotation(matrix, where)
    if nearest.off <= ROUNDED:
        return nearest.rotation
    if is_rotation(-matrix, ROUNDED):
        raise InputError(f"{where} is not a rotation matrix but a reflection: its determinant is -1, not +1")
    raise InputError(
        f"{where} is not a rotation matrix: the nearest one differs from it by {nearest.off:.2g} in an entry; up to "
        f"{ROUNDED:g} is taken for rounding"
    )


def as_rotations(R: ArrayLike, where: str = "R") -> NDArray[np.float64]:
    """Return matrices (..., 3, 3) as rotations, each as of `as_rotation`; in a batch one that is not finite stays.

    Raises
    ------
    InputError
        As of `as_rotation`.
    """
    matrices = (
        R if isinstance(R, np.ndarray) and R.dtype == np.float64 else as_floats(R, where, "3 x 3 matrices of numbers")
    )
    if matrices.shape[-2:] != (3, 3):
        raise InputError(f"{where}: expected shape (..., 3, 3), got {matrices.shape}")
    if matrices.ndim == 2:
        # Without a copy: every picture of a moving mark asks.
        return matrices if _orthonormal(matrices.ravel().tolist(), EXACT) else as_rotation(matrices, where)
    finite = np.asarray(np.isfinite(matrices).all(axis=(-2, -1)))
    given = np.where(finite[..., None, None], matrices, np.eye(3))
    off = np.abs(np.swapaxes(given, -1, -2) @ given - np.eye(3)).max(axis=(-2, -1), initial=0.0)
    doubtful = ~((off < EXACT) & (np.linalg.det(given) > 0.0))
    if doubtful.any():
        matrices = matrices.copy()
        for index in np.argwhere(doubtful).tolist():
            matrices[tuple(index)] = as_rotation(matrices[tuple(index)], f"{where}{index}")
    return matrices


def axis_angle(R: ArrayLike) -> tuple[Array, Array]:
    """Return axis (..., 3) and angle (...) in [0, pi] of rotations.

    At the identity every axis is right; ``(0, 0, 1)`` is returned. At pi the axis and its opposite are both right; the
    one whose last non-zero component is positive is returned. The angle is 2 atan2(|eps|, eta) from the quaternion and
    stays accurate at both ends, where arccos of the trace (3.63) loses half of the digits. Equation 3.66 prints a
    factor 1/2 that does not belong there.

    Raises
    ------
    InputError
        As of `as_rotations`.

    References
    ----------
    Notes 3.62-3.68.
    """
    q = quaternion_from_rotation(R)
    eta, eps = q[..., 0], q[..., 1:]
    length = np.linalg.norm(eps, axis=-1)
    angle = 2.0 * np.arctan2(length, eta)
    identity = length < 1e-300
    axis = np.where(identity[..., None], [0.0, 0.0, 1.0], eps / np.where(identity, 1.0, length)[..., None])
    return axis, angle


def quaternion_from_rotation(R: ArrayLike) -> Array:
    """Return unit quaternions (..., 4), scalar first and not negative.

    Shepperd's method: of w, x, y, z the largest is computed from the diagonal and the others are divided by it, so
    nothing is lost near pi, where the signs of 3.77-3.79 fail. Equation 3.78 has the indices of a sign wrong.

    Raises
    ------
    InputError
        As of `as_rotations`.
    """
    R = as_rotations(R)
    if R.ndim == 2:
        return _of_one_rotation(*R.ravel().tolist())
    m = np.moveaxis(R, (-2, -1), (0, 1))
    trace = m[0, 0] + m[1, 1] + m[2, 2]
    squares = np.stack([trace, m[0, 0], m[1, 1], m[2, 2]])
    largest = np.argmax(squares, axis=0)
    w = np.stack([1.0 + trace, m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]])
    x = np.stack([w[1], 1.0 + 2.0 * m[0, 0] - trace, m[0, 1] + m[1, 0], m[0, 2] + m[2, 0]])
    y = np.stack([w[2], x[2], 1.0 + 2.0 * m[1, 1] - trace, m[1, 2] + m[2, 1]])
    z = np.stack([w[3], x[3], y[3], 1.0 + 2.0 * m[2, 2] - trace])
    q = np.take_along_axis(np.stack([w, x, y, z]), largest[None, None], axis=0)[0]
    q = np.moveaxis(q, 0, -1)
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    return np.asarray(q * _sign_rule(q)[..., None])


def _orthonormal(m: list[float], tolerance: float) -> bool:
    """Return whether nine entries, row by row, are a rotation; false when one is not a number."""
    a, b, c, d, e, f, g, h, i = m
    return (
        -tolerance < a * a + b * b + c * c - 1.0 < tolerance
        and -tolerance < d * d + e * e + f * f - 1.0 < tolerance
        and -tolerance < g * g + h * h + i * i - 1.0 < tolerance
        and -tolerance < a * d + b * e + c * f < tolerance
        and -tolerance < d * g + e * h + f * i < tolerance
        and -tolerance < g * a + h * b + i * c < tolerance
        and g * (b * f - c * e) + h * (c * d - a * f) + i * (a * e - b * d) > 0.0
    )


def _of_one_rotation(a: float, b: float, c: float, d: float, e: float, f: float, g: float, h: float, i: float) -> Array:
    """Return the quaternion of one rotation, given by rows: quicker, as each frame of a film needs it."""
    trace = a + e + i
    largest = max(trace, a, e, i)
    if largest == trace:
        q = (1.0 + trace, h - f, c - g, d - b)
    elif largest == a:
        q = (h - f, 1.0 + 2.0 * a - trace, b + d, c + g)
    elif largest == e:
        q = (c - g, b + d, 1.0 + 2.0 * e - trace, f + h)
    else:
        q = (d - b, c + g, f + h, 1.0 + 2.0 * i - trace)
    length = math.hypot(*q)
    w, x, y, z = (part / length for part in q)
    decides = next((part for part in (w, z, y, x) if abs(part) > SMALL), 1.0)
    sign = math.copysign(1.0, decides)
    return np.array([sign * w, sign * x, sign * y, sign * z])


def _sign_rule(q: Array) -> Array:
    """Return the sign that makes the scalar part positive or, when that is zero, the last non-zero component."""
    sign = np.sign(np.where(np.abs(q[..., 0]) > SMALL, q[..., 0], 0.0))
    for k in (3, 2, 1):
        sign = np.where(sign == 0.0, np.sign(np.where(np.abs(q[..., k]) > SMALL, q[..., k], 0.0)), sign)
    return np.where(sign == 0.0, 1.0, sign)


def rotation_from_quaternion(q: ArrayLike) -> Array:
    """Return rotations (..., 3, 3) of quaternions (..., 4), scalar first; they are normalised.

    References
    ----------
    Notes 3.73.
    """
    values: Array = as_floats(q, "q", "numbers of shape (..., 4)")
    if values.shape[-1:] != (4,):
        raise InputError(f"q: expected shape (..., 4), got {values.shape}")
    if values.ndim == 1:
        return _of_one_quaternion(*values.tolist())
    length = np.linalg.norm(values, axis=-1, keepdims=True)
    if np.any(length == 0.0) or not np.all(np.isfinite(length)):
        raise InputError("q: expected a finite quaternion that is not zero")
    values = values / length
    eta, eps = values[..., :1, None], values[..., 1:]
    outer = eps[..., :, None] * eps[..., None, :]
    return (2.0 * eta * eta - 1.0) * np.eye(3) + 2.0 * outer + 2.0 * eta * skew(eps)


def _of_one_quaternion(w: float, x: float, y: float, z: float) -> Array:
    """Return the matrix of one quaternion, in a tenth of the time: each event of a drag needs it."""
    square = w * w + x * x + y * y + z * z
    if square == 0.0 or not math.isfinite(square):
        raise InputError("q: expected a finite quaternion that is not zero")
    s = 2.0 / square
    return np.array(
        [
            [1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
            [s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)],
            [s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)],
        ]
    )


def euler_zyx(R: ArrayLike) -> tuple[Array, NDArray[np.bool_]]:
    """Return yaw, pitch, roll with R = Rz(yaw) Ry(pitch) Rx(roll), and where they are not unique.

    Parameters
    ----------
    R : array_like, shape (..., 3, 3)

    Returns
    -------
    angles : ndarray, shape (..., 3)
        Yaw, pitch, roll in radians; pitch in [-pi/2, pi/2].
    singular : ndarray of bool, shape (...)
        Rotations with pitch ±pi/2, for which only yaw ∓ roll is defined; roll is then 0.

    Raises
    ------
    InputError
        As of `as_rotations`.

    References
    ----------
    Notes 3.104-3.108; entries (1,2) and (2,3) of 3.103 are misprinted.
    """
    R = as_rotations(R)
    c = np.hypot(R[..., 0, 0], R[..., 1, 0])
    # Below this the two angles change by more than the accuracy of a pose given with eight decimals.
    singular = c < 1e-7
    yaw = np.where(singular, np.arctan2(-R[..., 0, 1], R[..., 1, 1]), np.arctan2(R[..., 1, 0], R[..., 0, 0]))
    pitch = np.arctan2(-R[..., 2, 0], c)
    roll = np.where(singular, 0.0, np.arctan2(R[..., 2, 1], R[..., 2, 2]))
    return np.stack([yaw, pitch, roll], axis=-1), singular


def is_rotation(R: ArrayLike, tolerance: float = 1e-6) -> bool:
    """Return whether a 3 x 3 matrix is orthonormal with determinant +1, entries within the tolerance.

    Raises
    ------
    InputError
        No array of numbers: a text, complex numbers, or rows of different lengths.
    """
    R = as_floats(R, "R", "a matrix of numbers")
    if R.shape != (3, 3):
        return False
    return _orthonormal(R.ravel().tolist(), tolerance)
