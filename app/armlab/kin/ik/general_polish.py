"""Newton's method on the loop of the arm itself, for many candidates at once; and which results are the same."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik.general_loop import Floats, turns

STEPS = 20
"""At most. Most candidates need two; at a double root every step halves the distance."""

EXACT = 1e-13
"""Errors below this, in radians and units of length, are rounding."""

FAR = 0.3
"""A candidate that is not nearer than this after `PATIENCE` steps comes from no root."""

PATIENCE = 4

LARGEST_STEP = 0.5
"""Radians a joint moves in one step at most."""

SAME = 1e-5
"""Solutions whose cosines and sines differ by less are one. At a fold, where two solutions merge, an error e of the
pose is an error of about sqrt(e) of the angles, which is added."""

_UNIT = np.eye(6)


def errors_and_columns(links: Floats, q: Floats, hands: Floats) -> tuple[Floats, Floats, Floats]:
    """Return error, Jacobian and size of the error.

    Parameters
    ----------
    links : ndarray, shape (5, 4, 4)
        See `Loop`.
    q : ndarray, shape (m, 6)
        Angles with their offsets.
    hands : ndarray, shape (m, 4, 4)
        Wanted frames 6.

    Returns
    -------
    errors : ndarray, shape (m, 6)
        From the present to the wanted pose: a way, and sin(theta) r of the turn.
    columns : ndarray, shape (m, 6, 6)
        ``[:, i]`` is the twist (v; omega) at the end by joint i.
    sizes : ndarray, shape (m,)
        Largest entry of the error, and 1 more where the turn is past 90 degrees and its sine falls again.
    """
    R = turns(q)
    moves = R[:, :5] @ links
    frames = np.empty((6, len(q), 4, 4))
    frames[0] = np.eye(4)
    for i in range(5):
        frames[i + 1] = frames[i] @ moves[:, i]
    ends = frames[5] @ R[:, 5]
    errors = np.empty((len(q), 6))
    errors[:, :3] = hands[:, :3, 3] - ends[:, :3, 3]
    D = hands[:, :3, :3] @ np.swapaxes(ends[:, :3, :3], 1, 2)
    errors[:, 3], errors[:, 4] = D[:, 2, 1] - D[:, 1, 2], D[:, 0, 2] - D[:, 2, 0]
    errors[:, 5] = D[:, 1, 0] - D[:, 0, 1]
    errors[:, 3:] *= 0.5
    sizes = np.abs(errors).max(axis=1) + (D[:, 0, 0] + D[:, 1, 1] + D[:, 2, 2] < 1.0)
    columns = np.empty((len(q), 6, 6))
    zx, zy, zz = (frames[:, :, k, 2].T for k in range(3))
    bx, by, bz = (ends[:, k, 3, None] - frames[:, :, k, 3].T for k in range(3))
    columns[..., 0], columns[..., 1], columns[..., 2] = zy * bz - zz * by, zz * bx - zx * bz, zx * by - zy * bx
    columns[..., 3], columns[..., 4], columns[..., 5] = zx, zy, zz
    return errors, columns, sizes


def polish(links: Floats, q: Floats, hands: Floats, steps: int = STEPS) -> tuple[Floats, Floats]:
    """Return the nearest solutions of the loop and their errors.

    Steps are damped by the square of the error, which vanishes at the root and leaves the end quadratic. Who is exact,
    hopeless or no longer gets nearer leaves the batch.

    Parameters
    ----------
    links : ndarray, shape (5, 4, 4)
    q : ndarray, shape (m, 6)
        Angles with their offsets.
    hands : ndarray, shape (m, 4, 4)

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
        going = sizes > EXACT
        if step >= PATIENCE:
            going &= (before < FAR) & (sizes < 0.5 * before)
        if step == steps - 1 or not going.any():
            break
        if not going.all():
            rows, q, hands = rows[going], q[going], hands[going]
            errors, columns = errors[going], columns[going]
        q = q + np.clip(damped_steps(errors, columns), -LARGEST_STEP, LARGEST_STEP)
    return found, best


def damped_steps(errors: Floats, columns: Floats) -> Floats:
    """Return J^T (J J^T + mu 1)^-1 e with mu = 1e-3 |e|^2, which grows with the error, shape (m, 6)."""
    normal = np.swapaxes(columns, 1, 2) @ columns
    normal += (1e-3 * (errors * errors).sum(axis=1) + 1e-15)[:, None, None] * _UNIT
    return np.asarray((columns @ np.linalg.solve(normal, errors[..., None]))[..., 0])


def groups(q: Floats, sizes: Floats) -> NDArray[np.intp]:
    """Return for each configuration the first one that is the same, whole turns apart, shape (m,).

    Parameters
    ----------
    q : ndarray, shape (m, 6)
    sizes : ndarray, shape (m,)
        Errors, see `SAME`.
    """
    points = np.concatenate([np.cos(q), np.sin(q)], axis=1)
    apart = np.abs(points[:, None] - points).max(axis=2)
    near = apart < SAME + 3.0 * np.sqrt(np.maximum(sizes[:, None], sizes))
    first = np.full(len(q), -1)
    for i in range(len(q)):
        if first[i] < 0:
            first[near[i] & (first < 0)] = i
    return first
