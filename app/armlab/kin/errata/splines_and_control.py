"""Trials of splines, blends and three-phase moves of chapter 6, of control of chapter 7, and of the appendix."""

from __future__ import annotations

import cmath
import math

import numpy as np
from scipy.interpolate import CubicSpline  # type: ignore[import-untyped]
from scipy.linalg import expm  # type: ignore[import-untyped]

from armlab.kin.errata.arms import jacobian_2r, point_2r
from armlab.kin.errata.draws import Floats, Generator, direction, signed, two_links
from armlab.kin.errata.trial import Forms, Quiet, Trial
from armlab.kin.paths.lts_434 import make

KNOTS = 5
"""Number of knots of the splines."""

SETTLED, STEPS = 16.0, 2000
"""Time after which a loop has settled, in units of its time constant, and number of steps until then."""


def _spline(times: Floats, q: Floats) -> CubicSpline:
    return CubicSpline(times, q, bc_type="clamped")


def _knot_speeds(times: Floats, q: Floats) -> Forms:
    """6.95: the speeds at the inner knots of a spline that is at rest at both ends."""
    h, steps = np.diff(times), np.diff(q)
    matrix = np.diag(2.0 * (h[:-1] + h[1:])) + np.diag(h[:-2], 1) + np.diag(h[2:], -1)

    def solved(first: Floats, second: Floats) -> Floats:
        right = 3.0 / (h[:-1] * h[1:]) * (first**2 * steps[1:] + second**2 * steps[:-1])
        return np.asarray(np.linalg.solve(matrix, right))

    return Forms(solved(h[1:], h[:-1]), solved(h[:-1], h[1:]), _spline(times, q)(times, 1)[1:-1])


def _coefficients(times: Floats, q: Floats) -> Forms:
    """6.91: the second and third coefficients of every piece, from the speeds at the knots."""
    judge, h = _spline(times, q), np.diff(times)
    v = judge(times, 1)

    def solved(power: int) -> Floats:
        rows = [
            np.linalg.solve(
                [[step**2, step**3], [2.0 * step, 3.0 * step**power]],
                [q[k + 1] - q[k] - v[k] * step, v[k + 1] - v[k]],
            )
            for k, step in enumerate(h)
        ]
        return np.array(rows)

    return Forms(solved(3), solved(2), judge.c[[1, 0]].T)


def _knots(rng: Generator, even: float | None = None) -> tuple[Floats, Floats]:
    h = rng.uniform(0.4, 2.0, KNOTS - 1) if even is None else np.full(KNOTS - 1, even)
    if even is None:
        h[1] = h[0] * rng.choice((0.4, 1.8))  # never nearly even, nor of length 1
        h[np.abs(h - 1.0) < 0.1] = 1.2
    return np.concatenate([[0.0], np.cumsum(h)]), signed(rng, 0.2, 2.0, KNOTS)


def _set_down(times: Floats, q: Floats) -> Forms:
    """6.79: the speed at the end of lift-off, travel and set-down."""
    path = make(q[:, None], {"times": times.tolist()})
    rows = path.names.index("q̇(t_f)"), path.names.index("q̈(t_f)")
    printed = path.matrix.copy()
    printed[rows[0]] = path.matrix[rows[1]]
    h = times[3] - times[2]
    printed[rows[1]] = 0.0
    printed[rows[1], 12:] = [6.0, 24.0 * h]

    def speed(matrix: Floats) -> float:
        found = np.linalg.solve(matrix, path.right)[9:, 0]
        return float(found @ [0.0, 1.0, 2.0 * h, 3.0 * h**2, 4.0 * h**3])

    return Forms(speed(printed), speed(path.matrix), 0.0)


def _three_phases(rng: Generator) -> tuple[Floats, Floats]:
    times = np.concatenate([[0.0], np.cumsum(rng.uniform(0.6, 1.8, 3))])
    return times, np.cumsum([0.0, *rng.uniform([0.1, 1.0, 0.1], [0.4, 2.0, 0.4])])


def _two_parameters(q: Floats, step: float, unit: float, blend: float) -> Forms:
    """6.86: the change of speed over a blend: an acceleration from slopes by s, or by time, times its duration."""
    accelerations = [float(np.diff(np.diff(q) / each)[0]) / blend for each in (unit, step)]
    h, times = 1e-3 * step, [0.0, step, 2.0 * step]
    middle = [np.interp([at - h, at + h], times, q) for at in (step / 2.0, 1.5 * step)]
    before, after = [(pair[1] - pair[0]) / (2.0 * h) for pair in middle]
    return Forms(accelerations[0] * blend, accelerations[1] * blend, after - before)


def _sine(gain: float, omega: float) -> Forms:
    """7.10: the amplitude of the error of a velocity loop that follows a sine of size 1, long after the start."""
    h, x = SETTLED / gain / STEPS, 0.0
    times = h * np.arange(STEPS)

    def rate(t: float, at: float) -> float:
        return gain * (math.sin(omega * t) - at)

    for t in times:
        k1 = rate(t, x)
        k2 = rate(t + h / 2.0, x + h / 2.0 * k1)
        k3 = rate(t + h / 2.0, x + h / 2.0 * k2)
        x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + rate(t + h, x + h * k3))
    end = STEPS * h
    # In the steady state e and e' tell the amplitude at any time.
    error, slope = math.sin(omega * end) - x, omega * math.cos(omega * end) - rate(end, x)
    return Forms(0.0, abs(1.0 - gain / (gain + 1j * omega)), math.hypot(error, slope / omega))


def _two_gains(gains: Floats, error: Floats, t: float) -> Forms:
    """7.18: the errors of two joints at a time."""
    return Forms(error * np.exp(-gains[0] * t), error * np.exp(-gains * t), expm(-np.diag(gains) * t) @ error)


def _cartesian_error(links: Floats, q: Floats, q_d: Floats, rate: Floats, gains: Floats) -> Forms:
    """7.23: the rate of the error of the tool under the joint control law."""
    l1, l2 = links.tolist()
    e, J = q_d - q, jacobian_2r(l1, l2, q)
    rest = jacobian_2r(l1, l2, q_d) @ rate - J @ rate
    h = 1e-6

    def away(t: float) -> Floats:
        return point_2r(l1, l2, q_d + t * rate) - point_2r(l1, l2, q + t * (rate + gains * e))

    return Forms(rest - J @ e, rest - J @ (gains * e), (away(h) - away(-h)) / (2.0 * h))


def _tracking(rng: Generator) -> tuple[Floats, Floats, Floats, Floats, Floats]:
    l1, l2, *q = two_links(rng)
    start = np.array(q)
    return (
        np.array([l1, l2]),
        start,
        start + signed(rng, 0.05, 0.3, 2),
        signed(rng, 0.1, 0.5, 2),
        rng.uniform(2.0, 6.0, 2),
    )


def _control_at(links: Floats, q: Floats, wanted: Floats, error: Floats, gain: float) -> Forms:
    """7.27: the rate of the error of the tool under the Cartesian control law."""
    l1, l2 = links.tolist()
    J = jacobian_2r(l1, l2, q)
    asked = wanted + gain * error
    rate = np.linalg.lstsq(J, asked, rcond=1e-9)[0]
    kept = np.eye(2) - J @ np.linalg.pinv(J, rcond=1e-9)
    h = 1e-6
    moved = (point_2r(l1, l2, q + h * rate) - point_2r(l1, l2, q - h * rate)) / (2.0 * h)
    return Forms(-gain * error, -gain * error + kept @ asked, wanted - moved)


def _following(rng: Generator, singular: bool) -> tuple[Floats, Floats, Floats, Floats, float]:
    l1, l2, q1, q2 = two_links(rng)
    q = np.array([q1, 0.0 if singular else q2])
    return np.array([l1, l2]), q, 0.3 * direction(rng, 2), signed(rng, 0.05, 0.4, 2), float(rng.uniform(1.0, 4.0))


def _argument(x: float, y: float) -> Forms:
    """Appendix: the argument of x + i y."""
    return Forms(math.atan(y / x), math.atan2(y, x), cmath.phase(complex(x, y)))


TRIALS = (
    Trial(
        "6.79",
        "times and places of the four knots",
        _three_phases,
        _set_down,
        "speed at the end",
        "0, as the part is set down",
        unit="rad/s",
    ),
    Trial(
        "6.86",
        "three knots, the time and the s between them, and a blend",
        lambda rng: (
            np.cumsum([0.0, float(rng.uniform(0.5, 1.5)), -float(rng.uniform(0.3, 1.0))]),
            float(rng.uniform(1.5, 3.0)),
            1.0,
            float(rng.uniform(0.2, 0.8)),
        ),
        _two_parameters,
        "change of speed over the blend",
        "the slopes of both lines in time",
        1e-7,
        "rad/s",
        quiet=Quiet(
            lambda rng: (np.cumsum([0.0, 1.0, -float(rng.uniform(0.3, 1.0))]), 1.0, 1.0, float(rng.uniform(0.2, 0.8))),
            "where one unit of s takes one second",
        ),
    ),
    Trial(
        "6.91",
        f"{KNOTS} knots with uneven intervals",
        _knots,
        _coefficients,
        "largest difference of a coefficient",
        "scipy.interpolate.CubicSpline",
        1e-8,
        quiet=Quiet(lambda rng: _knots(rng, 1.0), "with intervals of length 1"),
    ),
    Trial(
        "6.95",
        f"{KNOTS} knots with uneven intervals",
        _knots,
        _knot_speeds,
        "largest difference of the speed at a knot",
        "scipy.interpolate.CubicSpline with both ends at rest",
        1e-8,
        "rad/s",
        quiet=Quiet(lambda rng: _knots(rng, float(rng.uniform(0.5, 2.0))), "with intervals of equal length"),
    ),
    Trial(
        "7.10",
        "a bandwidth K/M and a frequency of a fifth to twice of it",
        lambda rng: (gain := float(rng.uniform(5.0, 15.0)), gain * float(rng.uniform(0.2, 2.0))),
        _sine,
        "amplitude of the error, for a sine of size 1",
        "the simulated loop, when it has settled",
        1e-6,
    ),
    Trial(
        "7.18",
        "two gains, two errors and a time",
        lambda rng: (rng.uniform([1.0, 2.5], [2.0, 5.0]), signed(rng, 0.2, 1.0, 2), float(rng.uniform(0.2, 1.0))),
        _two_gains,
        "largest difference of an error",
        "scipy.linalg.expm",
        unit="rad",
        quiet=Quiet(
            lambda rng: (np.full(2, rng.uniform(1.0, 5.0)), signed(rng, 0.2, 1.0, 2), float(rng.uniform(0.2, 1.0))),
            "with one gain for both joints",
        ),
    ),
    Trial(
        "7.23",
        "a 2R, a wanted configuration and its speed, and two gains",
        _tracking,
        _cartesian_error,
        "length of the difference of the rate of the error",
        "differences of the error in time",
        1e-7,
        "m/s",
        "length",
        quiet=Quiet(lambda rng: (*_tracking(rng)[:4], np.ones(2)), "with gains of 1"),
    ),
    Trial(
        "7.27",
        "a stretched 2R, a wanted velocity and an error",
        lambda rng: _following(rng, True),
        _control_at,
        "length of the difference of the rate of the error",
        "differences of the direct kinematics",
        1e-7,
        "m/s",
        "length",
        quiet=Quiet(lambda rng: _following(rng, False), "away from singularities"),
    ),
    Trial(
        "A.arg",
        "a number in the left half of the plane",
        lambda rng: (-float(rng.uniform(0.2, 2.0)), float(signed(rng, 0.2, 2.0))),
        _argument,
        "argument",
        "cmath.phase",
        unit="rad",
        norm="angle",
        quiet=Quiet(
            lambda rng: (float(rng.uniform(0.2, 2.0)), float(signed(rng, 0.2, 2.0))), "in the right half of the plane"
        ),
    ),
)
"""The trials of splines, control and the appendix."""
