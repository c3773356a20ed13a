"""Screw motions: the exponential of a twist and its inverse, and what the screw of a transform is."""

import math

import numpy as np
import pytest
from scipy.linalg import expm

from armlab.errors import InputError
from armlab.kin.quaternions import slerp
from armlab.kin.rotations import quaternion_from_rotation, rotation_from_axis_angle, rotation_from_quaternion, skew
from armlab.kin.screw_motion import PLACED, STILL, exponential, logarithm, screw_motion
from armlab.kin.transforms import inverse, transform
from support.arms import random_pose

ANGLES = [0.0, 1e-12, 1e-8, 1e-4, 0.0999, 0.1001, 1.0, 3.0, math.pi - 1e-4, math.pi - 1e-9, math.pi]
"""Angles, radians: no turn, near none, both sides of the change to the series, and near half a turn."""


def bracket(twist):
    """Return the 4 x 4 matrix of a twist, whose matrix exponential is the transform."""
    found = np.zeros((4, 4))
    found[:3, :3], found[:3, 3] = skew(twist[3:]), twist[:3]
    return found


def twists(rng, angle, count=6):
    for v, r in rng.normal(size=(count, 2, 3)):
        yield np.concatenate([v, angle * r / np.linalg.norm(r)])


@pytest.mark.parametrize("angle", ANGLES)
def test_the_exponential_is_that_of_the_matrix_of_the_twist(angle, rng):
    for twist in twists(rng, angle):
        np.testing.assert_allclose(exponential(twist), expm(bracket(twist)), rtol=0, atol=2e-14)


@pytest.mark.parametrize("angle", ANGLES)
def test_the_logarithm_leads_back(angle, rng):
    for twist in twists(rng, angle):
        T = exponential(twist)
        np.testing.assert_allclose(exponential(logarithm(T)), T, rtol=0, atol=1e-12)
        if angle < math.pi - 1e-6:
            np.testing.assert_allclose(logarithm(T), twist, rtol=0, atol=1e-10)


def test_many_twists_at_once_are_each_by_itself(rng):
    many = rng.normal(size=(2, 5, 6))
    T = exponential(many)
    assert T.shape == (2, 5, 4, 4)
    np.testing.assert_array_equal(T[1, 3], exponential(many[1, 3]))
    np.testing.assert_allclose(logarithm(T)[1, 3], logarithm(T[1, 3]), rtol=0, atol=1e-15)


def test_the_twists_of_the_robotics_toolbox_agree(rng):
    twist3 = pytest.importorskip("spatialmath").Twist3
    for twist in twists(rng, 1.3, 10):
        T = exponential(twist)
        unit, found = twist3(twist / 1.3), screw_motion(T)
        np.testing.assert_allclose(T, unit.exp(1.3).A, rtol=0, atol=1e-12)
        assert found.angle == pytest.approx(1.3, abs=1e-12)
        assert found.pitch == pytest.approx(unit.pitch, abs=1e-10)
        # Its pole is some point of the axis.
        np.testing.assert_allclose(found.foot(unit.pole), unit.pole, rtol=0, atol=1e-10)


@pytest.mark.parametrize("angle", [1e-3, 0.5, 2.0, math.pi - 1e-6])
@pytest.mark.parametrize("distance", [0.0, 0.7, -0.4])
def test_axis_point_angle_and_pitch_are_those_it_was_made_of(angle, distance, rng):
    for r, c in rng.normal(size=(8, 2, 3)):
        r /= np.linalg.norm(r)
        R = rotation_from_axis_angle(r, angle)
        T = transform(R, (np.eye(3) - R) @ c + distance * r)
        found = screw_motion(T)
        assert found.kind == ("screw" if distance else "rotation")
        np.testing.assert_allclose(found.direction, r, rtol=0, atol=1e-9)
        np.testing.assert_allclose(found.foot(c), c, rtol=0, atol=1e-9)
        assert found.point @ r == pytest.approx(0.0, abs=1e-9)
        assert found.angle == pytest.approx(angle, abs=1e-12)
        assert found.distance == pytest.approx(distance, abs=1e-9)
        assert found.pitch == pytest.approx(distance / angle, abs=1e-6)
        # The points of the axis move along it and not away from it.
        for s in (0.25, 1.0):
            moved = found.at(s) @ [*c, 1.0]
            np.testing.assert_allclose(moved[:3], c + s * distance * r, rtol=0, atol=1e-9)


def test_the_ways_from_one_pose_to_another_turn_alike_and_the_axis_is_carried_nowhere(rng):
    for _ in range(10):
        T1, T2 = random_pose(rng), random_pose(rng)
        found = screw_motion(T2 @ inverse(T1))
        np.testing.assert_allclose(found.at(0.0) @ T1, T1, rtol=0, atol=1e-12)
        np.testing.assert_allclose(found.at(1.0) @ T1, T2, rtol=0, atol=1e-10)
        q = [quaternion_from_rotation(T[:3, :3]) for T in (T1, T2)]
        for s in (0.3, 0.8):
            R = rotation_from_quaternion(slerp(*q, s))
            np.testing.assert_allclose((found.at(s) @ T1)[:3, :3], R, rtol=0, atol=1e-10)


def test_a_translation_and_nothing_at_all_are_said():
    shifted = screw_motion(transform(position=[0.0, 3.0, 4.0]))
    assert (shifted.kind, shifted.distance, shifted.angle) == ("translation", 5.0, 0.0)
    assert shifted.pitch == math.inf
    np.testing.assert_allclose(shifted.direction, [0.0, 0.6, 0.8], rtol=0, atol=1e-15)
    np.testing.assert_allclose(shifted.at(0.5)[:3, 3], [0.0, 1.5, 2.0], rtol=0, atol=1e-15)
    still = screw_motion(np.eye(4))
    assert (still.kind, still.distance, still.angle, still.pitch) == ("none", 0.0, 0.0, 0.0)
    np.testing.assert_array_equal(still.at(0.7), np.eye(4))


def test_what_is_below_the_thresholds_does_not_turn_or_move():
    less, more = (rotation_from_axis_angle([0, 0, 1], factor * STILL) for factor in (0.9, 1.1))
    assert screw_motion(transform(less)).kind == "none"
    assert screw_motion(transform(more)).kind == "rotation"
    assert screw_motion(transform(less, [1.0, 0.0, 0.0])).kind == "translation"
    assert screw_motion(transform(position=[0.9 * PLACED, 0.0, 0.0])).kind == "none"


def test_at_half_a_turn_the_opposite_axis_is_as_good():
    found = screw_motion(transform(np.diag([-1.0, -1.0, 1.0]), [2.0, 0.0, 0.5]))
    assert found.half_turn
    assert found.angle == pytest.approx(math.pi)
    np.testing.assert_allclose(found.point, [1.0, 0.0, 0.0], rtol=0, atol=1e-15)
    other = exponential(-found.twist + 2.0 * np.array([0.0, 0.0, found.distance, 0.0, 0.0, 0.0]))
    np.testing.assert_allclose(other, found.at(1.0), rtol=0, atol=1e-15)
    assert not screw_motion(transform(rotation_from_axis_angle([0, 0, 1], 3.0))).half_turn


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: exponential([1.0, 2.0, 3.0]), r"twist: expected shape \(\.\.\., 6\), got \(3,\)"),
        (lambda: exponential([math.nan] * 6), "twist: every number must be finite"),
        (lambda: logarithm(np.eye(3)), r"T: expected shape \(\.\.\., 4, 4\), got \(3, 3\)"),
        (lambda: screw_motion(2.0 * np.eye(4), "pose 2"), "pose 2: the last row must be 0 0 0 1"),
        (lambda: screw_motion(np.diag([1.0, 1.0, -1.0, 1.0])), "not a rotation matrix but a reflection"),
    ],
)
def test_what_is_no_motion_is_refused_in_words(call, told):
    with pytest.raises(InputError, match=told):
        call()
