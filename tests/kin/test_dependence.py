"""Which columns of a Jacobian have become dependent."""

import numpy as np
import pytest

from armlab.kin.arm import Arm
from armlab.kin.velocity.dependence import dependent_columns
from support.arms import random_q


def test_the_dependent_columns_of_the_notes(truth):
    found = dependent_columns(truth["C5.1.3-3R-J-b"]["expected"]["J"])
    assert [each.joints for each in found] == [(2,), (1, 3)]
    np.testing.assert_allclose(found[1].factors, [1.0, 1.0], rtol=0, atol=1e-12)
    # J1 + J3 = 0 alone does not make a 2 x 3 matrix singular (the text after 5.82).
    counterexample = np.array([[1.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    assert np.linalg.matrix_rank(counterexample) == truth["ERR-5.82"]["printed_value_if_wrong"]["printed_residual"]
    assert [each.joints for each in dependent_columns(counterexample)] == [(1, 3)]


def test_a_dependence_adds_up_to_zero_and_none_is_left_out(rng):
    for size in (1, 2, 3, 4):
        J = rng.normal(size=(6, 6))
        joints = sorted(rng.choice(6, size, replace=False).tolist())
        J[:, joints[-1]] = J[:, joints[:-1]] @ rng.uniform(0.5, 1.5, size - 1)
        (found,) = dependent_columns(J)
        assert found.joints == tuple(k + 1 for k in joints)
        np.testing.assert_allclose(J[:, joints] @ found.factors, np.zeros(6), rtol=0, atol=1e-8)
        assert np.abs(found.factors).max() == pytest.approx(1.0)


def test_larger_sets_come_from_the_null_space(rng):
    J = rng.normal(size=(6, 6))
    J[:, 5] = J[:, :5] @ rng.uniform(0.5, 1.5, 5)
    (found,) = dependent_columns(J)
    assert found.joints == (1, 2, 3, 4, 5, 6)
    assert dependent_columns(rng.normal(size=(6, 6))) == ()


def test_what_is_always_dependent_has_not_become_so(rng):
    arm = Arm.from_dh([("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0)], task="xyz")
    usual = np.array([arm.jacobian(q)[:3] for q in random_q(arm, rng, 6)])
    q = random_q(arm, rng)
    assert [each.joints for each in dependent_columns(arm.jacobian(q)[:3])] == [(1, 2, 3)]
    assert all(len(each.joints) == 3 for each in dependent_columns(arm.jacobian(q)[:3], usual))
    stretched = arm.jacobian([0.3, 0.0, 0.7])[:3]
    assert [each.joints for each in dependent_columns(stretched, usual) if len(each.joints) == 2] == []
