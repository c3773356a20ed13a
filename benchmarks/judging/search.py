"""The judge's search: whole batches of damped descents, polished until nothing more is gained, told apart by the error
between them."""

from __future__ import annotations

import numpy as np

from judging.probe import Probe

LONGEST = 1.5
"""Largest change of a joint in a step of a descent, radians or length scales."""

STEPS, ARRIVED, NEAR = 40, 1e-9, 1e-4
"""Steps of a descent; the scaled error at which it ends; and at which what still creeps then is polished, too."""

POLISHES, FEW, PATIENCE = 30, 8, 4
"""Full Newton steps at most, and along stiff directions alone; and how many in turn may fail to halve the error."""

ROUNDING = 1e-13
"""Scaled error that counts as none: some hundred roundings of the forward kinematics."""

SPREAD, MOST = 1e-5, 48
"""Ends of descents nearer than this are looked at together; so many groups at most, for a family has one a start."""

VALLEY, BEND, STIFF = 0.1, 3.0, 1e-3
"""Radians or length scales: the longest way along a valley; what a bend makes of its square is the error of a straight
one; and the singular values, relative to the largest, of the directions across it."""

IDENTICAL = 2e-7
"""Radians or length scales: between solutions as near as this errors are too small to be told from rounding."""

POINTS = np.linspace(0.0, 1.0, 11)[1:-1, None]
"""Where the way from one configuration to another is looked at."""


def searched(
    probe: Probe, G: np.ndarray, starts: int, rng: np.random.Generator, guesses: np.ndarray | None = None
) -> np.ndarray:
    """Return all distinct solutions found, exact to rounding, from random starts and from guesses, shape (k, n)."""
    ends = spread_out(probe, descended(probe, G, starts, rng)) if starts else np.empty((0, probe.n))
    if guesses is not None:
        ends = np.concatenate([guesses.reshape(-1, probe.n), ends])
    if not len(ends):
        return ends
    q = polished(probe, ends, G)
    size = probe.size(q, G)
    order = np.argsort(size, kind="stable")
    return distinct(probe, q[order][size[order] <= ROUNDING], G)


def descended(probe: Probe, G: np.ndarray, starts: int, rng: np.random.Generator) -> np.ndarray:
    """Return where damped descents from random starts ended near the target, shape (k, n)."""
    low, high = probe.arm.limits.T
    more = np.maximum(high - low, probe.length)
    low, high = np.where(probe.arm.revolute, -np.pi, low - more), np.where(probe.arm.revolute, np.pi, high + more)
    q = rng.uniform(low, high, (starts, probe.n)).T.copy()
    done = []
    for _ in range(STEPS):
        J, e = probe.linearised(q, G)
        here = (e * e).sum(axis=0) <= ARRIVED**2
        if here.any():
            done.append(q[:, here])
            q, J, e = q[:, ~here], J[:, :, ~here], e[:, ~here]
        if not q.shape[1]:
            break
        q = q + np.clip(probe.step(J, e), -LONGEST, LONGEST) * probe.scales[:, None]
    done.append(q[:, probe.size(q.T, G) <= NEAR])
    return np.concatenate(done, axis=1).T


def polished(
    probe: Probe, q: np.ndarray, G: np.ndarray, cutoff: float = 1e-13, longest: float = 0.3, steps: int = POLISHES
) -> np.ndarray:
    """Return configurations (k, n) after full Newton steps, each where its error was least.

    Steps go along singular vectors whose singular values are above ``cutoff`` times the largest, and are shortened so
    that no joint moves farther than ``longest``.
    """
    best, q = q.copy(), q.copy()
    least, waiting = np.full(len(q), np.inf), np.zeros(len(q), dtype=int)
    active = np.arange(len(q))
    for _ in range(steps):
        J, e = probe.linearised(np.ascontiguousarray(q[active].T), G)
        size = np.sqrt((e * e).sum(axis=0))
        better = size < least[active]
        waiting[active] = np.where(size < 0.5 * least[active], 0, waiting[active] + 1)
        best[active[better]], least[active[better]] = q[active[better]], size[better]
        moving = np.isfinite(size) & (waiting[active] < PATIENCE)
        active, J, e = active[moving], J[:, :, moving], e[:, moving]
        if not len(active):
            break
        step = np.einsum("kij,jk->ki", np.linalg.pinv(J.transpose(2, 1, 0), rcond=cutoff), e)
        far = np.abs(step).max(axis=1, keepdims=True)
        q[active] += step * np.minimum(1.0, longest / np.maximum(far, 1e-300)) * probe.scales
    return best


def spread_out(probe: Probe, q: np.ndarray) -> np.ndarray:
    """Return few of many configurations: of each group within `SPREAD` three far apart, maybe of several roots."""
    kept: list[np.ndarray] = []
    while len(q) and len(kept) < 3 * MOST:
        gaps = np.abs(probe.apart(q, q[0])).max(axis=1)
        near = gaps <= SPREAD
        group = q[near]
        far = group[np.argmax(gaps[near])]
        farther = group[np.argmax(np.abs(probe.apart(group, far)).max(axis=1))]
        kept += [group[0], far, farther] if len(group) > 1 else [group[0]]
        q = q[~near]
    return np.array(kept).reshape(-1, probe.n)


def path_error(probe: Probe, q: np.ndarray, other: np.ndarray, G: np.ndarray, enough: float) -> float:
    """Return the largest scaled error between two configurations, on a way without whole turns.

    That is the straight way, or where its error is more than ``enough`` and the two are near to one another, along the
    bottom of the valley: roots of high multiplicity are long, flat and bent.
    """
    apart = probe.apart(other, q)
    gap, far = apart * probe.scales, float(np.abs(apart).max())
    way = q + POINTS * gap
    error = float(probe.size(way, G).max())
    if error <= enough or far > VALLEY or error > BEND * far**2:
        return error
    bottom = polished(probe, way, G, cutoff=STIFF, longest=far, steps=FEW)
    steps = np.diff(np.vstack([q, bottom, q + gap]), axis=0) / probe.scales
    # What slid into one of the two ends says nothing of the way between them.
    joined = np.abs(steps).max() <= 2.5 * far / (len(POINTS) + 1)
    return min(error, float(probe.size(bottom, G).max())) if joined else error


def is_same(probe: Probe, q: np.ndarray, other: np.ndarray, G: np.ndarray) -> bool:
    """Return whether no error between two configurations exceeds what their own errors or rounding explain."""
    if np.abs(probe.apart(q, other)).max() <= IDENTICAL:
        return True
    enough = max(ROUNDING, 3.0 * float(probe.size(np.stack([q, other]), G).max()))
    return path_error(probe, q, other, G, enough) <= enough


def distinct(probe: Probe, q: np.ndarray, G: np.ndarray) -> np.ndarray:
    """Return configurations without those for which an earlier one stands."""
    kept: list[np.ndarray] = []
    for one in q:
        gaps = distances(probe, np.array(kept), one)
        if not any(is_same(probe, kept[k], one, G) for k in np.flatnonzero(gaps < 0.5)):
            kept.append(one)
    return np.array(kept).reshape(-1, probe.n)


def distances(probe: Probe, rows: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return the largest scaled joint differences of rows (k, n) to one configuration, shape (k,)."""
    return np.asarray(np.abs(probe.apart(rows.reshape(-1, probe.n), q)).max(axis=1, initial=0.0))
