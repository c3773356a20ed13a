"""Rotations and their representations, with the numbers of the notes."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from armlab.errors import InputError
from armlab.kin.euler import euler_angles
from armlab.kin.nearest import nearest_rotation
from armlab.kin.rotations import (
    as_rotation,
    axis_angle,
    euler_zyx,
    is_rotation,
    quaternion_from_rotation,
    rotation_about,
    rotation_from_axis_angle,
    rotation_from_quaternion,
    rotation_from_sequence,
    skew,
)
from armlab.kin.transforms import as_pose, inverse, transform
from support.arms import random_pose

APPENDIX = ["XYZ", "YXY", "YXZ", "YZY", "ZXY", "ZYX", "ZYZ", "XY", "XZ", "YZ", "ZX", "ZY"]


@pytest.mark.parametrize("axis", ["x", "y"])
def test_elementary_rotations_of_the_notes(truth, axis):
    case = truth[f"C3.1-R{axis}"]
    R = rotation_about(axis, case["inputs"]["theta"])
    np.testing.assert_allclose(R, case["expected"]["R"], rtol=0, atol=case["tol"])


@pytest.mark.parametrize("sequence", APPENDIX)
def test_products_of_the_appendix(truth, sequence):
    case = truth[f"CA-{sequence}"]
    angles = [case["inputs"][name] for name in ("alpha", "beta", "gamma") if name in case["inputs"]]
    R = rotation_from_sequence(case["inputs"]["seq"], angles)
    np.testing.assert_allclose(R, case["expected"]["R"], rtol=0, atol=case["tol"])


@pytest.mark.parametrize("axes", ["xyz", "zyx", "zxz", "yxy", "xzy"])
def test_sequences_agree_with_scipy(axes, rng):
    angles = rng.uniform(-3, 3, (20, 3))
    moving = rotation_from_sequence(axes, angles)
    np.testing.assert_allclose(moving, Rotation.from_euler(axes.upper(), angles).as_matrix(), atol=1e-14)
    fixed = rotation_from_sequence(axes, angles, fixed=True)
    np.testing.assert_allclose(fixed, Rotation.from_euler(axes, angles).as_matrix(), atol=1e-14)


def test_rodrigues_of_the_notes(truth):
    case = truth["C3.2-rodrigues"]
    R = rotation_from_axis_angle(case["inputs"]["r"], case["inputs"]["theta"])
    np.testing.assert_allclose(R, case["expected"]["R"], rtol=0, atol=case["tol"])
    assert np.trace(R) == pytest.approx(case["expected"]["trace"], abs=case["tol"])


def test_quaternion_of_the_notes(truth):
    case = truth["C3.2-quaternion"]
    R = rotation_from_axis_angle(case["inputs"]["r"], case["inputs"]["theta"])
    q = quaternion_from_rotation(R)
    np.testing.assert_allclose(q, [case["expected"]["eta"], *case["expected"]["eps"]], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(rotation_from_quaternion(q), case["expected"]["R"], rtol=0, atol=case["tol"])


@pytest.mark.parametrize("angle", [0.0, 1e-12, 1e-7, 1e-3, 1.0, 3.0, np.pi - 1e-3, np.pi - 1e-7, np.pi])
def test_axis_and_angle_come_back_at_every_angle(angle, rng):
    for _ in range(20):
        r = rng.normal(size=3)
        r /= np.linalg.norm(r)
        R = rotation_from_axis_angle(r, angle)
        axis, found = axis_angle(R)
        assert found == pytest.approx(angle, abs=1e-12)
        np.testing.assert_allclose(rotation_from_axis_angle(axis, found), R, rtol=0, atol=1e-12)
        if angle > 1e-3:
            sign = np.sign(axis @ r) if angle == np.pi else 1.0
            np.testing.assert_allclose(sign * axis, r, rtol=0, atol=1e-10)


def test_quaternions_come_back_for_half_turns_about_any_axis(rng):
    """Where the signs of equations 3.77 to 3.79 are all zero."""
    r = rng.normal(size=(200, 3))
    r /= np.linalg.norm(r, axis=1)[:, None]
    R = 2.0 * r[:, :, None] * r[:, None, :] - np.eye(3)
    np.testing.assert_allclose(rotation_from_quaternion(quaternion_from_rotation(R)), R, rtol=0, atol=1e-14)


def test_quaternions_are_unit_and_scalar_first_and_not_negative(rng):
    R = np.array([random_pose(rng)[:3, :3] for _ in range(200)])
    q = quaternion_from_rotation(R)
    np.testing.assert_allclose(np.linalg.norm(q, axis=1), 1.0, atol=1e-15)
    assert np.all(q[:, 0] >= 0.0)
    expected = Rotation.from_matrix(R).as_quat()[:, [3, 0, 1, 2]]
    np.testing.assert_allclose(np.abs(np.sum(q * expected, axis=1)), 1.0, atol=1e-14)


def test_one_rotation_is_as_many(rng):
    """One matrix goes a way of its own; signs of half turns included."""
    r = rng.normal(size=(200, 3))
    r /= np.linalg.norm(r, axis=1)[:, None]
    half_turns = 2.0 * r[:, :, None] * r[:, None, :] - np.eye(3)
    exact = [np.eye(3), *(np.diag(signs) for signs in ([1.0, -1, -1], [-1.0, 1, -1], [-1.0, -1, 1]))]
    R = np.array([*half_turns, *(random_pose(rng)[:3, :3] for _ in range(200)), *exact])
    np.testing.assert_allclose([quaternion_from_rotation(each) for each in R], quaternion_from_rotation(R), atol=1e-15)


def test_yaw_pitch_roll_come_back(rng):
    angles = rng.uniform(-1.5, 1.5, (200, 3))
    found, singular = euler_zyx(rotation_from_sequence("zyx", angles))
    np.testing.assert_allclose(found, angles, rtol=0, atol=1e-12)
    assert not singular.any()


@pytest.mark.parametrize("pitch", [np.pi / 2, -np.pi / 2])
def test_yaw_pitch_roll_at_the_singularity_give_the_same_rotation(pitch):
    R = rotation_from_sequence("zyx", [0.7, pitch, 0.3])
    angles, singular = euler_zyx(R)
    assert singular
    assert angles[2] == 0.0
    np.testing.assert_allclose(rotation_from_sequence("zyx", angles), R, rtol=0, atol=1e-12)


def test_skew_is_the_cross_product(rng):
    v, u = rng.normal(size=(2, 50, 3))
    np.testing.assert_allclose((skew(v) @ u[..., None])[..., 0], np.cross(v, u), atol=1e-15)


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda: rotation_about("w", 1.0), "axis: expected 'x', 'y' or 'z', got 'w'"),
        (lambda: rotation_from_sequence("zyx", [1.0]), "angles: expected 3 for the sequence 'zyx'"),
        (lambda: rotation_from_sequence(None, [1.0]), "axes: expected letters of 'xyz', such as 'zyx', got None"),
        (lambda: rotation_from_sequence(["z", 3], [1.0, 2.0]), "axes: expected letters of 'xyz', .*, got \\['z', 3]"),
        (lambda: rotation_from_sequence("zay", [1.0] * 3), "axes: expected letters of 'xyz', .*, got 'zay'"),
        (lambda: is_rotation("Rz"), "R: expected a matrix of numbers, got 'Rz'"),
        (lambda: is_rotation([[1.0], [0.0, 1.0]]), "R: expected a matrix of numbers, got"),
        (lambda: rotation_from_axis_angle([0.0, 0.0, 0.0], 1.0), "axis: expected a finite vector that is not zero"),
        (lambda: rotation_from_quaternion([0.0] * 4), "q: expected a finite quaternion that is not zero"),
        (lambda: rotation_from_quaternion([1.0, 0.0, 0.0]), r"q: expected shape \(\.\.\., 4\), got \(3,\)"),
        (lambda: quaternion_from_rotation(np.eye(4)), r"R: expected shape \(\.\.\., 3, 3\)"),
    ],
)
def test_wrong_input_is_named(call, text):
    with pytest.raises(InputError, match=text):
        call()


def test_what_a_rotation_is():
    assert is_rotation(np.eye(3))
    assert not is_rotation(np.diag([1.0, 1.0, -1.0]))
    assert not is_rotation(1.001 * np.eye(3))
    assert not is_rotation(np.full((3, 3), np.nan))
    assert not is_rotation(np.eye(4))


@pytest.mark.parametrize("decimals", [3, 4, 5, 8])
def test_a_rounded_rotation_is_taken_as_the_nearest_one(decimals, rng):
    """An entry is off by half of the last digit, the nine together by three halves: the nearest is no farther."""
    for _ in range(200):
        R = rotation_from_quaternion(rng.normal(size=4))
        rounded = R.round(decimals)
        found = nearest_rotation(rounded)
        assert is_rotation(found.rotation, 1e-14)
        assert found.off <= 1.5 * 10.0**-decimals
        np.testing.assert_allclose(as_rotation(rounded), R, rtol=0, atol=3.0 * 10.0**-decimals)
        assert np.linalg.norm(rounded - found.rotation) <= np.linalg.norm(rounded - R) + 1e-15


def test_the_rounded_rotation_of_the_notes_is_taken():
    """0.866 for the cosine of 30 degrees: 3.127."""
    T = np.array([[0.866, -0.5, 0, 10], [0.5, 0.866, 0, 5], [0, 0, 1, 0], [0, 0, 0, 1]])
    pose = as_pose(T, "T")
    np.testing.assert_allclose(pose[:3, :3], rotation_about("z", np.radians(30)), rtol=0, atol=3e-5)
    np.testing.assert_array_equal(pose[:, 3], T[:, 3])


def test_the_nearest_rotation_is_one_for_any_matrix(rng):
    for _ in range(200):
        matrix = rng.normal(size=(3, 3)) * 10.0 ** rng.uniform(-200, 200)
        assert is_rotation(nearest_rotation(matrix).rotation, 1e-13)
    for matrix in (np.zeros((3, 3)), np.ones((3, 3)), np.diag([1.0, 1.0, 0.0]), -np.eye(3)):
        assert is_rotation(nearest_rotation(matrix).rotation, 1e-13)


def test_the_distance_to_the_nearest_rotation_is_the_least(rng):
    """Of many other rotations none is nearer."""
    others = rotation_from_quaternion(rng.normal(size=(2000, 4)))
    for _ in range(50):
        matrix = rng.normal(size=(3, 3))
        found = nearest_rotation(matrix)
        assert found.distance == pytest.approx(np.linalg.norm(matrix - found.rotation), rel=1e-14)
        assert found.distance <= np.linalg.norm(matrix - others, axis=(1, 2)).min()
        assert found.only


@pytest.mark.parametrize(
    ("matrix", "only"),
    [
        (np.eye(3), True),
        (np.diag([1.0, 1.0, 0.0]), True),
        (np.diag([3.0, 2.0, -1.0]), True),
        (np.diag([1.0, 0.0, 0.0]), False),
        (np.zeros((3, 3)), False),
        (-np.eye(3), False),
        (np.diag([1.0, 1.0, -1.0]), False),
    ],
)
def test_it_says_whether_another_rotation_is_as_near(matrix, only, rng):
    """A turn about the axis that is left open leads to another one at the same distance."""
    found = nearest_rotation(matrix)
    assert found.only == only
    turned = [rotation_about(axis, 0.7) @ found.rotation for axis in "xyz"]
    turned += [found.rotation @ rotation_about(axis, 0.7) for axis in "xyz"]
    assert any(np.linalg.norm(matrix - R) < found.distance + 1e-12 for R in turned) != only


CONVERTERS = [
    axis_angle,
    quaternion_from_rotation,
    euler_zyx,
    lambda R: euler_angles(R, "zxz"),
    lambda R: as_pose(np.block([[np.asarray(R), np.zeros((3, 1))], [np.zeros((1, 3)), np.eye(1)]]), "T"),
]


@pytest.mark.parametrize("convert", CONVERTERS)
@pytest.mark.parametrize(
    ("matrix", "text"),
    [
        (np.diag([1.0, 1.0, -1.0]), "is not a rotation matrix but a reflection: its determinant is -1, not"),
        (np.zeros((3, 3)), "is not a rotation matrix: the nearest one differs from it by 1 in an entry; up to 0.002"),
        (np.ones((3, 3)), "is not a rotation matrix: the nearest one differs from it by"),
        (1.003 * np.eye(3), "is not a rotation matrix: the nearest one differs from it by 0.003 in an entry"),
    ],
)
def test_what_is_no_rotation_is_refused_with_how_far_it_is_off(convert, matrix, text):
    with pytest.raises(InputError, match=text):
        convert(matrix)


@pytest.mark.parametrize("convert", CONVERTERS[:4])
def test_a_batch_names_the_matrix_that_is_no_rotation(convert):
    with pytest.raises(InputError, match=r"R\[1, 0\] is not a rotation matrix but a reflection"):
        convert([[np.eye(3), np.eye(3)], [-np.eye(3), np.eye(3)]])


def test_a_matrix_of_a_batch_that_is_not_finite_stays_so():
    found = quaternion_from_rotation([np.full((3, 3), np.nan), np.eye(3)])
    assert np.isnan(found[0]).all()
    assert found[1].tolist() == [1.0, 0.0, 0.0, 0.0]


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda: quaternion_from_rotation(np.eye(4)), r"R: expected shape \(\.\.\., 3, 3\), got \(4, 4\)"),
        (lambda: axis_angle("R"), "R: expected 3 x 3 matrices of numbers, got 'R'"),
        (lambda: euler_zyx(np.eye(3) * 1j), "R: expected 3 x 3 matrices of numbers"),
        (lambda: axis_angle(np.full((3, 3), np.nan)), "R: every entry must be finite"),
        (lambda: rotation_from_axis_angle([1.0, 0.0], 0.1), r"axis: expected shape \(\.\.\., 3\), got \(2,\)"),
        (lambda: rotation_from_axis_angle([[1.0], [0.0, 1.0]], 0.1), "axis: expected numbers"),
        (lambda: rotation_about("z", "a"), "angle: expected numbers, got 'a'"),
        (lambda: rotation_about(["z"], 0.1), r"axis: expected 'x', 'y' or 'z', got \['z'\]"),
        (lambda: rotation_from_quaternion("wxyz"), r"q: expected numbers of shape \(\.\.\., 4\), got 'wxyz'"),
        (lambda: skew([1.0, 2.0]), r"v: expected shape \(\.\.\., 3\), got \(2,\)"),
        (lambda: transform(np.eye(4)), "expected a rotation"),
        (lambda: inverse(np.eye(3)), r"T: expected shape \(\.\.\., 4, 4\), got \(3, 3\)"),
        (lambda: nearest_rotation(np.eye(2)), r"R: expected shape \(3, 3\), got \(2, 2\)"),
    ],
)
def test_wrong_arguments_are_named(call, text):
    with pytest.raises(InputError, match=text):
        call()
