"""A lesson written for an arm as it stands: it reads back, its start is no solution, its solution is."""

import math
import re

import numpy as np
import pytest

from armlab.benches.lessons.author.write_lesson import NumberAsked, lesson_text
from armlab.content.lesson_file import parse_lesson
from armlab.content.observation import Observation
from armlab.content.robots import OWN, Camera, catalogue, own_robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm

ROBOTS = catalogue().robots


def read(text):
    return parse_lesson("written", text)


def assert_is_a_task(lesson, arm, q):
    check = lesson.steps[0].check
    (move,) = lesson.steps[0].solution
    np.testing.assert_allclose(move.q, q, rtol=0, atol=1e-12)
    assert check.judge(Observation.of(arm, move.q))[0]
    assert not check.judge(Observation.of(arm, lesson.start))[0]
    assert lesson.steps[0].hints


@pytest.mark.parametrize("key", list(ROBOTS))
def test_every_robot_at_any_place(key, rng):
    robot = ROBOTS[key]
    low, high = robot.arm.limits.T
    places = [rng.uniform(low, high), low, high, (low + high) / 2, *robot.poses.values()]
    for q in places:
        lesson = read(lesson_text("A goal", robot, q))
        assert lesson.robot_used is robot
        assert_is_a_task(lesson, robot.arm, q)


@pytest.mark.parametrize("key", list(ROBOTS))
def test_every_robot_as_an_arm_of_ones_own(key, rng):
    robot = own_robot(ROBOTS[key].arm, 'My "arm"', ROBOTS[key])
    q = rng.uniform(robot.arm.limits[:, 0], robot.arm.limits[:, 1])
    lesson = read(lesson_text("A goal", robot, q))
    arm = lesson.robot_used.arm
    assert (lesson.robot, lesson.robot_used.name, lesson.robot_used.family) == (OWN, 'My "arm"', robot.family)
    np.testing.assert_allclose(arm.fk(q), robot.arm.fk(q), rtol=0, atol=1e-12)
    np.testing.assert_allclose(arm.limits, robot.arm.limits, rtol=0, atol=1e-12)
    assert (arm.convention, arm.task.key) == (robot.arm.convention, robot.arm.task.key)
    assert_is_a_task(lesson, robot.arm, q)


def test_everything_that_is_shown_comes_back():
    robot, target = ROBOTS["puma560"], np.array(ROBOTS["puma560"].arm.fk(ROBOTS["puma560"].home))
    text = lesson_text(
        'The "goal"',
        robot,
        robot.home + 0.3,
        panel="joints",
        overlays=["frames", "trace"],
        target=target,
        camera=Camera(-40.0, 30.5, 1.25),
        answers=[NumberAsked("How far is $p_x$?", 0.5, "m", 0.01), NumberAsked("How many joints?", 6, "", 0.1)],
    )
    lesson = read(text)
    assert (lesson.title, lesson.panel, lesson.overlays) == ('The "goal"', "joints", ("frames", "trace"))
    np.testing.assert_allclose(lesson.target, target, rtol=0, atol=1e-6)
    assert lesson.camera == Camera(-40.0, 30.5, 1.25)
    np.testing.assert_array_equal(lesson.start, robot.home)
    assert len(lesson.steps) == 3
    assert lesson.steps[1].question.judge("50 cm").right
    assert lesson.steps[2].question.judge("6").right


def test_the_start_is_home_and_elsewhere_where_home_is_the_goal():
    robot = ROBOTS["planar_2r"]
    np.testing.assert_array_equal(read(lesson_text("x", robot, [0.1, 0.2])).start, robot.home)
    np.testing.assert_array_equal(read(lesson_text("x", robot, robot.home)).start, robot.poses["stretched"])


def test_a_start_with_the_tool_at_the_goal_is_none():
    # Elbow up and elbow down have the tool in one place: the first pose does not do as a start.
    robot = own_robot(ROBOTS["planar_2r"].arm, "x")
    down = [np.radians(95), np.radians(-55)]
    both = type(robot)(**{**vars(robot), "poses": {"up": np.radians([40, 55]), "other": np.radians([10, 10])}})
    lesson = read(lesson_text("x", both, down))
    np.testing.assert_allclose(lesson.start, np.radians([10, 10]), rtol=0, atol=1e-12)


def test_an_arm_whose_tool_stays_where_it_is_is_asked_for_its_joints():
    arm = Arm.from_dh([("R", 0, 0, 0.3, 0)], task="xy")
    lesson = read(lesson_text("x", own_robot(arm, "Spinning"), [0.5]))
    assert "joints" in lesson.steps[0].html
    assert_is_a_task(lesson, arm, [0.5])


def test_texts_that_look_like_expressions():
    robot = own_robot(ROBOTS["planar_2r"].arm, "= {{=x}} {{q1}}")
    lesson = read(lesson_text("== {{=a}} \\ \x7f", robot, [0.5, 0.5], answers=[NumberAsked("= {{=x}}?", 1, "m", 0.1)]))
    assert lesson.title == "{ {=a}} \\ \x7f"
    assert lesson.robot_used.name == "{ {=x}} { {q1}}"


@pytest.mark.parametrize(
    ("q", "answers", "says"),
    [
        ([0.1], (), "q: "),
        ([0.1, np.nan], (), "q: "),
        ([0.1, 9.0], (), "inside the joint limits of Planar 2R"),
        ([0.1, 0.2], [NumberAsked("x", 1.0, "mile", 0.1)], "unit of a question: unknown name 'mile'"),
        ([0.1, 0.2], [NumberAsked("$\\foo$", 1.0, "m", 0.1)], "the lesson cannot be written: the formula"),
        ([0.1, 0.2], [NumberAsked("x", 1.0, "m", -1)], "the lesson cannot be written: expected a positive number"),
    ],
)
def test_what_cannot_be_written(q, answers, says):
    with pytest.raises((InputError, UnknownName), match=says):
        lesson_text("x", ROBOTS["planar_2r"], q, answers=answers)


def test_an_arm_that_cannot_move():
    arm = Arm.from_dh([("R", 1, 0, 0, 0)], limits=[[0.0, 0.0]])
    with pytest.raises(InputError, match="has only this configuration"):
        lesson_text("x", own_robot(arm, "Fixed"), [0.0])


def test_joint_values_have_no_crumbs_of_rounding():
    robot = catalogue()["planar_2r"]
    text = lesson_text("T", robot, [1.0471975511965979, math.radians(30.1) + 1e-16])
    assert "60.0000" not in text
    assert re.search(r"^q_deg = \[60, 30\.1\]$", text, re.MULTILINE)


@pytest.mark.parametrize("size", [2.0, 0.1, 0.02, 1e-3])
@pytest.mark.parametrize("kinds", ["RR", "PRP"])
def test_the_place_that_a_task_tells_meets_its_check_for_small_arms_too(size, kinds):
    turned = [("R", size, 0.0, 0.0, 0.0), ("R", 0.7 * size, 0.0, 0.0, 0.0)]
    rows = turned if kinds == "RR" else [("P", 0.0, math.pi / 2, 0.0, 0.0), *turned[:1], ("P", 0.0, 0.0, 0.0, 0.0)]
    limits = [[-size, size] if kind == "P" else [-math.pi, math.pi] for kind in kinds]
    robot = own_robot(Arm.from_dh(rows, limits=limits), "Small", ROBOTS["planar_2r"])
    q = np.where(robot.arm.revolute, 0.713, 0.37123 * size)
    text = lesson_text("A goal", robot, q)
    told = re.search(r"Bring the hand to \((.*?)\) m", text)
    goal, within = (re.search(rf"{key} = (.*)", text)[1] for key in ("position", "tolerance_m"))
    place = [float(each.replace("−", "-")) for each in told[1].split(",")]
    assert np.linalg.norm(np.subtract(place, [float(each) for each in goal[1:-1].split(",")])) < 0.5 * float(within)
