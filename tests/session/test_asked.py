"""The part of a target that counts, and the error that is kept smaller out of reach."""

import json
import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import transform
from armlab.session.asked import asked_arm, asks_of, turned_like, weights_of
from armlab.session.edits import SetCell
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.target import AskFor, DragTarget, EndDrag, PlaceTarget, Target, TargetToTool, verdict
from armlab.session.session import Session, Undo
from armlab.session.state import State, apply

PUMA = catalogue()["puma560"]
HERE = np.array(PUMA.arm.fk(PUMA.home))

OTHER_WAY = HERE @ transform(rotation_about("y", 2.6))
"""The place of the tool, and an orientation that the limits of the wrist do not allow there."""


def opened(robot="puma560", **asked):
    return apply(State.initial(catalogue()[robot]), AskFor(**asked)) if asked else State.initial(catalogue()[robot])


@pytest.mark.parametrize(
    ("robot", "keys"),
    [
        ("puma560", ["", "position", "approach"]),
        ("planar_3r", ["", "position"]),
        ("scara", ["", "position"]),
        ("planar_2r", [""]),
    ],
)
def test_less_than_the_task_of_the_arm_can_be_asked_for(robot, keys):
    arm = catalogue()[robot].arm
    assert list(asks_of(arm)) == keys
    assert asked_arm(arm, "") is arm
    for key in keys[1:]:
        less = asked_arm(arm, key)
        assert less.task.m < arm.task.m
        assert asked_arm(arm, key) is less
    # What the arm has no less of is its own task.
    assert asked_arm(arm, "approach") is (arm if "approach" not in keys else asked_arm(arm, "approach"))


def test_a_place_is_reached_that_with_its_orientation_is_out_of_reach():
    state = apply(opened(), PlaceTarget(OTHER_WAY))
    assert state.derived(verdict).status != "reached"
    less = apply(state, AskFor(asks="position"))
    assert less.derived(verdict).reached
    assert less.derived(verdict).rotation_error == 0.0
    assert "only the position is asked for" in less.derived(verdict).notes
    np.testing.assert_allclose(less[Joints].tool_pose[:3, 3], HERE[:3, 3], atol=2e-6)
    # The orientation of the target is that of the tool, which nobody has asked for.
    np.testing.assert_array_equal(less[Target].pose[:3, :3], less[Joints].tool_pose[:3, :3])


def test_an_approach_direction_is_reached_and_the_turn_about_it_is_the_tools_own():
    turned = HERE @ transform(rotation_about("x", 0.2) @ rotation_about("z", 2.8), [0.0, 0.03, 0.0])
    state = apply(opened(asks="approach"), PlaceTarget(turned))
    assert state.derived(verdict).reached
    tool = state[Joints].tool_pose
    np.testing.assert_allclose(tool[:3, 2], turned[:3, 2], atol=2e-6)
    np.testing.assert_allclose(tool[:3, 3], turned[:3, 3], atol=2e-6)
    # So the whole pose of the target is reached, too, and its solutions have the arm among them.
    assert ik.judge(PUMA.arm, state[Target].pose, state[Joints].q).reached
    assert np.abs(tool[:3, 0] @ turned[:3, 0]) < 0.999


def test_the_favoured_error_is_the_smaller_one_out_of_reach():
    errors = {}
    for favours in ("", "position", "orientation"):
        found = apply(opened(favours=favours), PlaceTarget(OTHER_WAY)).derived(verdict)
        assert found.status != "reached"
        errors[favours] = found.position_error, found.rotation_error
    assert errors["position"][0] < errors[""][0] < errors["orientation"][0]
    assert errors["position"][1] > errors[""][1] > errors["orientation"][1]
    assert weights_of(PUMA.arm, "position") == (1.0, 1.0, 1.0, 0.1, 0.1, 0.1)
    assert weights_of(catalogue()["planar_2r"].arm, "position") is None


def test_what_is_in_reach_is_reached_whatever_is_favoured():
    near = HERE @ transform(rotation_about("y", 0.2), [0.02, 0.0, 0.05])
    for favours in ("position", "orientation"):
        assert apply(opened(favours=favours), PlaceTarget(near)).derived(verdict).reached


def test_a_drag_follows_what_is_asked_for_and_is_one_step_of_undo():
    session = Session.fresh("token", PUMA)
    session.apply(AskFor(asks="position"), 0.0)
    home, drag = session.state[Joints].q, object()
    for k in range(1, 6):
        pose = HERE @ transform(rotation_about("y", 0.5 * k), [0.0, 0.0, 0.01 * k])
        session.apply(DragTarget(pose, drag), 0.05 * k)
    session.apply(EndDrag(pose, drag), 0.3)
    assert session.state.derived(verdict).reached
    np.testing.assert_allclose(session.state[Joints].tool_pose[:3, 3], pose[:3, 3], atol=2e-6)
    session.apply(Undo(), 1.0)
    np.testing.assert_array_equal(session.state[Joints].q, home)
    assert session.state[Target].asks == "position"


def test_the_choice_goes_with_an_edit_but_not_with_another_arm_and_is_written_only_where_it_is_one():
    state = opened(asks="approach", favours="position")
    assert apply(state, SetCell(1, "a", 0.5))[Target].asks == "approach"
    assert apply(state, ChooseRobot("scara"))[Target].asks == ""
    assert set(opened()[Target].to_json()) == {"pose", "axes", "handle", "method"}
    written = json.loads(json.dumps(state[Target].to_json()))
    read = Target.from_json(written, PUMA)
    assert (read.asks, read.favours) == ("approach", "position")
    assert apply(state, TargetToTool()) is state


def test_an_unknown_choice_is_refused():
    for wrong in ({"asks": "colour"}, {"favours": "speed"}):
        with pytest.raises(InputError, match="unknown"):
            apply(opened(), AskFor(**wrong))


def test_a_pose_is_turned_about_its_own_z_axis_to_be_nearest_to_another():
    tool = HERE @ transform(rotation_about("z", math.radians(70.0)))
    np.testing.assert_allclose(turned_like(HERE, tool), tool, atol=1e-12)
    rng = np.random.default_rng(4)
    for _ in range(20):
        angles = rng.uniform(-3.0, 3.0, 3)
        R = rotation_about("z", angles[0]) @ rotation_about("x", angles[1]) @ rotation_about("z", angles[2])
        found = turned_like(transform(R), HERE)[:3, :3]
        np.testing.assert_allclose(found[:, 2], R[:, 2], atol=1e-12)
        best = np.trace(found.T @ HERE[:3, :3])
        around = [np.trace((R @ rotation_about("z", turn)).T @ HERE[:3, :3]) for turn in np.linspace(0.0, 6.28, 200)]
        assert best >= max(around) - 1e-12
