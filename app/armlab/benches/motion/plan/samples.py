"""A planned motion at many times: for pictures, plots and files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.question import Feasible, Leg, Question, Samples
from armlab.kin.arm import Arm
from armlab.kin.motion import Limits, Motion, Violation, violations

Floats = NDArray[np.float64]

ROUNDING = 1.0 + 1e-6
"""Multiple of a limit up to which it counts as kept."""

DRAWN = 161
"""Number of points of a leg's path in the scene."""

PLOTTED = 601
"""Number of samples of a whole motion in the plots."""

SEARCHED, FINER, REFINEMENTS = 400, 41, 3
"""Number of samples in the search for the largest speed of the tool, of those around the best, and of refinements."""

DIFFERENCE = 1e-5
"""Time to either side for the difference of the Jacobian, seconds."""

TOOL_SLACK = 1e-4
"""Relative excess of the tool speed that is allowed, for rounding and the search for its largest value."""

STANDS = 1e-6
"""Ratio to the largest speed of the tool below which it rests and its path has no curvature."""


def exceeded(question: Question, motion: Motion) -> tuple[Violation, ...]:
    """Return when limits are exceeded by more than rounding."""
    held = Limits(*(ROUNDING * values for values in question.limits.of_joints().each))
    # What was recorded may begin with a speed, and a spline through it does so by rounding.
    from_rest = question.recorded is None
    return tuple(violations(motion, held, positions=question.arm.limits, from_rest=from_rest))


def sampled(arm: Arm, motion: Motion, legs: Sequence[Leg], count: int = PLOTTED) -> Samples:
    """Return a motion at evenly spaced times, and at more during short legs, with the motion of the tool."""
    t = _times(motion, legs, count)
    q, qdot, qddot, qdddot = motion.derivatives(t)
    tool = np.asarray(arm.position(q), dtype=np.float64)
    v, a = tool_rates(arm, q, qdot, qddot)
    speed = np.linalg.norm(v, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        bend = np.linalg.norm(np.cross(v, a), axis=1) / speed**3
    curvature = np.where(speed > STANDS * max(float(speed.max()), 1e-12), bend, np.nan)
    return Samples(t, q, qdot, qddot, qdddot, tool, speed, _parameter(legs, t), curvature)


def _times(motion: Motion, legs: Sequence[Leg], count: int) -> Floats:
    """Return evenly spaced times, and `DRAWN` more of each leg that has fewer of them: beside long waits it has few."""
    even = np.linspace(0.0, motion.duration, count)
    short = [
        leg.start + np.linspace(0.0, leg.motion.duration, DRAWN)
        for leg in legs
        if leg.motion is not None and (count - 1) * leg.motion.duration < (DRAWN - 1) * motion.duration
    ]
    return np.unique(np.clip(np.concatenate([even, *short]), 0.0, motion.duration))


def tool_way(arm: Arm, motion: Motion) -> float:
    """Return how far the tool point goes, metres, from samples, and those that a motion read from a file is made of."""
    t = np.union1d(np.linspace(0.0, motion.duration, PLOTTED), motion.edges)
    return float(np.linalg.norm(np.diff(arm.position(motion.at(t)), axis=0), axis=1).sum())


def fastest_tool(arm: Arm, motion: Motion) -> float:
    """Return the largest speed of the tool point, m/s, from samples, and finer ones around the largest."""
    return fastest_moment(arm, motion)[0]


def fastest_moment(arm: Arm, motion: Motion) -> tuple[float, float]:
    """Return the same, and the time at which it is taken, seconds."""
    t = np.union1d(np.linspace(0.0, motion.duration, SEARCHED), motion.edges)
    best, best_at = 0.0, 0.0
    for _ in range(REFINEMENTS):
        q, qdot = motion.derivatives(t, (0, 1))
        speed = np.linalg.norm((arm.jacobian(q)[:, :3] @ qdot[:, :, None])[:, :, 0], axis=1)
        k = int(np.argmax(speed))
        if speed[k] > best:
            best, best_at = float(speed[k]), float(t[k])
        t = np.linspace(t[max(k - 1, 0)], t[min(k + 1, len(t) - 1)], FINER)
    return best, best_at


def tool_rates(arm: Arm, q: Floats, qdot: Floats, qddot: Floats) -> tuple[Floats, Floats]:
    """Return velocity and acceleration of the tool point in the world, (k, 3) each, from (k, n) joint rates.

    J-dot times q-dot is the change of J along q-dot, by a central difference.
    """
    J = arm.jacobian(q)[:, :3]
    v = (J @ qdot[:, :, None])[:, :, 0]
    turned = (arm.jacobian(q + DIFFERENCE * qdot)[:, :3] - arm.jacobian(q - DIFFERENCE * qdot)[:, :3]) / (
        2.0 * DIFFERENCE
    )
    a = (J @ qddot[:, :, None] + turned @ qdot[:, :, None])[:, :, 0]
    return np.asarray(v), np.asarray(a)


def _parameter(legs: Sequence[Leg], t: Floats) -> Floats:
    """Return the path parameter of the leg at each time; while the arm waits, that where it rests."""
    found = np.full(len(t), np.nan)
    for k, leg in enumerate(legs):
        if leg.trajectory is not None:
            begins = leg.start if k else 0.0
            on = (t >= begins - 1e-12) & (t <= leg.arrival + leg.wait + 1e-12)
            found[on] = leg.trajectory.law.at(t[on] - leg.start)
    return found


def drawn_leg(arm: Arm, leg: Leg, over: Sequence[tuple[float, float]]) -> Leg:
    """Return a leg with its path at evenly spaced times, marked where a limit is exceeded."""
    motion = leg.motion
    assert motion is not None
    t = np.linspace(0.0, motion.duration, DRAWN)
    points = np.asarray(arm.position(motion.at(t)), dtype=np.float64)
    worth = np.zeros(DRAWN, dtype=int)
    if leg.followed is not None and leg.trajectory is not None:
        place = leg.trajectory.law.at(t)
        worth = leg.worth[np.clip(np.searchsorted(leg.followed.s, place), 0, len(leg.followed.s) - 1)]
    times = leg.start + t
    half = 0.5 * motion.duration / (DRAWN - 1)
    for begin, end in over:
        # What lasts shorter than from one point to the next is seen as well.
        on = (times >= begin - half) & (times <= end + half)
        worth = np.where(on, int(Feasible.OVER_LIMIT), worth)
    return replace(leg, points=points, worth=worth, times=times)


def spans_of(over: Sequence[Violation]) -> tuple[tuple[float, float], ...]:
    """Return the intervals in which limits of joints are exceeded, seconds."""
    return tuple((violation.start, violation.end) for violation in over)


def too_fast(arm: Arm, samples: Samples, legs: Sequence[Leg], limit: float | None) -> list[tuple[float, float]]:
    """Return when the tool exceeds its speed limit.

    From samples and the fastest moment of each leg, which may lie between two of them, and straight lines between
    these.
    """
    if limit is None:
        return []
    tops = [(leg.start, *fastest_moment(arm, leg.motion)) for leg in legs if leg.motion is not None]
    times = np.concatenate([samples.t, [start + at for start, _, at in tops]])
    order = np.argsort(times, kind="stable")
    t, speed = times[order], np.concatenate([samples.tool_speed, [top for _, top, _ in tops]])[order]
    over = speed - limit * (1.0 + TOOL_SLACK)
    above = np.concatenate([[False], over > 0.0, [False]])
    first, last = np.flatnonzero(above[1:] & ~above[:-1]), np.flatnonzero(above[:-1] & ~above[1:]) - 1
    return [
        (_crossing(t, over, i - 1) if i else float(t[0]), _crossing(t, over, j) if j + 1 < len(t) else float(t[-1]))
        for i, j in zip(first.tolist(), last.tolist(), strict=True)
    ]


def _crossing(t: Floats, values: Floats, i: int) -> float:
    """Return the time at which values cross zero between samples i and i + 1."""
    return float(t[i] + (t[i + 1] - t[i]) * values[i] / (values[i] - values[i + 1]))
