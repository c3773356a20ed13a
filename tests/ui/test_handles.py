"""Handles and typed targets offer and take just what the arm's task controls."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from armlab.content.robots import catalogue, own_robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.ik.target import feasible
from armlab.kin.rotations import euler_zyx, rotation_about, rotation_from_axis_angle
from armlab.kin.task import task_named
from armlab.kin.transforms import transform
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.target import PlaceTarget, target_pose, verdict
from armlab.session.state import State, apply
from armlab.ui.pose_fields import typed_component
from armlab.ui.scene import gizmo
from armlab.ui.scene._handle import axes_of, handles_of
from armlab.ui.units import Units

UNITS = Units(Notation())
H = np.pi / 2


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


def test_an_arm_that_can_only_turn_has_a_ring_from_the_start(monkeypatch):
    arm, shown = Arm.from_dh([("R", 0.5, 0, 0, 0)]), []
    monkeypatch.setattr(gizmo, "Handle", lambda *_: SimpleNamespace(show=lambda pose, *how: shown.append(how), held=0))
    gizmo.Gizmo(SimpleNamespace()).show(State.initial(own_robot(arm, "mine")))
    ((handle, _),) = shown
    (ring,) = handles_of(arm, handle)
    assert ring["active_axes"] == (True, True, False)


SCARA = catalogue()["scara"].arm
ACROSS = {
    "the last twist, in a plane": (Arm.from_dh([("R", 1.0, 0, 0, 0), ("R", 0.5, H, 0, 0)], task="xy"), (0.4, 0.5)),
    "a hand in the plane": (
        Arm.from_dh([("R", 1, 0, 0, 0), ("R", 0.5, 0, 0, 0), ("R", 0, H, 0, H)], task="xy phi"),
        (0.4, 0.5, 0.3),
    ),
    "a tool turned on a SCARA": (
        replace(SCARA, tool=transform(rotation_about("y", H), [0.1, 0, 0])),
        catalogue()["scara"].home,
    ),
    "as it stands": (SCARA, catalogue()["scara"].home),
}
"""Arms whose tool has its z axis across that of frame 0, and one with it against it, with a configuration."""


@pytest.mark.parametrize("handle", ["move", "turn"])
@pytest.mark.parametrize(("arm", "q"), ACROSS.values(), ids=ACROSS.keys())
def test_what_is_offered_along_the_axes_of_the_tool_moves_the_target_all_the_way(arm, q, handle):
    pose = np.array(arm.fk(np.array(q)))
    axes = axes_of(arm, handle, "tool", pose)
    for options in handles_of(arm, handle):
        for axis in axes.T[np.array(options["active_axes"])] if handle == "move" else [axes[:, 2]]:
            wanted = np.array(pose)
            if handle == "move":
                wanted[:3, 3] += 0.05 * axis
            else:
                wanted[:3, :3] = rotation_from_axis_angle(axis, 0.5) @ pose[:3, :3]
            np.testing.assert_allclose(feasible(arm, wanted, pose), wanted, atol=1e-9)


def test_a_scara_s_handle_has_the_axes_of_its_tool_where_they_serve():
    pose = np.array(SCARA.fk(np.array(catalogue()["scara"].home)))
    np.testing.assert_array_equal(axes_of(SCARA, "turn", "tool", pose), pose[:3, :3])


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
