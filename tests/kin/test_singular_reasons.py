"""Where several ranks are lost at once: as many reasons, each of them true."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.velocity.singular import singularities, usual_rank
from armlab.kin.velocity.subspaces import task_subspaces
from support.singular import assert_is_lost

ROBOTS = catalogue().robots
RIGHT = math.pi / 2
LATTICE = [0.0, RIGHT, -RIGHT, math.pi, 0.4, 1.1]
"""Angles of which a draw makes several factors of a determinant vanish at once."""


@pytest.mark.parametrize("key", list(ROBOTS))
def test_as_many_reasons_are_named_as_ranks_are_lost(key, rng):
    arm = ROBOTS[key].arm
    low, high = arm.limits.T
    for _ in range(60):
        q = np.where(arm.revolute, rng.choice(LATTICE, arm.n), rng.uniform(low, high))
        lost = usual_rank(arm) - task_subspaces(arm, q).rank
        found = singularities(arm, q)
        assert bool(found) == (lost > 0)
        assert len(found) >= lost
        assert len({each.says for each in found}) == len(found)
        for each in found:
            assert list(each.joints) == sorted(set(each.joints))
            assert_is_lost(arm, q, each)


def test_the_iiwa_upright_has_an_elbow_a_shoulder_and_a_wrist():
    """Three ranks are lost: along the arm, across it, and a turn of the hand."""
    found = singularities(ROBOTS["iiwa7"].arm, np.zeros(7))
    assert [each.kind for each in found] == ["elbow", "shoulder", "wrist"]
    assert "Joints 2 and 4 move it the same way" in found[1].says
    assert abs(found[0].direction @ [0.0, 0.0, 1.0]) == pytest.approx(1.0)
    assert abs(found[1].direction @ [0.0, 1.0, 0.0]) == pytest.approx(1.0)


def test_the_iiwa_folded_flat_has_its_wrist_centre_at_the_shoulder():
    found = singularities(ROBOTS["iiwa7"].arm, [0.4, 1.1, 0.4, math.pi, 1.0, 0.4, 1.0])
    assert [each.kind for each in found] == ["elbow", "shoulder"]
    assert "the wrist centre is at the shoulder centre" in found[1].says
    assert abs(found[0].direction @ found[1].direction) < 1e-12


def test_the_canadarm_stretched_with_more_axes_dependent_says_both():
    found = singularities(ROBOTS["canadarm2"].arm, np.radians([90, 90, -90, 0, -90, 63, 180]))
    assert [each.kind for each in found] == ["elbow", "dependent"]
    assert "one of 2 motions" in found[1].says
