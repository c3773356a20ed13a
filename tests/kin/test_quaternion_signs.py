"""The quaternion by roots and signs: right where it should be, and wrong where the errata say so."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from armlab.errors import InputError
from armlab.kin.quaternion_signs import matrix_of_quaternion, quaternion_by_signs
from armlab.kin.rotations import quaternion_from_rotation, rotation_from_axis_angle, rotation_from_quaternion


def off(q, R):
    return np.abs(matrix_of_quaternion(q) - R).max()


def test_away_from_half_a_turn_it_is_the_quaternion(rng):
    for R in Rotation.random(300, random_state=3).as_matrix():
        if np.trace(R) > -0.99:
            q = quaternion_by_signs(R)
            np.testing.assert_allclose(q, quaternion_from_rotation(R), rtol=0, atol=1e-7)
            np.testing.assert_allclose(matrix_of_quaternion(q), rotation_from_quaternion(q), rtol=0, atol=1e-7)


def test_a_slip_in_an_index_makes_another_rotation(truth):
    """ERR-3.78: of 2000 rotations the largest difference of an entry is nearly 2."""
    Rs = Rotation.random(2000, random_state=1).as_matrix()
    worst = max(off(quaternion_by_signs(R, slip=True), R) for R in Rs)
    assert worst == pytest.approx(truth["ERR-3.78"]["printed_value_if_wrong"]["printed_residual"], abs=0.02)
    assert max(off(quaternion_by_signs(R), R) for R in Rs) < 1e-6


def test_at_half_a_turn_the_signs_are_zero_and_nothing_is_left_of_the_axis(truth):
    """ERR-3.77: r = (1, 2, 2)/3."""
    r = np.array([1.0, 2.0, 2.0]) / 3.0
    R = 2.0 * np.outer(r, r) - np.eye(3)
    q = quaternion_by_signs(R)
    np.testing.assert_allclose(q, 0.0, rtol=0, atol=1e-7)
    # The errata take the spectral norm of the difference.
    residual = np.linalg.norm(matrix_of_quaternion(q) - R, 2)
    assert residual == pytest.approx(truth["ERR-3.77"]["printed_value_if_wrong"]["printed_residual"], abs=1e-6)
    assert off(quaternion_from_rotation(R), R) < 1e-15


def test_near_half_a_turn_the_signs_still_hold_but_a_millionth_of_the_digits_is_lost():
    for away in (1e-3, 1e-5):
        R = rotation_from_axis_angle([1, 2, 2], np.pi - away)
        assert off(quaternion_by_signs(R), R) < 1e-9
        assert off(quaternion_from_rotation(R), R) < 1e-15


def test_what_is_no_matrix_is_refused():
    with pytest.raises(InputError, match="R: expected 3 rows of 3 finite numbers"):
        quaternion_by_signs(np.eye(4))
    with pytest.raises(InputError, match="q: expected 4 finite numbers"):
        matrix_of_quaternion([1, 0, 0])
