"""Velocity ellipsoids and measures of manipulability."""

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ellipsoid import RANK_TOLERANCE, measures, singular_places, velocity_ellipsoid
from armlab.kin.rotations import rotation_about
from support.arms import random_q

SHAPES = [(1, 1), (1, 4), (2, 2), (2, 3), (3, 3), (3, 7), (2, 1), (3, 1), (3, 2)]


def planar(*lengths):
    return Arm.from_dh([("R", length, 0, 0, 0) for length in lengths], task="xy")


def elbow_for(r, l1, l2):
    """Return q2 > 0 at which the tip is at the distance r (law of cosines, notes 4.50)."""
    return np.arccos((r**2 - l1**2 - l2**2) / (2 * l1 * l2))


def test_the_singular_values_of_the_2r_in_the_notes(truth):
    case = truth["C5.3-sigma-2R"]
    l1, l2 = case["inputs"]["l1"], case["inputs"]["l2"]
    arm = planar(l1, l2)
    expected = case["expected"]
    for r, q2, sigma, w in zip(case["inputs"]["r"], expected["q2"], expected["sigma"], expected["w"], strict=True):
        assert elbow_for(r, l1, l2) == pytest.approx(q2, abs=case["tol"])
        q = [0.4, q2]
        assert np.linalg.norm(arm.position(q)) == pytest.approx(r, abs=case["tol"])
        J = arm.jacobian(q)[:2]
        found = velocity_ellipsoid(J)
        np.testing.assert_allclose(found.sigma, sigma, rtol=0, atol=case["tol"])
        assert found.w == pytest.approx(w, abs=case["tol"])
        assert found.condition == pytest.approx(sigma[0] / sigma[1], rel=1e-9)
        np.testing.assert_allclose(measures(J), [w, sigma[1] / sigma[0], sigma[1]], rtol=0, atol=case["tol"])


def test_the_2r_is_most_manipulable_at_the_root_of_two():
    r = np.linspace(0.01, 1.99, 19801)
    q2 = elbow_for(r, 1.0, 1.0)
    J = planar(1.0, 1.0).jacobian(np.stack([np.zeros_like(q2), q2], axis=-1))[:, :2]
    w = measures(J).w
    assert r[np.argmax(w)] == pytest.approx(np.sqrt(2), abs=1e-4)
    assert w.max() == pytest.approx(1.0, abs=1e-8)
    np.testing.assert_allclose(w, np.sin(q2), rtol=0, atol=1e-14)


@pytest.mark.parametrize("lengths", [(1.0, 1.0), (0.7, 0.4), (1.0, 1.0, 1.0), (0.5, 0.3, 0.2)])
def test_w_is_that_of_a_planar_arm(lengths, rng):
    arm = planar(*lengths)
    q = random_q(arm, rng, 100)
    expected = arm.manipulability(q)
    J = arm.jacobian(q)[:, :2]
    np.testing.assert_allclose(measures(J).w, expected, rtol=0, atol=1e-14)
    np.testing.assert_allclose([velocity_ellipsoid(block).w for block in J], expected, rtol=0, atol=1e-14)


def test_w_with_fewer_joints_than_rows_is_that_of_the_arm(rng):
    """Where the root of det(J J^T) is always zero (erratum 5.144)."""
    arm = Arm.from_dh([("R", 0, np.pi / 2, 0.3, 0), ("R", 0.6, 0, 0, 0)], task="xyz")
    for q in random_q(arm, rng, 20):
        J = arm.jacobian(q)[:3]
        found = velocity_ellipsoid(J)
        assert found.w == pytest.approx(float(arm.manipulability(q)), abs=1e-14)
        assert found.sigma.shape == (3,)
        assert found.sigma[2] == 0.0
        assert found.rank == 2
        assert np.isfinite(found.condition)
        assert abs(np.linalg.det(J @ J.T)) < 1e-15


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("scaled", [False, True])
def test_axes_half_axes_and_joint_directions_belong_together(shape, scaled, rng):
    m, n = shape
    for _ in range(20):
        J = rng.normal(size=shape)
        scale = rng.uniform(0.1, 3.0, n) if scaled else None
        block = J * scale if scaled else J
        found = velocity_ellipsoid(J, scale)
        k = min(m, n)
        assert found.axes.shape == (m, m)
        assert found.sigma.shape == (m,)
        assert found.joint_directions.shape == (n, k)
        np.testing.assert_allclose(found.axes.T @ found.axes, np.eye(m), rtol=0, atol=1e-14)
        np.testing.assert_allclose(found.joint_directions.T @ found.joint_directions, np.eye(k), rtol=0, atol=1e-14)
        assert np.all(np.diff(found.sigma) <= 0.0)
        # 5.152, sigma squared; and J v_i = sigma_i u_i.
        np.testing.assert_allclose(block @ block.T @ found.axes, found.axes * found.sigma**2, rtol=0, atol=1e-13)
        images = found.axes[:, :k] * found.sigma[:k]
        np.testing.assert_allclose(block @ found.joint_directions, images, rtol=0, atol=1e-13)
        assert found.rank == k
        largest = np.argmax(np.abs(found.axes), axis=0)
        assert np.all(found.axes[largest, np.arange(m)] > 0.0)


def test_the_half_axes_are_the_roots_of_the_eigenvalues(truth, rng):
    """Not the eigenvalues themselves, as the text after 5.152 has it."""
    assert "σ_i² is the eigenvalue" in truth["ERR-5.152"]["expected"]["correct"]
    J = rng.normal(size=(2, 3))
    eigenvalues = np.linalg.eigvalsh(J @ J.T)[::-1]
    np.testing.assert_allclose(velocity_ellipsoid(J).sigma, np.sqrt(eigenvalues), rtol=0, atol=1e-14)
    assert np.abs(velocity_ellipsoid(J).sigma - eigenvalues).max() > 0.01


def test_unit_joint_speeds_end_on_the_ellipsoid(rng):
    """v^T (J J^T)^-1 v = 1 (5.142), in the principal axes the sum of (v_i / sigma_i)^2."""
    J = rng.normal(size=(3, 3))
    found = velocity_ellipsoid(J)
    speeds = rng.normal(size=(3, 50))
    v = J @ (speeds / np.linalg.norm(speeds, axis=0))
    np.testing.assert_allclose(np.sum(v * np.linalg.solve(J @ J.T, v), axis=0), 1.0, rtol=0, atol=1e-10)
    np.testing.assert_allclose(np.sum((found.axes.T @ v / found.sigma[:, None]) ** 2, axis=0), 1.0, rtol=0, atol=1e-10)


@pytest.mark.parametrize("q2", [0.0, np.pi])
def test_a_stretched_or_folded_arm_is_singular(q2):
    J = planar(1.0, 0.6).jacobian([0.3, q2])[:2]
    found = velocity_ellipsoid(J)
    assert found.rank == 1
    assert found.condition == np.inf
    assert found.inverse_condition == 0.0
    assert found.sigma_min == pytest.approx(0.0, abs=1e-15)
    assert found.w == pytest.approx(0.0, abs=1e-15)
    # It moves across the arm and not along it; stretched or folded, the arm is along q1 = 0.3.
    np.testing.assert_allclose(np.abs(found.axes[:, 1]), [np.cos(0.3), np.sin(0.3)], rtol=0, atol=1e-15)
    np.testing.assert_allclose(measures(J), 0.0, rtol=0, atol=1e-15)


def test_the_rank_is_judged_relative_to_the_longest_half_axis():
    for size in (1e-6, 1.0, 1e6):
        assert velocity_ellipsoid(size * np.diag([1.0, 0.9 * RANK_TOLERANCE])).rank == 1
        above = velocity_ellipsoid(size * np.diag([1.0, 1.1 * RANK_TOLERANCE]))
        assert above.rank == 2
        assert above.condition == pytest.approx(1 / (1.1 * RANK_TOLERANCE))
        inverse = measures(size * np.array([np.diag([1.0, f * RANK_TOLERANCE]) for f in (0.9, 1.1)])).inverse_condition
        np.testing.assert_allclose(inverse, [0.0, 1.1 * RANK_TOLERANCE], rtol=1e-9, atol=0)


def test_no_motion_at_all():
    found = velocity_ellipsoid(np.zeros((2, 3)))
    assert found.rank == 0
    assert found.condition == np.inf
    assert (found.w, found.sigma_min, found.inverse_condition) == (0.0, 0.0, 0.0)
    assert measures(np.zeros((2, 3))) == (0.0, 0.0, 0.0)


def test_the_notes_isotropic_2r_is_a_circle():
    """l1 = sqrt 2 l2 and cos q2 = -1/sqrt 2 make both half axes l2."""
    J = planar(np.sqrt(2) * 0.4, 0.4).jacobian([0.9, 3 * np.pi / 4])[:2]
    found = velocity_ellipsoid(J)
    np.testing.assert_allclose(found.sigma, 0.4, rtol=0, atol=1e-15)
    assert found.inverse_condition == pytest.approx(1.0, abs=1e-14)


def test_signs_do_not_follow_rounding():
    """Axes at 45 degrees: both components are equal but for the last digit."""
    for angle in np.pi / 4 + np.array([-1e-15, -1e-16, 0.0, 1e-16, 1e-15]):
        R = rotation_about("z", angle)[:2, :2]
        axes = velocity_ellipsoid(R @ np.diag([2.0, 1.0]) @ R.T).axes
        np.testing.assert_allclose(axes, np.array([[1, 1], [1, -1]]) / np.sqrt(2), rtol=0, atol=1e-14)


def test_many_blocks_at_once_are_each_block(rng):
    for m, n in SHAPES:
        J = rng.normal(size=(4, 5, m, n))
        J[0, 0] = 0.0
        scale = rng.uniform(0.1, 2.0, n)
        found = measures(J, scale)
        for index in np.ndindex(4, 5):
            one = velocity_ellipsoid(J[index], scale)
            expected = [one.w, one.inverse_condition, one.sigma_min]
            np.testing.assert_allclose([value[index] for value in found], expected, rtol=1e-12, atol=1e-15)


def test_a_block_that_is_not_finite_gives_nan_and_leaves_the_others(rng):
    J = rng.normal(size=(3, 2, 3))
    J[1, 0, 2] = np.nan
    for value, expected in zip(measures(J), measures(J[[0, 2]]), strict=True):
        assert np.isnan(value[1])
        np.testing.assert_array_equal(value[[0, 2]], expected)


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda: velocity_ellipsoid(np.ones((6, 3))), r"J: expected one to three rows of one unit.*got \(6, 3\)"),
        (lambda: velocity_ellipsoid(np.ones(3)), r"J: expected one to three rows of one unit.*got \(3,\)"),
        (lambda: velocity_ellipsoid(np.ones((2, 2, 3))), r"J: expected shape \(m, n\), got \(2, 2, 3\)"),
        (lambda: velocity_ellipsoid([[np.nan, 1.0]]), "J: expected finite numbers, got"),
        (lambda: velocity_ellipsoid(np.ones((2, 3)), [1.0, 2.0]), "scale: expected 3 finite numbers, none negative"),
        (lambda: velocity_ellipsoid(np.ones((2, 1)), [-1.0]), "scale: expected 1 finite numbers, none negative"),
        (lambda: measures(np.ones((9, 2, 0))), r"J: expected one to three rows of one unit.*got \(9, 2, 0\)"),
        (lambda: measures(np.ones((2, 2)), [1.0, np.inf]), "scale: expected 2 finite numbers"),
    ],
)
def test_wrong_input_is_named(call, text):
    with pytest.raises(InputError, match=text):
        call()


def course(*zeros, floor=0.0):
    """Return a Jacobian diag(1, f) whose f has these zeros, and a least size otherwise."""

    def jacobian(values):
        product = np.prod([np.sin(0.5 * (values - zero)) for zero in zeros], axis=0)
        J = np.zeros((len(values), 2, 2))
        J[:, 0, 0], J[:, 1, 1] = 1.0, np.hypot(product, floor)
        return J

    return jacobian


@pytest.mark.parametrize(
    "zeros", [(0.3,), (-3.14, 3.14), (-3.139, 1.0, 1.02), (2.0, 2.03, 2.06), (0.5, 0.5), (3.1399999,), (-3.14, 0.1)]
)
def test_all_singular_places_are_found(zeros):
    found = singular_places(course(*zeros), -3.14, 3.14)
    np.testing.assert_allclose(found.places, sorted(set(zeros)), atol=2e-4 if zeros[0] == 0.5 else 2e-5)
    assert not found.everywhere


def test_random_singular_places_are_found(rng):
    for _ in range(100):
        zeros = np.sort(rng.uniform(-3.0, 3.0, rng.integers(1, 4)))
        if len(zeros) == 1 or np.diff(zeros).min() > 1e-2:
            np.testing.assert_allclose(singular_places(course(*zeros), -3.0, 3.0).places, zeros, atol=1e-5)


def test_what_only_comes_near_is_not_singular():
    found = singular_places(course(0.3, floor=1e-3), -3.14, 3.14)
    assert (found.places, found.everywhere) == ((), False)
    assert found.samples > 121


def test_what_is_singular_everywhere_has_no_places():
    assert singular_places(lambda values: np.zeros((len(values), 2, 2)), 0.0, 1.0).everywhere
    assert singular_places(course(0.3), 0.3, 0.3) == ((), True, 1)
    assert singular_places(course(0.3), 0.4, 0.4) == ((), False, 1)
