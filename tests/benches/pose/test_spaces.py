"""The page of spaces: n and m of every arm, the stick by two numbers and by one, and the arms of one r."""

import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.pose.spaces.arms import GoToTwin, SetR, misfit, r_of, suited, tools_apart, twins_of
from armlab.benches.pose.spaces.examples import EXAMPLES, ChooseSpacesExample
from armlab.benches.pose.spaces.facts import FACTS
from armlab.benches.pose.spaces.maps import components_of, maps_of
from armlab.benches.pose.spaces.state import (
    SHOWN,
    TASKS,
    DragEnd,
    MoveEnd,
    Represent,
    SetLength,
    Spaces,
    TurnStick,
)
from armlab.benches.pose.spaces.ui.arms import arms_markup
from armlab.benches.pose.spaces.ui.maps import maps_markup
from armlab.benches.pose.spaces.ui.scene import point_of
from armlab.benches.pose.spaces.ui.stick import CIRCLE, HIGH, WIDE, others_markup, stick_markup
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import transform
from armlab.session.edits import SetCell, SetEnd, SetLimits
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint
from armlab.session.parts.robot import ChooseRobot
from armlab.session.session import Session, Undo
from armlab.session.state import State, apply
from armlab.ui.html import joined
from support.bare_gui import BarePage
from support.done import done
from support.forms import asked

ABOUT_X = transform(rotation_about("x", math.pi))
TILTED = transform(rotation_about("y", math.radians(-120.0)))


def opened(*commands, robot="planar_3r"):
    return done(State.initial(catalogue()[robot]), *commands)


def shown(markup, state):
    found = []

    def kept(form):
        found.append(joined(markup(form, state)))
        return found[0]

    asked(lambda form: kept(form) + form.chip("nothing", "", ()), "nothing")
    return str(found[0])


def fact(name, state):
    return FACTS.facts[name].now(state).value


# -- joint space and task space -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("robot", "task", "kind", "n", "m", "spare"),
    [
        ("planar_2r", "own", "square", 2, 2, 0),
        ("planar_2r", "xy phi", "more", 2, 3, 0),
        ("planar_3r", "own", "square", 3, 3, 0),
        ("planar_3r", "xy", "redundant", 3, 2, 1),
        ("planar_3r", "xyz", "fixed", 3, 3, 1),
        ("scara", "own", "square", 4, 4, 0),
        ("puma560", "own", "square", 6, 6, 0),
        ("puma560", "xyz", "redundant", 6, 3, 3),
        ("panda", "own", "redundant", 7, 6, 1),
        ("trunk9", "own", "redundant", 9, 6, 3),
        ("elbow_3r", "pose", "more", 3, 6, 0),
    ],
)
def test_n_and_m_compare_as_they_should(robot, task, kind, n, m, spare):
    state = opened(Set(Spaces, "task", task), robot=robot)
    found = maps_of(state)
    assert (found.kind, found.n, found.m, found.spare) == (kind, n, m, spare)
    assert fact("kind", state) == kind


def test_r_is_the_pose_of_the_tool_in_frame_0():
    """3R at (20°, 50°, 40°): unit links at 20°, 70° and 110°."""
    state = opened(ChooseSpacesExample("redundant"), Set(Spaces, "task", "xy phi"))
    angles = np.radians([20.0, 70.0, 110.0])
    x, y, phi = (each.value for each in components_of(state))
    np.testing.assert_allclose([x, y, phi], [np.cos(angles).sum(), np.sin(angles).sum(), angles[2]], rtol=0, atol=1e-12)


def test_a_singular_configuration_is_told(robot):
    state = opened(robot=robot.key)
    found = maps_of(state)
    assert found.rank <= found.generic <= min(found.n, found.m)
    stretched = opened(MoveJoint(1, 0.0), robot="planar_2r")
    assert maps_of(stretched).rank == 1
    assert "the arm is singular here" in shown(maps_markup, stretched)


@pytest.mark.parametrize("task", ["xyz approach", "pose", "own"])
def test_three_components_of_a_direction_count_as_two(task):
    state = opened(Set(Spaces, "task", task), robot="puma560")
    text = shown(maps_markup, state)
    more = len(components_of(state)) > maps_of(state).m
    assert more is (task == "xyz approach")
    assert ("a has length 1" in text) is more


def test_the_diagram_has_the_numbers_and_the_formula_of_the_arm():
    state = opened(ChooseSpacesExample("square"))
    text = shown(maps_markup, state)
    assert "n = 2" in text
    assert "m = 2" in text
    assert "30.0°" in text
    assert "a few solutions q" in text
    assert asked(lambda form: joined(maps_markup(form, state)), "task", "xyz") == (Set(Spaces, "task", "xyz"),)
    assert asked(lambda form: joined(maps_markup(form, state)), "task", "own") == (Set(Spaces, "task", "own"),)


@pytest.mark.parametrize("view", SHOWN)
def test_every_view_is_there_for_every_arm(robot, view):
    page = BarePage("spaces", robot)
    page.session.apply(Set(Spaces, "shown", view), 1.0)
    for k, task in enumerate(TASKS if view == "maps" else ["own"]):
        page.session.apply(Set(Spaces, "task", task), 2.0 + k)
        page.show()


# -- the stick ----------------------------------------------------------------------------------------------------


def test_by_two_numbers_the_end_goes_anywhere_and_the_residual_tells():
    state = opened(MoveEnd(0.9, -0.9))
    assert fact("residual", state) == pytest.approx(0.62)
    text = shown(stick_markup, state)
    assert "No configuration" in text
    assert "= 0.62 m²" in text
    assert "1272.8" in text
    state = apply(
        apply(state, *asked(lambda form: joined(stick_markup(form, state)), "nearest")[:1]),
        Set(Spaces, "y", -math.sqrt(0.5)),
    )
    assert fact("residual", state) == pytest.approx(0.0, abs=1e-12)
    assert "A configuration" in shown(stick_markup, state)


def test_by_its_angle_the_end_stays_where_it_can_be_whatever_is_done(rng):
    state = opened(MoveEnd(2.0, 1.0), Represent("theta"))
    for x, y, length in rng.uniform([-3, -3, 0.2], [3, 3, 4], (40, 3)):
        state = apply(apply(state, DragEnd(x, y, 7)), SetLength(length))
        assert abs(fact("residual", state)) < 1e-12
    state = apply(state, TurnStick(math.radians(70.0)))
    assert fact("theta", state) == pytest.approx(math.radians(70.0))
    assert fact("residual", state) == pytest.approx(0.0, abs=1e-12)
    assert "a minimal representation" in shown(stick_markup, state)


def test_a_drag_is_one_step_of_undo():
    session = Session.fresh("someone", catalogue()["planar_3r"])
    session.apply(Set(Spaces, "shown", "stick"), 1.0)
    for k in range(5):
        session.apply(DragEnd(0.1 * k, -0.5, 3), 2.0 + 0.05 * k)
    session.apply(Undo(), 4.0)
    assert (session.state[Spaces].x, session.state[Spaces].y) == (0.6, -0.8)


def test_a_place_in_the_picture_is_a_place_of_the_end():
    state = opened(SetLength(2.0))
    at = f"{0.5 + CIRCLE / WIDE},{0.5 + 0.5 * CIRCLE / HIGH},4"
    (command,) = asked(lambda form: joined(stick_markup(form, state)), "stick", at)
    np.testing.assert_allclose([command.x, command.y], [2.0, -1.0], rtol=0, atol=1e-9)
    assert command.drag == 4


def test_other_representations_leave_three_numbers_for_an_orientation(robot):
    text = str(joined(others_markup(opened(robot=robot.key))))
    cells = [cell.partition("<")[0] for cell in text.split("<td>")[1:]]
    assert [cells[3 * k + k] for k in range(4)] == ["9", "4", "4", "3"]
    assert [cells[4 * k + 2] for k in range(4)] == ["3"] * 4


def test_fields_of_the_stick_are_read_in_the_units_on_screen():
    state = opened()

    def typed(cell, text, state=state):
        return asked(lambda form: joined(stick_markup(form, state)), cell, text)

    assert typed("x", "900") == (MoveEnd(0.9, -0.8),)
    assert typed("length", "2 m") == (SetLength(2.0),)
    by_angle = apply(state, Represent("theta"))
    (command,) = typed("theta", "90", by_angle)
    assert command.theta == pytest.approx(math.pi / 2)
    with pytest.raises(InputError, match="p_y: expected a number in mm"):
        typed("y", "down")


# -- arms of one r ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("described", ["joint3", "tool"])
def test_two_arms_have_the_same_r_and_their_tools_are_apart_or_not(described, rng):
    arm = catalogue()["planar_3r"].arm
    for q in rng.uniform(-2.8, 2.8, (25, 3)):
        state = opened(Set(Spaces, "described", described))
        state = state.replace(state[Joints].moved_to(q))
        twins = twins_of(state)
        assert fact("arms", state) == 2
        np.testing.assert_allclose(
            np.exp(1j * r_of(arm, twins.others[0], described)), np.exp(1j * twins.r), rtol=0, atol=1e-8
        )
        apart, turned = tools_apart(state)
        if described == "tool":
            assert apart < 1e-8
            assert turned < 1e-7
        else:
            # The last link of unit length is turned by the same angle as the tool.
            assert apart == pytest.approx(2.0 * math.sin(0.5 * turned), abs=1e-9)


@pytest.mark.parametrize("described", ["joint3", "tool"])
def test_half_a_turn_forwards_and_backwards_are_the_same_number_of_r(described):
    state = opened(Set(Spaces, "described", described))
    state = state.replace(state[Joints].moved_to(np.radians([100.0, 40.0, -180.0 if described == "joint3" else 40.0])))
    assert abs(fact("r", state)[2]) == pytest.approx(math.pi)
    assert fact("arms", state) == 2
    assert fact("r_residual", state) < 1e-9
    assert "6.3 m or rad" not in shown(arms_markup, state)


@pytest.mark.parametrize(
    "turned",
    [SetCell(1, "alpha", math.pi), SetCell(2, "alpha", math.pi), SetEnd("tool", ABOUT_X), SetEnd("tool", TILTED)],
)
def test_a_tool_that_is_turned_over_or_tilted_has_another_arm_of_its_r(turned):
    state = opened(Set(Spaces, "described", "tool"), turned)
    state = state.replace(state[Joints].moved_to([0.3, 0.8, 0.4]))
    (other,) = twins_of(state).others
    np.testing.assert_allclose(other[:2], [1.1, -0.8], rtol=0, atol=1e-9)
    np.testing.assert_allclose(state[Joints].arm.fk(other), state[Joints].tool_pose, rtol=0, atol=1e-9)
    assert "Two arms, one tool" in shown(arms_markup, state)
    for k, value in enumerate(fact("r", state)):
        np.testing.assert_allclose(apply(state, SetR(k, value))[Joints].q, [0.3, 0.8, 0.4], rtol=0, atol=1e-9)


def test_a_tool_with_x_across_the_plane_has_no_angle_but_joint_3_has():
    state = opened(Set(Spaces, "described", "tool"), SetEnd("tool", transform(rotation_about("y", 0.5 * math.pi))))
    text = shown(arms_markup, state)
    assert "No angle φ" in text
    assert fact("arms", state) is None
    with pytest.raises(InputError, match="has no angle φ"):
        SetR(2, 0.0).apply(state)
    assert asked(lambda form: joined(arms_markup(form, state)), "described joint3") == (
        Set(Spaces, "described", "joint3"),
    )
    assert fact("arms", apply(state, Set(Spaces, "described", "joint3"))) == 2


def test_a_typed_r_moves_the_arm_to_the_nearest_configuration():
    state = opened(ChooseSpacesExample("two_arms"))
    state = apply(apply(state, SetR(0, 1.0)), SetR(2, math.radians(45.0)))
    np.testing.assert_allclose(fact("r", state), [1.0, 1.3420201433, math.radians(45.0)], rtol=0, atol=1e-9)
    assert state[Joints].q[1] > 0.0
    with pytest.raises(InputError, match="No arm has this r"):
        SetR(0, 3.0).apply(state)
    with pytest.raises(InputError, match="component: expected 0 to 2"):
        SetR(3, 0.0).apply(state)


@pytest.mark.parametrize("low", [0.0, -360.0])
def test_limits_beyond_half_a_turn_keep_no_arm_from_its_own_r_nor_turn_it_back(low):
    state = opened(ChooseSpacesExample("two_arms"), SetLimits(0, math.radians(low), math.radians(360.0)))
    state = apply(state, MoveJoint(0, math.radians(200.0)))
    again = apply(state, SetR(0, float(fact("r", state)[0])))
    np.testing.assert_allclose(again[Joints].q, state[Joints].q, rtol=0, atol=1e-9)
    there = apply(apply(state, GoToTwin()), GoToTwin())
    np.testing.assert_allclose(there[Joints].q, state[Joints].q, rtol=0, atol=1e-9)


def test_the_point_of_joint_3_is_drawn_where_it_is_whatever_the_base():
    state = opened(ChooseSpacesExample("two_arms"))
    for turn in (0.0, math.radians(90.0)):
        arm = replace(state[Joints].arm, base=transform(rotation_about("x", turn), [0.1, 0.2, 0.3]))
        height = point_of(arm, twins_of(state).r, arm.fk(state[Joints].q))
        np.testing.assert_allclose(height, arm.frames(state[Joints].q)[2][:3, 3], rtol=0, atol=1e-9)


def test_the_other_arm_is_a_press_away_and_back():
    state = opened(ChooseSpacesExample("two_arms"))
    r = fact("r", state)
    other = apply(state, GoToTwin())
    np.testing.assert_allclose(np.degrees(other[Joints].q), [90.0, -70.0, 30.0], rtol=0, atol=1e-9)
    np.testing.assert_allclose(fact("r", other), r, rtol=0, atol=1e-9)
    np.testing.assert_allclose(apply(other, GoToTwin())[Joints].q, state[Joints].q, rtol=0, atol=1e-9)
    assert "Two arms, two tools" in shown(arms_markup, state)
    assert "Two arms, one tool" in shown(arms_markup, opened(ChooseSpacesExample("one_tool")))


def test_a_stretched_arm_has_no_other_and_a_held_joint_does_not_move():
    stretched = opened(MoveJoint(1, 0.0))
    assert fact("arms", stretched) == 1
    assert fact("tools_apart", stretched) is None
    assert "One arm only" in shown(arms_markup, stretched)
    with pytest.raises(InputError, match="No other arm"):
        GoToTwin().apply(stretched)
    held = opened(ChooseSpacesExample("two_arms"), LockJoint(0, True))
    with pytest.raises(InputError, match="held"):
        GoToTwin().apply(held)


@pytest.mark.parametrize("described", ["joint3", "tool"])
@pytest.mark.parametrize("first", [0.0, 20.0])
def test_of_a_folded_arm_that_turns_freely_a_whole_curve_has_the_same_r(described, first):
    state = opened(Set(Spaces, "described", described))
    state = state.replace(state[Joints].moved_to(np.radians([first, 180.0, 30.0])))
    assert fact("arms", state) is None
    text = shown(arms_markup, state)
    assert "Infinitely many arms" in text
    assert "arms, " not in text
    assert "One arm only" not in text


def test_another_arm_is_told_why_and_what_to_go_on_with():
    state = opened(robot="puma560")
    assert "RRRRRR" in misfit(state)
    assert set(suited()) == {"planar_3r", "planar_3r_unequal"}
    text = shown(arms_markup, state)
    assert "Not for this arm" in text
    offered = asked(lambda form: joined(arms_markup(form, state)), "arm planar_3r")
    assert offered == (ChooseRobot("planar_3r"),)
    with pytest.raises(InputError, match="arm: expected three joints that turn"):
        SetR(0, 1.0).apply(state)


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_brings_its_arm_and_its_view(key):
    state = opened(ChooseSpacesExample(key), robot="puma560")
    example = EXAMPLES[key]
    assert state[Spaces].example == key
    assert state[Spaces].shown == example.sets["shown"]
    assert state[Joints].arm is catalogue()[example.robot or "puma560"].arm
