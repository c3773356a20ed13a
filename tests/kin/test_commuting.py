"""Two rotations in both orders: the angle between the ends against SciPy, small ones, and what is refused."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from armlab.errors import InputError
from armlab.kin.commuting import across, apart_by_order, beyond_first_order
from armlab.kin.rotations import skew


def ends(first, second, one, other):
    """Return R_b R_a and R_a R_b of SciPy."""
    a, b = (
        Rotation.from_rotvec(angle * np.array(axis) / np.linalg.norm(axis))
        for axis, angle in ((first, one), (second, other))
    )
    return b * a, a * b


def test_the_angle_between_the_ends_is_that_of_scipy(rng):
    first, second = rng.normal(size=(2, 300, 3))
    one, other = rng.uniform(-7.0, 7.0, size=(2, 300))
    found = apart_by_order(first, second, one, other)
    for k in range(300):
        R, Q = ends(first[k], second[k], one[k], other[k])
        assert found[k] == pytest.approx((R.inv() * Q).magnitude(), rel=0, abs=1e-7)


def test_by_hand():
    x, z = [1, 0, 0], [0, 0, 1]
    # One order permutes the axes, the other one as well: the permutations differ by a third of a turn.
    assert math.degrees(apart_by_order(x, z, math.pi / 2, math.pi / 2)) == pytest.approx(120.0, abs=1e-12)
    assert apart_by_order(x, z, math.pi, math.pi) == pytest.approx(0.0, abs=1e-15)
    assert apart_by_order([1, 2, 2], [2, 1, -2], math.pi, math.pi) == pytest.approx(0.0, abs=1e-14)
    assert apart_by_order(z, [0, 0, -3], 1.0, 2.0) == 0.0
    assert across([1, 1, 0], x) == pytest.approx(math.sqrt(0.5))


@pytest.mark.parametrize("size", [1e-2, 1e-4, 1e-7, 1e-10])
def test_it_falls_with_the_square_and_keeps_its_digits(size):
    assert apart_by_order([1, 0, 0], [0, 3, 4], size, size) == pytest.approx(size**2, rel=size**2)
    assert beyond_first_order([1, 0, 0], [0, 0, 1], size, size) == pytest.approx(size**2, rel=size**2 + 1e-15)


def test_what_is_left_of_first_order_is_that_of_the_matrices(rng, truth):
    first, second = rng.normal(size=(2, 50, 3))
    one, other = rng.uniform(-2.0, 2.0, size=(2, 50))
    found = beyond_first_order(first, second, one, other)
    for k in range(50):
        R, _ = ends(first[k], second[k], one[k], other[k])
        small = one[k] * first[k] / np.linalg.norm(first[k]) + other[k] * second[k] / np.linalg.norm(second[k])
        assert found[k] == pytest.approx(np.abs(R.as_matrix() - np.eye(3) - skew(small)).max(), abs=1e-13)
    case = truth["ERR-5.27"]["expected"]["corrected_residual"]
    assert beyond_first_order([1, 0, 0], [0, 0, 1], 1e-4, 1e-4) < 1.0 * case


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: apart_by_order([0, 0, 0], [1, 0, 0], 1.0, 1.0), "first: expected a finite axis that is not zero"),
        (lambda: apart_by_order([1, 0, 0], [1, 0], 1.0, 1.0), r"second: expected shape \(..., 3\), got \(2,\)"),
        (lambda: beyond_first_order([1, 0, 0], [0, np.nan, 0], 1.0, 1.0), "second: expected a finite axis"),
        (lambda: across("x", [1, 0, 0]), "first: expected numbers"),
    ],
)
def test_what_is_none_is_refused_in_words(call, told):
    with pytest.raises(InputError, match=told):
        call()
