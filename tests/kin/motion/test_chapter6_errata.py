"""The errata of chapter 6: what each printed formula misses, and that ours does not."""

import math

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from armlab.errors import InputError
from armlab.kin.motion.bounds import law_bounds
from armlab.kin.motion.coordinated import coordinated
from armlab.kin.motion.geometry import curvature, frenet
from armlab.kin.motion.law_types import law_type
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.path_types import path_type
from armlab.kin.motion.sequence import Slowed
from armlab.kin.motion.trajectory import Motion
from armlab.kin.paths._spline_system import clamped_system
from armlab.kin.paths.polynomial import doubly_normalised


def example_6_34():
    """q = (2 s^2 + 1, 3 s^2 - 2 s)."""
    return path_type("polynomial").path([[1, 0], [3, 1]], start=[[0, -2]])


def example_6_142():
    """p = (6 s + 2, 5 s^2, -8 s)."""
    return path_type("polynomial").path([[2, 0, 0], [8, 5, -8]], start=[[6, 0, -8]])


class Sine(Motion):
    """q = sin(1.3 t) on [0, 4]."""

    m, duration, pieces = 1, 4.0, np.zeros(0)

    def derivatives(self, t, orders=(0, 1, 2, 3)):
        return [1.3**k * np.sin(1.3 * np.asarray(t) + k * np.pi / 2)[..., None] for k in orders]

    def limits_at(self, t, before):
        return self.derivatives(t)


def cubic_of_6_6():
    def printed(s):
        return 1 + 6 * (math.pi - 1) * s - 6 * (math.pi - 1) * s**2

    path = path_type("cubic").path([0, math.pi])
    return abs(printed(0)) + abs(printed(1)), np.abs(path.at([0.0, 1.0], 1)).sum()


def ends_of_6_24():
    """Distance of the maxima found with the end points from 4; interior zeros of q'' there are none."""
    path = example_6_34()
    inner = np.abs(path.at(np.linspace(0, 1, 101), 2)).min(axis=0)
    assert inner.min() > 0.0
    return None, np.abs(law_bounds(path, Limits(1.0)).M_v - 4).max()


def bound_of_6_33():
    path = example_6_34()
    return law_bounds(path, Limits([3, 2], [1, 1])).A, law_bounds(path, Limits([3, 2], [1, 1]), 0.25).A


def hermite_of_6_54():
    with pytest.raises(InputError, match="the same as q_start"):
        doubly_normalised(1.0, 1.0, [0.5], [0.0])
    path = path_type("cubic").path([[0, 1], [1, 1]], v_start=[0, 0.5])
    return math.inf, np.abs(path.at(0.0, 1) - [0, 0.5]).max()


def quintic_of_6_74():
    return abs(6 - 5 + 10 - 1), abs(float(law_type("quintic").law().at(1.0)) - 1)


def ends_of_6_79():
    path = path_type("lts_434").path([0, 0.2, 1.8, 2], times=[0, 1, 3, 4])
    names = path.names.index("q̇(t_f)"), path.names.index("q̈(t_f)")
    printed = path.matrix.copy()
    # One order higher at the end: acceleration and jerk instead of velocity and acceleration.
    printed[names[0]] = path.matrix[names[1]]
    printed[names[1], :] = 0.0
    printed[names[1], 12:] = [6.0, 24.0]
    found = np.linalg.solve(printed, path.right)[:, 0]
    end = found[9:] @ [0.0, 1.0, 2.0, 3.0, 4.0]
    return abs(end), abs(float(path.in_time.at(np.array(4.0), (1,))[0][0]))


def mixed_units_of_6_86():
    """Velocities per s used with a blend time in seconds: the end of the blend is not at the speed of the line."""
    path = path_type("blends").path([0, 1, 0.5], times=[0, 2, 4], blend=0.4, ends="moving")
    end = path.breaks[1:]
    (before,), (after,) = (path.derivatives(end, (1,), before=side) for side in (True, False))
    printed = abs((-0.5 - 1.0) - (-0.25 - 0.5))
    return printed, np.abs(after - before).max()


TIMES, KNOTS = np.array([0, 0.5, 1.7, 2.1, 4]), np.array([0.0, 1.0, -1.0, 2.0, 0.5])


def squares_of_6_95():
    h, zero = np.diff(TIMES), np.zeros(1)
    system = clamped_system(h, KNOTS[:, None], zero, zero)
    judge = CubicSpline(TIMES, KNOTS, bc_type="clamped")(TIMES, 1)
    steps = np.diff(KNOTS)
    right = 3 / (h[:-1] * h[1:]) * (h[1:] ** 2 * steps[1:] + h[:-1] ** 2 * steps[:-1])
    printed = np.linalg.solve(system.matrix, right)
    return np.abs(printed - judge[1:-1]).max(), np.abs(system.solve()[:, 0] - judge[1:-1]).max()


def cubics_of_6_91():
    judge = CubicSpline(TIMES, KNOTS, bc_type="clamped")
    path = path_type("spline").path(KNOTS, times=TIMES)
    v, h = judge(TIMES, 1), np.diff(TIMES)
    printed = [
        np.linalg.solve(
            [[h[k] ** 2, h[k] ** 3], [2 * h[k], 3 * h[k] ** 3]],
            [KNOTS[k + 1] - KNOTS[k] - v[k] * h[k], v[k + 1] - v[k]],
        )
        for k in range(4)
    ]
    right = judge.c[[1, 0]].T
    ours = path.in_time.coefficients[:, 2:, 0]
    return np.abs(printed - right).max(), np.abs(ours - right).max()


def triangle_of_6_112():
    law = law_type("trapezoidal").within(Limits(1.0, 1.0), distance=0.5)
    printed = abs(0.5 * 1.0**2 - (0.5 - 0.5 * (1.0 - 1.5) ** 2))
    top = law.pieces[0]
    return printed, abs(float(law.at(top) - law.derivatives(top, (0,), before=True)[0]))


def acceleration_of_6_118():
    """The printed claim is that the acceleration of 6.120 is zero at the ends; this is what it is."""
    knots = [[0, 0], [1, 0], [1, 1]]
    parabola = path_type("overfly").path(knots, by="time", amount=0.4)
    quartic = path_type("overfly").path(knots, by="time", amount=0.4, shape="quartic")
    start = quartic.pieces[0]
    return np.linalg.norm(parabola.accelerations[0]), np.linalg.norm(quartic.at(start, 2))


def tangent_of_6_145():
    s = 0.3
    printed = 10 * math.sqrt(1 + s * s) * example_6_142().at(s)
    exact = np.array([0.6, s, -0.8]) / math.sqrt(1 + s * s)
    return np.linalg.norm(printed - exact), np.linalg.norm(frenet(example_6_142(), s).tangent - exact)


def acceleration_of_6_160():
    slow, t, h = Slowed(Sine(), 2.0), 1.4, 1e-4
    numeric = float((slow.at(t + h) - 2 * slow.at(t) + slow.at(t - h))[0]) / h**2
    return abs(1.3 * math.cos(1.3 * t / 2) / 4 - numeric), abs(float(slow.at(t, 2)[0]) - numeric)


def continuity_of_6_183():
    cubic, quintic = (coordinated([1.0], [4.0], law, duration=2.0) for law in ("cubic", "quintic"))
    assert quintic.continuity_from_rest == 2
    return abs(float(cubic.at(0.0, 2)[0])), abs(float(quintic.at(0.0, 2)[0]))


def curvature_of_6_11():
    with pytest.raises(ValueError, match="dimension"):
        np.cross(np.ones(6), np.ones(6))
    d1, d2 = np.array([[1.0, -2.0, 0.5], [0.3, 0.1, 2.0]])
    by_cross = np.linalg.norm(np.cross(d1, d2)) / np.linalg.norm(d1) ** 3
    return None, abs(float(curvature(d1, d2)) - by_cross)


ERRATA = {
    "ERR-6.6": cubic_of_6_6,
    "ERR-6.11": curvature_of_6_11,
    "ERR-6.24": ends_of_6_24,
    "ERR-6.33": bound_of_6_33,
    "ERR-6.54": hermite_of_6_54,
    "ERR-6.74": quintic_of_6_74,
    "ERR-6.79": ends_of_6_79,
    "ERR-6.86": mixed_units_of_6_86,
    "ERR-6.91": cubics_of_6_91,
    "ERR-6.95": squares_of_6_95,
    "ERR-6.112": triangle_of_6_112,
    "ERR-6.118": acceleration_of_6_118,
    "ERR-6.145": tangent_of_6_145,
    "ERR-6.160": acceleration_of_6_160,
    "ERR-6.183": continuity_of_6_183,
}


OTHER_NUMBERS = ("ERR-6.74", "ERR-6.91", "ERR-6.95")
"""The data behind their printed residuals are not given; ours has other data, with the same error in it."""


@pytest.mark.parametrize("name", ERRATA)
def test_the_corrected_formula_holds_where_the_printed_one_does_not(truth, name):
    case = truth[name]
    printed, corrected = ERRATA[name]()
    said = case["printed_value_if_wrong"]["printed_residual"]
    if printed is not None and isinstance(said, float):
        assert printed == pytest.approx(said, rel=1e-4) if name not in OTHER_NUMBERS else printed > 1.0
    # By differences in time the second derivative has seven digits.
    tolerance = 1e-7 if name == "ERR-6.160" else 1e-11
    expected = case["expected"]["corrected_residual"]
    assert corrected == pytest.approx(0.0 if abs(expected) < 1e-6 else expected, abs=tolerance)
