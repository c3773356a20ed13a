"""Handles and typed targets offer and take just what the arm's task controls."""

from dataclasses import replace

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.rotations import euler_zyx, rotation_about
from armlab.kin.task import task_named
from armlab.kin.transforms import transform
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.target import PlaceTarget, target_pose, verdict
from armlab.session.state import State, apply
from armlab.ui.pose_fields import typed_component
from armlab.ui.scene._handle import handles_of
from armlab.ui.units import Units

UNITS = Units(Notation())


@pytest.mark.parametrize(
    ("key", "axes", "rings"),
    [
        ("planar_2r", (True, True, False), 0),
        ("planar_3r", (True, True, False), 1),
        ("scara", (True, True, True), 1),
        ("elbow_3r", (True, True, True), 0),
        ("cartesian_3p", (True, True, True), 0),
        ("puma560", (True, True, True), 1),
    ],
)
def test_the_handles_fit_the_task(key, axes, rings):
    arm = catalogue()[key].arm
    (move,) = handles_of(arm, "move")
    assert move["active_axes"] == axes
    assert move["disable_rotations"]
    # In a plane there is a square to move in it freely.
    assert move["disable_sliders"] == (sum(axes) != 2)
    turn = handles_of(arm, "turn")
    assert len(turn) == rings
    assert all(options["disable_axes"] and options["disable_sliders"] for options in turn)


def test_a_scara_turns_about_z_only():
    (ring,) = handles_of(catalogue()["scara"].arm, "turn")
    assert ring["active_axes"] == (True, True, False)


def test_a_direction_is_turned_about_two_axes():
    arm = replace(catalogue()["puma560"].arm, task=task_named("xyz approach"))
    assert [ring["active_axes"] for ring in handles_of(arm, "turn")] == [(False, True, True), (True, False, True)]


@pytest.fixture
def state():
    return State.initial(catalogue()["puma560"])


@pytest.mark.parametrize(
    ("cell", "text", "entry", "value"),
    [
        ("x", "500", (0, 3), 0.5),
        ("z", " 12,5 ", (2, 3), 0.0125),
        ("y", "−40", (1, 3), -0.04),
        ("y", "1e2", (1, 3), 0.1),
    ],
)
def test_typed_numbers_are_taken(state, cell, text, entry, value):
    assert typed_component(state[Joints].arm, target_pose(state), cell, text, UNITS)[entry] == pytest.approx(value)


def test_a_typed_angle_changes_only_that_angle(state):
    before = euler_zyx(target_pose(state)[:3, :3])[0]
    after = euler_zyx(typed_component(state[Joints].arm, target_pose(state), "pitch", "35", UNITS)[:3, :3])[0]
    np.testing.assert_allclose(after, [before[0], np.radians(35.0), before[2]], atol=1e-9)


@pytest.mark.parametrize("text", ["", "abc", "nan", "inf", "-inf", "1e999", "1 2", "0x10", "<b>", "1_000"])
def test_what_is_no_number_is_refused(state, text):
    with pytest.raises(InputError, match="x: expected "):
        typed_component(state[Joints].arm, target_pose(state), "x", text, UNITS)


@pytest.mark.parametrize(("cell", "text"), [("x", "1e7"), ("yaw", "4000")])
def test_absurd_numbers_are_refused(state, cell, text):
    with pytest.raises(InputError, match="expected at most"):
        typed_component(state[Joints].arm, target_pose(state), cell, text, UNITS)


@pytest.mark.parametrize("cell", ["", "zz", "xy", "xyz", "yz", "q", "Yaw"])
def test_components_that_are_none_are_refused(state, cell):
    with pytest.raises(UnknownName, match="component: unknown name"):
        typed_component(state[Joints].arm, target_pose(state), cell, "1", UNITS)


def test_an_arm_on_the_wall_is_told_its_target_in_its_own_frame(state):
    """A planar arm in the world's xz plane: what is typed as y is what its second coordinate can do."""
    planar = catalogue()["planar_2r"]
    base = transform(rotation_about("x", np.pi / 2))
    arm = Arm.from_dh(planar.arm.rows, base=base, limits=planar.arm.limits, task="xy")
    wall = State.initial(replace(planar, arm=arm))
    wanted = typed_component(wall[Joints].arm, target_pose(wall), "y", "300", UNITS)
    before, after = target_pose(wall)[:3, 3], wanted[:3, 3]
    np.testing.assert_allclose(after, [before[0], before[1], 0.3], atol=1e-12)
    assert apply(wall, PlaceTarget(wanted)).derived(verdict).reached
