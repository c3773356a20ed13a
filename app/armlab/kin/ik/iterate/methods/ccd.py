"""Cyclic coordinate descent: one joint after the other, the last first, each to where the cost is smallest.

Along a revolute joint every coordinate of the tool is a + b cos q + c sin q. So the squared distance, and the squared
chord of the orientation error, are trigonometric polynomials of degree two at most, and five samples determine them;
along a prismatic joint the cost is a parabola, and three do. The minimum is found without iterating on the arm, inside
the limits, and is taken only where the cost falls: it never rises. Angles count by their chord 2 sin(theta/2).

References
----------
Wang and Chen, *A combined optimization method for solving the inverse kinematics problem of mechanical manipulators*,
1991.
"""

from __future__ import annotations

import math

import numpy as np

from armlab.kin.ik.iterate.method import IterationMethod, Memory, Move, Parameters
from armlab.kin.ik.iterate.problem import Floats, Point, Problem

GRID = 73
"""Samples of the polynomial over one turn; it has at most two minima, far wider than 5 degrees unless equal."""

POLISH = 8
"""Newton steps on the polynomial from the best sample; convergence is quadratic, so three or four are enough."""

GAIN = 1e-14
"""Relative decrease of the cost that is more than rounding."""


def step(problem: Problem, point: Point, parameters: Parameters, memory: Memory) -> Move:
    """Return the change of all joints after one sweep."""
    q, cost = point.q, problem.half_square(point.e)
    for joint in problem.free[::-1]:
        q, cost = _lowered(problem, q, cost, int(joint))
    return Move(problem.travelled(point.q, q))


def _lowered(problem: Problem, q: Floats, cost: Floats, joint: int) -> tuple[Floats, Floats]:
    """Return configurations (B, n) with one joint at its best value, and their costs."""
    low, high = problem.low[joint] - q[:, joint], problem.high[joint] - q[:, joint]
    find = _best_turn if problem.arm.revolute[joint] else _best_slide
    tried = q.copy()
    tried[:, joint] = np.clip(q[:, joint] + find(problem, q, joint, low, high), problem.low[joint], problem.high[joint])
    there = problem.cost(tried)
    better = there < cost - GAIN * cost
    return np.where(better[:, None], tried, q), np.where(better, there, cost)


def _sampled(problem: Problem, q: Floats, joint: int, moves: Floats) -> Floats:
    """Return the costs (B, k) with one joint moved by each of k values."""
    tried = np.repeat(q[:, None, :], len(moves), axis=1)
    tried[:, :, joint] += moves
    return problem.cost(tried.reshape(-1, q.shape[1])).reshape(len(q), len(moves))


def _best_turn(problem: Problem, q: Floats, joint: int, low: Floats, high: Floats) -> Floats:
    """Return the turn (B,) to the minimum of a0 + a1 cos + b1 sin + a2 cos 2 + b2 sin 2 within one turn."""
    at: Floats = 2.0 * math.pi * np.arange(5.0) / 5.0
    costs = _sampled(problem, q, joint, at)
    a1, b1 = (0.4 * costs @ wave for wave in (np.cos(at), np.sin(at)))
    a2, b2 = (0.4 * costs @ wave for wave in (np.cos(2.0 * at), np.sin(2.0 * at)))
    # One turn at most, as near to half a turn to either side as the limits allow.
    start = np.clip(-math.pi, low, np.maximum(high - 2.0 * math.pi, low))
    width = np.minimum(2.0 * math.pi, high - start)
    x = start[:, None] + width[:, None] * np.linspace(0.0, 1.0, GRID)
    waves = (part[:, None] for part in (a1, b1, a2, b2))
    c1, s1, c2, s2 = waves
    values = c1 * np.cos(x) + s1 * np.sin(x) + c2 * np.cos(2.0 * x) + s2 * np.sin(2.0 * x)
    best = np.take_along_axis(x, np.argmin(values, axis=1)[:, None], 1)[:, 0]
    found, cell = best, width / (GRID - 1)
    for _ in range(POLISH):
        slope = -a1 * np.sin(found) + b1 * np.cos(found) + 2.0 * (b2 * np.cos(2.0 * found) - a2 * np.sin(2.0 * found))
        bend = -a1 * np.cos(found) - b1 * np.sin(found) - 4.0 * (a2 * np.cos(2.0 * found) + b2 * np.sin(2.0 * found))
        convex = bend > 0.0
        found = np.where(convex, found - slope / np.where(convex, bend, 1.0), found)
        found = np.clip(found, np.maximum(best - cell, start), np.minimum(best + cell, start + width))
    return found


def _best_slide(problem: Problem, q: Floats, joint: int, low: Floats, high: Floats) -> Floats:
    """Return the slide (B,) in metres to the minimum of a parabola."""
    unit = problem.arm.length_scale
    before, here, after = _sampled(problem, q, joint, np.array([-unit, 0.0, unit])).T
    bend = after - 2.0 * here + before
    flat = bend <= 0.0
    best = np.where(flat, 0.0, 0.5 * unit * (before - after) / np.where(flat, 1.0, bend))
    return np.clip(best, low, high)


ITERATION = IterationMethod("ccd", "cyclic coordinate descent", 11, step, chord=True)
