"""Curves of solutions, along which the tool stands still: whether there is one, and how exactly."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from judging.probe import Probe
from judging.search import FEW, distances, polished

SLACK, EXACT_SLACK = 1e-4, 1e-8
"""Singular value, relative to the largest, of a direction that is tried; and where the curve has to be exact."""

CURVE = 4e-15
"""Scaled error along a curve of solutions that has none."""

SIZES = np.array([1.0, 0.55, 0.3])
"""Steps that are tried along a direction, times the largest."""

FAR = (0.06, 0.015)
"""Largest steps in radians: families may be small."""

MIXED = 6
"""Random directions where several are slack, of which one may be the curve's."""


Size = Callable[[np.ndarray], np.ndarray]
"""The errors of configurations (k, n) as numbers, shape (k,)."""


def error_along(
    probe: Probe, q: np.ndarray, G: np.ndarray, slack_below: float = SLACK, size: Size | None = None
) -> float:
    """Return the error on the curve of solutions through a solution (n,), by some size of it: infinite without a curve.

    Steps of three sizes along a direction in which the tool does not move are brought back by the stiff directions
    alone. On a curve all end about as far away as they set out; at an isolated solution, also where branches merge,
    they return or keep an error. The size is that of the scaled error if it is not given.
    """
    size = size or (lambda q: probe.size(q, G))
    s, V = probe.singular(q)
    slack = V[s <= slack_below * max(s[0], 1e-300)]
    if not len(slack):
        return np.inf
    ways = slack
    if len(slack) > 1:
        mixed = np.random.default_rng(0).normal(size=(MIXED, len(slack))) @ slack
        ways = np.concatenate([slack, mixed / np.linalg.norm(mixed, axis=1)[:, None]])
    ways = np.concatenate([ways, -ways])
    error = np.inf
    for far in FAR:
        error = error if np.isfinite(error) else _tried(probe, q, G, ways, far, size)
    return error


def is_family(probe: Probe, q: np.ndarray, G: np.ndarray) -> bool:
    """Return whether a solution is on a curve of others beyond doubt: to the last roundings."""
    return error_along(probe, q, G, EXACT_SLACK) <= CURVE


def _tried(probe: Probe, q: np.ndarray, G: np.ndarray, ways: np.ndarray, far: float, size: Size) -> float:
    # The second round sets out where the first one led: curves are tangent to one of many slack directions.
    for _ in range(2):
        out = q + (far * SIZES[:, None] * ways[:, None, :] * probe.scales).reshape(-1, probe.n)
        back = polished(probe, out, G, cutoff=1e-3 * far, longest=0.5 * far, steps=FEW)
        gone = probe.apart(back, q).reshape(len(ways), len(SIZES), probe.n)
        lengths = np.linalg.norm(gone, axis=2)
        good = ((lengths > 0.7 * far * SIZES) & (lengths < 1.5 * far * SIZES)).all(axis=1)
        ways = gone[:, 0] / np.maximum(lengths[:, :1], 1e-300)
    error = size(back).reshape(len(ways), len(SIZES)).max(axis=1)
    return float(error[good].min(initial=np.inf))


def is_on(probe: Probe, curves: Sequence[np.ndarray], q: np.ndarray) -> bool:
    """Return whether a configuration is as near to the points of a curve as these are to one another."""
    for curve in map(np.asarray, curves):
        step = np.abs(probe.apart(curve[1:], curve[:-1])).max(initial=1e-6)
        if distances(probe, curve, q).min() <= 2.0 * step:
            return True
    return False
