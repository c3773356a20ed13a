"""The joint speeds for a wanted velocity: none, one or infinitely many; the shortest, and the velocity it reaches."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.checks import finite_floats
from armlab.kin.ellipsoid import RANK_TOLERANCE
from armlab.kin.velocity.subspaces import Subspaces, subspaces

Array = NDArray[np.float64]
Verdict = Literal["none", "one", "many"]

REACHED = 1e-9
"""Missing velocity, scaled and relative to the wanted one, up to which it counts as reached."""


@dataclass(frozen=True, eq=False)
class Answer:
    """The solutions of J qdot = v.

    Attributes
    ----------
    verdict : "none", "one" or "many"
        The number of joint speeds that give exactly v.
    qdot : ndarray, shape (n,)
        The shortest of those that come nearest to v (notes 5.116-5.124, 5.128): of what `subspaces` scales, scaled.
    reached : ndarray, shape (m,)
        ``J qdot``, the projection of v on R(J).
    lost : ndarray, shape (m,)
        ``v - reached``.
    free : ndarray, shape (n, k)
        Basis of N(J): what may be added to qdot without a change of the tool's velocity.
    spaces : Subspaces
    """

    verdict: Verdict
    qdot: Array
    reached: Array
    lost: Array
    free: Array
    spaces: Subspaces


def answer(
    J: ArrayLike,
    v: ArrayLike,
    length: ArrayLike | None = None,
    speeds: ArrayLike | None = None,
    tolerance: float = RANK_TOLERANCE,
) -> Answer:
    """Return how many joint speeds give a velocity, and the shortest that comes nearest to it.

    Parameters
    ----------
    J, length, speeds, tolerance
        As of `subspaces`.
    v : array_like, shape (m,)
        Wanted velocity, in the units of the rows of J.

    Raises
    ------
    InputError
        As of `subspaces`, or v is not m finite numbers.

    References
    ----------
    Notes 1.14-1.17, 5.116-5.128. The formula J^T (J J^T)^-1 of 5.123 exists only where J has rank m, and then every v
    is reached; for v outside R(J) it is the pseudo-inverse of definition 10 that comes nearest.

    Examples
    --------
    >>> found = answer([[-2.0, -1.0], [0.0, 0.0]], [-0.5, 0.1])
    >>> found.verdict, found.qdot.round(6).tolist(), found.lost.tolist()
    ('none', [0.2, 0.1], [0.0, 0.1])
    """
    return answer_in(subspaces(J, length, speeds, tolerance), J, v)


def answer_in(spaces: Subspaces, J: ArrayLike, v: ArrayLike) -> Answer:
    """Return the answer from subspaces of J that are already known."""
    matrix = np.asarray(J, dtype=np.float64)
    wanted = finite_floats(v, "v", (len(matrix),), f"{len(matrix)} finite numbers")
    qdot = spaces.inverse @ wanted
    # Parts of v outside R(J) are taken off in the scaled axes, exactly zero where the rank is full.
    outside = spaces.U[:, spaces.rank :]
    lost = spaces.lengths * (outside @ (outside.T @ (wanted / spaces.lengths)))
    size, missing = float(np.linalg.norm(wanted / spaces.lengths)), float(np.linalg.norm(lost / spaces.lengths))
    if missing <= REACHED * size:
        lost = np.zeros_like(lost)
    free = spaces.null
    verdict: Verdict = "none" if lost.any() else "many" if free.shape[1] else "one"
    return Answer(verdict, qdot, wanted - lost, lost, free, spaces)


def penrose(J: ArrayLike, X: ArrayLike) -> tuple[float, float, float, float]:
    """Return the largest entry of each of the four Penrose conditions' differences; all zero for the pseudo-inverse.

    ``J X J - J``, ``X J X - X``, ``(J X)^T - J X`` and ``(X J)^T - X J``. The last two compare entries of different
    units where rows or columns are mixed: give scaled matrices.

    References
    ----------
    Penrose 1955; notes, definition 10.

    Examples
    --------
    >>> penrose([[2.0]], [[0.5]])
    (0.0, 0.0, 0.0, 0.0)
    """
    a, x = np.asarray(J, dtype=np.float64), np.asarray(X, dtype=np.float64)
    ax, xa = a @ x, x @ a
    one, two, three, four = (float(np.abs(part).max()) for part in (ax @ a - a, xa @ x - x, ax.T - ax, xa.T - xa))
    return one, two, three, four


def full_rank_inverse(J: ArrayLike) -> tuple[str, Array] | None:
    """Return the formula, in LaTeX, and the value of the pseudo-inverse for full rank; None where there is none.

    ``J^{-1}`` (m = n), ``J^T(J J^T)^{-1}`` (m < n) or ``(J^T J)^{-1}J^T`` (m > n).

    References
    ----------
    Notes, the list after definition 10.
    """
    matrix = np.asarray(J, dtype=np.float64)
    m, n = matrix.shape
    if subspaces(matrix).rank < min(m, n):
        return None
    if m == n:
        return "J^{-1}", np.asarray(np.linalg.inv(matrix), dtype=np.float64)
    if m < n:
        return "J^T(J J^T)^{-1}", matrix.T @ np.linalg.inv(matrix @ matrix.T)
    return "(J^T J)^{-1}J^T", np.linalg.inv(matrix.T @ matrix) @ matrix.T
