"""Characteristic curves: injected errors are found again, and calibration removes what can be removed."""

import itertools
import math

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.sensors.characteristic import Calibration, Cycle, Sensor, best_line, dead_band, linearity_error


def test_an_ideal_sensor_has_no_errors():
    cycle = Cycle(Sensor(), 21)
    np.testing.assert_allclose(cycle.outputs, cycle.inputs, rtol=0, atol=1e-15)
    figures = [cycle.largest_error, cycle.linearity, cycle.offset, cycle.hysteresis, dead_band(Sensor())]
    np.testing.assert_allclose(figures, 0.0, rtol=0, atol=1e-3)  # the dead band is known to a step of its fine cycle
    assert cycle.line == pytest.approx((0.0, 1.0), abs=1e-12)


def test_offset_and_gain_alone_are_a_line_and_a_line_takes_them_away():
    cycle = Cycle(Sensor(offset=0.05, gain=-0.1), 11)
    assert cycle.offset == pytest.approx(0.05, abs=1e-12)
    assert cycle.line == pytest.approx((0.05, 0.9), abs=1e-12)
    assert cycle.linearity == pytest.approx(0.0, abs=1e-12)
    assert cycle.largest_error == pytest.approx(0.05, abs=1e-12)  # 0.05 at 0 and -0.05 at 1
    fitted = Calibration(cycle, 1)
    np.testing.assert_allclose(fitted.coefficients, [-0.05 / 0.9, 1 / 0.9], rtol=0, atol=1e-12)
    np.testing.assert_allclose(fitted.residuals, 0.0, rtol=0, atol=1e-12)


def test_the_linearity_error_of_an_arch_by_hand():
    """Arch b 4 u (1 - u), densely sampled: its best line is level at 2/3 b, from which the ends are farthest."""
    cycle = Cycle(Sensor(bend=0.06), 400)
    assert cycle.line == pytest.approx((0.04, 1.0), abs=2e-4)
    assert cycle.linearity == pytest.approx(0.04, abs=2e-4)
    assert linearity_error([0, 1, 2, 3], [0, 1, 2, 3]) == pytest.approx(0.0, abs=1e-12)
    assert best_line([0, 1, 2], [0, 3, 0]) == pytest.approx((1.0, 0.0), abs=1e-12)


@pytest.mark.parametrize("shape", ["arch", "wave"])
def test_the_bend_has_its_height(shape):
    cycle = Cycle(Sensor(bend=0.08, shape=shape), 400)
    assert np.abs(cycle.outputs - cycle.inputs).max() == pytest.approx(0.08, abs=1e-5)


def test_higher_degrees_straighten_a_bent_curve_step_by_step():
    cycle = Cycle(Sensor(offset=0.03, gain=0.05, bend=0.05), 41)
    left = [float(np.abs(Calibration(cycle, degree).residuals).max()) for degree in range(1, 6)]
    assert all(after < 0.5 * before for before, after in itertools.pairwise(left))
    assert left[0] > 0.02
    assert left[4] < 1e-4


def test_hysteresis_is_the_play_and_no_polynomial_takes_it_away():
    cycle = Cycle(Sensor(hysteresis=0.02), 51)
    assert cycle.hysteresis == pytest.approx(0.02, abs=1e-12)
    # In the middle of the range the input is half the play ahead, going up.
    middle = np.argmin(np.abs(cycle.inputs[:51] - 0.5))
    assert cycle.outputs[middle] == pytest.approx(0.49, abs=1e-12)
    for degree in (1, 3, 7):
        assert np.abs(Calibration(cycle, degree).residuals).max() >= 0.009


def test_the_dead_band_is_the_step_and_the_play():
    assert dead_band(Sensor(resolution=0.02)) == pytest.approx(0.02, abs=5e-4)
    assert dead_band(Sensor(hysteresis=0.03)) == pytest.approx(0.03, abs=5e-4)
    assert dead_band(Sensor(resolution=0.02, hysteresis=0.03)) >= 0.03


def test_a_polynomial_fits_the_noise_and_fails_between_the_points():
    """With as many coefficients as nearly as there are inputs, the points are met better, and others worse."""
    sensor = Sensor(bend=0.02, noise=0.01)
    better, worse = 0, 0
    for seed in range(60):
        cycle = Cycle(sensor, 8, seed)
        again = cycle.between(1000 + seed)
        low, high = Calibration(cycle, 2), Calibration(cycle, 7)
        better += np.mean(high.residuals**2) < np.mean(low.residuals**2)
        worse += np.mean(high.checked(again) ** 2) > np.mean(low.checked(again) ** 2)
    assert better == 60  # least squares over more functions can only be better at its own points
    assert worse > 50


def test_a_drift_of_the_offset_comes_back_as_an_error():
    cycle = Cycle(Sensor(gain=0.25), 11)
    fitted = Calibration(cycle, 1)
    np.testing.assert_allclose(fitted.checked(cycle, 0.05), 0.05 / 1.25, rtol=0, atol=1e-12)


def test_the_same_seed_makes_the_same_noise():
    noisy = Sensor(noise=0.01)
    np.testing.assert_array_equal(Cycle(noisy, 20, 4).outputs, Cycle(noisy, 20, 4).outputs)
    assert not np.allclose(Cycle(noisy, 20, 4).outputs, Cycle(noisy, 20, 5).outputs)
    inputs = Cycle(noisy, 5).between(0).inputs
    np.testing.assert_allclose(inputs[:4], [0.125, 0.375, 0.625, 0.875], rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: Sensor(hysteresis=-0.1), r"hysteresis: expected no negative number, got -0.1"),
        (lambda: Sensor(gain=math.nan), r"gain: expected a finite number, got nan"),
        (lambda: Sensor(shape="bow"), r"shape: unknown name 'bow'"),
        (lambda: Cycle(Sensor(), 1), r"points: expected a whole number, at least 2, got 1"),
        (lambda: Cycle(Sensor(), 10**9), r"points: expected at most 400, got 1000000000"),
        (lambda: Calibration(Cycle(Sensor(), 5), 5), r"degree: expected 1 to 4, with 5 points, got 5"),
        (lambda: Calibration(Cycle(Sensor(resolution=2.0), 5), 1), r"degree: 1 needs more outputs that differ"),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(make, text):
    with pytest.raises(InputError, match=text):
        make()
