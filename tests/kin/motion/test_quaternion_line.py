"""A straight line between quaternions: its ends, its axis, its speed, against slerp and numeric derivatives."""

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.motion.orientation import about_one_axis, swept, wandering
from armlab.kin.motion.quaternion_line import along_line
from armlab.kin.quaternions import exponential, slerp, unit
from armlab.kin.rotations import rotation_from_quaternion
from armlab.kin.velocity.rigid import angular_velocity

ONE = np.array([1.0, 0.0, 0.0, 0.0])


def turn(degrees, axis=(0.0, 0.0, 1.0)):
    half = 0.5 * np.radians(degrees) * np.array(axis) / np.linalg.norm(axis)
    return exponential([0.0, *half])


def test_it_begins_and_ends_where_it_should_and_has_the_middle_of_slerp(rng):
    for p, q in rng.normal(size=(50, 2, 4)):
        line = along_line(p, q)
        for s, end in ((0.0, p), (1.0, q)):
            assert abs(line.quaternion(s) @ unit(end)) == pytest.approx(1.0, abs=1e-14)
        np.testing.assert_allclose(line.quaternion(0.5), slerp(p, q, 0.5), rtol=0, atol=1e-12)


@pytest.mark.parametrize("shorter", [True, False])
def test_it_takes_the_way_of_slerp_at_another_pace(rng, shorter):
    for p, q in rng.normal(size=(20, 2, 4)):
        line = along_line(p, q, shorter=shorter)
        way = slerp(p, q, np.linspace(0.0, 1.0, 2001), shorter=shorter)
        for each in line.quaternion(np.array([0.2, 0.6, 0.9])):
            assert np.abs(way @ each).max() > 1.0 - 1e-6


def test_omega_and_its_derivative_are_those_of_the_rotation(rng):
    h = 1e-5
    for p, q in rng.normal(size=(20, 2, 4)):
        line = along_line(p, q)
        for s in (0.0, 0.3, 1.0):
            omega, change = line.angular(s)
            Rdot = (line.rotation(s + h) - line.rotation(s - h)) / (2.0 * h)
            np.testing.assert_allclose(omega, angular_velocity(line.rotation(s), Rdot), rtol=0, atol=1e-7)
            numeric = (line.angular(s + h)[0] - line.angular(s - h)[0]) / (2.0 * h)
            np.testing.assert_allclose(change, numeric, rtol=0, atol=1e-6)


def test_it_is_faster_in_the_middle_and_as_short_as_about_one_axis():
    p, q = ONE, turn(170.0)
    line = along_line(p, q)
    speed = np.linalg.norm(line.angular(np.array([0.0, 0.5, 1.0]))[0], axis=-1)
    # tan of half the angle between the quaternions: 2 sin(85°) at the ends, 4 tan(42.5°) in the middle.
    np.testing.assert_allclose(speed, [2 * np.sin(np.radians(85)), 4 * np.tan(np.radians(42.5)), speed[0]], rtol=1e-12)
    assert swept(line) == pytest.approx(np.radians(170.0), rel=1e-9)
    one = about_one_axis(np.eye(3), rotation_from_quaternion(q))
    s, h = np.linspace(0.0, 1.0, 2001), np.radians(85.0)
    ahead = 2.0 * np.arctan2(s * np.sin(h), 1.0 - s + s * np.cos(h)) - 2.0 * h * s
    assert wandering(line, one) == pytest.approx(np.abs(ahead).max(), abs=1e-5)


def test_the_other_way_round_and_half_a_turn():
    assert swept(along_line(ONE, turn(100.0), shorter=False)) == pytest.approx(np.radians(100.0))
    assert swept(along_line(ONE, -turn(100.0), shorter=False)) == pytest.approx(np.radians(260.0))
    assert swept(along_line(ONE, -turn(100.0))) == pytest.approx(np.radians(100.0))
    assert "either way is as short" in along_line(ONE, turn(180.0)).remarks[0]
    assert along_line(ONE, turn(179.0)).remarks == ()


def test_what_has_no_line_is_refused():
    with pytest.raises(InputError, match="leads through zero"):
        along_line(ONE, -ONE, shorter=False)
    assert swept(along_line(ONE, -ONE)) == 0.0
    with pytest.raises(InputError, match="one quaternion each"):
        along_line(np.ones((2, 4)), ONE)
    with pytest.raises(InputError, match="not zero"):
        along_line(np.zeros(4), ONE)
