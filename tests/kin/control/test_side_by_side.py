"""Five inverses beside each other: by hand, against each other on random matrices, and at singularities."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.control.rate_inverse import rate_inverses
from armlab.kin.control.scaled_task import ScaledTask
from armlab.kin.control.side_by_side import METHODS, side_by_side

OPTIONS = {"dls_constant": {"lambda": 0.01}, "dls_variable": {"lambda_max": 0.01, "epsilon": 0.2}}


def by_key(J, v, **options):
    return {each.key: each for each in side_by_side(J, v, {**OPTIONS, **options})}


def test_a_diagonal_matrix_by_hand():
    """J = diag(1, 0.1), v along the slow direction: what is met is s^2/(s^2 + lambda)."""
    found = by_key([[1.0, 0.0], [0.0, 0.1]], [0.0, 0.3])
    assert found["inverse"].step.qdot == pytest.approx([0.0, 3.0])
    assert (found["inverse"].along, found["inverse"].error) == pytest.approx((1.0, 0.0))
    assert found["dls_constant"].along == pytest.approx(0.01 / (0.01 + 0.01))
    damping = 0.01 * (1.0 - 0.25)
    assert found["dls_variable"].step.damping == pytest.approx(damping)
    assert found["dls_variable"].along == pytest.approx(0.01 / (0.01 + damping))
    assert found["dls_constant"].error == pytest.approx(0.5)
    # The best step along J^T v meets a v that is a singular direction.
    assert found["transpose"].along == pytest.approx(1.0)


def test_the_direction_of_what_is_reached_by_hand():
    """v between the directions: damping bends what is reached towards the fast one."""
    found = by_key([[1.0, 0.0], [0.0, 0.1]], [1.0, 1.0])["dls_constant"]
    reached = np.array([1.0 / 1.01, 0.5])
    np.testing.assert_allclose(found.reached, reached, rtol=0, atol=1e-14)
    assert found.off == pytest.approx(math.pi / 4 - math.atan2(0.5, 1.0 / 1.01))
    assert found.error == pytest.approx(math.hypot(1.0 - 1.0 / 1.01, 0.5) / math.sqrt(2.0))


def test_at_a_singularity_all_is_finite_but_the_inverse_which_says_why():
    J = [[-1.0, -0.5], [0.0, 0.0]]
    for v in ([0.0, 0.3], [0.3, 0.0], [0.2, -0.1]):
        found = by_key(J, v)
        assert found["inverse"].step.qdot is None
        assert "J⁻¹ does not exist" in found["inverse"].step.says
        assert (found["inverse"].reached, found["inverse"].error, found["inverse"].off) == (None, 1.0, None)
        for key in set(METHODS) - {"inverse"}:
            assert np.isfinite(found[key].step.qdot).all()
            assert math.isfinite(found[key].error)
    lost = by_key(J, [0.0, 0.3])
    assert all(np.abs(lost[key].step.qdot).max() < 1e-12 for key in METHODS if key != "inverse")
    assert all(lost[key].off is None for key in METHODS)


def test_random_matrices_agree_with_the_definitions(rng):
    for _ in range(200):
        m, n = int(rng.integers(1, 7)), int(rng.integers(1, 8))
        J, v = rng.normal(size=(m, n)), rng.normal(size=m)
        if rng.random() < 0.3:  # almost, or quite, singular
            J[-1] = J[0] + rng.choice([0.0, 1e-13, 1e-6]) * rng.normal(size=n)
        found = by_key(J, v)
        assert tuple(found) == METHODS
        damped = J.T @ np.linalg.solve(J @ J.T + 0.01 * np.eye(m), v)
        np.testing.assert_allclose(found["dls_constant"].step.qdot, damped, rtol=0, atol=1e-9 * np.linalg.norm(damped))
        for each in found.values():
            if each.reached is None:
                continue
            assert each.error == pytest.approx(np.linalg.norm(each.reached - v) / np.linalg.norm(v), abs=1e-9)
            assert each.along == pytest.approx(each.reached @ v / (v @ v), abs=1e-9)
            if each.off is not None:
                cosine = each.reached @ v / np.linalg.norm(each.reached) / np.linalg.norm(v)
                assert math.cos(each.off) == pytest.approx(cosine, abs=1e-9)
        # Of all joint speeds the pseudo-inverse comes closest.
        assert found["pinv"].error <= min(each.error for each in found.values()) + 1e-6


def test_every_robot_in_random_and_in_all_zero_configurations(robot, rng):
    task = ScaledTask(robot.arm)
    for q in [np.zeros(robot.arm.n), *rng.uniform(*robot.arm.limits.T, (5, robot.arm.n))]:
        for each in side_by_side(task.scaled(task.jacobian(robot.arm.clip(q))), rng.normal(size=task.m)):
            assert each.step.says or np.isfinite(each.step.qdot).all()
            assert math.isfinite(each.along + each.error)


def test_the_methods_are_known():
    assert set(METHODS) <= set(rate_inverses())


@pytest.mark.parametrize(
    ("J", "v", "says"),
    [
        ([[1.0]], [0.0], "v: expected a velocity that is not zero"),
        ([[1.0]], [1.0, 2.0], "v: expected 1 finite numbers"),
        ([1.0], [1.0], "v: expected 0 finite numbers"),
        ([[math.nan]], [1.0], "J: expected"),
    ],
)
def test_nonsense_is_refused(J, v, says):
    with pytest.raises(InputError, match=says):
        side_by_side(J, v)
    with pytest.raises(InputError, match="unknown name"):
        side_by_side([[1.0]], [1.0], methods=("nothing",))


def test_planar_2r_stretched():
    arm = catalogue()["planar_2r"].arm
    task = ScaledTask(arm)
    J = task.scaled(task.jacobian(np.array([0.4, 0.0])))
    across = np.array([-math.sin(0.4), math.cos(0.4)])
    found = by_key(J, 0.3 * across)
    assert found["inverse"].step.qdot is None
    assert (found["pinv"].along, found["transpose"].along) == pytest.approx((1.0, 1.0))
    assert 0.99 < found["dls_constant"].along < 1.0
