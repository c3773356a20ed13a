"""What is written is read back as the same arm."""

from dataclasses import replace

import numpy as np
import pytest

from armlab.content import write_robot
from armlab.content.robots import (
    DEFAULT_CAMERA,
    FAMILIES,
    catalogue,
    family_of,
    own_robot,
    parse_robot,
)
from armlab.content.write_robot import robot_toml
from armlab.errors import ContentError, InputError
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_from_sequence
from armlab.kin.task import Task
from armlab.kin.transforms import transform
from support.arms import random_arm, random_q

LAST_PLACE = 1e-15
"""Relative. Angles go through degrees; lengths come back exactly."""

ONE_JOINT = """
name = "One"
family = "planar"
summary = "One joint."
convention = "standard"
source = "Made up for a test."
[[joints]]
type = "R"
a = 1.0
limits_deg = [30, 90]
"""


def same_arm(read, arm):
    assert read.convention == arm.convention
    assert read.task == arm.task
    assert read.name == arm.name
    for got, row in zip(read.rows, arm.rows, strict=True):
        assert (got.kind, got.a, got.d) == (row.kind, row.a, row.d)
        np.testing.assert_allclose((got.alpha, got.theta), (row.alpha, row.theta), rtol=LAST_PLACE, atol=0)
    for field in ("limits", "speed_limits", "acceleration_limits"):
        np.testing.assert_allclose(getattr(read, field), getattr(arm, field), rtol=LAST_PLACE, atol=0)
    for field in ("base", "tool"):
        got, pose = getattr(read, field), getattr(arm, field)
        np.testing.assert_array_equal(got[:3, 3], pose[:3, 3])
        np.testing.assert_allclose(got[:3, :3], pose[:3, :3], rtol=0, atol=LAST_PLACE)


def same_poses(read, robot):
    assert list(read.poses) == list(robot.poses)
    for name, q in robot.poses.items():
        np.testing.assert_allclose(read.poses[name], q, rtol=LAST_PLACE, atol=0)


def test_every_robot_of_the_lab(robot):
    read = parse_robot(robot.key, robot_toml(robot))
    same_arm(read.arm, robot.arm)
    same_poses(read, robot)
    for word in ("key", "name", "family", "summary", "source", "camera"):
        assert getattr(read, word) == getattr(robot, word)
    for got, expected in zip(read.expected, robot.expected, strict=True):
        np.testing.assert_allclose(got.q, expected.q, rtol=LAST_PLACE, atol=0)
        np.testing.assert_array_equal(got.T, expected.T)
        assert (got.flange, got.tolerance, got.source) == (expected.flange, expected.tolerance, expected.source)


def test_random_arms_with_limits_speeds_poses_and_task(rng):
    for i in range(150):
        arm = random_arm(rng, int(rng.integers(1, 13)), special=bool(i % 2))
        limits = np.sort(rng.uniform(-4, 4, (arm.n, 2)), axis=1)
        speeds = np.where(rng.random(arm.n) < 0.3, np.inf, rng.uniform(0.1, 9, arm.n))
        arm = replace(arm, limits=limits, speed_limits=speeds, acceleration_limits=3 * speeds, name=f"arm {i}")
        robot = own_robot(arm, arm.name)
        poses = {"home": robot.home, 'a "second" \\ pose': random_q(arm, rng)}
        read = parse_robot("own", robot_toml(replace(robot, poses=poses)), proven=False)
        same_arm(read.arm, arm)
        same_poses(read, replace(robot, poses=poses))


def test_turned_tools_are_written_as_angles_where_these_are_exact_enough(rng):
    for pitch in (0.0, 30.0, 90.0, -90.0, 89.9999999, 90.0 - 1e-7):
        for roll, yaw in rng.uniform(-180, 180, (20, 2)):
            R = rotation_from_sequence("xyz", np.radians([roll, pitch, yaw]), fixed=True)
            arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)], tool=transform(R, [0.1, 0.2, 0.3]))
            same_arm(parse_robot("own", robot_toml(own_robot(arm, "x")), proven=False).arm, replace(arm, name="x"))
    quarter = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)], tool=[[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    assert "rpy_deg = [0, 0, 90]" in robot_toml(own_robot(quarter, "x"))


@pytest.mark.parametrize(("exact", "numbers"), [(0.0, True), (1e-12, False)])
def test_a_rounded_rotation_comes_back_as_the_nearest_one_to_the_last_digits(rng, monkeypatch, exact, numbers):
    """With nine numbers as with three angles; which ones are exact enough differs between processors."""
    monkeypatch.setattr(write_robot, "EXACT", exact)
    texts = []
    for _ in range(100):
        R = rotation_from_sequence("xyz", rng.uniform(-3, 3, 3), fixed=True).round(7)
        arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)], tool=transform(R, [0.1, 0.2, 0.3]), name="x")
        texts.append(robot_toml(own_robot(arm, "x")))
        again = parse_robot("own", texts[-1], proven=False).arm.tool
        np.testing.assert_allclose(again, arm.tool, rtol=0, atol=2e-15)
    assert any("rotation = [[" in text for text in texts) == numbers


def test_a_rotation_that_is_none_is_refused():
    text = ONE_JOINT + "[tool]\nrotation = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]\n"
    with pytest.raises(ContentError, match=r"one\.toml: tool\.rotation: expected a rotation matrix"):
        parse_robot("one", text, proven=False)


@pytest.mark.parametrize("name", ['quotes " and \\', "line\nbreak", "tab\t bell \x07 delete \x7f", "Рука θ₁ 🤖"])
def test_any_name_survives(name):
    robot = own_robot(Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)]), name)
    assert parse_robot("own", robot_toml(robot), proven=False).name == robot.name == robot.arm.name


def test_a_task_without_a_name_is_refused():
    arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 3, task=Task("xy", "full"))
    with pytest.raises(InputError, match="task: expected one with a name"):
        robot_toml(own_robot(arm, "x"))


# --- A student's own arm


def test_an_own_arm_needs_no_proof_and_no_poses():
    robot = parse_robot("one", ONE_JOINT, proven=False)
    assert robot.expected == ()
    assert list(robot.poses) == ["home"]
    np.testing.assert_allclose(robot.home, [np.radians(30)], rtol=0, atol=1e-15)
    with pytest.raises(ContentError, match="give at least one named pose"):
        parse_robot("one", ONE_JOINT)


def test_a_file_without_proof_is_refused_in_the_catalogue():
    text = ONE_JOINT + '[[poses]]\nname = "home"\nq_deg = [40]\n'
    with pytest.raises(ContentError, match="give at least two poses that prove the table, got 0"):
        parse_robot("one", text)
    np.testing.assert_allclose(parse_robot("one", text, proven=False).home, [np.radians(40)], rtol=0, atol=1e-15)


def test_an_edited_arm_keeps_camera_and_poses_that_fit():
    like = catalogue()["planar_2r"]
    narrow = Arm.from_dh(like.arm.rows, limits=np.radians([[-10, 50], [-10, 95]]))
    robot = own_robot(narrow, "Mine", like)
    assert robot.key == "own"
    assert robot.arm.name == robot.name == "Mine"
    assert robot.camera == like.camera
    assert list(robot.poses) == ["home", "stretched", "right angle"]


def test_an_edited_arm_with_another_joint_loses_the_poses():
    like = catalogue()["planar_2r"]
    robot = own_robot(
        Arm.from_dh([*like.arm.rows, ("P", 0.0, 0.0, 0.0, 0.0)], limits=[[0, 1], [-1, 1], [0.2, 1]]), "", like
    )
    assert robot.name == "My arm"
    assert list(robot.poses) == ["home"]
    assert robot.home.tolist() == [0.0, 0.0, 0.2]
    sliding = own_robot(Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("P", 1.0, 0.0, 0.0, 0.0)]), "x", like)
    assert list(sliding.poses) == ["home"]
    assert own_robot(sliding.arm, "x").camera == DEFAULT_CAMERA


def test_families_by_structure_are_those_of_the_files(robot):
    assert family_of(robot.arm) == robot.family


def test_a_twist_makes_an_arm_spatial_unless_it_is_after_the_last_joint():
    flat, twisted = ("R", 1.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.5, 0.0, 0.0)
    assert family_of(Arm.from_dh([flat, twisted])) == FAMILIES[0]
    assert family_of(Arm.from_dh([twisted, flat])) == FAMILIES[1]
    assert family_of(Arm.from_dh([twisted, flat], "modified")) == FAMILIES[0]
