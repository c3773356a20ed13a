"""The page of pose accuracy: AP and RP of the present arm, what the examples say, and the cloud in the scene."""

import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.sensor.pose.commands import MoveAgain
from armlab.benches.sensor.pose.examples import EXAMPLES, ChoosePoseExample
from armlab.benches.sensor.pose.facts import FACTS
from armlab.benches.sensor.pose.state import Repeats, found
from armlab.benches.sensor.pose.ui.cloud import SEEN, around, cloud_of, magnification
from armlab.benches.sensor.pose.ui.page import _angle, _verdict
from armlab.benches.sensor.pose.ui.scene import marks, words
from armlab.content.robots import catalogue
from armlab.kin.sensors.pose_accuracy import PoseFigures
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, TypeJoint
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.units import Units
from support.arms import random_pose, wrist_alone
from support.done import done
from support.filled import Filled

ARMS = ["planar_2r", "puma560", "scara", "cartesian_3p", "iiwa7"]


def opened(robot, *commands):
    return done(State.initial(catalogue()[robot]), *commands)


def fact(state, name):
    return FACTS.facts[name].now(state).value


@pytest.mark.parametrize("robot", ARMS)
def test_ap_and_rp_are_those_of_the_standard(robot):
    """Against the formulas of the standard, written out on the attained joint values once more."""
    state = opened(robot, Set(Repeats, "times", 40))
    arm, q = state[Joints].arm, state[Joints].q
    positions = np.array([arm.position(each) for each in found(state).q])
    x, y, z = positions.T
    x_c, y_c, z_c = arm.position(q)
    ap = math.sqrt((x.mean() - x_c) ** 2 + (y.mean() - y_c) ** 2 + (z.mean() - z_c) ** 2)
    distance = np.sqrt((x - x.mean()) ** 2 + (y - y.mean()) ** 2 + (z - z.mean()) ** 2)
    s = math.sqrt(float(((distance - distance.mean()) ** 2).sum()) / (40 - 1))
    assert fact(state, "accuracy") == pytest.approx(ap, abs=1e-12)
    assert fact(state, "repeatability") == pytest.approx(distance.mean() + 3.0 * s, abs=1e-12)
    assert fact(state, "expected_spread") == pytest.approx(math.sqrt(float((distance**2).mean())), rel=0.4)


@pytest.mark.parametrize("robot", ARMS)
def test_the_examples_show_what_they_say(robot):
    figures = {key: opened(robot, ChoosePoseExample(key)) for key in EXAMPLES}
    assert figures["usual"][Repeats] == opened(robot)[Repeats]
    same, either = figures["same_side"], figures["either_side"]
    # An error of accuracy from one side, and of repeatability from either.
    assert fact(same, "accuracy") > 5.0 * fact(same, "repeatability")
    assert fact(either, "repeatability") > 5.0 * fact(same, "repeatability")
    assert fact(either, "repeatability") > fact(either, "accuracy")
    zeros = figures["zeros"]
    assert fact(zeros, "accuracy") > 100.0 * fact(zeros, "repeatability")
    link = figures["link_encoder"]
    on_motor = apply(link, Set(Repeats, "shaft", "motor"))
    assert fact(link, "repeatability") == pytest.approx(100.0 * fact(on_motor, "repeatability"), rel=0.05)
    if state_turns(link):
        assert math.degrees(fact(link, "count")) == pytest.approx(0.088, abs=1e-3)


@pytest.mark.parametrize("robot", ARMS)
@pytest.mark.parametrize("example", ["same_side", "either_side"])
def test_an_encoder_on_the_link_sees_the_backlash(robot, example):
    """Only counts are left, as on the page Joint drive: half of one at each joint, at most."""
    state = opened(robot, ChoosePoseExample(example))
    link = done(state, Set(Repeats, "counts", 10_000_000), Set(Repeats, "shaft", "link"))
    joints, part = link[Joints], link[Repeats]
    off = np.abs(found(link).q - joints.q)
    assert (off <= 0.5 * part.errors(joints.arm).count * (1.0 + 1e-6)).all()
    for figure in ("accuracy", "repeatability", "expected_spread"):
        assert fact(link, figure) < 0.05 * max(fact(state, "accuracy"), fact(state, "repeatability"))


def state_turns(state):
    return bool(state[Joints].arm.revolute[0])


def test_the_figures_follow_the_arm():
    state = opened("planar_2r")
    folded = apply(apply(state, TypeJoint(0, 0.3)), TypeJoint(1, 3.0))
    assert fact(folded, "expected_spread") < 0.6 * fact(state, "expected_spread")


def test_moving_again_changes_the_attempts_and_nothing_else():
    state = opened("puma560")
    again = apply(state, MoveAgain())
    assert again[Repeats].seed == state[Repeats].seed + 1
    assert fact(again, "accuracy") != fact(state, "accuracy")
    assert abs(fact(again, "accuracy") - fact(state, "accuracy")) < fact(state, "repeatability")  # the same zeros
    other = apply(state, Set(Repeats, "specimen", 5))
    assert abs(fact(other, "accuracy") - fact(state, "accuracy")) > 2.0 * fact(state, "repeatability")
    assert fact(again, "expected_spread") == pytest.approx(fact(state, "expected_spread"))
    assert apply(opened("puma560", Set(Repeats, "seed", 1_000_000)), MoveAgain())[Repeats].seed == 0


def test_the_joint_that_spreads_most_is_named():
    state = opened("planar_2r")
    shares = fact(state, "shares")
    assert fact(state, "largest_share") == int(np.argmax(shares)) + 1 == 1
    assert fact(state, "expected_spread") == pytest.approx(math.hypot(*shares))


@pytest.mark.parametrize("robot", ARMS)
def test_the_cloud_is_seen_and_true_to_the_errors(robot):
    for key in EXAMPLES:
        state = opened(robot, ChoosePoseExample(key))
        cloud, figures = cloud_of(state), found(state).figures
        reach = state[Joints].arm.reach
        away = np.linalg.norm(cloud.points - cloud.commanded, axis=1)
        assert away.max() <= SEEN * reach * (1.0 + 1e-9)
        assert np.linalg.norm(cloud.mean - cloud.commanded) == pytest.approx(
            cloud.magnification * figures.position.accuracy, rel=1e-9
        )
        assert cloud.radius == pytest.approx(cloud.magnification * figures.position.repeatability)
        assert words(cloud).startswith("errors × ")
        assert marks(cloud, reach).label == words(cloud)
        low, high = around(state)
        assert (low <= cloud.points.min(axis=0) + 1e-12).all()
        assert (high >= cloud.points.max(axis=0) - 1e-12).all()


def test_magnifications_are_round_and_bounded():
    assert [magnification(error, 1.0) for error in (1e-4, 3e-5, 0.07, 0.0, 1e-30)] == [1000, 2000, 2, 1, 1e9]
    assert magnification(1.0, 1.0) == 1.0


def test_an_arm_without_errors_has_no_arrow():
    exact = opened(
        "planar_2r",
        Set(Repeats, "counts", 100_000_000),
        Set(Repeats, "backlash", 0.0),
        Set(Repeats, "zero", 0.0),
    )
    assert fact(exact, "accuracy") < 1e-9
    assert np.isfinite(cloud_of(exact).points).all()


@pytest.mark.parametrize("base", [np.eye(4), random_pose(np.random.default_rng(4))])
def test_a_wrist_whose_tool_stays_in_place_is_not_said_to_be_without_error(base):
    robot = replace(catalogue()["planar_3r"], arm=wrist_alone(base))
    attained = found(State.initial(robot))
    assert np.abs(attained.figures.turn_accuracy).max() > 1e-4
    assert "No error of the position" in str(_verdict(attained))
    exact = [Set(Repeats, name, 0.0) for name in ("backlash", "zero")]
    state = done(State.initial(robot), Set(Repeats, "counts", 100_000_000), *exact)
    assert "No error of the position" in str(_verdict(found(state)))


def test_an_arm_whose_joints_do_not_move_is_without_error():
    still = found(opened("planar_2r"))
    pose = still.figures.commanded
    assert "No error<" in str(_verdict(replace(still, figures=PoseFigures(pose, np.array([pose, pose])))))


def test_only_fields_that_the_arm_has_are_shown():
    cells = {robot: set(re_cells(Filled("pose_accuracy", robot))) for robot in ("planar_2r", "cartesian_3p", "scara")}
    assert {"backlash", "zero"} <= cells["planar_2r"]
    assert not {"play", "zero_slide"} & cells["planar_2r"]
    assert not {"backlash", "zero"} & cells["cartesian_3p"]
    assert {"backlash", "zero", "play", "zero_slide"} <= cells["scara"]


def re_cells(page):
    return (cell for _, cell, _ in page._page.controls("input"))


def test_what_is_said_of_the_figures():
    page = Filled("pose_accuracy")
    assert "More repeatable than accurate" in page.text
    page.fill("example", "either_side")
    assert "Accurate on the mean, not repeatable" in page.text
    assert "with n = 30" in page.text
    page.fill("shaft link")
    assert "gears 1" not in page.text
    assert "sees the play of the gears" in page.text


def test_small_figures_are_written_with_a_power_of_ten():
    units = Units(Notation(angle="rad", length="m"))
    assert [_angle(value, units) for value in (5.89e-7, -1.27e-6, 1.76e-3, 0.0)] == [
        "5.89·10⁻⁷ rad",
        "−1.27·10⁻⁶ rad",
        "0.00176 rad",
        "0 rad",
    ]


@pytest.mark.parametrize(
    ("cell", "text", "words"),
    [
        ("times", "1e9", "times: expected a whole number from 2 to 1000, got '1e9'"),
        ("times", "1", "times: expected a whole number from 2 to 1000, got '1'"),
        ("counts", "0", "encoder counts in a turn: expected a whole number from 4 to 100000000, got '0'"),
        ("ratio", "0", "n (gear ratio): expected a number greater than 0 and at most 100000, got '0'"),
        ("backlash", "-1", "backlash of turning joints: expected a number in ° from 0 to 5, got '-1'"),
    ],
)
def test_bad_input_is_said_at_its_field_and_all_stays_as_it_was(cell, text, words):
    page = Filled("pose_accuracy")
    before = page.state
    page.fill(cell, text)
    assert words in page.text
    assert page.state is before
