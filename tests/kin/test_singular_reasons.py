"""Reasons of singularities, each of them true: several where several ranks are lost, and those of parts of a pose."""

import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.task import Task
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


TOOL_ON_AXIS_1 = {
    "scorbot": (1.923143671046452, -2.2689280275926285),
    "youbot": (0.6158723020240637, -1.7889624832941877),
}


@pytest.mark.parametrize("key", TOOL_ON_AXIS_1)
def test_three_axes_in_line_are_no_elbow_where_the_last_of_them_still_moves_the_tool(key):
    """Joint 5 turns about the tool point: the planar part ends there and not at axis 4."""
    q2, q4 = TOOL_ON_AXIS_1[key]
    (found,) = singularities(ROBOTS[key].arm, [0.3, q2, 0.0, q4, 0.2])
    assert (found.kind, found.joints) == ("shoulder", (1,))
    assert "the tool point lies on axis 1" in found.says
    (stretched,) = singularities(ROBOTS[key].arm, [0.3, 0.4, 0.0, 0.0, 0.2])
    assert "axes 2, 3 and 4 and the tool point are in line" in stretched.says


@pytest.mark.parametrize(("q2", "how"), [(0.0, "stretched"), (math.pi, "folded")])
def test_a_tool_point_on_the_last_axis_leaves_a_scara_stretched_or_folded(q2, how):
    arm = replace(ROBOTS["scara"].arm, task=Task("xyz", "none"))
    (found,) = singularities(arm, [0.3, q2, 0.1, 0.2])
    assert f"the arm is {how}: axes 1, 2 and 4 and the tool point are in line" in found.says


def test_a_joint_that_moves_the_tool_only_where_the_task_does_not_look_is_told_as_that():
    """At q = 0 the tool of one link moves along y alone, and a tool point on the axis not at all."""
    (found,) = singularities(Arm.from_dh([("R", 1.0, 0, 0, 0)], task="x"), [0.0])
    assert "joint 1 does not move the tool in its task." in found.says
    (found,) = singularities(ROBOTS["polar_rrp"].arm, [0.4, math.pi / 2, 0.5])
    assert "joint 1 does not move the tool (" in found.says


@pytest.mark.parametrize("q", [0.0, math.pi, -math.pi])
def test_one_joint_is_singular_on_both_sides_whatever_is_rounded(q):
    (found,) = singularities(Arm.from_dh([("R", 1.0, 0, 0, 0)], task="x"), [q])
    assert (found.kind, found.joints, found.boundary) == ("shoulder", (1,), True)
    np.testing.assert_allclose(np.abs(found.direction), [1.0, 0.0, 0.0], rtol=0, atol=1e-12)


def test_joints_that_move_the_tool_along_two_lines_are_not_said_to_share_one():
    """With link 2 upright both joints move the tool in the xy plane, across each other; of y and z only along y."""
    arm = Arm.from_dh([("R", 1.0, math.pi / 2, 0, 0), ("R", 1.0, 0, 0, 0)], task="yz")
    (found,) = singularities(arm, [0.4, math.pi / 2])
    assert "columns of joints 1 and 2 are dependent" in found.says.lower()
