"""Trials of chapter 4, inverse kinematics: half angles, the polar and the elbow arm, Newton and gradient methods."""

from __future__ import annotations

import math

import numpy as np

from armlab.kin.errata.arms import jacobian_2r, point_2r, point_elbow, point_polar
from armlab.kin.errata.draws import Floats, Generator, either, matrix, signed
from armlab.kin.errata.trial import Forms, Quiet, Trial

NEWTON = 6
"""Number of steps of Newton's method."""

LONG = 5.0
"""Time of the gradient flow, in units of one over its gain and the square of a metre."""

GRADIENT = 40
"""Number of steps of the gradient method."""

CLEAR = 1e-12
"""Reciprocal condition below which a matrix counts as one without an inverse."""


def _numerator(a: float, b: float, u: float) -> Forms:
    """4.29: a sin(theta) + b cos(theta) by the tangent of half the angle."""
    right = (2.0 * a * u + b - u * u * b) / (1.0 + u * u)
    theta = 2.0 * math.atan(u)
    return Forms(right + 2.0 * a * u / (1.0 + u * u), right, a * math.sin(theta) + b * math.cos(theta))


def _both_angles(a: float, b: float, c: float) -> Forms:
    """4.35: a sin(theta) + b cos(theta) - c at both solutions."""
    root = math.sqrt(a * a + b * b - c * c)

    def left(theta: list[float]) -> list[float]:
        return [a * math.sin(each) + b * math.cos(each) - c for each in theta]

    halves = [(a + root) / (b + c), (a - root) / (b + c)] if b + c else None
    middle, side = math.atan2(a, b), math.atan2(root, c)
    printed = None if halves is None else left([2.0 * math.atan(u) for u in halves])
    return Forms(printed, left([middle + side, middle - side]), [0.0, 0.0])


def _degenerate(rng: Generator) -> tuple[float, float, float]:
    b = float(signed(rng, 0.2, 1.5))
    return float(signed(rng, 0.3, 2.0)), b, -b


def _quadratic(rng: Generator) -> tuple[float, float, float]:
    a, b = float(signed(rng, 0.5, 2.0)), float(signed(rng, 0.5, 2.0))
    return a, b, 0.9 * b


def _four(d1: float, p: Floats, with_sign: bool) -> list[Floats]:
    """Return the four solutions of the polar arm, with or without the sign of q3 in q1 (notes 4.72 to 4.82)."""
    found = []
    gamma, height = float(np.linalg.norm(p - [0.0, 0.0, d1])), p[2] - d1
    for q3 in (gamma, -gamma):
        for side in (1.0, -1.0):
            q2 = math.atan2(height / q3, side * math.sqrt(max(0.0, 1.0 - (height / q3) ** 2)))
            over = math.cos(q2) * (q3 if with_sign else 1.0)
            found.append(np.array([math.atan2(p[1] / over, p[0] / over), q2, q3]))
    return found


def _first_angle(d1: float, p: Floats) -> Forms:
    """4.82: the distances of the tool from its point in the four solutions."""
    away = [
        [float(np.linalg.norm(point_polar(d1, q) - p)) for q in _four(d1, p, with_sign)] for with_sign in (False, True)
    ]
    return Forms(away[0], away[1], np.zeros(4))


def _how_many(d1: float, p: Floats) -> Forms:
    """4.81: the solutions of an arm whose slide stays on one side of zero."""
    right = [q for q in _four(d1, p, True) if np.linalg.norm(point_polar(d1, q) - p) < 1e-9]
    return Forms(4.0, 2.0, float(sum(q[2] >= 0.0 for q in right)))


def _height(d1: float, p: Floats) -> Forms:
    """4.77: the height of the tool with q3 positive and either sign of the sine."""
    gamma, height = float(np.linalg.norm(p - [0.0, 0.0, d1])), p[2] - d1
    tool = [
        point_polar(d1, [0.0, math.atan2(sign * height / gamma, math.sqrt(1.0 - (height / gamma) ** 2)), gamma])[2]
        for sign in (-1.0, 1.0)
    ]
    return Forms(tool[0], tool[1], p[2])


def _polar_point(rng: Generator) -> tuple[float, Floats]:
    d1 = float(rng.uniform(0.3, 0.8))
    return d1, np.array([*signed(rng, 0.2, 0.8, 2), d1 + float(signed(rng, 0.2, 0.6))])


def _elbow_cosine(d1: float, l2: float, l3: float, q: Floats) -> Forms:
    """4.94: the cosine of the elbow from the point."""
    p = point_elbow(d1, l2, l3, q)

    def cosine(height: float) -> float:
        return float((p[0] ** 2 + p[1] ** 2 + height**2 - l2**2 - l3**2) / (2.0 * l2 * l3))

    return Forms(cosine(p[2]), cosine(p[2] - d1), math.cos(q[2]))


def _reach(d1: float, l2: float, l3: float, q: Floats) -> Forms:
    """4.101: the left side of the first equation, which is to be L2 c2 + L3 c23."""
    p = point_elbow(d1, l2, l3, q)
    straight = l2 * math.cos(q[1]) + l3 * math.cos(q[1] + q[2])
    return Forms(p[0] + p[1], math.cos(q[0]) * p[0] + math.sin(q[0]) * p[1], straight)


def _elbow(rng: Generator) -> tuple[float, float, float, Floats]:
    d1, l2, l3 = rng.uniform(0.4, 1.0, 3).tolist()
    return (
        d1,
        l2,
        l3,
        np.array([float(signed(rng, 0.3, 2.8)), float(rng.uniform(0.2, 1.2)), float(signed(rng, 0.3, 2.5))]),
    )


def _newton(square: float, x: float) -> Forms:
    """4.110: the root of x^2 - c after some steps."""
    printed = correct = x
    for _ in range(NEWTON):
        printed = (printed**2 - square) / (2.0 * printed)
        correct = correct - (correct**2 - square) / (2.0 * correct)
    return Forms(printed, correct, math.sqrt(square))


def _pseudo_inverse(J: Floats) -> Forms:
    """4.116: the pseudo-inverse of a matrix with more columns than rows."""
    inner = J.T @ J
    printed = None if 1.0 / np.linalg.cond(inner) < CLEAR else np.linalg.inv(inner) @ J.T
    return Forms(printed, J.T @ np.linalg.inv(J @ J.T), np.linalg.pinv(J))


def _limits(gain: float, wanted: float, t: float, dt: float) -> Forms:
    """4.127: a sliding joint at t + dt, from 0 with q' = K (r_d - q)."""

    def integral(end: float) -> float:
        nodes, weights = np.polynomial.legendre.leggauss(20)
        times = end / 2.0 * (nodes + 1.0)
        return float(end / 2.0 * weights @ (gain * wanted * np.exp(-gain * times)))

    return Forms(integral(t), integral(t + dt), wanted * (1.0 - math.exp(-gain * (t + dt))))


def _stuck(l1: float, l2: float, bearing: float, distance: float) -> Forms:
    """4.128: the error of a stretched 2R after a long time, whose target lies on its ray."""
    wanted = distance * np.array([math.cos(bearing), math.sin(bearing)])
    q, h = np.array([bearing, 0.0]), LONG / 200
    for _ in range(200):
        q = q + h * jacobian_2r(l1, l2, q).T @ (wanted - point_2r(l1, l2, q))
    return Forms(0.0, l1 + l2 - distance, float(np.linalg.norm(wanted - point_2r(l1, l2, q))))


def _growth(alpha: float, error: Floats) -> Forms:
    """4.129: the decades by which the error of an arm of three sliding joints, J = I, has grown in some steps."""
    e = error
    for _ in range(GRADIENT):
        e = e - alpha * e
    grown = math.log10(float(np.linalg.norm(e) / np.linalg.norm(error)))
    said = GRADIENT * math.log10(abs(1.0 - alpha))
    return Forms(min(said, 0.0), said, grown)


TRIALS = (
    Trial(
        "4.29",
        "a, b and u",
        lambda rng: tuple(signed(rng, 0.3, 2.0, 3).tolist()),
        _numerator,
        "value of a sin θ + b cos θ",
        "sine and cosine themselves",
    ),
    Trial(
        "4.35",
        "a and b, with c = −b",
        _degenerate,
        _both_angles,
        "what is left of the equation at both solutions",
        "the equation itself",
        quiet=Quiet(_quadratic, "where b + c is not 0"),
    ),
    Trial(
        "4.82",
        "the height of the shoulder and a point",
        _polar_point,
        _first_angle,
        "largest distance of the tool from the point, of four solutions",
        "the direct kinematics",
        unit="m",
    ),
    Trial(
        "4.81",
        "the height of the shoulder and a point",
        _polar_point,
        _how_many,
        "number of solutions with q₃ ≥ 0",
        "counting the solutions that reach the point",
    ),
    Trial(
        "4.77",
        "the height of the shoulder and a point",
        _polar_point,
        _height,
        "height of the tool",
        "the height that is asked for",
        unit="m",
    ),
    Trial(
        "4.94",
        "an elbow arm and a configuration",
        _elbow,
        _elbow_cosine,
        "cosine of the elbow",
        "the configuration from which the point was made",
    ),
    Trial(
        "4.101",
        "an elbow arm and a configuration",
        _elbow,
        _reach,
        "horizontal reach",
        "both links seen from the side",
        unit="m",
    ),
    Trial(
        "4.110",
        "a square and a start above its root",
        lambda rng: (square := float(rng.uniform(1.0, 4.0)), math.sqrt(square) * either(rng, (0.6, 0.9), (1.1, 1.5))),
        _newton,
        f"x after {NEWTON} steps",
        "the square root",
    ),
    Trial(
        "4.116",
        "a well-conditioned 2 × 3 matrix",
        lambda rng: (matrix(rng, 2, 3),),
        _pseudo_inverse,
        "largest difference of an entry",
        "numpy.linalg.pinv",
        quiet=Quiet(lambda rng: (matrix(rng, 2, 2),), "for a square matrix"),
    ),
    Trial(
        "4.127",
        "a gain, a target, a time and a step",
        lambda rng: tuple(rng.uniform([0.5, 0.5, 0.2, 0.05], [2.0, 1.5, 1.0, 0.3]).tolist()),
        _limits,
        "value of the joint at t + dt",
        "the exponential that solves the equation",
        unit="m",
    ),
    Trial(
        "4.128",
        "a stretched 2R, and a target on its ray within reach",
        lambda rng: (
            *(links := rng.uniform(0.6, 1.4, 2).tolist()),
            float(rng.uniform(-3.0, 3.0)),
            sum(links) * float(rng.uniform(0.3, 0.8)),
        ),
        _stuck,
        "error after a long time",
        "the flow in 200 steps",
        1e-6,
        "m",
    ),
    Trial(
        "4.129",
        "a step size above 2 and an error",
        lambda rng: (float(rng.uniform(2.2, 3.0)), signed(rng, 0.2, 1.5, 3)),
        _growth,
        f"decades by which the error has grown in {GRADIENT} steps",
        "the steps themselves",
        quiet=Quiet(lambda rng: (float(rng.uniform(0.2, 0.9)), signed(rng, 0.2, 1.5, 3)), "with a step size below 2"),
    ),
)
"""The trials of inverse kinematics."""
