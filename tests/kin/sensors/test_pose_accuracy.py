"""AP and RP of ISO 9283: by hand, against the joints' spread to first order, and with backlash from either side."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.rotations import rotation_from_axis_angle
from armlab.kin.sensors.pose_accuracy import JointErrors, PoseFigures, attained, expected_spread, shares


def pose(x=0.0, y=0.0, z=0.0, axis=(0, 0, 1), angle=0.0):
    T = np.eye(4)
    T[:3, :3] = rotation_from_axis_angle(np.array(axis, dtype=float), angle)
    T[:3, 3] = x, y, z
    return T


def test_three_positions_by_hand():
    """Means (1, 0, 0), so AP = 1; l = 3, 0, 3, mean 2, S = sqrt(3), so RP = 2 + 3 sqrt(3)."""
    figures = PoseFigures(np.eye(4), np.stack([pose(1, 3), pose(1, 0), pose(1, -3)]))
    assert figures.position.accuracy == pytest.approx(1.0, abs=1e-12)
    np.testing.assert_allclose(figures.position.distances, [3, 0, 3], rtol=0, atol=1e-12)
    assert figures.position.mean_distance == pytest.approx(2.0, abs=1e-12)
    assert figures.position.deviation == pytest.approx(math.sqrt(3), abs=1e-12)
    assert figures.position.repeatability == pytest.approx(2 + 3 * math.sqrt(3), abs=1e-12)
    np.testing.assert_allclose(figures.turn_accuracy, 0.0, rtol=0, atol=1e-12)


def test_angles_are_figures_of_their_own():
    """About z by 1, 2 and 3 mrad: AP_c = 2 mrad, S = 1 mrad, RP_c = 3 mrad; the positions do not matter."""
    commanded = pose(5, 6, 7, (1, 2, 3), 0.8)
    turned = [pose(angle=angle) @ commanded for angle in (1e-3, 2e-3, 3e-3)]
    figures = PoseFigures(commanded, np.stack(turned))
    np.testing.assert_allclose(figures.turn_accuracy, [0, 0, 2e-3], rtol=0, atol=1e-9)
    np.testing.assert_allclose(figures.turn_repeatability, [0, 0, 3e-3], rtol=0, atol=1e-9)


def errors_of(arm, count=1e-4, backlash=0.0, zero=0.0):
    return JointErrors(*(np.full(arm.n, value) for value in (count, backlash, zero)))


@pytest.mark.parametrize("key", ["planar_2r", "puma560", "scara"])
def test_the_spread_of_the_tool_is_that_of_the_joints_through_the_jacobian(key):
    robot = catalogue()[key]
    arm, q = robot.arm, next(iter(robot.poses.values()))
    errors = errors_of(arm, 1e-4, 2e-4)
    for approach in ("same", "either"):
        stops, _ = attained(q, errors, 1000, approach, 5)
        np.testing.assert_allclose(stops.std(axis=0), errors.spread(approach), rtol=0.1)
        figures = PoseFigures(arm.fk(q), arm.fk(stops))
        rms = math.sqrt(float((figures.position.distances**2).mean()))
        assert rms == pytest.approx(expected_spread(arm, q, errors, approach), rel=0.1)
        parts = shares(arm, q, errors, approach)
        assert math.sqrt(float((parts**2).sum())) == pytest.approx(expected_spread(arm, q, errors, approach), rel=1e-9)


def test_backlash_is_accuracy_from_one_side_and_repeatability_from_either():
    """With a play of 1 mrad of the first joint: half of it off every time, or to one side or the other."""
    arm, q = catalogue()["planar_2r"].arm, [0.3, 0.4]
    reach = np.linalg.norm(arm.jacobian(q)[:3, 0])
    play = JointErrors(np.zeros(arm.n), np.array([1e-3, *[0.0] * (arm.n - 1)]), np.zeros(arm.n))
    same, _ = attained(q, play, 400, "same", 1)
    figures = PoseFigures(arm.fk(q), arm.fk(same))
    assert figures.position.accuracy == pytest.approx(0.5e-3 * reach, rel=1e-3)
    assert figures.position.repeatability == pytest.approx(0.0, abs=1e-12)
    either, below = attained(q, play, 400, "either", 1)
    assert 0.4 < below[:, 0].mean() < 0.6
    figures = PoseFigures(arm.fk(q), arm.fk(either))
    assert figures.position.accuracy < 0.1e-3 * reach
    assert figures.position.mean_distance == pytest.approx(0.5e-3 * reach, rel=0.02)


def test_the_error_of_the_zero_is_the_same_every_time():
    arm, q = catalogue()["planar_2r"].arm, np.array([0.3, 0.4])
    figures = PoseFigures(arm.fk(q), arm.fk(attained(q, errors_of(arm, 0.0, 0.0, 2e-3), 30)[0]))
    expected = np.linalg.norm(arm.position(q + 2e-3) - arm.position(q))
    assert figures.position.accuracy == pytest.approx(expected, abs=1e-12)
    assert figures.position.repeatability == pytest.approx(0.0, abs=1e-12)


def test_the_same_seed_moves_the_arm_to_the_same_places():
    arm = catalogue()["planar_2r"].arm
    one, two, other = (attained([0.1, 0.2], errors_of(arm), 30, "either", seed)[0] for seed in (3, 3, 4))
    np.testing.assert_array_equal(one, two)
    assert not np.allclose(one, other, rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda e: attained([0.1, 0.2], e, 1), r"times: expected a whole number, at least 2, got 1"),
        (lambda e: attained([0.1, 0.2], e, 10**9), r"times: expected at most 1000, got 1000000000"),
        (lambda e: attained([0.1, 0.2], e, 30, "left"), r"approach: unknown name 'left'"),
        (lambda e: PoseFigures(np.eye(4), np.eye(4)[None]), r"attained: expected at least two poses"),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(make, text):
    with pytest.raises(InputError, match=text):
        make(errors_of(catalogue()["planar_2r"].arm))
