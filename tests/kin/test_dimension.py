"""Of how many dimensions the solutions around one are: known by geometry."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.ik.dimension import local_dimension, null_dimension
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.ik.spare_joints import POINTS, SURFACE

H = math.pi / 2


def of(arm, q):
    return local_dimension(arm, np.asarray(q, dtype=float), np.asarray(arm.fk(q)))


def iiwa(**joints):
    q = np.array([0.3, 0.5, -0.4, 1.1, 0.7, -0.6, 0.2])
    for name, value in joints.items():
        q[int(name[1]) - 1] = value
    return q


@pytest.mark.parametrize(
    ("q", "dimension"),
    [
        (iiwa(), 1),
        # Stretched: the null space has two dimensions, but the elbow cannot move; axes 3 and 5 are one line.
        (iiwa(q4=0.0), 1),
        # Axes 1 and 3, and axes 5 and 7, are one line each.
        (iiwa(q2=0.0, q6=0.0), 2),
        # All of axes 1, 3, 5 and 7 are one line.
        (iiwa(q2=0.0, q4=0.0, q6=0.0), 3),
        # Folded, with links of one length: the wrist is in the shoulder, whichever way the upper arm points.
        (iiwa(q4=math.pi), 3),
    ],
)
def test_seven_joints(q, dimension):
    arm = catalogue()["iiwa7"].arm
    assert of(arm, q) == dimension
    assert null_dimension(arm, q, np.asarray(arm.fk(q))) >= dimension


def test_a_stretched_arm_is_a_point():
    arm = Arm.from_dh([("R", 1.0, 0, 0, 0)] * 2)
    assert null_dimension(arm, np.array([0.4, 0.0]), np.asarray(arm.fk([0.4, 0.0]))) == 1
    assert of(arm, [0.4, 0.0]) == 0
    assert of(arm, [0.4, 0.9]) == 0
    assert of(arm, [0.4, math.pi]) == 1


def test_where_two_curves_cross_there_is_no_surface():
    """Links of one length with the second folded on the first: either joint 1 turns or the last two move as a 2R."""
    arm = Arm.from_dh([("R", 1.0, 0, 0, 0), ("R", 1.0, 0, 0, 0), ("R", 0.5, 0, 0, 0)], task="xy")
    q = np.array([0.3, math.pi, 0.0])
    T = np.asarray(arm.fk(q))
    assert local_dimension(arm, q, T) == 1


def test_a_folded_arm_is_a_family_of_three_dimensions_and_not_traced():
    arm = catalogue()["iiwa7"].arm
    found = solve_all(arm, arm.fk(iiwa(q4=math.pi)))
    assert found.completeness == "infinite"
    assert found.families == ()
    assert "a family of 3 dimensions" in found.sentence
    assert "within the joint limits" in found.sentence
    assert len(found) <= SURFACE


@pytest.mark.parametrize("key", ["iiwa7", "canadarm2", "panda", "gen3"])
def test_at_singular_poses_no_more_is_traced_than_elsewhere(key):
    arm, rng = catalogue()[key].arm, np.random.default_rng(5)
    for _ in range(6):
        found = solve_all(arm, arm.fk(rng.integers(-2, 3, 7) * H))
        # One curve may begin when little is left of what all may have.
        assert sum(len(curve) for curve in found.families) <= 3 * POINTS


def test_joints_to_spare_are_counted_in_the_sentence():
    arm = catalogue()["trunk9"].arm
    found = solve_all(arm, arm.fk(arm.limits.mean(axis=1) + 0.3))
    assert f"a family of {arm.n - arm.task.m} dimensions" in found.sentence
