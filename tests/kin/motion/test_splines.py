"""Cubic splines, interpolating polynomials and Hermite curves against SciPy, and the system of the notes."""

import numpy as np
import pytest
from scipy.integrate import trapezoid
from scipy.interpolate import BarycentricInterpolator, CubicHermiteSpline, CubicSpline, make_interp_spline

from armlab.kin.motion.path_types import path_type

SPLINE = path_type("spline")


def knots_of(rng, count, m=3):
    times = np.cumsum(rng.uniform(0.05, 2.0, count))
    return times, rng.normal(size=(count, m))


def in_time(path, t, t_1, order):
    (values,) = path.in_time.at(t - t_1, (order,))
    return values


@pytest.mark.parametrize("count", [2, 3, 4, 10, 200])
def test_clamped_splines_are_those_of_scipy(rng, count):
    for _ in range(5):
        times, q = knots_of(rng, count)
        v = rng.normal(size=(2, 3))
        path = SPLINE.path(q, times=times, v_start=v[0], v_end=v[1])
        judge = CubicSpline(times, q, bc_type=((1, v[0]), (1, v[1])))
        t = rng.uniform(times[0], times[-1], 300)
        for order in range(4):
            expected = judge(t, order)
            tolerance = 1e-12 * max(np.abs(expected).max(), 1.0) * (1 if order < 2 else 100)
            np.testing.assert_allclose(in_time(path, t, times[0], order), expected, rtol=0, atol=tolerance)


@pytest.mark.parametrize("count", [2, 3, 8, 100])
def test_natural_splines_and_given_end_accelerations_are_those_of_scipy(rng, count):
    times, q = knots_of(rng, count)
    t = rng.uniform(times[0], times[-1], 300)
    judge = CubicSpline(times, q, bc_type="natural")(t)
    path = SPLINE.path(q, times=times, ends="natural")
    np.testing.assert_allclose(in_time(path, t, times[0], 0), judge, rtol=0, atol=1e-12 * np.abs(judge).max())
    a = rng.normal(size=(2, 3))
    judge = make_interp_spline(times, q, k=3, bc_type=([(2, a[0])], [(2, a[1])]))(t)
    path = SPLINE.path(q, times=times, ends="natural", a_start=a[0], a_end=a[1])
    np.testing.assert_allclose(in_time(path, t, times[0], 0), judge, rtol=0, atol=1e-11 * np.abs(judge).max())


@pytest.mark.parametrize("count", [2, 3, 4, 30])
def test_virtual_knots_give_velocities_and_accelerations_at_both_ends(rng, count):
    times, q = knots_of(rng, count)
    v, a = rng.normal(size=(2, 3)), rng.normal(size=(2, 3))
    path = SPLINE.path(q, times=times, ends="both", v_start=v[0], v_end=v[1], a_start=a[0], a_end=a[1])
    ends = times[[0, -1]]
    np.testing.assert_allclose(in_time(path, ends, times[0], 1), v, rtol=0, atol=1e-8)
    np.testing.assert_allclose(in_time(path, ends, times[0], 2), a, rtol=0, atol=1e-7)
    np.testing.assert_allclose(in_time(path, times, times[0], 0), q, rtol=0, atol=1e-10)
    assert path.continuity == 2
    assert path.equations == 4 * (count + 1)
    assert path.virtual == (2, count + 1)
    # The judge: the spline through all its knots.
    judge = CubicSpline(path.times, path.positions, bc_type=((1, v[0]), (1, v[1])))
    t = rng.uniform(times[0], times[-1], 300)
    np.testing.assert_allclose(in_time(path, t, times[0], 0), judge(t), rtol=0, atol=1e-10)


def test_the_system_is_the_one_of_the_notes(rng):
    times, q = knots_of(rng, 6, 1)
    h = np.diff(times)
    path = SPLINE.path(q, times=times, v_start=[0.3], v_end=[-0.2])
    matrix = path.system.matrix
    for k in range(4):
        assert matrix[k, k] == pytest.approx(2 * (h[k] + h[k + 1]))
        if k > 0:
            assert matrix[k, k - 1] == pytest.approx(h[k + 1])
        if k < 3:
            assert matrix[k, k + 1] == pytest.approx(h[k])
    np.testing.assert_allclose(matrix @ path.velocities[1:-1], path.system.right, rtol=0, atol=1e-12)
    first = 3 / (h[0] * h[1]) * (h[0] ** 2 * (q[2] - q[1]) + h[1] ** 2 * (q[1] - q[0])) - h[1] * 0.3
    np.testing.assert_allclose(path.system.right[0], first, rtol=0, atol=1e-12)


def test_a_spline_bends_less_than_other_curves_through_the_same_knots(rng):
    """The integral of the squared acceleration is least: any change that keeps the conditions makes it larger."""
    times, q = knots_of(rng, 6, 1)
    path = SPLINE.path(q, times=times)
    t = np.linspace(times[0], times[-1], 20001)
    bend = in_time(path, t, times[0], 2)[:, 0]
    for _ in range(5):
        # A quintic with zero value and slope at both ends of an interval, so it keeps the knots and the end velocities.
        k = rng.integers(0, 5)
        a, b = times[k], times[k + 1]
        u = np.clip((t - a) / (b - a), 0, 1)
        hump = rng.normal() * (2 - 12 * u + 12 * u**2) / (b - a) ** 2 * ((t >= a) & (t <= b))
        assert trapezoid((bend + hump) ** 2, t) > trapezoid(bend**2, t)


def test_ten_thousand_waypoints(rng):
    q = np.cumsum(rng.normal(size=(10_000, 7)), axis=0)
    path = SPLINE.path(q, duration=100.0)
    judge = CubicSpline(path.times, q, bc_type="clamped")
    t = rng.uniform(0, 100, 5000)
    scale = np.abs(q).max()
    np.testing.assert_allclose(path.at(t / 100), judge(t), rtol=0, atol=1e-12 * scale)
    assert path.continuity == 2
    for kind in ("polyline", "overfly", "blends"):
        other = path_type(kind).path(q)
        np.testing.assert_allclose(other.at([0.0, 1.0]), q[[0, -1]], rtol=0, atol=1e-9 * scale)


@pytest.mark.parametrize("count", [2, 5, 11, 20])
def test_one_polynomial_through_all_is_that_of_scipy(rng, count):
    q = rng.normal(size=(count, 2))
    path = path_type("interpolating").path(q, spacing="uniform")
    judge = BarycentricInterpolator(np.linspace(0, 1, count), q)
    s = rng.uniform(0, 1, 200)
    expected = judge(s)
    np.testing.assert_allclose(path.at(s), expected, rtol=0, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize(
    ("count", "said"), [(2, None), (3, "Degree 2 with up to 1 extreme in"), (4, "Degree 3 with up to 2 extremes in")]
)
def test_only_a_polynomial_that_is_no_line_is_said_to_wander(count, said):
    remarks = path_type("interpolating").path(np.eye(count), spacing="uniform").remarks
    assert [remark.startswith(said) for remark in remarks] == ([] if said is None else [True])


def test_the_polynomial_wanders_and_the_spline_does_not():
    """Eleven knots of a calm curve: the polynomial leaves it by more than its height, the spline stays."""
    x = np.linspace(-1, 1, 11)
    q = (1 / (1 + 25 * x**2))[:, None]
    s = np.linspace(0, 1, 2001)
    polynomial = path_type("interpolating").path(q, spacing="uniform").at(s)
    spline = SPLINE.path(q, spacing="uniform", ends="natural").at(s)
    curve = (1 / (1 + 25 * (2 * s - 1) ** 2))[:, None]
    assert np.abs(polynomial - curve).max() > 1.5
    assert np.abs(spline - curve).max() < 0.03


def test_cubics_are_those_of_scipy(rng):
    q, v = rng.normal(size=(2, 4)), rng.normal(size=(2, 4))
    path = path_type("cubic").path(q, v_start=v[0], v_end=v[1], duration=2.5)
    judge = CubicHermiteSpline([0, 2.5], q, v)
    t = rng.uniform(0, 2.5, 100)
    np.testing.assert_allclose(path.at(t / 2.5), judge(t), rtol=0, atol=1e-12)


def test_given_conditions_of_any_number_are_kept(rng):
    for start_count in range(5):
        for end_count in range(5):
            q = rng.normal(size=(2, 3))
            start, end = rng.normal(size=(start_count, 3)), rng.normal(size=(end_count, 3))
            options = {key: rows for key, rows in (("start", start), ("end", end)) if len(rows)}
            path = path_type("polynomial").path(q, duration=1.7, **options)
            assert path.degree == 1 + start_count + end_count
            for order, value in enumerate(start[:3], start=1):
                np.testing.assert_allclose(path.at(0.0, order) / 1.7**order, value, rtol=0, atol=1e-9)
            for order, value in enumerate(end[:3], start=1):
                np.testing.assert_allclose(path.at(1.0, order) / 1.7**order, value, rtol=0, atol=1e-9)
