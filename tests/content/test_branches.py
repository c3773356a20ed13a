"""Elbow, shoulder and wrist, told from the geometry."""

from dataclasses import replace

import numpy as np
import pytest

from armlab.content.check import read_check
from armlab.content.checks._branches import Branches, other_elbow
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import catalogue
from armlab.errors import ContentError
from armlab.kin.arm import Arm
from armlab.kin.convert import converted

# All eight solutions of the PUMA for one pose, from the Robotics Toolbox (Corke), ikine_a with its configuration
# letters: left or right, up or down; the last two columns differ by the flip of the wrist.
PUMA = {
    ("left", "up"): [2.649, 2.356, 0.094, -0.609, -0.974, -2.768],
    ("left", "down"): [2.649, -2.308, -3.142, -2.467, -0.86, -0.48],
    ("right", "up"): [0.0, 0.785, -3.142, -3.142, -0.785, 3.142],
    ("right", "down"): [0.0, -0.834, 0.094, 0.0, -0.831, 0.0],
}


def check(text, key):
    return read_check(Table.parse("f.md", f'kind = "branch"\n{text}'), catalogue()[key])


def flipped(q):
    return [*q[:3], q[3] + np.pi, -q[4], q[5] + np.pi]


@pytest.mark.parametrize(("side", "elbow"), PUMA)
def test_the_eight_branches_of_the_puma(side, elbow):
    arm = catalogue()["puma560"].arm
    for q, wrist in ((PUMA[side, elbow], "negative"), (flipped(PUMA[side, elbow]), "positive")):
        front = "front" if side == "right" else "back"
        text = f'shoulder = "{side}"\nelbow = "{elbow}"\nwrist = "{wrist}"'
        for given in (text, text.replace(side, front)):
            assert check(given, "puma560").is_met(Observation.of(arm, q))
        for other in (text.replace(side, "left" if side == "right" else "right"), text.replace(wrist, "xx")):
            if "xx" not in other:
                assert not check(other, "puma560").is_met(Observation.of(arm, q))


@pytest.mark.parametrize(("side", "elbow"), PUMA)
def test_the_four_arms_reach_one_wrist_point(side, elbow):
    """The truth above is one: all solutions have the same pose, to the three decimals they are written with."""
    arm = catalogue()["puma560"].arm
    expected = arm.fk(PUMA["right", "up"])
    np.testing.assert_allclose(arm.fk(PUMA[side, elbow]), expected, rtol=0, atol=3e-3)
    np.testing.assert_allclose(arm.fk(flipped(PUMA[side, elbow])), expected, rtol=0, atol=3e-3)


def test_an_arm_on_the_other_side_has_the_other_shoulder():
    arm = catalogue()["puma560"].arm
    rows = [replace(row, d=-row.d) if i == 2 else row for i, row in enumerate(arm.rows)]
    other = Branches(Arm.from_dh(rows, tool=arm.tool))
    for (side, _), q in PUMA.items():
        assert Branches(arm).side(q) == ("first" if side == "left" else "second")
        assert other.side(q) == ("second" if side == "left" else "first")


@pytest.mark.parametrize("key", ["planar_2r", "planar_2r_unequal", "planar_3r"])
def test_the_elbow_of_a_planar_arm_is_up_where_q2_is_negative(key, rng):
    arm = catalogue()[key].arm
    for q in rng.uniform(-3.0, 3.0, (100, arm.n)):
        assert Branches(arm).elbow(q) == ("first" if q[1] < 0 else "second")


def test_the_other_elbow_has_the_same_point(rng):
    for _ in range(100):
        a, b = rng.uniform(0.2, 1.0, 2)
        offsets = rng.uniform(-3, 3, 2)
        alpha = rng.choice([0.0, np.pi])
        arm = Arm.from_dh([("R", a, alpha, 0.1, offsets[0]), ("R", b, 0.0, 0.2, offsets[1])])
        q = rng.uniform(-3, 3, 2)
        other = other_elbow(arm, q)
        np.testing.assert_allclose(arm.position(other), arm.position(q), rtol=0, atol=1e-9)
        sides = {Branches(arm).elbow(q), Branches(arm).elbow(other)}
        assert sides == {"first", "second"} or "neither" in sides


def test_the_elbow_of_an_upright_arm(rng):
    """Above the line from shoulder to hand: for a hand in front of the arm that is where q3 is negative."""
    arm = catalogue()["elbow_3r"].arm
    for q1, q2, q3 in rng.uniform([-3, -1, -2.5], [3, 1, 2.5], (200, 3)):
        found = Branches(arm).elbow([q1, q2, q3])
        hand = 0.8 * np.cos(q2) + 0.5 * np.cos(q2 + q3)
        if abs(hand) > 0.05 and abs(q3) > 0.05:
            assert found == ("first" if (q3 < 0) == (hand > 0) else "second")
            assert Branches(arm).front([q1, q2, q3]) == ("first" if hand > 0 else "second")


@pytest.mark.parametrize("key", ["puma560", "elbow_3r", "irb140", "ur5e", "planar_2r", "planar_3r"])
def test_the_convention_does_not_matter(key, rng):
    arm = catalogue()[key].arm
    other = converted(arm, "modified")
    one, two = Branches(arm), Branches(other)
    assert (one.planar, one.turning, one.sided, one.wrist) == (two.planar, two.turning, two.sided, two.wrist)
    for q in rng.uniform(*arm.limits.T, (50, arm.n)):
        assert one.elbow(q) == two.elbow(q)
        if one.turning:
            assert one.front(q) == two.front(q)
        if one.sided:
            assert one.side(q) == two.side(q)


def test_between_two_branches_the_arm_is_in_neither():
    asked = check('elbow = "up"', "planar_2r")
    arm = catalogue()["planar_2r"].arm
    stretched = Observation.of(arm, [0.3, 0.0])
    assert not asked.is_met(stretched)
    assert asked.says(stretched).startswith("The arm is stretched, folded")
    assert asked.says(Observation.of(arm, [0.3, -0.5])) == "The arm is on the branch that is asked for."
    assert asked.says(Observation.of(arm, [0.3, 0.5])) == (
        "This is elbow down, the mirror branch; the branch asked for is elbow up."
    )


def test_a_table_that_has_lost_the_branch_is_in_neither():
    asked = check('elbow = "up"', "planar_2r")
    other = catalogue()["cartesian_3p"]
    assert not asked.is_met(Observation.of(other.arm, other.home))
    assert "elbow up" in asked.says(Observation.of(other.arm, other.home))


@pytest.mark.parametrize(
    ("key", "text"),
    [
        ("scara", 'elbow = "up"'),
        ("panda", 'elbow = "up"'),
        ("cartesian_3p", 'elbow = "down"'),
        ("ur5e", 'wrist = "positive"'),
        ("ur5e", 'shoulder = "left"'),
        ("irb140", 'shoulder = "left"'),
        ("elbow_3r", 'wrist = "positive"'),
        ("planar_3r", 'shoulder = "front"'),
    ],
)
def test_arms_without_a_branch_are_refused(key, text):
    with pytest.raises(ContentError, match=r"f\.md: (elbow|shoulder|wrist): .* has no such branch; .* is for"):
        check(text, key)
