"""Rows and link transforms."""

import numpy as np
import pytest

from armlab.errors import InputError, UnknownName
from armlab.kin.dh import Row, link_transform, row_of
from armlab.kin.rotations import rotation_about, rotation_from_axis_angle
from armlab.kin.transforms import as_pose, inverse, transform
from support.arms import random_pose


def rz(t):
    return transform(rotation_about("z", t))


def rx(t):
    return transform(rotation_about("x", t))


def test_the_matrix_of_the_notes(truth):
    case = truth["C4.1-dh-matrix"]
    np.testing.assert_allclose(link_transform(**case["inputs"]), case["expected"]["A"], rtol=0, atol=case["tol"])


def test_both_conventions_are_their_four_moves_in_order(rng):
    a, alpha, d, theta = rng.uniform(-1, 1, 4)
    tz, tx = transform(position=[0, 0, d]), transform(position=[a, 0, 0])
    standard = rz(theta) @ tz @ tx @ rx(alpha)
    np.testing.assert_allclose(link_transform(a, alpha, d, theta), standard, atol=1e-15)
    modified = rx(alpha) @ tx @ rz(theta) @ tz
    np.testing.assert_allclose(link_transform(a, alpha, d, theta, "modified"), modified, atol=1e-15)


def test_link_transforms_broadcast(rng):
    theta = rng.uniform(-3, 3, (4, 5))
    A = link_transform(0.3, 0.2, 0.1, theta)
    assert A.shape == (4, 5, 4, 4)
    np.testing.assert_array_equal(A[2, 3], link_transform(0.3, 0.2, 0.1, theta[2, 3]))


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: link_transform([1.0, 2.0], [0.0] * 3, 0.0, 0.0), r"a, alpha, d, theta: .*\(2,\), \(3,\), \(\), \(\)"),
        (lambda: transform(np.ones((2, 3, 3)), np.ones((3, 3))), "rotation, position: expected as many of each"),
        (lambda: rotation_from_axis_angle(np.ones((2, 3)), np.ones(3)), "axis, angle: expected as many of each"),
    ],
)
def test_shapes_that_do_not_fit_are_told(call, words):
    with pytest.raises(InputError, match=words):
        call()


def test_a_row_can_be_written_in_three_ways():
    row = Row("P", 0.1, 0.2, 0.3, 0.4)
    assert row_of(("P", 0.1, 0.2, 0.3, 0.4)) == row
    assert row_of({"kind": "P", "theta": 0.4, "a": 0.1, "d": 0.3, "alpha": 0.2}) == row
    assert row_of(row) == row


@pytest.mark.parametrize(
    ("entry", "text"),
    [
        (("X", 0, 0, 0, 0), "row 2: the joint type must be 'R' .* or 'P' .*, got 'X'"),
        (("R", 0, 0, 0), "row 2: expected 5 entries .*, got 4"),
        (("R", 0, float("nan"), 0, 0), "row 2, alpha: expected a finite number, got nan"),
        (("R", "1", 0, 0, 0), "row 2, a: expected a number, got '1'"),
        ({"kind": "R", "alfa": 1.0}, "row 2: unknown name 'alfa'; did you mean 'alpha'"),
        ({"a": 1.0}, "row 2: the joint type must be"),
        ((np.array(["R", "P"]), 0, 0, 0, 0), "row 2: the joint type must be .*, got array"),
    ],
)
def test_a_wrong_row_is_named(entry, text):
    with pytest.raises(InputError, match=text):
        row_of(entry, "row 2")


def test_an_unknown_convention_lists_the_two():
    with pytest.raises(UnknownName, match="Available: modified, standard"):
        link_transform(0, 0, 0, 0, "craig")


def test_the_inverse_undoes(rng):
    T = np.array([random_pose(rng) for _ in range(20)])
    np.testing.assert_allclose(inverse(T) @ T, np.broadcast_to(np.eye(4), T.shape), atol=1e-15)


@pytest.mark.parametrize(
    ("matrix", "text"),
    [
        (np.eye(3), r"base: expected shape \(4, 4\), got \(3, 3\)"),
        (np.full((4, 4), np.nan), "base: every entry must be finite"),
        (np.diag([1.0, 1.0, 1.0, 2.0]), "base: the last row must be 0 0 0 1"),
        (np.diag([2.0, 1.0, 1.0, 1.0]), "base: .* is not a rotation matrix"),
        ("four", "base: expected a 4 x 4 matrix of numbers"),
    ],
)
def test_what_is_no_pose_is_named(matrix, text):
    with pytest.raises(InputError, match=text):
        as_pose(matrix, "base")
