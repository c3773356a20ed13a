"""Velocities of a rigid body, and rates of three angles."""

import itertools
import math

import numpy as np
import pytest

from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.euler import SEQUENCES
from armlab.kin.rotations import rotation_about, rotation_from_axis_angle, rotation_from_sequence, skew
from armlab.kin.velocity.rates import (
    angle_rates,
    columns_latex,
    lost_axis,
    rate_determinant,
    rate_matrix,
    singular_angles,
)
from armlab.kin.velocity.rigid import angular_velocity, point_velocity, rotation_rate, turned_by, twist_at

WAYS = [(axes, fixed) for axes in SEQUENCES for fixed in (False, True)]


def rate_by_differences(axes, fixed, angles, rates, h=1e-6):
    """Return the angular velocity from central differences of the rotation."""
    after, before = (rotation_from_sequence(axes, angles + sign * h * rates, fixed=fixed) for sign in (1, -1))
    return angular_velocity(rotation_from_sequence(axes, angles, fixed=fixed), (after - before) / (2 * h))


# -- rigid bodies ------------------------------------------------------------------------------------------------------


def test_two_points_of_the_notes(truth):
    case = truth["C1.2-rigid-velocity"]
    given = case["inputs"]
    found = point_velocity(given["v1"], given["omega"], given["r12"])
    np.testing.assert_allclose(found, case["expected"]["v2"], rtol=0, atol=case["tol"])


def test_velocities_are_those_of_a_moving_body(rng):
    h = 1e-6
    for _ in range(50):
        omega, v, first, second = rng.normal(size=(4, 3))
        moved = [
            (point + sign * h * v, rotation_from_axis_angle(omega, sign * h * np.linalg.norm(omega)))
            for sign in (1, -1)
            for point in (first,)
        ]
        ends = [p + R @ (second - first) for p, R in moved]
        by_differences = (ends[0] - ends[1]) / (2 * h)
        np.testing.assert_allclose(point_velocity(v, omega, second - first), by_differences, rtol=0, atol=1e-8)


def test_the_difference_is_across_the_line_between_the_points_and_a_way_and_back_is_none(rng):
    twists, r = rng.normal(size=(20, 6)), rng.normal(size=(20, 3))
    there = twist_at(twists, r)
    assert np.abs(np.sum((there - twists)[:, :3] * r, axis=1)).max() < 1e-13
    np.testing.assert_array_equal(there[:, 3:], twists[:, 3:])
    np.testing.assert_allclose(twist_at(there, -r), twists, rtol=0, atol=1e-13)


def test_one_twist_at_many_points():
    found = twist_at([1.0, 0.0, 0.0, 0.0, 0.0, 2.0], [[0.0, 1.0, 0.0], [0.0, 0.5, 0.0]])
    np.testing.assert_array_equal(found, [[-1, 0, 0, 0, 0, 2], [0, 0, 0, 0, 0, 2]])


def test_two_points_do_not_fix_omega(rng):
    """Erratum 5.8: omega + r23 gives the same difference of velocities."""
    omega, r23 = rng.normal(size=(2, 3))
    np.testing.assert_allclose(point_velocity(np.zeros(3), omega + r23, r23), np.cross(omega, r23), atol=1e-14)


def test_omega_and_rdot_are_each_others(rng):
    R = rotation_from_sequence("zyx", rng.uniform(-3, 3, (30, 3)))
    omega = rng.normal(size=(30, 3))
    Rdot = rotation_rate(R, omega)
    np.testing.assert_allclose(Rdot, skew(omega) @ R, rtol=0, atol=1e-15)
    np.testing.assert_allclose(angular_velocity(R, Rdot), omega, rtol=0, atol=1e-14)
    # What a numeric derivative has besides is left out.
    np.testing.assert_allclose(angular_velocity(R, Rdot + 0.1 * R), omega, rtol=0, atol=1e-14)


def test_equal_integrals_of_omega_and_different_rotations():
    """Notes 5.19-5.21: both integrals are (90, 0, 90) degrees."""
    quarter = math.pi / 2
    one, other = [[0, 0, quarter], [quarter, 0, 0]], [[quarter, 0, 0], [0, 0, quarter]]
    np.testing.assert_array_equal(np.sum(one, axis=0), np.sum(other, axis=0))
    np.testing.assert_allclose(turned_by(one, [1, 1]), [[0, -1, 0], [0, 0, -1], [1, 0, 0]], rtol=0, atol=1e-15)
    np.testing.assert_allclose(turned_by(other, [1, 1]), [[0, 0, 1], [1, 0, 0], [0, 1, 0]], rtol=0, atol=1e-15)


def test_pieces_of_constant_omega_are_what_small_steps_give(rng):
    rates, durations = rng.normal(size=(3, 3)), rng.uniform(0.2, 1.0, 3)
    R, steps = np.eye(3), 20000
    for omega, t in zip(rates, durations, strict=True):
        middle = np.eye(3) + skew(omega) * t / steps + 0.5 * (skew(omega) * t / steps) @ (skew(omega) * t / steps)
        R = np.linalg.matrix_power(middle, steps) @ R
    np.testing.assert_allclose(turned_by(rates, durations), R, rtol=0, atol=1e-7)
    np.testing.assert_array_equal(turned_by([[0, 0, 0]], [1.0]), np.eye(3))


def test_rotations_at_many_times_are_those_of_each_time(rng):
    rates = [*rng.normal(size=(3, 3)), [0, 0, 0]]
    durations = np.clip(rng.uniform(-0.5, 1.0, (4, 5, 4)), 0.0, None)
    together = turned_by(rates, durations)
    alone = [[turned_by(rates, one) for one in row] for row in durations]
    np.testing.assert_allclose(together, alone, rtol=0, atol=1e-15)
    np.testing.assert_array_equal(turned_by(rates, np.zeros((2, 4))), [np.eye(3)] * 2)


def test_finite_turns_do_not_commute_and_infinitesimal_ones_do():
    """Notes 5.18 and 5.22-5.27: six orders, not twelve; equal up to the square of the angles (erratum)."""
    x, z = rotation_about("x", math.pi / 2), rotation_about("z", math.pi / 2)
    assert np.abs(x @ z - z @ x).max() == pytest.approx(1.0)
    for size in (0.1, 0.01, 0.001):
        angles = size * np.array([1.0, 0.7, 0.5])
        turns = {axis: rotation_about(axis, angle) for axis, angle in zip("xyz", angles, strict=True)}
        products = [turns[a] @ turns[b] @ turns[c] for a, b, c in itertools.permutations("xyz")]
        assert len(products) == 6
        away = max(np.abs(product - np.eye(3) - skew(angles)).max() for product in products)
        assert 0.1 * size**2 < away < 1.5 * size**2


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: point_velocity([1, 2], [0, 0, 0], [0, 0, 0]), "v: expected shape"),
        (lambda: twist_at([0, 0, 0], [0, 0, 0]), "twist: expected shape"),
        (lambda: rotation_rate(np.eye(2), [0, 0, 0]), "R: expected shape"),
        (lambda: turned_by([[0, 0, 1]], [-1.0]), "durations: expected 1 numbers of seconds, none negative"),
        (lambda: turned_by([[0, 0, 1]], [1.0, 2.0]), "durations"),
    ],
)
def test_bad_input_says_where(call, told):
    with pytest.raises(InputError, match=told):
        call()


# -- rates of angles ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "axes", "fixed"), [("rpy-xyz", "xyz", True), ("euler-zxz", "zxz", False)])
def test_the_rate_matrices_of_the_notes(truth, name, axes, fixed):
    case = truth[f"C5.1-T-{name}"]
    angles, rates = (np.array(case["inputs"][key]) for key in ("angles", "rates"))
    expected, tol = case["expected"], case["tol"]
    T = rate_matrix(angles, axes, fixed)
    np.testing.assert_allclose(T, expected["T"], rtol=0, atol=tol)
    np.testing.assert_allclose(T @ rates, expected["omega"], rtol=0, atol=tol)
    if "det" in expected:
        assert float(rate_determinant(angles, axes, fixed)) == pytest.approx(expected["det"], abs=tol)
    else:
        assert abs(float(rate_determinant(angles, axes, fixed))) == pytest.approx(expected["det_abs"], abs=tol)


@pytest.mark.parametrize(("axes", "fixed"), WAYS)
def test_every_sequence_agrees_with_the_derivative_of_the_rotation(axes, fixed, rng):
    for _ in range(10):
        angles, rates = rng.uniform(-3, 3, 3), rng.normal(size=3)
        expected = rate_by_differences(axes, fixed, angles, rates)
        np.testing.assert_allclose(rate_matrix(angles, axes, fixed) @ rates, expected, rtol=0, atol=1e-8)


@pytest.mark.parametrize(("axes", "fixed"), WAYS)
def test_determinant_and_inverse(axes, fixed, rng):
    angles = rng.uniform(-3, 3, (40, 3))
    T = rate_matrix(angles, axes.upper(), fixed)
    np.testing.assert_allclose(rate_determinant(angles, axes, fixed), np.linalg.det(T), rtol=0, atol=1e-13)
    np.testing.assert_allclose(np.linalg.norm(T, axis=1), 1.0, rtol=0, atol=1e-14)
    omega = rng.normal(size=(40, 3))
    rates = angle_rates(omega, angles, axes, fixed)
    np.testing.assert_allclose((T @ rates[..., None])[..., 0], omega, rtol=0, atol=1e-9)


@pytest.mark.parametrize(("axes", "fixed"), WAYS)
def test_at_the_singular_angle_one_axis_is_lost_and_said(axes, fixed, rng):
    for middle in singular_angles(axes):
        angles = np.array([0.4, middle, -1.1])
        assert abs(float(rate_determinant(angles, axes, fixed))) < 1e-15
        lost = lost_axis(angles, axes, fixed)
        assert np.abs(lost @ rate_matrix(angles, axes, fixed)).max() < 1e-15
        assert np.linalg.norm(lost) == pytest.approx(1.0)
        with pytest.raises(InputError, match="first and the third axis are one line"):
            angle_rates([0, 0, 1], angles, axes, fixed)
        # Almost there the rates are large and still right.
        near = angles + np.array([0.0, 1e-5, 0.0])
        rates = angle_rates(lost, near, axes, fixed)
        assert 5e4 < np.abs(rates).max() < 2e5
        np.testing.assert_allclose(rate_matrix(near, axes, fixed) @ rates, lost, rtol=0, atol=1e-9)


def test_a_column_in_symbols_is_the_column(rng):
    """The LaTeX of the columns, read back as a product of turns."""
    angles = rng.uniform(-2, 2, 3)
    units = {axis: np.eye(3)[k] for k, axis in enumerate("xyz")}
    for axes, fixed in WAYS:
        names = (r"\psi", r"\theta", r"\varphi") if fixed and axes == "xyz" else (r"\varphi", r"\theta", r"\psi")
        for k, text in enumerate(columns_latex(axes, fixed)):
            vector = None
            for factor in reversed(text.split(r"\,")):
                if factor.startswith("e_"):
                    vector = units[factor[2]]
                else:
                    angle = angles[names.index(factor[4:-1])]
                    vector = rotation_about(factor[2], angle) @ vector
            np.testing.assert_allclose(vector, rate_matrix(angles, axes, fixed)[:, k], rtol=0, atol=1e-14)


def test_unknown_sequences_and_shapes_are_named():
    with pytest.raises(UnknownName, match="zzx"):
        rate_matrix([0, 0, 0], "zzx")
    with pytest.raises(InputError, match="angles: expected shape"):
        rate_matrix([0, 0], "zyx")
    with pytest.raises(InputError, match="omega: expected shape"):
        angle_rates([0, 0], [0, 1, 0], "zyx")


# -- the kernel of the spatial 3R --------------------------------------------------------------------------------------


def test_joint_1_does_not_move_a_tool_on_its_axis(truth):
    """Notes 1.25-1.26: a2 c2 + a3 c23 = 0 puts the tool on z0, and e1 is in the kernel of J_L."""
    rows = truth["DH-3R-elbow"]["inputs"]["rows"]
    arm = Arm.from_dh([tuple(row) for row in rows], task="xyz")
    a2, a3 = rows[1][1], rows[2][1]
    for q3 in (-2.5, -1.0, 0.3, 2.0):
        q2 = math.atan2(a2 + a3 * math.cos(q3), a3 * math.sin(q3))
        J = arm.jacobian([0.7, q2, q3])
        assert np.abs(J[:3, 0]).max() < 1e-15
        np.testing.assert_allclose(J[3:, 0], [0, 0, 1], rtol=0, atol=1e-15)
        assert np.linalg.matrix_rank(J[:3], tol=1e-9) == 2
    assert np.linalg.norm(arm.jacobian([0.7, 0.4, -0.9])[:3, 0]) > 0.5
