"""Three angles of a rotation, for each of the 12 sequences of axes, about moving axes or about fixed ones.

Six sequences have three different axes (Tait-Bryan, such as roll-pitch-yaw) and six return to the first axis (proper
Euler, such as the zxz of the notes). About fixed axes the same product is written in the reverse order (notes,
theorem 2), so everything here is done for moving axes and reversed. The product itself is `rotation_from_sequence`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError, UnknownName
from armlab.kin.rotations import as_rotations, rotation_about

TAIT_BRYAN: tuple[str, ...] = ("xyz", "xzy", "yxz", "yzx", "zxy", "zyx")
PROPER: tuple[str, ...] = ("xyx", "xzx", "yxy", "yzy", "zxz", "zyz")
SEQUENCES: tuple[str, ...] = TAIT_BRYAN + PROPER
"""The 12 sequences in which no two neighbours are the same axis (notes, definitions 4 and 5)."""

NAMES: Mapping[tuple[str, bool], str] = MappingProxyType(
    {
        ("zyx", False): "yaw, pitch, roll about current axes; the same as XYZ about fixed axes",
        ("xyz", True): "roll, pitch, yaw about fixed axes; the same as ZYX about current axes",
        ("xyz", False): "Cardan angles",
        ("zxz", False): "Euler angles of classical mechanics",
        ("zyz", False): "Euler angles of most robotics books, and of a spherical wrist",
    }
)
"""Usual names of the angles, by sequence and whether the axes are fixed."""

SINGULAR_SINE = 1e-7
"""Sine (proper Euler) or cosine (Tait-Bryan) of the middle angle below which a rotation counts as singular: first and
third angle then change by more than the accuracy of a matrix given with eight decimals."""

_LETTERS = "xyz"


@dataclass(frozen=True, eq=False)
class EulerSolutions:
    """Both triples of angles of rotations, and where there are infinitely many.

    Parameters
    ----------
    solutions : ndarray, shape (..., 2, 3)
        Radians in (-pi, pi], in the order of the sequence. The first triple is the principal one: middle angle in
        [0, pi] for a proper Euler sequence, in [-pi/2, pi/2] for a Tait-Bryan one. Where singular, both are the same.
    singular : ndarray of bool, shape (...)
        Configurations in which the first and third axis coincide; the third angle is then 0 and the first holds what is
        defined.
    combination : ndarray of int, shape (...)
        At a singularity, what is defined: 1 for the sum (first + third), -1 for the difference (first - third).
        Elsewhere 0: every angle is defined.
    """

    solutions: NDArray[np.float64]
    singular: NDArray[np.bool_]
    combination: NDArray[np.int64]


def euler_angles(R: ArrayLike, axes: str, *, fixed: bool = False) -> EulerSolutions:
    """Return both triples of angles whose product of elementary rotations is R.

    The first angle comes from the image of the last axis. The third comes from what is left when the first turn is
    undone, so that their defined combination stays accurate to the last digits however near a singularity is, where
    formulas 3.92 and 3.93 lose it in both.

    Parameters
    ----------
    R : array_like, shape (..., 3, 3)
        Rotation matrices.
    axes : str
        One of `SEQUENCES`; case does not matter.
    fixed : bool
        Whether the axes stay where they were before the first turn.

    Returns
    -------
    EulerSolutions
        The second triple is (first ± pi, pi - middle, third ± pi) for three different axes and
        (first ± pi, -middle, third ± pi) otherwise. Where singular (`SINGULAR_SINE`) the triple gives R back within
        twice that sine, elsewhere within rounding.

    Raises
    ------
    InputError
        No rotations, as of `as_rotations`, or not a sequence.

    References
    ----------
    Notes 3.82-3.94 (zxz; entry (2,1) of 3.82 and the text after 3.94 are misprinted) and 3.102-3.108 (xyz fixed).

    Examples
    --------
    >>> found = euler_angles([[0, -1, 0], [1, 0, 0], [0, 0, 1]], "zyx")
    >>> found.solutions[0].round(4).tolist()
    [1.5708, 0.0, 0.0]
    >>> bool(euler_angles([[0, -1, 0], [1, 0, 0], [0, 0, 1]], "zxz").singular)
    True
    """
    sequence = _checked(axes)
    matrices = as_rotations(R)
    moving = sequence[::-1] if fixed else sequence
    first, middle, third, singular = _principal(matrices, moving)
    combination = np.where(singular, _defined_combination(moving, middle), 0)
    if fixed:
        # The first turn of the reversed product is the third of the sequence, whose angle is 0 where singular.
        carried = np.where(combination < 0, -first, first)
        first, third = np.where(singular, carried, third), np.where(singular, 0.0, first)
    one = np.stack([first, middle, third], axis=-1)
    mirrored = -middle if sequence in PROPER else math.pi - middle
    other = np.stack([first + math.pi, mirrored, third + math.pi], axis=-1)
    other = np.where(singular[..., None], one, other)
    return EulerSolutions(_wrapped(np.stack([one, other], axis=-2)), singular, combination)


def _principal(
    R: NDArray[np.float64], axes: str
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_]]:
    """Return the first, middle and third angle about moving axes, each (...), and where they are not unique."""
    i, j, k = (_LETTERS.index(letter) for letter in axes)
    other = 3 - i - j
    sign = _parity(i, j)
    image = R[..., :, k]
    if i == k:
        c, s = -sign * image[..., other], image[..., j]
        middle = np.arctan2(np.hypot(c, s), image[..., i])
    else:
        c, s = image[..., other], -sign * image[..., j]
        middle = np.arctan2(sign * image[..., i], np.hypot(c, s))
    singular = np.hypot(c, s) < SINGULAR_SINE
    first = np.where(singular, np.arctan2(sign * R[..., other, j], R[..., j, j]), np.arctan2(s, c))
    # R_i(first)^T R = R_j(middle) R_k(third), whose row j is that of R_k(third).
    rest = np.swapaxes(rotation_about(axes[0], first), -1, -2) @ R
    third = np.arctan2(-_parity(k, j) * rest[..., j, 3 - j - k], rest[..., j, j])
    return first, middle, np.where(singular, 0.0, third), singular


def _defined_combination(axes: str, middle: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return 1 or -1: at a singularity the third axis is this factor times the first one."""
    i, j, k = (_LETTERS.index(letter) for letter in axes)
    if i == k:
        return np.where(middle < math.pi / 2, 1, -1)
    return np.where(middle > 0.0, _parity(i, j), -_parity(i, j))


def _parity(i: int, j: int) -> int:
    """Return 1 where axis j follows axis i in x, y, z, x, ...; -1 otherwise."""
    return 1 if (j - i) % 3 == 1 else -1


def _wrapped(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return angles of less than two turns in (-pi, pi], without a negative zero."""
    down = np.where(angles > math.pi, angles - 2.0 * math.pi, angles)
    return np.asarray(np.where(down <= -math.pi, down + 2.0 * math.pi, down) + 0.0)


def _checked(axes: str) -> str:
    """Return the sequence in lower case; `UnknownName` when there is no such sequence."""
    if not isinstance(axes, str) or axes.lower() not in SEQUENCES:
        raise UnknownName("axes", axes, SEQUENCES)
    return axes.lower()


def angle_symbols(axes: str, fixed: bool) -> tuple[str, str, str]:
    r"""Return the LaTeX names of the three angles in the order of the sequence.

    They are phi, theta, psi (notes 3.80), except for xyz fixed, which the notes give psi, theta, phi (3.102).
    """
    usual = (r"\varphi", r"\theta", r"\psi")
    return (usual[2], usual[1], usual[0]) if fixed and _checked(axes) == "xyz" else usual


def product_latex(axes: str, fixed: bool, angles_text: Sequence[str] | None = None) -> str:
    r"""Return the product of elementary rotations in LaTeX, as it is multiplied.

    Parameters
    ----------
    axes : str
        One of `SEQUENCES`.
    fixed : bool
        About fixed axes the first turn is written last (notes 3.101).
    angles_text : sequence of three str, optional
        Numbers in degrees, in the order of ``axes``, to stand for the symbols; with or without a degree sign.

    Raises
    ------
    InputError
        Not a sequence, or not three texts.

    Examples
    --------
    >>> print(product_latex("zxz", False))
    R_z(\varphi)\,R_x(\theta)\,R_z(\psi)
    >>> print(product_latex("xyz", True, ["10", "20", "−30°"]))
    R_z(-30^\circ)\,R_y(20^\circ)\,R_x(10^\circ)
    """
    sequence = _checked(axes)
    if angles_text is None:
        angles: Sequence[str] = angle_symbols(sequence, fixed)
    else:
        angles = [text.rstrip("° ").replace("−", "-") + r"^\circ" for text in angles_text]
    if len(angles) != len(sequence):
        raise InputError(f"angles_text: expected three texts, got {len(angles)}")
    turns = [f"R_{axis}({angle})" for axis, angle in zip(sequence, angles, strict=True)]
    return r"\,".join(reversed(turns) if fixed else turns)
