"""The film of a table: the four elementary moves of each row, one after the other, and the frame on its way.

=========  =========================================================
standard   Rz(theta_i), Tz(d_i), Tx(a_i), Rx(alpha_i)
modified   Rx(alpha_{i-1}), Tx(a_{i-1}), Rz(theta_i), Tz(d_i)
=========  =========================================================
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats, whole_number, wrong
from armlab.kin.dh import CONVENTIONS, Convention, Row
from armlab.kin.graph.walker import exact
from armlab.kin.rotations import axis_angle, rotation_from_axis_angle
from armlab.kin.transforms import transform
from armlab.registry import known_name

Symbol = Literal["theta", "d", "a", "alpha"]
ORDER: dict[Convention, tuple[Symbol, Symbol, Symbol, Symbol]] = {
    "standard": ("theta", "d", "a", "alpha"),
    "modified": ("alpha", "a", "theta", "d"),
}
"""Moves of a row, in their order about the axes of the moving frame."""

MOVES = 4
"""Number of moves of a row."""


@dataclass(frozen=True)
class Move:
    """One elementary move of a frame about or along its own axis.

    Attributes
    ----------
    symbol : "theta", "d", "a" or "alpha"
    axis : "x" or "z"
    kind : "turn" or "shift"
    amount : float
        Radians or metres, the joint value included.
    variable : bool
        Whether it is the joint that makes it.
    """

    symbol: Symbol
    axis: Literal["x", "z"]
    kind: Literal["turn", "shift"]
    amount: float
    variable: bool


@dataclass(frozen=True, eq=False)
class Factors:
    """A row on its way.

    Attributes
    ----------
    moves : tuple of 4 Move
    parts : tuple of 4 float
        Fraction of each move that is done, 0 to 1.
    matrices : ndarray, shape (4, 4, 4)
        One factor a move; the identity for a move that has not begun.
    product : ndarray, shape (4, 4)
        Product of the four factors: the moving frame in frame i-1, and the row's matrix A_i at the end.
    """

    moves: tuple[Move, Move, Move, Move]
    parts: tuple[float, float, float, float]
    matrices: NDArray[np.float64]
    product: NDArray[np.float64]


def moves_of(row: Row, q_i: float, convention: Convention) -> tuple[Move, Move, Move, Move]:
    """Return the four moves of a row at a joint value, in the order of the convention.

    Parameters
    ----------
    row : Row
    q_i : float
        Radians of a revolute, metres of a prismatic joint.
    convention : "standard" or "modified"

    References
    ----------
    Notes 4.10-4.14 (the text before 4.10 lists d before theta: the two commute); Craig, 3.6 (modified).

    Examples
    --------
    >>> [f"{move.kind} {move.axis} {move.amount}" for move in moves_of(Row("R", a=0.5, d=0.2), 1.0, "standard")]
    ['turn z 1.0', 'shift z 0.2', 'shift x 0.5', 'turn x 0.0']
    """
    known_name("convention", convention, CONVENTIONS)
    made = {
        "theta": Move("theta", "z", "turn", row.theta + (q_i if row.revolute else 0.0), row.revolute),
        "d": Move("d", "z", "shift", row.d + (0.0 if row.revolute else q_i), not row.revolute),
        "a": Move("a", "x", "shift", row.a, False),
        "alpha": Move("alpha", "x", "turn", row.alpha, False),
    }
    first, second, third, fourth = (made[symbol] for symbol in ORDER[convention])
    return first, second, third, fourth


def matrix_of(move: Move, part: float = 1.0) -> NDArray[np.float64]:
    """Return the matrix of a part of a move, shape (4, 4).

    Quarter turns of the constants of the table are exact; a joint value is taken as it is.

    Parameters
    ----------
    move : Move
    part : float
        0: the identity, 1: the whole move.
    """
    amount = part * move.amount
    T = np.eye(4)
    if move.kind == "shift":
        T["xyz".index(move.axis), 3] = amount
        return T
    c, s = math.cos(amount), math.sin(amount)
    if not move.variable:
        c, s = exact(c), exact(s)
    i, j = (0, 1) if move.axis == "z" else (1, 2)
    T[i, i] = T[j, j] = c
    T[i, j], T[j, i] = -s, s
    return T


def factors(arm: Arm, q: ArrayLike, row: int, progress: float) -> Factors:
    """Return the four factors of a row when some of its moves are done, and their product.

    Parameters
    ----------
    arm : Arm
    q : array_like, shape (n,)
    row : int
        0 to n-1.
    progress : float
        0 to 4: whole moves done and the part of the present one.

    Raises
    ------
    InputError
        Another row, or a progress outside.
    """
    values = _joint_values(arm, q)
    _check(row, arm.n - 1, progress, MOVES)
    moves = moves_of(arm.rows[row], float(values[row]), arm.convention)
    done = [min(max(progress - k, 0.0), 1.0) for k in range(MOVES)]
    matrices = np.array([matrix_of(move, part) for move, part in zip(moves, done, strict=True)])
    product = matrices[0] @ matrices[1] @ matrices[2] @ matrices[3]
    return Factors(moves, (done[0], done[1], done[2], done[3]), matrices, product)


def partial_product(arm: Arm, q: ArrayLike, row: int, progress: float) -> NDArray[np.float64]:
    """Return the moving frame in the world, base included, when some moves of a row are done.

    It starts from frame ``row`` at progress 0 and arrives in frame ``row + 1`` at progress 4. The row after the last is
    the step from frame n to the tool: its turn about one axis and its shift grow evenly together.

    Parameters
    ----------
    arm : Arm
    q : array_like, shape (n,)
    row : int
        0 to n-1, or n for the tool.
    progress : float
        0 to 4; 0 to 1 for the tool.

    Returns
    -------
    ndarray, shape (4, 4)

    Raises
    ------
    InputError
        Another row, or a progress outside.
    """
    values = _joint_values(arm, q)
    _check(row, arm.n, progress, MOVES if row != arm.n else 1)
    start = arm.frames(values)[row]
    step = _part_of_pose(arm.tool, progress) if row == arm.n else factors(arm, values, row, progress).product
    return np.asarray(start @ step, dtype=np.float64)


def _part_of_pose(pose: NDArray[np.float64], part: float) -> NDArray[np.float64]:
    if part == 1.0:
        return pose
    axis, angle = axis_angle(pose[:3, :3])
    turned = rotation_from_axis_angle(axis, part * angle)
    return np.asarray(transform(turned, part * pose[:3, 3]), dtype=np.float64)


def _joint_values(arm: Arm, q: ArrayLike) -> NDArray[np.float64]:
    return finite_floats(q, "q", (arm.n,), f"{arm.n} finite numbers")


def _check(row: int, last: int, progress: float, most: int) -> None:
    if whole_number(row, "row", 0) > last:
        raise InputError(f"row: expected 0 to {last}, got {row}")
    if not 0.0 <= progress <= most:
        raise wrong("progress", f"a number from 0 to {most}", progress)
