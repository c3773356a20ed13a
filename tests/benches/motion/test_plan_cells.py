"""What a cell of the page Plan asks for, and what is refused in words: text, and joints another arm has not."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.motion.plan.commands import AllMovesLike, SetMove, SetMoveOption
from armlab.benches.motion.plan.examples import TakeExample
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.limits import LastFor, LimitJoint, LimitTool, UseShare
from armlab.benches.motion.plan.points import (
    AddWaypoint,
    CopyWaypoint,
    SelectWaypoint,
    SetWaypointJoint,
    SetWaypointPose,
    ShiftWaypoint,
)
from armlab.benches.motion.plan.ui.limits import time_markup
from armlab.benches.motion.plan.ui.move import move_markup
from armlab.benches.motion.plan.ui.points import points_markup
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import transform
from armlab.session.state import State, apply
from support.done import done
from support.forms import BareForm, asked

STATE = State.initial(catalogue()["planar_2r"])


def typed(cell, text="", state=STATE):
    def page(form):
        return points_markup(form, state) + move_markup(form, state) + time_markup(form, state)

    return asked(page, cell, text)


@pytest.mark.parametrize(
    "command", [SetWaypointJoint(0, 2, 0.1), LimitJoint(9, "velocity", 1.0), LimitJoint(2, "acceleration", 1.0)]
)
def test_a_joint_that_the_arm_has_not_is_refused(command):
    # The page still showed another arm when it was typed.
    with pytest.raises(InputError, match=f"joint: expected 1 to 2, got {command.joint + 1}"):
        apply(STATE, command)


@pytest.mark.parametrize("cell", ["q 2", "vmax 9", "amax 2", "pose zz", "pose ", "pose z", "up-0", "remove-7", "stop"])
def test_a_cell_that_is_not_on_the_page_or_off_asks_for_nothing(cell):
    assert typed(cell, "10") == ()


@pytest.mark.parametrize(
    ("cell", "asks"),
    [
        ("add", AddWaypoint()),
        ("down-0", ShiftWaypoint(0, 1)),
        ("select-0", SelectWaypoint(0)),
        ("copy-1", CopyWaypoint(1)),
        ("named-joint-line", SetMove(1, space="joint", path="line")),
        ("named-cartesian-line", SetMove(1, space="cartesian", path="line")),
        ("named-cartesian-circle", SetMove(1, space="cartesian", path="circle")),
        ("drag", SelectWaypoint(1, True)),
        ("space-cartesian", SetMove(1, space="cartesian")),
        ("apart", SetMove(1, apart=True)),
        ("time-fastest", LastFor(None)),
        ("speed", LimitTool(None)),
    ],
)
def test_what_is_pressed_or_emptied_becomes_a_command(cell, asks):
    assert typed(cell) == (asks,)


def test_what_is_typed_becomes_a_command_in_si_units():
    (joint,) = typed("q 1", "10")
    assert joint == SetWaypointJoint(1, 1, pytest.approx(math.radians(10.0)))
    (pose,) = typed("pose x", "400")
    assert isinstance(pose, SetWaypointPose)
    assert (pose.k, pose.pose[0, 3]) == (1, 0.4)
    assert typed("amax 0", "10") == (LimitJoint(0, "acceleration", pytest.approx(math.radians(10.0))),)
    assert typed("v", "50 ") == (UseShare(velocity=0.5),)
    assert typed("all-like", state=apply(STATE, AddWaypoint())) == (AllMovesLike(2),)


@pytest.mark.parametrize(
    ("cell", "says"),
    [
        ("q 1", "joint 2 of waypoint 2: expected"),
        ("pose x", "x: expected"),
        ("vmax 0", "limit of velocity of joint 1: expected a number in °/s"),
        ("a", "share of the accelerations: expected a number of percent, got 'much'"),
        ("jerk", "jerk time: expected a number"),
    ],
)
def test_a_text_that_is_no_number_is_refused_with_the_name_of_its_field(cell, says):
    with pytest.raises(InputError, match=says):
        typed(cell, "much")


@pytest.mark.parametrize(
    ("commands", "names"),
    [
        ((), ("Move J, or PTP", "joint: straight line · Move J")),
        ((SetMove(1, space="cartesian"),), ("Move L, or LIN", "Cartesian: straight line · Move L")),
        ((SetMove(1, path="spline"),), ()),
    ],
)
def test_moves_have_the_names_of_industrial_robots_where_there_are_some(commands, names):
    state = STATE
    for command in commands:
        state = apply(state, command)
    shown = BareForm()
    shown.show(points_markup(shown, state) + move_markup(shown, state))
    text = str(shown.fields.content)
    assert all(
        f"{name} ({other})" in text for name, other in (("Move J", "PTP"), ("Move L", "LIN"), ("Move C", "CIRC"))
    )
    assert [name for name in ALL_NAMES if name in text] == list(names)


ALL_NAMES = (
    "Move J, or PTP",
    "joint: straight line · Move J",
    "Move L, or LIN",
    "Cartesian: straight line · Move L",
    "Move C, or CIRC",
)


def test_the_list_and_the_fields_of_an_arm_whose_base_is_turned_are_both_in_frame_0():
    robot = catalogue()["planar_2r"]
    base = transform(rotation_about("x", np.pi / 2), [0.2, -0.1, 0.5])
    wall = replace(robot, arm=Arm.from_dh(robot.arm.rows, base=base, limits=robot.arm.limits, task=robot.arm.task))

    def said(arm):
        form = BareForm()
        page = str(points_markup(form, State.initial(arm)))
        return re.findall(r'mo-at">([^<]*)<', page), page

    (flat, _), (places, page) = said(robot), said(wall)
    assert places == flat
    assert "Waypoints in frame 0, mm" in page
    assert "in frame 0,\xa0mm" in page


@pytest.mark.parametrize("law", ["trapezoidal", "double_s"])
def test_ramps_that_do_not_count_are_grey_and_a_sentence_says_what_shapes_them(law):
    def ramp(*commands):
        form, state = BareForm(), done(STATE, SetMove(1, law=law), *commands)
        page = str(move_markup(form, state))
        (found,) = re.findall(r'<input[^>]*value="([^"]*)"[^>]*data-cell="law ramp"( disabled)?', page)
        return found, page

    field, page = ramp()
    assert field == ("", " disabled")
    assert "The limits shape the ramps of the fastest motion" in page
    field, page = ramp(LastFor(4.0))
    assert field == ("", "")
    assert "they are those of the fastest motion" in page
    field, page = ramp(LastFor(4.0), SetMoveOption(1, "law", "ramp", 0.2))
    assert field == ("0.2", "")
    assert "limits shape" not in page
    assert "fastest motion" not in page
    field, page = ramp(LastFor(4.0), SetMoveOption(1, "law", "ramp", 0.2), SetMove(1, apart=True))
    assert field == ("0.2", " disabled")
    assert "The limits shape the ramps of independent joints" in page
    assert typed("law ramp", "0.3", done(STATE, SetMove(1, law=law))) == ()


def test_an_orientation_that_goes_on_past_waypoints_says_so():
    smooth = "It goes on smoothly past the waypoints: the angular velocity does not jump."

    def page(*commands):
        state = with_planned(done(State.initial(catalogue()["puma560"]), TakeExample("circle"), *commands))
        return str(move_markup(BareForm(), state))

    assert smooth in page()
    assert smooth not in page(SetMove(1, turning="kept"), SetMove(2, turning="kept"))
    assert smooth not in page(SetMove(1, path="polyline"), SetMove(2, path="polyline"))
    assert smooth not in page(SetMove(1, space="joint"), SetMove(2, space="joint"))
