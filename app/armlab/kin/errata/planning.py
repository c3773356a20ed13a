"""Trials of chapter 6, paths and laws: curvature, bounds, polynomials, blends, lines, the tangent, scaling in time."""

from __future__ import annotations

import math

import numpy as np
from scipy.interpolate import BPoly, CubicHermiteSpline  # type: ignore[import-untyped]

from armlab.kin.errata.draws import Floats, Generator, direction, either, signed
from armlab.kin.errata.trial import Forms, Quiet, Trial
from armlab.kin.motion.geometry import curvature

SMALL = 1e-4
"""Step of second differences in a parameter."""

DENSE = 4001
"""Number of places at which a maximum is looked for."""

Polynomial = np.polynomial.Polynomial


def _slope(s: float, rate: float) -> Forms:
    """6.6: the speed of the cubic path from 0 to pi at s, with a speed of s."""
    top = math.pi
    printed = Polynomial([0.0, 1.0, 3.0 * (top - 1.0), -2.0 * (top - 1.0)])
    correct = Polynomial([0.0, 0.0, 3.0 * top, -2.0 * top])
    judge = CubicHermiteSpline([0.0, 1.0], [0.0, top], [0.0, 0.0])
    return Forms(printed.deriv()(s) * rate, correct.deriv()(s) * rate, float(judge(s, 1)) * rate)


def _bend(coefficients: Floats, s: float) -> Forms:
    """6.11: the curvature of a cubic curve in n dimensions."""
    curve = [Polynomial(each) for each in coefficients]
    first, second = (np.array([each.deriv(order)(s) for each in curve]) for order in (1, 2))

    def tangent(at: float) -> Floats:
        d = np.array([each.deriv()(at) for each in curve])
        return np.asarray(d / np.linalg.norm(d))

    turning = (tangent(s + SMALL) - tangent(s - SMALL)) / (2.0 * SMALL)
    length = float(np.linalg.norm(first))
    crossed = float(np.linalg.norm(np.cross(first, second))) / length**3 if len(first) == 3 else None
    return Forms(crossed, float(curvature(first, second)), float(np.linalg.norm(turning)) / length)


def _curve(rng: Generator, n: int) -> tuple[Floats, float]:
    return np.column_stack(
        [signed(rng, 0.0, 1.0, n), signed(rng, 0.8, 1.5, n), *signed(rng, 0.1, 0.5, 2 * n).reshape(2, n)]
    ), float(rng.uniform(0.2, 0.8))


def _regular(line: Floats, power: int) -> Forms:
    """6.12: whether the path q = line s^power is regular at s = 0, 1 if it is; its curvature is 0."""
    h = 1e-4
    slope = float(np.linalg.norm(line * h**power - line * (-h) ** power)) / (2.0 * h)
    return Forms(1.0, float(power == 1), float(slope > 1e-3))


def _steepest(coefficients: Floats) -> Forms:
    """6.24: the largest slope of a path on [0, 1]."""
    path = Polynomial(coefficients)
    zeros = np.asarray(path.deriv(2).roots(), dtype=np.complex128)
    inside = [float(s.real) for s in zeros if abs(s.imag) < 1e-12 and 0.0 <= s.real <= 1.0]
    slope = path.deriv()
    printed = max((abs(slope(s)) for s in inside), default=None)
    everywhere = float(np.abs(slope(np.linspace(0.0, 1.0, DENSE))).max())
    return Forms(printed, max(abs(slope(s)) for s in (*inside, 0.0, 1.0)), everywhere)


def _allowance(slope: float, bend: float, v_max: float, a_max: float) -> Forms:
    """6.33: by how much the acceleration of s that is left is below 0, with V of the speeds and with a lowered one."""
    V = v_max / slope
    lowered = min(V, 0.9 * math.sqrt(a_max / bend))
    left = [(a_max - speed**2 * bend) / slope for speed in (V, lowered)]
    return Forms(min(left[0], 0.0), min(left[1], 0.0), 0.0)


def _hermite(q_i: Floats, q_f: Floats, v_i: Floats, v_f: Floats, tau: float) -> Forms:
    """6.54: the cubic of several joints with speeds at its ends."""
    way, c = q_f - q_i, v_i / (q_f - q_i)
    b = 3.0 - 2.0 * c - v_f / way
    printed = q_i + way * ((1.0 - b - c) * tau**3 + b * tau**2 + c * tau)
    h00, h10 = (1.0 + 2.0 * tau) * (1.0 - tau) ** 2, tau * (1.0 - tau) ** 2
    h01, h11 = tau**2 * (3.0 - 2.0 * tau), tau**2 * (tau - 1.0)
    correct = q_i * h00 + v_i * h10 + q_f * h01 + v_f * h11
    judge = CubicHermiteSpline([0.0, 1.0], [q_i, q_f], [v_i, v_f])(tau)
    return Forms(printed if np.isfinite(printed).all() else None, correct, judge)


def _some_still(rng: Generator, still: bool) -> tuple[Floats, Floats, Floats, Floats, float]:
    start, way = rng.uniform(-1.0, 1.0, 2), signed(rng, 0.3, 1.5, 2)
    way[1] = 0.0 if still else way[1]
    return start, start + way, signed(rng, 0.2, 1.0, 2), signed(rng, 0.2, 1.0, 2), float(rng.uniform(0.1, 0.9))


def _cosine_end(duration: float, way: float) -> Forms:
    """6.60: the slope of the cosine profile at the end of its parameter, in parts of its largest."""

    def slope(tau: float) -> float:
        return way * math.pi / 2.0 * math.sin(math.pi * tau)

    return Forms(slope(duration), slope(1.0), 0.0)


def _six_conditions(values: Floats) -> Forms:
    """6.71: the degree of the polynomial that meets places, speeds and accelerations at both ends."""
    quintic = BPoly.from_derivatives([0.0, 1.0], [values[:3], values[3:]])
    return Forms(6.0, 5.0, float(len(quintic.c) - 1))


def _rest_to_rest(tau: float, start: float, way: float) -> Forms:
    """6.74: the quintic from rest to rest."""
    judge = BPoly.from_derivatives([0.0, 1.0], [[start, 0.0, 0.0], [start + way, 0.0, 0.0]])

    def law(middle: float) -> float:
        return start + way * (6.0 * tau**5 - middle * tau**4 + 10.0 * tau**3)

    return Forms(law(5.0), law(15.0), float(judge(tau)))


def _short_line(length: float, v: float, a: float) -> Forms:
    """6.112: the largest jump of sigma of the bang-coast-bang law."""

    def jump(top: float) -> float:
        ramp, total = top / a, length / top + top / a
        risen = a * ramp * ramp / 2.0
        if total - ramp < ramp:  # there is no middle piece
            return abs(risen - (length - a * (ramp - total) ** 2 / 2.0))
        begun, ended = (top * t - top * top / (2.0 * a) for t in (ramp, total - ramp))
        return max(abs(risen - begun), abs(ended - (length - a * ramp * ramp / 2.0)))

    return Forms(jump(v), jump(min(v, math.sqrt(length * a))), 0.0)


def _too_short(rng: Generator) -> tuple[float, float, float]:
    v, a = rng.uniform(0.5, 2.0, 2).tolist()
    return v * v / a * float(rng.uniform(0.1, 0.8)), v, a


def _blend(k_ab: Floats, k_bc: Floats, v1: float, v2: float, duration: float, t: float) -> tuple[Floats, Floats]:
    """Return acceleration (6.120) and place of an over-fly that begins at the origin."""
    acceleration = (v2 * k_bc - v1 * k_ab) / duration
    return acceleration, v1 * t * k_ab + acceleration * t * t / 2.0


def _overfly(k_ab: Floats, k_bc: Floats, v1: float, v2: float, duration: float) -> Forms:
    """6.118: the size of the acceleration where an over-fly begins."""
    acceleration, _ = _blend(k_ab, k_bc, v1, v2, duration, 0.0)
    h = 1e-3 * duration
    p = [_blend(k_ab, k_bc, v1, v2, duration, t)[1] for t in (0.0, h, 2.0 * h)]
    judge = float(np.linalg.norm(p[0] - 2.0 * p[1] + p[2])) / h**2
    return Forms(0.0, float(np.linalg.norm(acceleration)), judge)


def _definite(k_ab: Floats, k_bc: Floats, v1: float, v2: float, duration: float) -> Forms:
    """6.121: the integral of the acceleration from 0 to half of the blend, with and without the first speed added."""
    t = duration / 2.0
    acceleration, _ = _blend(k_ab, k_bc, v1, v2, duration, t)
    h = 1e-6
    before, after = (_blend(k_ab, k_bc, v1, v2, duration, t + each)[1] for each in (-h, h))
    gained = (after - before) / (2.0 * h) - v1 * k_ab
    return Forms(acceleration * t + v1 * k_ab, acceleration * t, gained)


def _corner(rng: Generator) -> tuple[Floats, Floats, float, float, float]:
    first = direction(rng, 3)
    second = direction(rng, 3)
    return first, second, *rng.uniform([0.3, 0.3, 0.2], [1.0, 1.0, 0.8]).tolist()


def _normal(a: float, b: float, rate: float, t: float) -> Forms:
    """6.135: the acceleration across the path, on an ellipse whose parameter runs evenly."""

    def place(at: float) -> Floats:
        return np.array([a * math.cos(rate * at), b * math.sin(rate * at)])

    s, c = math.sin(rate * t), math.cos(rate * t)
    first, second = np.array([-a * s, b * c]), np.array([-a * c, -b * s])
    tangent = first / np.linalg.norm(first)
    normal = np.array([-tangent[1], tangent[0]]) * np.sign(tangent[0] * second[1] - tangent[1] * second[0])
    speed = rate * float(np.linalg.norm(first))
    kappa = abs(first[0] * second[1] - first[1] * second[0]) / float(np.linalg.norm(first)) ** 3
    h = 1e-4
    acceleration = (place(t + h) - 2.0 * place(t) + place(t - h)) / h**2
    return Forms(normal, kappa * speed**2 * normal, acceleration - (acceleration @ tangent) * tangent)


def _tangent(s: float) -> Forms:
    """6.145: the tangent of p = (6 s + 2, 5 s^2, -8 s)."""

    def place(at: float) -> Floats:
        return np.array([6.0 * at + 2.0, 5.0 * at * at, -8.0 * at])

    step = place(s + 1e-6) - place(s - 1e-6)
    root = math.sqrt(1.0 + s * s)
    return Forms(10.0 * root * place(s), np.array([0.6, s, -0.8]) / root, step / np.linalg.norm(step))


def _scaled(omega: float, k: float, r: float) -> Forms:
    """6.160: the acceleration of q = sin(omega t), scaled to k times its time, at the new time r."""

    def q(at: float) -> float:
        return math.sin(omega * at / k)

    t, h = r / k, 1e-4
    judge = (q(r + h) - 2.0 * q(r) + q(r - h)) / h**2
    return Forms(omega * math.cos(omega * t) / k**2, -(omega**2) * math.sin(omega * t) / k**2, judge)


def _at_the_start(way: float, duration: float) -> Forms:
    """6.183: the acceleration with which the cubic and the quintic from rest to rest begin; at rest it is 0."""
    cubic = Polynomial([0.0, 0.0, 3.0, -2.0]).deriv(2)(0.0)
    quintic = Polynomial([0.0, 0.0, 0.0, 10.0, -15.0, 6.0]).deriv(2)(0.0)
    return Forms(way / duration**2 * cubic, way / duration**2 * quintic, 0.0)


TRIALS = (
    Trial(
        "6.6",
        "a place on the path and a speed of s",
        lambda rng: (either(rng, (0.0, 0.15), (0.3, 0.7), (0.85, 1.0)), float(rng.uniform(0.2, 1.0))),
        _slope,
        "speed along the path",
        "scipy.interpolate.CubicHermiteSpline with slope 0 at both ends",
        unit="rad/s",
        quiet=Quiet(lambda rng: (float(rng.integers(2)), 0.0), "at both ends with the timing law 6.8, where ṡ is 0"),
    ),
    Trial(
        "6.11",
        "a cubic curve of six joints",
        lambda rng: _curve(rng, 6),
        _bend,
        "curvature",
        "differences of the unit tangent",
        1e-6,
        quiet=Quiet(lambda rng: _curve(rng, 3), "in three dimensions"),
    ),
    Trial(
        "6.12",
        "a direction, and the third or fifth power of s",
        lambda rng: (direction(rng, 2), int(rng.choice((3, 5)))),
        _regular,
        "whether the path is regular at s = 0, 1 if it is",
        "differences at s = 0",
        quiet=Quiet(lambda rng: (direction(rng, 2), 1), "with the first power"),
    ),
    Trial(
        "6.24",
        "a cubic path of one joint",
        lambda rng: (signed(rng, 0.3, 2.0, 4),),
        _steepest,
        "largest slope on [0, 1]",
        f"{DENSE} places on it",
        1e-6,
        somewhere="where the slope is largest at an end",
    ),
    Trial(
        "6.33",
        "largest slope and bend of a path, with a low limit of the acceleration",
        lambda rng: tuple(rng.uniform([1.0, 4.0, 1.5, 0.2], [4.0, 8.0, 3.0, 0.6]).tolist()),
        _allowance,
        "how far the bound lies below 0",
        "0, as a bound of a size has to be positive",
        unit="1/s²",
        quiet=Quiet(
            lambda rng: tuple(rng.uniform([2.0, 1.0, 0.5, 3.0], [4.0, 2.0, 1.0, 6.0]).tolist()),
            "with a high limit of the acceleration",
        ),
    ),
    Trial(
        "6.54",
        "two joints with speeds at both ends, of which one ends where it began",
        lambda rng: _some_still(rng, True),
        _hermite,
        "largest difference of a joint value",
        "scipy.interpolate.CubicHermiteSpline",
        unit="rad",
        quiet=Quiet(lambda rng: _some_still(rng, False), "where each joint ends elsewhere, taken one by one"),
    ),
    Trial(
        "6.60",
        "a duration that is no whole number, and a way",
        lambda rng: (int(rng.integers(1, 4)) + float(rng.uniform(0.2, 0.8)), float(rng.uniform(0.5, 2.0))),
        _cosine_end,
        "slope at the end of the parameter",
        "0, as it is asked for",
        unit="rad",
    ),
    Trial(
        "6.71",
        "places, speeds and accelerations at both ends",
        lambda rng: (signed(rng, 0.2, 1.5, 6),),
        _six_conditions,
        "degree of the polynomial",
        "scipy.interpolate.BPoly.from_derivatives",
    ),
    Trial(
        "6.74",
        "a time between start and end, a start and a way",
        lambda rng: (float(rng.uniform(0.2, 1.0)), float(rng.uniform(-1.0, 1.0)), float(signed(rng, 0.5, 2.0))),
        _rest_to_rest,
        "joint value",
        "scipy.interpolate.BPoly.from_derivatives",
        unit="rad",
    ),
    Trial(
        "6.112",
        "a path that is too short for the speed",
        _too_short,
        _short_line,
        "largest jump of σ(t)",
        "0, as an arm cannot jump",
        unit="m",
        quiet=Quiet(lambda rng: (float(rng.uniform(4.5, 8.0)), *rng.uniform(0.8, 1.8, 2).tolist()), "for a long path"),
    ),
    Trial(
        "6.118",
        "two directions, two speeds and a duration",
        _corner,
        _overfly,
        "size of the acceleration at the beginning of the blend",
        "second differences of the place inside of the blend",
        1e-6,
        "m/s²",
    ),
    Trial(
        "6.121",
        "two directions, two speeds and a duration",
        _corner,
        _definite,
        "largest difference of a component of what the integral gives",
        "the gain of speed, by differences of the place",
        1e-6,
        "m/s",
    ),
    Trial(
        "6.135",
        "an ellipse, an even speed of its parameter and a time",
        lambda rng: (*rng.uniform([0.8, 0.3, 1.5], [1.5, 0.6, 3.0]).tolist(), float(rng.uniform(0.0, 3.0))),
        _normal,
        "length of the difference of the acceleration across the path",
        "second differences of the place",
        1e-5,
        "m/s²",
        "length",
    ),
    Trial(
        "6.145",
        "a place on the curve of the example",
        lambda rng: (float(rng.uniform(-1.0, 1.0)),),
        _tangent,
        "length of the difference of the tangent",
        "differences of the curve, brought to length 1",
        1e-7,
        norm="length",
    ),
    Trial(
        "6.160",
        "a frequency, a factor and a time",
        lambda rng: tuple(rng.uniform([0.8, 1.5, 0.3], [2.0, 3.0, 2.0]).tolist()),
        _scaled,
        "acceleration of the scaled motion",
        "second differences of the scaled motion",
        1e-6,
        "rad/s²",
    ),
    Trial(
        "6.183",
        "a way and a duration",
        lambda rng: (float(signed(rng, 0.5, 3.0)), float(rng.uniform(0.5, 3.0))),
        _at_the_start,
        "jump of the acceleration at the start",
        "0, the acceleration at rest",
        unit="rad/s²",
    ),
)
"""The trials of paths and laws."""
