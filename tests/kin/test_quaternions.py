"""Algebra of quaternions with SciPy as judge: random rotations, none, half turns, tiny ones, and batches of them."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from armlab.errors import InputError
from armlab.kin.quaternions import conjugate, exponential, inverse, logarithm, product, slerp, unit
from armlab.kin.rotations import (
    axis_angle,
    quaternion_from_rotation,
    rotation_from_axis_angle,
    rotation_from_quaternion,
)

SPECIAL = (0.0, 1e-300, 1e-12, 1e-8, 1e-4, 1.0, np.pi - 1e-8, np.pi - 1e-14, np.pi)
"""Angles of rotations, radians: none, tiny ones, and up to half a turn."""


def judge(q):
    """Return the rotation of SciPy, whose quaternions have the scalar last."""
    return Rotation.from_quat(np.roll(q, -1, axis=-1))


def some(rng, count=200):
    """Return unit quaternions (count, 4): random ones, and each special angle about random and coordinate axes."""
    axes = np.concatenate([np.eye(3), -np.eye(3), rng.normal(size=(6, 3))])
    half = 0.5 * np.repeat(SPECIAL, len(axes))[:, None]
    axes = np.tile(axes / np.linalg.norm(axes, axis=1, keepdims=True), (len(SPECIAL), 1))
    return np.concatenate([unit(rng.normal(size=(count, 4))), np.hstack([np.cos(half), np.sin(half) * axes])])


def test_a_product_is_the_rotations_one_after_the_other(rng):
    p, q = some(rng), some(rng)[::-1]
    np.testing.assert_allclose(judge(product(p, q)).as_matrix(), (judge(p) * judge(q)).as_matrix(), rtol=0, atol=1e-14)
    np.testing.assert_allclose(
        rotation_from_quaternion(product(p, q)), rotation_from_quaternion(p) @ rotation_from_quaternion(q), atol=1e-14
    )


def test_hamiltons_units():
    one, i, j, k = np.eye(4)
    for a, b, c in ((i, j, k), (j, k, i), (k, i, j)):
        np.testing.assert_array_equal(product(a, b), c)
        np.testing.assert_array_equal(product(b, a), -c)
        np.testing.assert_array_equal(product(a, a), -one)


def test_the_inverse_undoes_from_both_sides(rng):
    q = some(rng) * rng.uniform(0.01, 100.0, (len(some(rng)), 1))
    for found in (product(q, inverse(q)), product(inverse(q), q)):
        np.testing.assert_allclose(found, np.broadcast_to([1.0, 0, 0, 0], q.shape), rtol=0, atol=1e-14)
    units = some(rng)
    np.testing.assert_allclose(inverse(units), conjugate(units), rtol=0, atol=1e-15)
    np.testing.assert_allclose(judge(inverse(units)).as_matrix(), judge(units).inv().as_matrix(), rtol=0, atol=1e-14)


@pytest.mark.parametrize("size", [1e-200, 1e200])
def test_very_small_and_large_ones_have_inverse_and_direction(size):
    q = size * np.array([1.0, -2.0, 3.0, 4.0])
    np.testing.assert_allclose(product(q, inverse(q)), [1, 0, 0, 0], rtol=0, atol=1e-14)
    np.testing.assert_allclose(unit(q), np.array([1, -2, 3, 4]) / np.sqrt(30), rtol=1e-14)


def test_the_logarithm_is_half_of_the_rotation_vector(rng):
    q = some(rng)
    found = logarithm(q)
    np.testing.assert_allclose(found[:, 0], 0.0, atol=1e-15)
    # SciPy takes the shorter turn of q and -q.
    near = np.where(q[:, :1] < 0.0, -q, q)
    np.testing.assert_allclose(2.0 * logarithm(near)[:, 1:], judge(near).as_rotvec(), rtol=0, atol=1e-12)
    np.testing.assert_allclose(exponential(found), q, rtol=0, atol=1e-14)


def test_tiny_and_half_turns_keep_their_digits():
    for angle in SPECIAL[1:]:
        q = exponential(0.5 * angle * np.array([0.0, 0.6, 0.0, 0.8]))
        v = 2.0 * logarithm(q)[1:]
        assert math.hypot(*v) == pytest.approx(angle, rel=4e-16, abs=0.0)
        np.testing.assert_allclose(v / angle, [0.6, 0, 0.8], rtol=0, atol=4e-16)


def test_the_exponential_is_that_of_the_matrix_and_has_a_size(rng):
    v = np.concatenate([np.zeros((1, 3)), 1e-9 * rng.normal(size=(3, 3)), 3.0 * rng.normal(size=(50, 3))])
    pure = np.hstack([np.zeros((len(v), 1)), v])
    np.testing.assert_allclose(
        rotation_from_quaternion(exponential(pure)), Rotation.from_rotvec(2.0 * v).as_matrix(), rtol=0, atol=1e-14
    )
    q = rng.normal(size=(50, 4))
    np.testing.assert_allclose(exponential(logarithm(q)), q, rtol=0, atol=1e-14)
    np.testing.assert_allclose(logarithm(q)[:, 0], np.log(np.linalg.norm(q, axis=1)), rtol=0, atol=1e-14)


def test_negative_numbers_have_a_logarithm_about_z():
    np.testing.assert_allclose(logarithm([-1.0, 0, 0, 0]), [0, 0, 0, np.pi], rtol=0, atol=0)
    np.testing.assert_allclose(exponential([0, 0, 0, np.pi]), [-1, 0, 0, 0], rtol=0, atol=1e-15)


def test_the_way_between_two_is_that_of_scipy(rng):
    starts, ends, s = some(rng), some(rng)[::-1], np.linspace(0.0, 1.0, 7)
    found = slerp(starts[:, None], ends[:, None], s)
    assert found.shape == (len(starts), 7, 4)
    for p, q, way in zip(starts, ends, found, strict=True):
        expected = Slerp([0.0, 1.0], judge(np.array([p, q])))(s).as_matrix()
        if (judge(p).inv() * judge(q)).magnitude() < np.pi - 1e-6:  # half a turn goes either way
            np.testing.assert_allclose(judge(way).as_matrix(), expected, rtol=0, atol=1e-9)
        np.testing.assert_allclose(judge(way[[0, -1]]).as_matrix(), expected[[0, -1]], rtol=0, atol=1e-12)


def test_the_long_way_goes_through_what_the_short_one_leaves_out():
    p, q = [1.0, 0, 0, 0], exponential([0, 0, 0, np.radians(100.0)])  # 200 degrees about z
    short, long = slerp(p, q, 0.5), slerp(p, q, 0.5, shorter=False)
    np.testing.assert_allclose(rotation_from_quaternion(short), rotation_from_axis_angle([0, 0, 1], np.radians(-80.0)))
    np.testing.assert_allclose(rotation_from_quaternion(long), rotation_from_axis_angle([0, 0, 1], np.radians(100.0)))
    np.testing.assert_allclose(slerp(p, q, 1.0, shorter=False), q, rtol=0, atol=1e-15)


def test_the_double_cover():
    """A whole turn changes the sign, two do not."""
    turn = exponential([0.0, 0.0, 0.0, np.pi])
    np.testing.assert_allclose(turn, [-1, 0, 0, 0], rtol=0, atol=1e-15)
    np.testing.assert_allclose(product(turn, turn), [1, 0, 0, 0], rtol=0, atol=1e-15)
    np.testing.assert_allclose(rotation_from_quaternion(turn), np.eye(3), rtol=0, atol=1e-15)


def test_it_agrees_with_axis_and_angle(rng):
    q = some(rng)
    axis, angle = axis_angle(rotation_from_quaternion(q))
    again = exponential(np.concatenate([np.zeros((len(q), 1)), 0.5 * angle[:, None] * axis], axis=1))
    signs = quaternion_from_rotation(rotation_from_quaternion(q))
    np.testing.assert_allclose(again, signs, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: inverse([0.0, 0, 0, 0]), "q: expected a finite quaternion that is not zero"),
        (lambda: unit([np.nan, 0, 0, 1]), "q: expected a finite quaternion that is not zero"),
        (lambda: logarithm([[1.0, 0, 0, 0], [0, 0, 0, 0]]), "q: expected a finite quaternion that is not zero"),
        (lambda: product([1.0, 0, 0], [1.0, 0, 0, 0]), r"p: expected shape \(..., 4\), got \(3,\)"),
        (lambda: slerp([1.0, 0, 0, 0], [0.0, 0, 0, 0], 0.5), "q: expected a finite quaternion"),
        (lambda: exponential("axis"), "q: expected numbers"),
    ],
)
def test_what_is_none_is_refused_in_words(call, told):
    with pytest.raises(InputError, match=told):
        call()


def test_another_library_agrees(rng):
    """Products, inverses, matrices and slerp of spatialmath, whose quaternions have the scalar first."""
    base = pytest.importorskip("spatialmath.base")
    p, q = unit(rng.normal(size=(2, 60, 4)))
    for one, other in zip(p, q, strict=True):
        np.testing.assert_allclose(product(one, other), base.qqmul(one, other), rtol=0, atol=1e-14)
        np.testing.assert_allclose(inverse(one), base.qconj(one), rtol=0, atol=1e-15)
        np.testing.assert_allclose(rotation_from_quaternion(one), base.q2r(one), rtol=0, atol=1e-14)
        for s in (0.0, 0.3, 1.0):
            expected = base.qslerp(one, other, s, shortest=True)
            assert abs(slerp(one, other, s) @ expected) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("near", [0.0, np.pi])
@pytest.mark.parametrize("away", [1e-8, 1e-9, 1e-12, 0.0])
def test_within_1e_8_of_no_turn_and_of_half_a_turn_all_is_exact(near, away, rng):
    angle = abs(near - away)
    axes = rng.normal(size=(40, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    q = exponential(np.hstack([np.zeros((40, 1)), 0.5 * angle * axes]))
    vector = 2.0 * logarithm(q)[:, 1:]
    np.testing.assert_allclose(np.linalg.norm(vector, axis=1), angle, rtol=0, atol=1e-15)
    R = Rotation.from_rotvec(angle * axes).as_matrix()
    np.testing.assert_allclose(rotation_from_quaternion(q), R, rtol=0, atol=1e-15)
    found = 2.0 * logarithm(quaternion_from_rotation(R))[:, 1:]
    same = np.minimum(np.abs(found - angle * axes).max(axis=1), np.abs(found + angle * axes).max(axis=1))
    assert (same if near else np.abs(found - angle * axes).max(axis=1)).max() < 1e-7
    half = 2.0 * logarithm(slerp([1.0, 0, 0, 0], q, 0.5))[:, 1:]
    if angle < np.pi:  # there both ways are as short
        np.testing.assert_allclose(half, 0.5 * angle * axes, rtol=0, atol=2e-15)


def test_between_a_quaternion_and_its_opposite_the_short_way_stands_still_and_the_long_one_is_a_whole_turn():
    p = unit([0.3, -0.5, 0.7, 0.2])
    np.testing.assert_allclose(slerp(p, -p, [0.0, 0.4, 1.0]), np.array([p, p, p]), rtol=0, atol=1e-15)
    long = slerp(p, -p, [0.0, 0.5, 1.0], shorter=False)
    np.testing.assert_allclose(long[2], -p, rtol=0, atol=1e-15)
    # About z of the body, which is taken where no axis is given: its logarithm is that of -1.
    np.testing.assert_allclose(long[1], product(p, [0.0, 0.0, 0.0, 1.0]), rtol=0, atol=1e-15)
