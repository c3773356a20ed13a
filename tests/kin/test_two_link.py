"""The planar 2R over the distance of its tool: the plots of section 5.3 of the notes."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ellipsoid import velocity_ellipsoid
from armlab.kin.two_link import TwoLink, distance, two_link
from support.arms import random_pose


def planar_of(rng, l1, l2, convention):
    """Return a 2R somewhere in space, its tool away from the end of the second link."""
    side, along = rng.uniform(-0.3, 0.3, 2)
    tool = np.eye(4)
    tool[:3, 3] = [along, side, 0.2]
    if convention == "standard":
        rows = [("R", l1, 0, 0.1, 0.3), ("R", l2, 0, 0, 0)]
        reach = np.hypot(l2 + along, side)
    else:
        rows = [("R", 0.2, 0.7, 0.1, 0.3), ("R", l1, 0, 0, 0)]
        reach = np.hypot(along, side)
    return Arm.from_dh(rows, convention, base=random_pose(rng), tool=tool, task="xyz"), l1, reach


def test_the_singular_values_of_the_notes(truth):
    case = truth["C5.3-sigma-2R"]
    arm = TwoLink(case["inputs"]["l1"], case["inputs"]["l2"])
    found = arm.sigma(case["inputs"]["r"])
    np.testing.assert_allclose(found, case["expected"]["sigma"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(found.prod(axis=-1), case["expected"]["w"], rtol=0, atol=case["tol"])


def test_w_is_largest_at_the_root_of_two():
    arm = TwoLink(1.0, 1.0)
    r = np.linspace(0.0, 2.0, 200_001)
    w = arm.sigma(r).prod(axis=-1)
    assert arm.best == pytest.approx(np.sqrt(2.0), abs=1e-15)
    assert r[np.argmax(w)] == pytest.approx(arm.best, abs=1e-4)
    assert w.max() == pytest.approx(1.0, abs=1e-9)


def test_a_forearm_shorter_by_the_root_of_two_is_isotropic_somewhere():
    """l1 = sqrt(2) l2 at q2 = 135 degrees: a circle."""
    l2 = 0.7
    arm = TwoLink(np.sqrt(2.0) * l2, l2)
    r = np.sqrt(arm.l1**2 + l2**2 + 2.0 * arm.l1 * l2 * np.cos(0.75 * np.pi))
    assert r == pytest.approx(l2, abs=1e-12)
    # A double root: an error of 1e-16 in r becomes 1e-8 in the half axes.
    np.testing.assert_allclose(arm.sigma(r), [l2, l2], rtol=0, atol=1e-7)


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_any_planar_2r_has_the_half_axes_of_its_jacobian(convention, rng):
    for _ in range(20):
        arm, l1, l2 = planar_of(rng, *rng.uniform(0.2, 1.0, 2), convention)
        found = two_link(arm)
        assert found.l1 == pytest.approx(l1, abs=1e-12)
        assert found.l2 == pytest.approx(l2, abs=1e-12)
        for q in rng.uniform(-np.pi, np.pi, (10, 2)):
            J = arm.jacobian(q)[:3]
            expected = velocity_ellipsoid(J).sigma[:2]
            np.testing.assert_allclose(found.sigma(distance(arm, q)), expected, rtol=0, atol=1e-7)
            assert found.ends[0] - 1e-9 <= distance(arm, q) <= found.ends[1] + 1e-9
        q = rng.uniform(-np.pi, np.pi, (5, 2))
        assert distance(arm, q).shape == (5,)


def test_nothing_is_nan_at_and_beyond_the_ends():
    for l1, l2 in ((1.0, 1.0), (1.0, 0.5), (0.3, 0.9), (1e-6, 1.0)):
        arm = TwoLink(l1, l2)
        low, high = arm.ends
        found = arm.sigma([low - 1.0, low, high, high + 1.0])
        assert np.isfinite(found).all()
        np.testing.assert_allclose(found[:, 1], 0.0, atol=1e-12)


def test_other_arms_are_refused_with_words():
    for key, words in (
        ("planar_3r", "two joints that turn, got 3"),
        ("cylindrical_rpp", "two joints that turn, got 3 of which 1"),
    ):
        with pytest.raises(InputError, match=words):
            two_link(catalogue()[key].arm)
    crossed = Arm.from_dh([("R", 0.5, 1.0, 0, 0), ("R", 0.5, 0, 0, 0)])
    with pytest.raises(InputError, match="parallel"):
        two_link(crossed)
    with pytest.raises(InputError, match="links with a length"):
        two_link(Arm.from_dh([("R", 0.5, 0, 0, 0), ("R", 0, 0, 0, 0)]))
