"""Gimbal rings: the axes are those of the turns, each ring holds the axis of the next, and the body is in the last."""

import numpy as np
import pytest

from armlab.benches.body.forms.gimbal import RADII, rings_of
from armlab.kin.euler import SEQUENCES
from armlab.kin.rotations import is_rotation, rotation_from_sequence
from armlab.kin.velocity.rates import rate_matrix

BOTH = [(axes, fixed) for axes in SEQUENCES for fixed in (False, True)]


@pytest.mark.parametrize(("axes", "fixed"), BOTH)
def test_their_axes_are_the_columns_of_the_rate_matrix(axes, fixed, rng):
    angles = rng.uniform(-3.0, 3.0, 3)
    T = rate_matrix(angles, axes, fixed)
    rings = rings_of(axes, fixed, angles)
    assert sorted(ring.turn for ring in rings) == [0, 1, 2]
    assert tuple(ring.radius for ring in rings) == RADII
    for ring in rings:
        assert ring.letter == axes[ring.turn]
        np.testing.assert_allclose(ring.axis, T[:, ring.turn], rtol=0, atol=1e-14)


@pytest.mark.parametrize(("axes", "fixed"), BOTH)
def test_a_ring_holds_its_own_axis_and_the_next_and_the_last_turns_with_the_body(axes, fixed, rng):
    angles = rng.uniform(-3.0, 3.0, 3)
    R = rotation_from_sequence(axes, angles, fixed=fixed)
    rings, still = rings_of(axes, fixed, angles), rings_of(axes, fixed, np.zeros(3))
    for k, ring in enumerate(rings):
        assert is_rotation(ring.frame, 1e-12)
        across = ring.frame[:, 2]
        np.testing.assert_allclose(ring.frame[:, 0], ring.axis, rtol=0, atol=1e-14)
        if k < 2:
            assert abs(across @ rings[k + 1].axis) < 1e-14
    np.testing.assert_allclose(rings[2].frame, R @ still[2].frame, rtol=0, atol=1e-14)


def test_at_a_singularity_two_rings_lie_in_one_plane():
    outer, middle, _ = rings_of("zyx", False, np.radians([35.0, 90.0, 20.0]))
    np.testing.assert_allclose(np.abs(outer.frame[:, 2] @ middle.frame[:, 2]), 1.0, atol=1e-14)
    outer, middle, _ = rings_of("zxz", False, np.radians([35.0, 0.0, 20.0]))
    np.testing.assert_allclose(np.abs(outer.frame[:, 2] @ middle.frame[:, 2]), 1.0, atol=1e-14)


def test_about_fixed_axes_the_last_turn_has_the_outermost_ring():
    """Notes, theorem 2."""
    angles = np.array([0.3, 0.8, -0.5])
    fixed, moving = rings_of("xyz", True, angles), rings_of("zyx", False, angles[::-1])
    assert [ring.turn for ring in fixed] == [2, 1, 0]
    for one, other in zip(fixed, moving, strict=True):
        np.testing.assert_allclose(one.frame, other.frame, rtol=0, atol=1e-15)
