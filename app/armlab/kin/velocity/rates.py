"""Rates of three orientation angles and angular velocity: ``omega = T(phi) phidot``.

phi is no vector and its derivative is not the angular velocity (notes 5.13): the columns of T are the axes of the three
turns where they stand at present, in the fixed axes. The sequences and their names are those of `armlab.kin.euler`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError, UnknownName
from armlab.kin.checks import as_floats
from armlab.kin.euler import PROPER, SEQUENCES, SINGULAR_SINE, angle_symbols
from armlab.kin.rotations import rotation_about

Floats = NDArray[np.float64]

_LETTERS = "xyz"


def rate_matrix(angles: ArrayLike, axes: str = "zyz", fixed: bool = False) -> Floats:
    """Return T(phi), whose columns are the present axes of the three turns.

    Parameters
    ----------
    angles : array_like, shape (..., 3)
        Radians, in the order of the sequence.
    axes : str
        One of `armlab.kin.euler.SEQUENCES`; case does not matter.
    fixed : bool
        Whether the axes stay where they were before the first turn.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        ``omega = T @ phidot`` in the fixed axes. About moving axes the columns are e_i, R_i(phi_1) e_j and
        R_i(phi_1) R_j(phi_2) e_k: T does not depend on the third angle; about fixed axes not on the first.

    Raises
    ------
    InputError
        Not three angles, or not a sequence.

    References
    ----------
    Notes 5.42-5.43, which call T the roll-pitch-yaw matrix: it is no rotation, its determinant is that of
    `rate_determinant`.

    Examples
    --------
    >>> rate_matrix([0.0, np.pi / 2, 0.0], "zyx").round(6)[:, 2].tolist()
    [0.0, 0.0, -1.0]
    """
    sequence, values = _sequence(axes), _angles(angles)
    letters, order = (sequence[::-1], (2, 1, 0)) if fixed else (sequence, (0, 1, 2))
    first = rotation_about(letters[0], values[..., order[0]])
    second = first @ rotation_about(letters[1], values[..., order[1]])
    found = np.zeros((*values.shape[:-1], 3, 3))
    i, j, k = (_LETTERS.index(letter) for letter in letters)
    found[..., i, order[0]] = 1.0
    found[..., :, order[1]] = first[..., :, j]
    found[..., :, order[2]] = second[..., :, k]
    return found


def rate_determinant(angles: ArrayLike, axes: str = "zyz", fixed: bool = False) -> Floats:
    """Return det T in closed form, shape (...).

    It is ± the cosine of the second angle for three different axes (+ where they follow each other as x, y, z do), and
    its sine, negative about moving axes, where the sequence returns to its first axis.

    Parameters
    ----------
    angles : array_like, shape (..., 3)
    axes : str
    fixed : bool

    Raises
    ------
    InputError
        As of `rate_matrix`.
    """
    sequence, values = _sequence(axes), _angles(angles)
    middle = values[..., 1]
    if sequence in PROPER:
        return np.asarray(np.sin(middle) if fixed else -np.sin(middle))
    return np.asarray(_parity(sequence) * np.cos(middle))


def singular_angles(axes: str) -> tuple[float, float]:
    """Return the second angles, in (-pi, pi], at which first and third axis coincide and det T is 0."""
    return (0.0, math.pi) if _sequence(axes) in PROPER else (0.5 * math.pi, -0.5 * math.pi)


def angle_rates(omega: ArrayLike, angles: ArrayLike, axes: str = "zyz", fixed: bool = False) -> Floats:
    """Return the rates of the angles of a body that turns with omega: ``phidot = T^-1 omega``.

    Parameters
    ----------
    omega : array_like, shape (..., 3)
        Angular velocity in the fixed axes, rad/s.
    angles : array_like, shape (..., 3)
    axes : str
    fixed : bool

    Returns
    -------
    ndarray, shape (..., 3)
        rad/s, in the order of the sequence.

    Raises
    ------
    InputError
        As of `rate_matrix`; or first and third axis are one line within `armlab.kin.euler.SINGULAR_SINE`: then a part
        of omega is made by no rates, and the rest by infinitely many.
    """
    turning = as_floats(omega, "omega", "numbers of shape (..., 3)")
    if turning.shape[-1:] != (3,):
        raise InputError(f"omega: expected shape (..., 3), got {turning.shape}")
    if bool(np.any(np.abs(rate_determinant(angles, axes, fixed)) < SINGULAR_SINE)):
        raise InputError(f"angles: {singular_sentence(axes)}")
    T = rate_matrix(angles, axes, fixed)
    return np.asarray(np.linalg.solve(T, turning[..., None])[..., 0])


def singular_sentence(axes: str) -> str:
    """Return a sentence on the angular velocity that is lost where det T is 0.

    >>> singular_sentence("zyz").split(":")[0]
    'the second angle is 0° or 180°'
    """
    where = "0° or 180°" if _sequence(axes) in PROPER else "90° or −90°"
    return (
        f"the second angle is {where}: the first and the third axis are one line, so no rates turn the body about the "
        "axis across it and the second one"
    )


def lost_axis(angles: ArrayLike, axes: str = "zyz", fixed: bool = False) -> Floats:
    """Return the unit vector across the first two axes of the turns, shape (..., 3), in the fixed axes.

    Where det T is 0 it is what no rates turn the body about; elsewhere the third axis is not across it.

    Raises
    ------
    InputError
        As of `rate_matrix`.
    """
    T = rate_matrix(angles, axes, fixed)
    return np.asarray(np.cross(T[..., :, 0], T[..., :, 1]) if not fixed else np.cross(T[..., :, 2], T[..., :, 1]))


def columns_latex(axes: str, fixed: bool = False) -> tuple[str, str, str]:
    r"""Return the three columns of T in LaTeX, in the order of the sequence.

    Raises
    ------
    InputError
        Not a sequence.

    Examples
    --------
    >>> columns_latex("zxz")
    ('e_z', 'R_z(\\varphi)\\,e_x', 'R_z(\\varphi)\\,R_x(\\theta)\\,e_z')
    """
    sequence = _sequence(axes)
    turns = [f"R_{axis}({angle})" for axis, angle in zip(sequence, angle_symbols(sequence, fixed), strict=True)]
    order = (2, 1, 0) if fixed else (0, 1, 2)
    columns = ["", "", ""]
    for place, k in enumerate(order):
        columns[k] = r"\,".join([*(turns[before] for before in order[:place]), f"e_{sequence[k]}"])
    one, two, three = columns
    return one, two, three


def _sequence(axes: str) -> str:
    if not isinstance(axes, str) or axes.lower() not in SEQUENCES:
        raise UnknownName("axes", axes, SEQUENCES)
    return axes.lower()


def _angles(angles: ArrayLike) -> Floats:
    values = as_floats(angles, "angles", "numbers of shape (..., 3)")
    if values.shape[-1:] != (3,):
        raise InputError(f"angles: expected shape (..., 3), got {values.shape}")
    return values


def _parity(sequence: str) -> float:
    """Return 1 where the second axis follows the first one in x, y, z, x, ...; -1 otherwise."""
    i, j = _LETTERS.index(sequence[0]), _LETTERS.index(sequence[1])
    return 1.0 if (j - i) % 3 == 1 else -1.0
