"""Newton's method on the closed loop of the arm, for many candidates at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from armlab.kin.ik.general_loop import Floats, Numbers, turns

STEPS = 20
"""Largest number of steps. Most candidates need two; at a double root every step halves the distance."""

EXACT = 1e-13
"""Error, in radians and units of length, below which only rounding is left."""

FAR = 0.3
"""Error of a candidate that belongs to no root, if it is larger after `PATIENCE` steps or does not fall."""

PATIENCE = 4

NEAREST = 4
"""Steps to the nearest configuration: two are enough for what is near."""

SETTLED = 2
"""Number of steps after which a step that does not halve the sum of squares is the last."""

FLOOR = 1e-13
"""Smallest damping: some hundred roundings of J J^T, so that it can be inverted at singular poses."""

LARGEST_STEP = 0.5
"""Largest change of a joint in one step, radians."""

_UNIT = np.eye(6)

_CROSS = np.array([np.cross(a, b) for a in np.eye(3) for b in np.eye(3)])
"""Matrix from the nine products a_i b_j to a x b."""

_SINES_AND_TRACE = np.column_stack([-0.5 * _CROSS, np.eye(3).reshape(9)])
"""Matrix from the entries of a rotation to sin(theta) r and 1 + 2 cos(theta)."""


def errors_and_columns(links: Floats, q: Numbers, hands: Numbers) -> tuple[Numbers, Numbers, Floats]:
    """Return error, Jacobian and size of the error.

    Parameters
    ----------
    links : ndarray, shape (5, 4, 4)
        See `Loop`.
    q : ndarray, real or complex, shape (m, 6)
        Angles with their offsets.
    hands : ndarray, shape (m, 4, 4)
        Wanted frames 6.

    Returns
    -------
    errors : ndarray, shape (m, 6)
        Errors from the present to the wanted pose: a displacement, and sin(theta) r of the rotation.
    columns : ndarray, shape (m, 6, 6)
        ``[:, i]`` is the twist (v; omega) at the end by joint i.
    sizes : ndarray, shape (m,)
        Largest entry of the error, and 1 more where the turn is past 90 degrees and its sine falls again.
    """
    frames, ends = _chain(links, q)
    turned = (hands[:, :3, :3] @ np.swapaxes(ends[:, :3, :3], 1, 2)).reshape(-1, 9) @ _SINES_AND_TRACE
    errors = np.empty((len(q), 6), dtype=q.dtype)
    errors[:, :3] = hands[:, :3, 3] - ends[:, :3, 3]
    errors[:, 3:] = turned[:, :3]
    sizes = np.abs(errors).max(axis=1) + (turned[:, 3].real < 1.0)
    return errors, _columns(frames, ends), sizes


def columns_at(links: Floats, q: Numbers) -> Numbers:
    """Return the Jacobians alone; see `errors_and_columns`."""
    return _columns(*_chain(links, q))


def _chain(links: Floats, q: Numbers) -> tuple[Numbers, Numbers]:
    """Return the frames before each joint, shape (m, 6, 4, 4), and after the last, shape (m, 4, 4)."""
    R = turns(q)
    moves = R[:, :5] @ links
    frames = np.empty((len(q), 6, 4, 4), dtype=q.dtype)
    frames[:, 0] = np.eye(4)
    for i in range(5):
        np.matmul(frames[:, i], moves[:, i], out=frames[:, i + 1])
    return frames, frames[:, 5] @ R[:, 5]


def _columns(frames: Numbers, ends: Numbers) -> Numbers:
    columns = np.empty((len(frames), 6, 6), dtype=frames.dtype)
    axes, arms = frames[..., :3, 2], ends[:, None, :3, 3] - frames[..., :3, 3]
    columns[..., :3] = crossed(axes, arms)
    columns[..., 3:] = axes
    return columns


def crossed(a: Numbers, b: Numbers) -> Numbers:
    """Return vector products a x b, shape (..., 3); NumPy's own takes several times as long for a few."""
    return np.asarray((a[..., None] * b[..., None, :]).reshape(*a.shape[:-1], 9) @ _CROSS)


def polish(
    links: Floats, q: Floats, hands: Floats, steps: int = STEPS, patience: int = PATIENCE, exact: float = EXACT
) -> tuple[Floats, Floats]:
    """Return the nearest solutions of the loop and their errors.

    Steps are damped by the square of the error, which vanishes at the root and leaves the end quadratic. Who is exact,
    hopeless or no longer gets nearer leaves the batch.

    Parameters
    ----------
    links : ndarray, shape (5, 4, 4)
    q : ndarray, shape (m, 6)
        Angles with their offsets.
    hands : ndarray, shape (m, 4, 4)
    steps, patience : int
        See `STEPS` and `FAR`.
    exact : float
        Error at which a candidate leaves the batch.

    Returns
    -------
    q : ndarray, shape (m, 6)
        The best of each row.
    sizes : ndarray, shape (m,)
        Largest entry of its error.
    """
    best, found = np.full(len(q), np.inf), q.copy()
    rows = np.arange(len(q))
    for step in range(steps):
        errors, columns, sizes = errors_and_columns(links, q, hands)
        before = best[rows]
        better = sizes < before
        best[rows[better]], found[rows[better]] = sizes[better], q[better]
        going = sizes > exact
        if step >= patience:
            going &= (before < FAR) & (sizes < 0.5 * before)
        if step == steps - 1 or not going.any():
            break
        if not going.all():
            rows, q, hands = rows[going], q[going], hands[going]
            errors, columns = errors[going], columns[going]
        q = q + np.clip(damped_steps(errors, columns), -LARGEST_STEP, LARGEST_STEP)
    return found, best


class Nearest(NamedTuple):
    """The nearest configurations to hands, and what `errors_and_columns` says there.

    Attributes
    ----------
    q, errors : ndarray, shape (m, 6)
    columns : ndarray, shape (m, 6, 6)
    sizes : ndarray, shape (m,)
    """

    q: Floats
    errors: Floats
    columns: Floats
    sizes: Floats


def nearest(
    links: Floats,
    q: Floats,
    hands: Floats,
    weak: float,
    steps: int = NEAREST,
    exact: float = EXACT,
    across: Floats | None = None,
) -> Nearest:
    """Return the nearest configurations to hands, without moving along weak directions.

    Parameters
    ----------
    links : ndarray, shape (5, 4, 4)
    q : ndarray, shape (m, 6)
    hands : ndarray, shape (m, 4, 4)
    weak : float
        Singular value, relative to the largest, below which the arm can hardly move its tool along a direction.
    steps : int
    exact : float
        Error below which all may stay where they are.
    across : ndarray, shape (m, 6), optional
        Unit directions in which they stay where they are.
    """
    found, best, least = q.copy(), np.full(len(q), np.inf), np.full(len(q), np.inf)
    off, there = np.full((len(q), 6), np.inf), np.zeros((len(q), 6, 6))
    for step in range(steps):
        errors, columns, sizes = errors_and_columns(links, q, hands)
        # Steps make the sum of squares least, and may make the largest entry grow.
        squares = (errors * errors).sum(axis=1) + (sizes >= 1.0)
        still, better = squares > 0.5 * least, squares < least
        found[better], best[better], least[better] = q[better], sizes[better], squares[better]
        off[better], there[better] = errors[better], columns[better]
        # They converge quadratically to what is nearest, and then stand still.
        if ((best <= exact) | (still & (step >= SETTLED))).all():
            break
        if across is not None:
            columns = columns - across[:, :, None] * (across[:, None] @ columns)
        q = q + (errors[:, None] @ np.linalg.pinv(columns, rcond=weak))[:, 0]
    return Nearest(found, off, there, best)


def damped_steps(errors: Floats, columns: Floats) -> Floats:
    """Return J^T (J J^T + mu 1)^-1 e with mu = 1e-3 |e|^2 + `FLOOR`, shape (m, 6)."""
    normal = np.swapaxes(columns, 1, 2) @ columns
    normal += (1e-3 * (errors * errors).sum(axis=1) + FLOOR)[:, None, None] * _UNIT
    return np.asarray((columns @ np.linalg.solve(normal, errors[..., None]))[..., 0])
