"""Spur gears and their trains: truth cases, teeth that mesh without interference, power, and the best ratio."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from armlab.errors import InputError
from armlab.kin.drive.best_ratio import (
    Load,
    best_ratio,
    measured_slope,
    motor_torque,
    printed_slope,
    reflected,
    slope,
)
from armlab.kin.drive.tooth import ADDENDUM, DEDENDUM, FEWEST, half_gap, half_tooth, outline, undercut
from armlab.kin.drive.train import Train, train
from armlab.kin.drive.transfer import transfer

THINNED = 0.02
"""By how much teeth are thinner in tests of interference, modules."""


def test_the_ideal_gear_of_the_notes(truth):
    case = truth["C2.2-ideal-gear"]
    given, expected = case["inputs"], case["expected"]
    found = transfer(given["n"], given["theta_dot_m"], given["tau_m"])
    assert found.load_speed == pytest.approx(expected["theta_dot_u"], abs=case["tol"])
    assert found.load_torque == pytest.approx(expected["tau_u"], abs=case["tol"])
    assert found.motor_power == pytest.approx(expected["P"], abs=case["tol"])
    assert found.load_power == pytest.approx(expected["P"], abs=case["tol"])
    assert found.lost == 0.0


@pytest.mark.parametrize("speed", [3.0, -3.0])
@pytest.mark.parametrize("ratio", [5.0, -5.0])
def test_what_is_lost_is_never_negative_whoever_drives(speed, ratio):
    driving = transfer(ratio, speed, math.copysign(2.0, speed), 0.8)
    assert driving.motor_power == 6.0
    assert driving.load_power == pytest.approx(4.8)
    braking = transfer(ratio, speed, -math.copysign(2.0, speed), 0.8)
    assert braking.load_power == pytest.approx(-7.5)  # the load puts in 7.5 W, and 6 W of them reach the motor
    for found in (driving, braking):
        assert found.lost > 0.0
        assert found.load_power == pytest.approx(found.load_torque * found.load_speed)
        assert found.load_power == pytest.approx(found.motor_power - found.lost)


def test_the_best_ratio_of_the_notes(truth):
    case = truth["C2.2-opt-ratio"]
    given, expected = case["inputs"], case["expected"]
    load = Load(given["J_m"], given["J_u"], given["a"])
    best = best_ratio(load)
    assert best.ratio == pytest.approx(expected["n_opt"], abs=case["tol"])
    assert best.torque == pytest.approx(expected["tau_min"], abs=case["tol"])
    found = motor_torque(load, [10.0, 40.0])
    np.testing.assert_allclose(found, [expected["tau_n10"], expected["tau_n40"]], rtol=0, atol=case["tol"])


def test_the_derivative_has_a_minus_sign(truth):
    """Erratum 2.38: with a plus the derivative at the minimum would be 2 J_m a = 0.06, and would never be zero."""
    load = Load(0.01, 4.0, 3.0)
    assert measured_slope(load, 20.0) == pytest.approx(0.0, abs=1e-9)
    assert slope(load, 20.0) == pytest.approx(0.0, abs=1e-15)
    assert abs(printed_slope(load, 20.0)) == pytest.approx(
        truth["ERR-2.38"]["printed_value_if_wrong"]["printed_residual"]
    )
    for ratio in (3.0, 10.0, 80.0):
        assert measured_slope(load, ratio) == pytest.approx(slope(load, ratio), rel=1e-6)
        assert printed_slope(load, ratio) > 0.02


@pytest.mark.parametrize("torque", [0.0, 5.0, -6.0, -11.0])
@pytest.mark.parametrize("acceleration", [3.0, -3.0])
def test_the_best_ratio_is_where_a_search_finds_the_least_torque(acceleration, torque):
    load = Load(0.02, 4.0, acceleration, math.copysign(torque, torque * acceleration))
    best = best_ratio(load)
    found = minimize_scalar(
        lambda n: abs(float(motor_torque(load, n))), bounds=(0.2, 200.0), method="bounded", options={"xatol": 1e-9}
    )
    assert best.ratio == pytest.approx(found.x, rel=1e-5)
    assert float(motor_torque(load, best.ratio)) == pytest.approx(best.torque, abs=1e-12)


def test_a_load_that_drives_by_more_than_its_inertia_takes_needs_no_torque_at_one_ratio():
    load = Load(0.01, 4.0, 3.0, -21.0)  # J_u a + tau_L = -9 N m: n = sqrt(9/0.03)
    assert best_ratio(load) == (pytest.approx(math.sqrt(300.0)), 0.0)
    assert float(motor_torque(load, math.sqrt(300.0))) == pytest.approx(0.0, abs=1e-12)


def test_without_acceleration_the_torque_falls_with_every_ratio():
    assert best_ratio(Load(0.01, 4.0, 0.0, 5.0)).ratio == math.inf
    assert best_ratio(Load(0.01, 4.0, 3.0, -12.0)) == (0.0, 0.0)


def test_inertias_are_reflected_by_the_square_of_the_ratio():
    assert reflected(Load(0.01, 4.0, 1.0), -20.0) == (pytest.approx(0.02), pytest.approx(8.0))


@pytest.mark.parametrize(
    ("teeth", "layout", "ratio", "turns"),
    [
        ((20, 60), "row", -3.0, [1.0, -1 / 3]),
        ((20, 35, 60), "row", 3.0, [1.0, -20 / 35, 1 / 3]),
        ((20, 35, 17, 60), "row", -3.0, [1.0, -20 / 35, 20 / 17, -1 / 3]),
        ((20, 60, 15, 45), "compound", 9.0, [1.0, -1 / 3, -1 / 3, 1 / 9]),
    ],
)
def test_an_idler_changes_the_sense_and_not_the_ratio_and_stages_multiply(teeth, layout, ratio, turns):
    found = train(teeth, layout)
    assert found.ratio == pytest.approx(ratio)
    np.testing.assert_allclose(found.turns, turns, rtol=0, atol=1e-12)
    # What is drawn turns as the ratio says, over many turns.
    moved = found.angles(50.0) - found.angles(0.0)
    np.testing.assert_allclose(moved, 50.0 * np.array(turns), rtol=0, atol=1e-12)


def test_the_module_follows_from_the_centre_distance():
    found = train((20, 40))
    np.testing.assert_allclose(found.modules([0.06]), [0.002, 0.002], rtol=0, atol=1e-15)
    np.testing.assert_allclose(train((20, 40, 20)).places([0.06]), [0.0, 0.06, 0.12], rtol=0, atol=1e-15)
    stages = train((20, 60, 15, 45), "compound")
    np.testing.assert_allclose(stages.modules([0.08, 0.09]), [0.002, 0.002, 0.003, 0.003], rtol=0, atol=1e-15)
    np.testing.assert_allclose(stages.places([0.08, 0.09]), [0.0, 0.08, 0.08, 0.17], rtol=0, atol=1e-15)


def overlap(teeth, other, theta, points=400):
    """Return by how much, in modules, the first wheel of a pair reaches into the second, which it meshes with."""
    pair = train((teeth, other))
    first, second = pair.angles(theta)
    apart = 0.5 * (teeth + other)
    edge = outline(teeth, THINNED, points // 8)
    edge = edge @ np.array([[math.cos(first), math.sin(first)], [-math.sin(first), math.cos(first)]])
    x, y = apart - edge[:, 0], -edge[:, 1]  # as the second wheel sees them, whose x axis points back
    rho = np.hypot(x, y)
    near = rho < other / 2.0 + ADDENDUM
    rho, angle = rho[near], np.arctan2(y, x)[near] + math.pi - second
    pitch = 2.0 * math.pi / other
    offset = np.abs((angle + 0.5 * pitch) % pitch - 0.5 * pitch)
    assert rho.min() > other / 2.0 - DEDENDUM
    inside = (half_tooth(other, rho, THINNED) - offset) * rho
    return float(inside.max())


@pytest.mark.parametrize(("teeth", "other"), [(6, 6), (6, 200), (12, 30), (17, 17), (40, 41), (200, 9)])
def test_wheels_mesh_without_interference_and_touch(teeth, other):
    turns = np.linspace(0.0, 2.0 * math.pi / teeth, 9)
    deepest = [overlap(teeth, other, theta) for theta in turns]
    assert max(deepest) < 1e-3
    # They do not stay further apart than what was taken from both teeth leaves.
    assert max(deepest) > -2.0 * THINNED


def test_a_wheel_that_is_off_by_half_a_tooth_would_interfere(monkeypatch):
    monkeypatch.setattr(Train, "angles", lambda self, theta: np.array([theta, math.pi]))
    assert overlap(20, 40, 0.0) > 0.5


def test_the_pitch_circle_has_teeth_and_gaps_of_one_width():
    for teeth in (17, 40, 200):
        assert half_gap(teeth, teeth / 2.0) == pytest.approx(math.pi / (2.0 * teeth), abs=1e-12)
        assert half_tooth(teeth, teeth / 2.0, 0.1) * teeth / 2.0 == pytest.approx(math.pi / 4.0 - 0.05)


def test_few_teeth_are_undercut_and_none_is_pointed():
    assert [undercut(teeth) for teeth in (17, 18)] == [True, False]
    rho = np.linspace(6 / 2.0 - DEDENDUM, 6 / 2.0 + ADDENDUM, 200)
    half = half_tooth(6, rho) * rho
    assert half.min() > 0.1
    # Thinner in the middle than at the root: that is the undercut.
    assert half[:100].min() < half[0] - 0.05
    assert (half_tooth(FEWEST, FEWEST / 2.0 + ADDENDUM)) > 0.0


def test_an_outline_goes_round_once_with_a_tooth_on_the_x_axis():
    points = outline(24)
    assert points.shape == (24 * 14, 2)
    tip = points[np.argmax(points[:, 0])]
    assert np.hypot(*tip) == pytest.approx(13.0)
    area = 0.5 * float(np.sum(points[:, 0] * np.roll(points[:, 1], -1) - points[:, 1] * np.roll(points[:, 0], -1)))
    assert math.pi * 10.75**2 < area < math.pi * 13.0**2


@pytest.mark.parametrize(
    ("teeth", "layout", "told"),
    [
        ((20,), "row", "a train has 2 to 4 wheels, got 1"),
        ((20,) * 30, "row", "a train has 2 to 4 wheels, got 30"),
        ((20, 60, 20), "compound", "two stages have 4 wheels, got 3"),
        ((20, 0), "row", "teeth of wheel 2: expected a whole number from 6 to 200, got 0"),
        ((1, 20), "row", "teeth of wheel 1: expected a whole number from 6 to 200, got 1"),
        ((20, 20.5), "row", "teeth of wheel 2: expected a whole number from 6 to 200, got 20.5"),
        ((20, 1000), "row", "teeth of wheel 2: expected a whole number from 6 to 200, got 1000"),
        ((20, 60), "pile", "pile"),
    ],
)
def test_a_train_that_cannot_be_is_refused_in_words(teeth, layout, told):
    with pytest.raises(InputError, match=told):
        train(teeth, layout)
