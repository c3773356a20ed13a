"""Frames and tables that a person makes, and the table that belongs to the frames."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.assignment import (
    DIRECTION_TOLERANCE,
    Choice,
    expected_table,
    judge_cell,
    judge_frames,
    judge_row,
    length_tolerance,
    own_choices,
)
from armlab.kin.convert import converted
from armlab.kin.dh import Row
from armlab.kin.relations import axis_relations
from support.arms import random_arm, random_pose, random_q

H = math.pi / 2
TEXTBOOK = ["planar_2r", "planar_3r", "scara", "elbow_3r", "polar_rrp", "cylindrical_rpp", "stanford", "puma560"]
PLANAR = Arm.from_dh([("R", 1.0, 0, 0, 0), ("R", 0.5, 0, 0, 0)])
ELBOW = Arm.from_dh([("R", 0, H, 0.6, 0), ("R", 0.8, 0, 0, 0), ("R", 0.5, 0, 0, 0)])
X, Y, Z = np.eye(3)


def across(rng, *directions):
    """A random unit vector perpendicular to one or two directions."""
    v = rng.normal(size=3)
    if len(directions) == 2 and np.linalg.norm(np.cross(*directions)) > 1e-6:
        v = np.cross(*directions)
        return rng.choice([-1, 1]) * v / np.linalg.norm(v)
    v -= (v @ directions[0]) * directions[0]
    return v / np.linalg.norm(v)


def legal_choices(arm, q, rng):
    """Random choices that obey the rules, from the axes alone."""
    arm = converted(arm, "standard")
    frames, kinds = arm.frames(q), [relation.kind for relation in axis_relations(arm)]
    choices = []
    for i in range(arm.n + 1):
        z = rng.choice([-1, 1]) * frames[i, :3, 2]
        if i == 0:
            x = across(rng, z)
        elif i == arm.n:
            x = across(rng, frames[i - 1, :3, 2])
            z = across(rng, x)
        elif kinds[i - 1] == "parallel":
            apart = frames[i, :3, 3] - frames[i - 1, :3, 3]
            apart -= (apart @ z) * z
            x = rng.choice([-1, 1]) * apart / np.linalg.norm(apart)
        else:
            x = across(rng, frames[i - 1, :3, 2], z)
        choices.append(Choice(z * rng.uniform(0.5, 2.0), x))
    return choices


def assert_same_motion(arm, choices, q, rng):
    assert all(verdict.ok for verdict in judge_frames(arm, q, choices))
    found = expected_table(arm, q, choices)
    other = found.arm(arm)
    for values in random_q(arm, rng, 6):
        np.testing.assert_allclose(other.fk(found.signs * values), arm.fk(values), rtol=0, atol=1e-9)
        assert other.within_limits(found.signs * values)
    # In the configuration of the choices the frames are the chosen ones.
    frames = other.frames(found.signs * q)
    np.testing.assert_allclose(frames, found.frames, rtol=0, atol=1e-9)
    for frame, choice in zip(frames, choices, strict=True):
        np.testing.assert_allclose(np.cross(frame[:3, 2], choice.z), 0.0, atol=1e-9)
        assert frame[:3, 2] @ np.asarray(choice.z) > 0.0
        np.testing.assert_allclose(frame[:3, 0], choice.x, rtol=0, atol=1e-9)
    return found


@pytest.mark.parametrize("key", TEXTBOOK)
def test_any_legal_choice_gives_a_table_of_the_same_arm(key, rng):
    arm = catalogue()[key].arm
    for _ in range(12):
        q = random_q(arm, rng)
        assert_same_motion(arm, legal_choices(arm, q, rng), q, rng)


def test_every_robot_has_a_table_for_random_legal_choices(robot, rng):
    q = random_q(robot.arm, rng)
    assert_same_motion(robot.arm, legal_choices(robot.arm, q, rng), q, rng)


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("special", [False, True])
def test_random_arms_have_tables_too(convention, special, rng):
    for n in (1, 2, 3, 5):
        for _ in range(3):
            arm = random_arm(rng, n, convention=convention, special=special)
            q = random_q(arm, rng)
            assert_same_motion(arm, legal_choices(arm, q, rng), q, rng)


@pytest.mark.parametrize("key", ["planar_2r", "planar_3r", "elbow_3r", "stanford", "puma560", "ur10", "polar_rrp"])
def test_the_arms_own_frames_give_its_own_table(key, rng):
    arm = catalogue()[key].arm
    q = random_q(arm, rng)
    found = expected_table(arm, q, own_choices(arm, q))
    assert found.reversed == ()
    for mine, theirs in zip(found.rows, arm.rows, strict=True):
        np.testing.assert_allclose((mine.a, mine.d), (theirs.a, theirs.d), rtol=0, atol=1e-12)
        for angle, true in ((mine.alpha, theirs.alpha), (mine.theta, theirs.theta)):
            assert math.cos(angle - true) == pytest.approx(1.0, abs=1e-12)
    np.testing.assert_allclose(found.base, arm.base, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.tool, arm.tool, rtol=0, atol=1e-12)


def test_quarter_turns_and_zeros_of_the_table_are_exact():
    found = expected_table(ELBOW, [0.3, 0.2, -0.4], own_choices(ELBOW, [0.3, 0.2, -0.4]))
    assert [(row.alpha, row.d) for row in found.rows] == [(H, 0.6), (0.0, 0.0), (0.0, 0.0)]
    assert found.base.tolist() == np.eye(4).tolist()


def test_a_reversed_axis_turns_the_joint_the_other_way():
    choices = [Choice(-Z, X), Choice(Z, X), Choice(Z, X)]
    found = expected_table(PLANAR, [0.0, 0.0], choices)
    assert found.reversed == (1,)
    assert found.signs.tolist() == [-1.0, 1.0]
    assert [(row.a, row.alpha, row.d, row.theta) for row in found.rows] == [(1.0, math.pi, 0.0, 0.0), (0.5, 0, 0, 0)]
    limited = Arm.from_dh(PLANAR.rows, limits=[(-1.0, 2.0), (-0.5, 0.5)])
    assert found.arm(limited).limits.tolist() == [[-2.0, 1.0], [-0.5, 0.5]]


def test_a_reversed_x_makes_a_negative_and_turns_theta_by_half_a_turn():
    choices = [Choice(Z, X), Choice(Z, -X), Choice(Z, X)]
    rows = expected_table(PLANAR, [0.0, 0.0], choices).rows
    assert [(row.a, row.theta) for row in rows] == [(-1.0, math.pi), (0.5, math.pi)]


def test_where_axes_are_parallel_d_is_zero():
    arm = Arm.from_dh([("R", 1.0, 0, 0.7, 0), ("R", 0.5, 0, 0.2, 0), ("P", 0, 0, 0.1, 0)])
    found = expected_table(arm, [0.4, -0.3, 0.2], own_choices(arm, [0.4, -0.3, 0.2]))
    # The heights add up in the last row, whose origin is the arm's own.
    assert [row.d for row in found.rows] == [0.0, 0.0, pytest.approx(1.0)]


def test_what_x_n_cannot_reach_goes_into_the_tool():
    found = expected_table(PLANAR, [0.0, 0.0], [Choice(Z, X), Choice(Z, X), Choice(Z, Y)])
    assert found.rows[1].a == 0.0
    # The hand is 0.5 m from axis 2 along the old x, which is -y of the frame that was turned by 90 degrees.
    np.testing.assert_allclose(found.tool[:3, 3], [0.0, -0.5, 0.0], atol=1e-15)
    assert found.rows[1].theta == H


def test_small_errors_of_legal_directions_do_not_reach_the_table():
    tilt = 0.5 * DIRECTION_TOLERANCE
    choices = [Choice(Z + tilt * X, X), Choice(-Y, X + tilt * Z), Choice(-Y, X), Choice(-Y, X)]
    rows = expected_table(ELBOW, [0.0, 0.0, 0.0], choices).rows
    assert [(row.a, row.alpha, row.d) for row in rows] == [(0.0, H, 0.6), (0.8, 0.0, 0.0), (0.5, 0.0, 0.0)]


@pytest.mark.parametrize(
    ("frame", "choice", "text"),
    [
        (0, Choice(X, Y), "z0 must lie along the axis of joint 1: it is 90° away"),
        (0, Choice(Z, X + Z), "x0 must be perpendicular to z0: the angle between them is 45°"),
        (1, Choice(Z, X), "z1 must lie along the axis of joint 2: it is 90° away"),
        (1, Choice(Y, Y), "x1 must be perpendicular to z1: it points along it"),
        (1, Choice(Y, Z), "x1 must be perpendicular to z0: it points along it"),
        (2, Choice(Y, Z), "x2 must lie along the common normal of the axes of joints 2 and 3: it is 90° away"),
        (2, Choice(Y, Y), "x2 must be perpendicular to z2: it points along it"),
        (3, Choice(Z, -Y), "x3 must be perpendicular to z2: it points along it"),
        (3, Choice(X, X), "x3 must be perpendicular to z3: it points along it"),
    ],
)
def test_the_broken_rule_is_named(frame, choice, text):
    choices = list(own_choices(ELBOW, [0.0, 0.0, 0.0]))
    choices[frame] = choice
    verdicts = judge_frames(ELBOW, [0.0, 0.0, 0.0], choices)
    assert [verdict.ok for verdict in verdicts] == [i != frame for i in range(4)]
    assert verdicts[frame].text == text
    with pytest.raises(InputError, match=f"^frame {frame}: z|^frame {frame}: x"):
        expected_table(ELBOW, [0.0, 0.0, 0.0], choices)


def test_legal_frames_say_which_rule_holds():
    texts = [verdict.text for verdict in judge_frames(ELBOW, [0.0] * 3, own_choices(ELBOW, [0.0] * 3))]
    assert texts == [
        "x0 is perpendicular to z0",
        "z1 lies along the axis of joint 2 and x1 parallel to z0 × z1",
        "z2 lies along the axis of joint 3 and x2 along the common normal",
        "x3 is perpendicular to z2 and z3",
    ]


def test_axes_in_one_line_leave_x_free(rng):
    arm, q = catalogue()["scara"].arm, [0.1, 0.2, 0.05, 0.3]
    choices = list(own_choices(arm, q))
    choices[3] = Choice(choices[3].z, across(rng, np.array([0.0, 0.0, 1.0])))
    assert judge_frames(arm, q, choices)[3].ok


@pytest.mark.parametrize(
    ("choices", "text"),
    [
        ([Choice(Z, X)], "choices: expected 3, for frames 0 to 2, got 1"),
        ([Choice(Z, X), Choice(Z, [0, 0, 0]), Choice(Z, X)], "frame 1, x: expected a direction that is not zero"),
        ([Choice([1, 2], X), Choice(Z, X), Choice(Z, X)], "frame 0, z: expected a direction, three finite numbers"),
    ],
)
def test_what_is_no_direction_is_refused(choices, text):
    with pytest.raises(InputError, match=text):
        judge_frames(PLANAR, [0.0, 0.0], choices)


def test_a_random_direction_is_hardly_ever_legal(rng):
    arm = catalogue()["puma560"].arm
    choices = [Choice(*random_pose(rng)[:2, :3]) for _ in range(7)]
    verdicts = judge_frames(arm, np.zeros(6), choices)
    # Of the last frame z is free, its x is not.
    assert not any(verdict.ok for verdict in verdicts)


@pytest.mark.parametrize(
    ("expected", "got", "kind", "mistake"),
    [
        (0.4318, 0.432, "length", ""),
        (0.4318, -0.4318, "length", "sign"),
        (0.4318, 431.8, "length", "millimetres"),
        (0.4318, 0.0004318, "length", "metres"),
        (0.4318, 0.15, "length", "wrong"),
        (0.3, 0.0, "length", "wrong"),
        (0.0, 0.0004, "length", ""),
        (0.0, 0.001, "length", "wrong"),
        (H, H, "angle", ""),
        (H, -3 * H, "angle", ""),
        (math.pi, -math.pi, "angle", ""),
        (H, -H, "angle", "sign"),
        (0.4, 0.4 - math.pi, "angle", "half turn"),
        (0.4, 0.4 + math.pi, "angle", "half turn"),
        (0.0, math.pi, "angle", "half turn"),
        (H, 90.0, "angle", "degrees"),
        (H, H * math.pi / 180, "angle", "radians"),
        (H, 1.0, "angle", "wrong"),
        (H, None, "angle", "not a number"),
        (H, math.nan, "angle", "not a number"),
        (0.1, math.inf, "length", "not a number"),
    ],
)
def test_mistakes_in_a_cell_have_names(expected, got, kind, mistake):
    verdict = judge_cell(expected, got, kind)
    assert (verdict.ok, verdict.mistake) == (mistake == "", mistake)
    assert verdict.text


def test_lengths_of_a_small_arm_are_judged_by_its_size():
    small = Arm.from_dh([("R", 0.02, 0, 0, 0), ("R", 0.01, 0, 0, 0)])
    assert length_tolerance(small) == pytest.approx(3e-5)
    assert length_tolerance(PLANAR) == 5e-4
    assert length_tolerance(Arm.from_dh([("R", 0, 0, 0, 0)])) == 5e-4
    assert not judge_cell(0.02, 0.0204, "length", length_tolerance(small)).ok
    assert not judge_row(small.rows[0], {"a": 0.0204}, length_tolerance(small))["a"].ok
    assert judge_cell(0.02, 0.02002, "length", length_tolerance(small)).ok


def test_what_is_lawful_for_a_slide_drawn_elsewhere_is_not_called_against_the_rules():
    arm, q = catalogue()["scara"].arm, np.zeros(4)
    choices = list(own_choices(arm, q))
    choices[2] = Choice(choices[2].z, np.cross(choices[2].z, choices[2].x))
    verdict = judge_frames(arm, q, choices)[2]
    assert "must" not in verdict.text
    assert verdict.text == (
        "joint 3 slides and its axis is taken where it is drawn: with it, x2 lies along the common normal of the axes "
        "of joints 2 and 3, 90° away"
    )


def test_a_cell_of_another_kind_is_refused():
    with pytest.raises(UnknownName, match="Available: angle, length"):
        judge_cell(1.0, 1.0, "mass")


def test_swapped_cells_of_a_row_are_recognised():
    row = Row("R", a=0.4, alpha=H, d=0.1, theta=0.2)
    right = {"a": 0.4, "alpha": H, "d": 0.1, "theta": 0.2}
    assert all(verdict.ok for verdict in judge_row(row, right).values())
    lengths = judge_row(row, right | {"a": 0.1, "d": 0.4})
    assert {name: verdict.mistake for name, verdict in lengths.items()} == {
        "a": "swapped",
        "alpha": "",
        "d": "swapped",
        "theta": "",
    }
    angles = judge_row(row, right | {"alpha": 0.2, "theta": H})
    assert angles["alpha"].mistake == angles["theta"].mistake == "swapped"
    assert angles["alpha"].text == "alpha and theta have changed places"
    assert judge_row(row, right | {"a": 0.1})["a"].mistake == "wrong"


def test_equal_cells_are_not_swapped_and_missing_ones_are_no_numbers():
    verdicts = judge_row(Row("R", a=0.3, d=0.3), {"a": 0.3, "d": 0.3, "alpha": 0.0})
    assert [verdicts[name].mistake for name in ("a", "alpha", "d", "theta")] == ["", "", "", "not a number"]
    with pytest.raises(UnknownName, match="cell: unknown name 'beta'"):
        judge_row(Row("R"), {"beta": 1.0})
