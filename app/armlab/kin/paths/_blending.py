"""Straight lines in time with blends at the waypoints: shared by joint-space blends and the over-fly in space.

On line k the velocity is constant, v_k = (q_{k+1} - q_k) / (t_{k+1} - t_k). Around t_k, for half the blend time before
and after, the velocity goes from v_{k-1} to v_k: evenly (a parabola, constant acceleration), or as 3 u^2 - 2 u^3 (a
quartic, whose acceleration is zero at both ends and 1.5 times as large in the middle). Both leave and meet the lines at
the same points.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion.piecewise import Piecewise

Floats = NDArray[np.float64]

SHAPE = Field(
    "shape",
    "",
    "curve of the blend",
    "choice",
    "parabola",
    choices=(("parabola", "parabola: constant acceleration"), ("quartic", "quartic: acceleration without jumps")),
)


def blended(knots: Floats, times: Floats, blends: Floats, *, rest: bool, quartic: bool) -> Piecewise:
    """Return lines and blends over time.

    Parameters
    ----------
    knots : ndarray, shape (N, m)
    times : ndarray, shape (N,)
        Increasing, seconds.
    blends : ndarray, shape (N,)
        Blend time of each waypoint; of the first and last only with ``rest``, there all inside the motion.
    rest : bool
        Whether the motion begins and ends at rest. The first line is then timed so that it still meets waypoint 2 in
        time (Craig, *Introduction to Robotics*, 7.3).
    quartic : bool
    """
    before, after = blends / 2.0, blends / 2.0
    before[0], after[-1] = 0.0, 0.0
    after[0], before[-1] = blends[0], blends[-1]
    effective = np.diff(times)
    effective[0] -= after[0] / 2.0 if rest else 0.0
    effective[-1] -= before[-1] / 2.0 if rest else 0.0
    v = np.diff(knots, axis=0) / effective[:, None]
    still = np.zeros((1, knots.shape[1]))
    incoming = np.concatenate([still if rest else v[:1], v])
    outgoing = np.concatenate([v, still if rest else v[-1:]])
    # Where each blend begins: on the line that comes in. Of the first knot it is the knot itself.
    begin = knots - incoming * before[:, None]
    begin[-1] = knots[-1] - incoming[-1] * (blends[-1] / 2.0)
    end = knots + outgoing * after[:, None]
    end[0] = knots[0] + outgoing[0] * (blends[0] / 2.0)
    bends = _bends(begin, incoming, outgoing - incoming, blends, quartic)
    lines = np.zeros((len(v), *bends.shape[1:]))
    lines[:, 0], lines[:, 1] = end[:-1], v
    starts = np.stack([times - before, times + after], axis=1).reshape(-1)
    pieces = np.empty((2 * len(knots) - 1, *bends.shape[1:]))
    pieces[0::2], pieces[1::2] = bends, lines
    long = np.diff(starts) > 1e-12 * (times[-1] - times[0])
    return Piecewise(np.append(starts[:-1][long], times[-1]), pieces[long])


def _bends(begin: Floats, v: Floats, change: Floats, blends: Floats, quartic: bool) -> Floats:
    """Return the coefficients of the blends, shape (N, 3 or 5, m)."""
    t = np.where(blends > 0.0, blends, 1.0)[:, None]
    nothing = np.zeros_like(begin)
    if quartic:
        return np.stack([begin, v, nothing, change / t**2, -change / (2.0 * t**3)], axis=1)
    return np.stack([begin, v, change / (2.0 * t)], axis=1)


def check_room(room: Floats, after: Floats, before: Floats, unit: str) -> None:
    """Raise `InputError`, naming the waypoint, when two blends overlap.

    Parameters
    ----------
    room, after, before : ndarray, shape (N-1,)
        For each line, its length, the part taken by the blend at its start, and the part taken by that at its end.
    unit : str
        ``"s"``; empty for lengths, whose unit is not known here: then parts of the line are told.
    """
    over = np.flatnonzero(after + before > room * (1.0 + 1e-12))
    if len(over):
        k = int(over[0])
        larger = k + 1 if after[k] > before[k] else k + 2
        taken = after[k] + before[k]
        told = f"{taken:.6g} {unit} and there are {room[k]:.6g} {unit}" if unit else _times_the_line(taken / room[k])
        raise InputError(
            f"waypoint {larger}: its blend does not fit: between waypoints {k + 1} and {k + 2} the blends take {told}"
        )


def _times_the_line(share: float) -> str:
    # Rounded up: what is too much must not read as all of it.
    return f"{math.ceil(share * 1000.0) / 10.0:g} % of the line"


def for_each(value: Any, where: str, count: int, each: str) -> Floats:
    """Return one number for each of ``count``; a single number stands for all. `InputError` otherwise."""
    values = np.atleast_1d(np.asarray(value, dtype=float))
    if values.size not in (1, count):
        raise InputError(f"{where}: expected one number, or {count}: one for each {each}; got {values.size}")
    return np.array(np.broadcast_to(values, (count,)))
