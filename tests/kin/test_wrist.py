"""The centre of a spherical wrist."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.wrist import wrist_centre


@pytest.mark.parametrize("key", ["puma560", "kr6r900", "irb140"])
def test_the_last_three_joints_do_not_move_the_centre(key):
    arm = catalogue()[key].arm
    centre = wrist_centre(arm)
    rng = np.random.default_rng(3)
    q = rng.uniform(arm.limits[:, 0], arm.limits[:, 1], (50, arm.n))
    turned = q.copy()
    turned[:, 3:] = rng.uniform(arm.limits[3:, 0], arm.limits[3:, 1], (50, 3))
    places = [(T[:, :3, :3] @ centre + T[:, :3, 3]) for T in (arm.fk(q), arm.fk(turned))]
    np.testing.assert_allclose(*places, rtol=0, atol=1e-9 * arm.length_scale)
    assert np.ptp(places[0], axis=0).max() > 0.1 * arm.length_scale


@pytest.mark.parametrize("key", ["ur10e", "planar_2r", "scara"])
def test_an_arm_without_a_spherical_wrist_has_no_centre(key):
    assert wrist_centre(catalogue()[key].arm) is None
