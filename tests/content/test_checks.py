"""The kinds of checks a lesson can have."""

import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.content.check import read_check, read_state_check
from armlab.content.checks.within_seconds import WithinSeconds
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import catalogue
from armlab.errors import ContentError


def check(text, robot="planar_2r"):
    table = Table.parse("f.md", text)
    table.where = "step 1.check"
    return read_check(table, catalogue()[robot])


def seen(q_deg, robot="planar_2r"):
    return Observation.of(catalogue()[robot].arm, np.radians(q_deg))


def test_a_place_is_marked_where_the_author_says_so():
    place = 'kind = "tool_at"\nposition = [1, 1, 0]\ntolerance_m = 0.05\n'
    robot = catalogue()["planar_2r"]

    def goals(text):
        return read_state_check(Table.parse("f.md", text), robot, str).goals

    assert goals(place) == ()
    (goal,) = goals(f"{place}marked = true")
    assert (goal.position.tolist(), goal.within) == ([1.0, 1.0, 0.0], 0.05)
    other = 'kind = "all_of"\n[[checks]]\nkind = "singular"\nwant = false\n[[checks]]\n'
    assert len(goals(f"{other}{place}marked = true")) == 1
    with pytest.raises(ContentError, match=r"step 1\.check\.marked: expected true or false, got 1"):
        check(f"{place}marked = 1")


def test_whole_turns_of_a_configuration_count_where_the_lesson_says_so():
    asked = check('kind = "joints_at"\nq_deg = [270, 0, 0, 0, 0, 0]\ntolerance_deg = 2\nturns = true', "ur5e")
    assert asked.is_met(seen([269, 0, 0, 0, 0, 0], "ur5e"))
    back = seen([-90, 0, 0, 0, 0, 0], "ur5e")
    assert not asked.is_met(back)
    assert asked.says(back) == "The pose is the right one, but a joint is a whole turn away."


def test_the_tool_at_a_point_names_mistakes():
    asked = check('kind = "tool_at"\nposition = [1.5, 0.5, 0]\ntolerance_m = 0.01')
    arm = catalogue()["planar_2r"].arm

    def says(x, y):
        r = math.hypot(x, y)
        q2 = math.acos((r * r - 2) / 2)
        q1 = math.atan2(y, x) - q2 / 2
        return asked.says(Observation.of(arm, [q1, q2]))

    assert "y has the wrong sign" in says(1.5, -0.5)
    assert "x has the wrong sign" in says(-1.5, 0.5)
    assert "the opposite way" in says(-1.5, -0.5)
    assert "x and y are exchanged" in says(0.5, 1.5)
    assert says(1.5, 0.3) == (
        "The tool is 0.200 m away from (1.500, 0.500, 0.000) m: y is 0.300 m and should be 0.500 m."
    )
    assert says(1.5, 0.5) == "The tool is where it should be."


def test_the_angle_of_the_tool_counts_when_it_is_asked_for():
    asked = check('kind = "tool_at"\nposition = [1, 1, 0]\ntolerance_m = 0.02\nphi_deg = 0\ntolerance_deg = 2')
    assert asked.is_met(seen([90, -90]))
    assert asked.is_met(seen([90.5, -89.5]))
    assert not asked.is_met(seen([0, 90]))
    assert asked.says(seen([0, 90])) == (
        "The position is right; the angle φ is not: rotate the tool 90.0° clockwise. "
        "The arm stands in the mirror branch: bend the elbow the other way."
    )
    with pytest.raises(ContentError, match="tolerance_deg: expected phi_deg with it"):
        check('kind = "tool_at"\nposition = [1, 1, 0]\ntolerance_m = 0.01\ntolerance_deg = 2')


def test_a_joint_at_a_value():
    asked = check('kind = "joint_at"\njoint = 2\nvalue_deg = 60\ntolerance_deg = 1')
    assert asked.is_met(seen([10, 60.9]))
    assert not asked.is_met(seen([60, 58.9]))
    assert asked.says(seen([60, 10])) == "Joint 2 is at 10.0° and should be at 60.0°."
    assert asked.says(seen([60, -60])).endswith(
        "should be at 60.0°. The sign is wrong: positive angles turn counter-clockwise about the joint's axis."
    )
    across = check('kind = "joint_at"\njoint = 1\nvalue_deg = 180\ntolerance_deg = 1')
    assert across.is_met(seen([-179.5, 0]))


def test_a_joint_that_an_edited_table_has_no_more():
    asked = check('kind = "joint_at"\njoint = 3\nvalue_deg = 10\ntolerance_deg = 1', "planar_3r")
    assert not asked.is_met(seen([10, 10]))
    assert asked.says(seen([10, 10])) == "The arm has no joint 3."


def test_degrees_taken_for_radians():
    asked = check('kind = "joint_at"\njoint = 2\nvalue_deg = 60\ntolerance_deg = 1')
    assert asked.says(seen([0, math.radians(60)])).endswith(" That is the number of radians, taken for degrees.")
    assert "radians" not in asked.says(seen([0, 0]))


def test_a_sliding_joint_is_in_metres():
    text = 'kind = "joint_at"\njoint = 3\nvalue_m = 0.1\ntolerance_m = 0.005'
    asked = check(text, "scara")
    arm = catalogue()["scara"].arm
    assert asked.is_met(Observation.of(arm, [0, 1, 0.104, 0]))
    assert asked.says(Observation.of(arm, [0, 1, 0.12, 0])) == "Joint 3 is at 0.120 m and should be at 0.100 m."
    with pytest.raises(ContentError, match=r"f\.md: step 1\.check\.value_m: outside the limits of joint 3"):
        check(text.replace("0.1\n", "9\n"), "scara")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (
            'kind = "joint_at"\njoint = 3\nvalue_deg = 0\ntolerance_deg = 1',
            "joint: expected a joint from 1 to 2, got 3",
        ),
        ('kind = "joint_at"\njoint = 1.5\nvalue_deg = 0\ntolerance_deg = 1', "joint: expected a joint from 1 to 2"),
        ('kind = "joint_at"\njoint = 1\nvalue = 0\ntolerance_deg = 1', "value: the unit belongs into the name"),
        (
            'kind = "joint_at"\njoint = 1\nvalue_deg = 200\ntolerance_deg = 1',
            "value_deg: outside the limits of joint 1",
        ),
        ('kind = "manipulability_at_least"\nvalue = 0', "value: expected a positive number, got 0"),
        ('kind = "manipulability_at_least"\nvalue = 1\nunit = "m"', "unit: unknown key"),
    ],
)
def test_mistakes_in_checks(text, says):
    with pytest.raises(ContentError, match=f"step 1.check.{says}"):
        check(text)


def test_manipulability_is_sin_q2_for_the_planar_arm():
    asked = check('kind = "manipulability_at_least"\nvalue = 0.5')
    assert asked.is_met(seen([10, 30.1]))
    assert not asked.is_met(seen([10, 29.9]))
    assert asked.says(seen([10, 20])) == "The manipulability is 0.342 and should be at least 0.500."
    assert asked.says(seen([10, 0])).endswith("The arm is singular here.")


@pytest.mark.parametrize(
    ("kind", "limit", "q2", "says"),
    [
        ("at_most", 0.5, 30.002, "is 0.50003 and should be at most 0.50000."),
        ("at_most", 0.0004, 90, "is 1.0000 and should be at most 0.0004."),
        ("at_least", 0.5, 29.99, "is 0.4998 and should be at least 0.5000."),
        ("at_least", 0.0004, 0.01, "is 0.0002 and should be at least 0.0004."),
    ],
)
def test_a_manipulability_that_misses_its_limit_by_little_is_told_apart_from_it(kind, limit, q2, says):
    asked = check(f'kind = "manipulability_{kind}"\nvalue = {limit}')
    assert asked.says(seen([10, q2])) == f"The manipulability {says}"


def test_a_time_beyond_its_limit_is_told_as_more():
    def said(seconds):
        return WithinSeconds(30.0).says(replace(seen([0, 0]), seconds=seconds)).partition(" s")[0]

    assert list(map(said, (29.96, 30.0, 30.02, 61.0))) == ["In time: 29.9", "In time: 30", "It took 30.1", "It took 61"]


def test_an_observation_is_of_the_tool():
    arm = catalogue()["puma560"].arm
    q = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
    np.testing.assert_array_equal(Observation.of(arm, q).tool_pose, arm.fk(q))


@pytest.mark.parametrize("kind", ["joint_at", "joints_at", "joints_found"])
def test_a_joint_on_the_edge_of_its_tolerance_is_within_it(kind):
    for value in range(-90, 91, 5):
        asked = f"joint = 1\nvalue_deg = {value}" if kind == "joint_at" else f"q_deg = [{value}, 0]"
        one = check(f'kind = "{kind}"\n{asked}\ntolerance_deg = 1')
        assert one.is_met(seen([value + 1, 0]))
        assert one.is_met(seen([value - 1, 0]))
        assert not one.is_met(seen([value + 1.0001, 0]))


def test_a_slide_on_the_edge_of_its_tolerance_is_within_it():
    slide = catalogue()["cartesian_3p"]
    for tenth in range(4, 9):
        one = check(f'kind = "joint_at"\njoint = 1\nvalue_m = 0.{tenth}\ntolerance_m = 0.1', "cartesian_3p")
        edges = [Observation.of(slide.arm, [value, 0.3, 0.5]) for value in (0.1 * (tenth + 1), 0.1 * (tenth - 1))]
        assert [one.is_met(edge) for edge in edges] == [True, True]
        assert not one.is_met(Observation.of(slide.arm, [0.1 * (tenth + 1) + 1e-6, 0.3, 0.5]))


ON_EDGE = {
    "tool_at": "position = {place}",
    "tool_pose": "position = {place}\nrotation = [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]\ntolerance_deg = 1",
    "on_line": "point = {place}\ndirection = [1, 0, 0]",
}


@pytest.mark.parametrize("kind", list(ON_EDGE))
def test_a_tool_on_the_edge_of_its_tolerance_is_within_it(kind):
    arm = catalogue()["cartesian_3p"].arm
    for height in (0.3, 0.5, 0.6, 0.7):
        for away in (0.1, 0.05, 0.01):
            place = f"[0.4, 0.2, {height + away}]"
            one = check(f'kind = "{kind}"\n{ON_EDGE[kind].format(place=place)}\ntolerance_m = {away}', "cartesian_3p")
            assert one.is_met(Observation.of(arm, [height, 0.2, 0.4]))
            assert not one.is_met(Observation.of(arm, [height - 1e-6, 0.2, 0.4]))
