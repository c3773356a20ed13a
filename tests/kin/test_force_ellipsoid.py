"""Force ellipsoids: the inverse of the velocity ellipsoid, endless where the arm is singular."""

import math

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ellipsoid import velocity_ellipsoid
from armlab.kin.force_ellipsoid import force_ellipsoid
from armlab.kin.statics import joint_torques

SHAPES = [(1, 1), (1, 4), (2, 2), (2, 3), (3, 3), (3, 7), (2, 1), (3, 1), (3, 2)]


def planar(*lengths):
    return Arm.from_dh([("R", length, 0, 0, 0) for length in lengths], task="xy")


def test_the_half_axes_of_the_2r_are_the_inverses_of_those_in_the_notes(truth):
    case = truth["C5.3-sigma-2R"]
    arm = planar(case["inputs"]["l1"], case["inputs"]["l2"])
    expected = case["expected"]
    for q2, sigma, w in zip(expected["q2"], expected["sigma"], expected["w"], strict=True):
        J = arm.jacobian([0.4, q2])[:2]
        found = force_ellipsoid(J)
        np.testing.assert_allclose(found.half_axes, 1.0 / np.array(sigma), rtol=1e-9, atol=0)
        np.testing.assert_array_equal(found.axes, velocity_ellipsoid(J).axes)
        assert found.w == pytest.approx(1.0 / w, rel=1e-9)
        assert found.w == pytest.approx(math.sqrt(np.linalg.det(np.linalg.inv(J @ J.T))), rel=1e-9)


@pytest.mark.parametrize("shape", [(2, 2), (2, 3), (3, 3), (3, 7)])
@pytest.mark.parametrize("scaled", [False, True])
def test_forces_of_the_surface_need_torques_of_length_one(shape, scaled, rng):
    for _ in range(50):
        J = rng.normal(size=shape)
        scale = rng.uniform(0.2, 3.0, shape[1]) if scaled else None
        found = force_ellipsoid(J, scale)
        u = rng.normal(size=shape[0])
        force = found.axes @ (found.half_axes * u / np.linalg.norm(u))
        tau = joint_torques(J, force) * (1.0 if scale is None else scale)
        assert np.linalg.norm(tau) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("shape", SHAPES)
def test_no_number_is_nan_however_singular_the_matrix(shape, rng):
    m, n = shape
    for size in (0.0, 1e-300, 1e-12, 1e-7, 1.0):
        for rank in range(min(shape) + 1):
            J = size * rng.normal(size=(m, rank)) @ rng.normal(size=(rank, n))
            found = force_ellipsoid(J)
            assert not np.isnan(found.half_axes).any()
            assert not math.isnan(found.w)
            assert (found.half_axes > 0.0).all()
            assert (np.diff(found.half_axes[: len(found.half_axes) - len(found.free)]) >= 0.0).all()
            assert len(found.free) == m - found.velocity.rank
            assert np.isinf(found.half_axes[list(found.free)]).all()


def test_along_the_stretched_arm_a_force_needs_no_torque():
    found = force_ellipsoid(planar(1.0, 1.0).jacobian([0.7, 0.0])[:2])
    assert found.free == (1,)
    assert found.half_axes[1] == math.inf
    assert found.w == math.inf
    np.testing.assert_allclose(np.abs(found.axes[:, 1]), [math.cos(0.7), math.sin(0.7)], atol=1e-12)
    assert found.half_axes[0] == pytest.approx(1.0 / math.sqrt(5.0), abs=1e-12)


def test_fewer_joints_than_rows_leave_axes_without_torque_and_a_finite_w(rng):
    J = rng.normal(size=(3, 2))
    found = force_ellipsoid(J)
    assert found.free == (2,)
    assert found.w == pytest.approx(1.0 / math.sqrt(np.linalg.det(J.T @ J)), rel=1e-9)


def test_bad_input_is_refused_with_words():
    with pytest.raises(InputError, match="J: expected one to three rows of one unit"):
        force_ellipsoid(np.eye(6))
    with pytest.raises(InputError, match="scale"):
        force_ellipsoid(np.eye(2), [1.0])
