"""Two robots that meet: the equations of the exercise, its solutions in every reading, and what is refused."""

import math
import re

import numpy as np
import pytest

from armlab.benches.frames.two.examples import EXAMPLES, ONLY_LINK, ChooseTwoExample
from armlab.benches.frames.two.facts import FACTS
from armlab.benches.frames.two.reach import end_of_b, meeting_of, planar, q_of_b, shown_way
from armlab.benches.frames.two.state import (
    DragRobotBase,
    SetJointOfA,
    SetRobotBase,
    TurnRobotBase,
    TwoRobots,
)
from armlab.benches.frames.two.ui.scene import circle
from armlab.benches.frames.two.ui.solutions import verdict
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import transform
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.units import units_of
from support.done import done

ROBOT = catalogue()["puma560"]


def opened(*commands):
    return done(State.initial(ROBOT), *commands)


def found(*commands):
    return opened(*commands).derived(meeting_of)


def said(*commands):
    return str(verdict(opened(*commands)))


# --- the numbers of the exercise


def test_both_poses_of_the_exercise(truth):
    hand, other = truth["C3.4.2-ATEA"], truth["C3.4.2-BTEB"]
    now = found()
    np.testing.assert_allclose(now.T_a_ea, hand["expected"]["A_T_EA"], rtol=0, atol=hand["tol"])
    for ours, key in ((now.T_wa, "w_T_A"), (now.T_wb, "w_T_B")):
        np.testing.assert_allclose(ours, other["inputs"][key], rtol=0, atol=1e-15)
    np.testing.assert_allclose(now.T_w_eb, other["expected"]["w_T_EB"], rtol=0, atol=other["tol"])
    np.testing.assert_allclose(now.T_b_eb, other["expected"]["B_T_EB"], rtol=0, atol=other["tol"])
    assert math.degrees(now.angle) == pytest.approx(other["expected"]["phi_B_deg"], abs=1e-10)
    assert now.distance == pytest.approx(other["expected"]["dist"], abs=other["tol"])
    # ERR-3.127: the position of the base of B is (1, 2, 0), and not 1.
    np.testing.assert_array_equal(now.T_wb[:3, 3], [1, 2, 0])


def same(ways, listed, tol):
    ours = sorted(way.q.tolist() for way in ways)
    np.testing.assert_allclose(ours, sorted(listed), rtol=0, atol=tol)


def test_three_links_have_the_two_solutions_that_the_notes_announce(truth):
    case = truth["C3.4.2-qB-3R"]
    now = found(ChooseTwoExample("three"))
    same(now.solutions, case["expected"]["q_B"], case["tol"])
    assert now.asked == pytest.approx(case["expected"]["wrist_distance"], abs=case["tol"])
    assert all(way.meets for way in now.solutions)
    assert {way.name for way in now.solutions} == {"elbow up", "elbow down"}


def test_two_links_of_one_metre_do_not_reach(truth):
    """ERR-3.132."""
    now = found(ChooseTwoExample("two"))
    assert now.ways == ()
    beyond = truth["ERR-3.132"]["printed_value_if_wrong"]["printed_residual"]
    assert now.asked - now.reach == pytest.approx(beyond, abs=1e-6)
    assert "226.2 mm too far" in said(ChooseTwoExample("two"))


def test_longer_links_reach_the_position_alone_in_two_ways(truth):
    case = truth["C3.4.2-qB-2R-position"]
    now = found(ChooseTwoExample("position"))
    assert now.link == case["inputs"]["l1"]
    same(now.solutions, case["expected"]["q_B"], case["tol"])
    assert not any(way.meets for way in now.solutions)
    angles = [math.remainder(math.degrees(now.angle - way.turned_off), 360.0) for way in now.solutions]
    expected = sorted(case["expected"]["final_orientation_deg"])
    np.testing.assert_allclose(sorted(angles), expected, rtol=0, atol=1e-8)


def test_two_links_of_just_one_length_have_the_whole_pose_in_one_way(truth):
    case = truth["C3.4.2-qB-2R-fullpose"]
    assert pytest.approx(case["expected"]["l_equal"], abs=case["tol"]) == ONLY_LINK
    now = found(ChooseTwoExample("one"))
    same(now.solutions, [case["expected"]["q_B"]], case["tol"])
    assert found(ChooseTwoExample("two")).only_link == pytest.approx(case["expected"]["l_equal"], abs=case["tol"])
    assert "One solution" in said(ChooseTwoExample("one"))


def test_a_pose_out_of_two_joints_says_by_how_much_the_angle_is_missed():
    text = said(ChooseTwoExample("two"), Set(TwoRobots, "link", 1.4))
    assert "No solution" in text
    assert "these are three numbers" in text
    assert "1618.3813 mm long" in text


@pytest.mark.parametrize("unit", ["mm", "m"])
def test_the_only_length_typed_as_it_is_told_has_the_whole_pose(unit):
    state = opened(ChooseTwoExample("two"), Set(Notation, "length", unit))
    units = units_of(state)
    told = re.search(r"would have to be ([\d.]+) m+ long", str(verdict(state)))[1]
    typed = Set(TwoRobots, "link", units.read(told, False, "l"))
    assert "One solution" in str(verdict(apply(state, typed)))
    # Three digits less are no solution, and what is missed is not told as 0.
    near = str(verdict(apply(state, Set(TwoRobots, "link", units.read(told[:-3], False, "l")))))
    assert "No solution" in near
    assert re.search(r"misses the angle by at least [\d.]+·10⁻³°", near)


def test_links_that_could_be_folded_on_their_base_have_infinitely_many_solutions():
    now = opened(ChooseTwoExample("position"))
    meet = now.derived(meeting_of).T_w_eb[:3, 3]
    state = apply(apply(now, SetRobotBase("B", 0, meet[0])), SetRobotBase("B", 1, meet[1]))
    assert "Infinitely many solutions" in str(verdict(state))


def test_a_whole_pose_on_the_base_has_the_one_folded_solution():
    on_base = (Set(TwoRobots, "q_a", (0.0, 0.0)), Set(TwoRobots, "base_b", (-0.5, 1.0)), TurnRobotBase("B", 0.3))
    state = opened(ChooseTwoExample("two"), *on_base)
    now = state.derived(meeting_of)
    assert now.distance == pytest.approx(0.0, abs=1e-12)
    (way,) = now.solutions
    # The tool points at A, half a turn from x of the world, and so does joint 1 with half a turn more in joint 2.
    np.testing.assert_allclose(way.q, [-0.3, math.pi], rtol=0, atol=1e-12)
    np.testing.assert_allclose(end_of_b(state), now.T_w_eb, rtol=0, atol=1e-12)
    assert "equal links are folded there" in str(verdict(state))


# --- what is moved


def test_whatever_the_bases_and_joints_the_tools_meet_and_point_at_each_other(rng):
    for _ in range(10):
        x, y, turn, q1, q2 = rng.uniform(-1, 1, 5)
        state = opened(
            SetRobotBase("B", 0, 1.0 + 0.3 * x),
            SetRobotBase("B", 1, 1.5 + 0.3 * y),
            TurnRobotBase("B", 3.0 * turn),
            SetJointOfA(0, math.pi / 3 + 0.2 * q1),
            SetJointOfA(1, -math.pi / 2 + 0.2 * q2),
        )
        now = state.derived(meeting_of)
        assert len(now.solutions) == 2
        tool_of_a = now.T_wa @ planar(2, 1.0).fk(state[TwoRobots].q_a)
        for elbow in ("up", "down"):
            end = end_of_b(apply(state, Set(TwoRobots, "elbow", elbow)))
            np.testing.assert_allclose(end[:3, 3], tool_of_a[:3, 3], rtol=0, atol=1e-9)
            np.testing.assert_allclose(end[:3, :2], -tool_of_a[:3, :2], rtol=0, atol=1e-9)


def test_both_elbows_can_be_chosen_and_the_choice_stays_while_the_base_is_dragged():
    state = opened(Set(TwoRobots, "elbow", "down"))
    assert shown_way(state).name == "elbow down"
    moved = apply(state, DragRobotBase("B", transform(rotation_about("z", 0.7), [1.1, 1.9, 0.3]), 1))
    assert shown_way(moved).name == "elbow down"
    part = moved[TwoRobots]
    assert part.base_b == (1.1, 1.9)
    assert part.turn_b == pytest.approx(0.7)
    assert part.example == ""


def test_a_dragged_base_turns_on_over_half_a_turn():
    state = opened(TurnRobotBase("A", 3.0))
    state = apply(state, DragRobotBase("A", transform(rotation_about("z", 3.3), [0, 0, 0]), 1))
    assert state[TwoRobots].turn_a == pytest.approx(3.3)


def test_out_of_reach_b_points_stretched_to_where_it_should_be():
    for key, stretched in (("two", 1), ("three", 1)):
        state = opened(ChooseTwoExample(key), SetRobotBase("B", 0, 4.0))
        assert q_of_b(state)[stretched] == 0.0
        now, end = state.derived(meeting_of), end_of_b(state)
        apart = np.linalg.norm(end[:3, 3] - now.T_w_eb[:3, 3])
        assert apart == pytest.approx(now.asked - now.reach, abs=1e-9)


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_something_else_is_set(key):
    state = opened(SetRobotBase("A", 0, 3.0), ChooseTwoExample(key))
    assert state[TwoRobots].example == key
    assert state[TwoRobots].base_a == (-2.5, 1.0)
    assert apply(state, Set(TwoRobots, "elbow", "down"))[TwoRobots].example == key
    assert apply(state, Set(TwoRobots, "link", 1.1))[TwoRobots].example == ""


def test_facts_are_those_of_the_meeting():
    value = {key: fact.now(opened()).value for key, fact in FACTS.facts.items()}
    assert value["solutions"] == 2
    assert value["distance"] == pytest.approx(2.2261561863)
    assert value["asked"] == pytest.approx(1.7010565950)
    assert value["reach"] == 2.0
    assert value["name"] == "elbow up"
    assert math.degrees(value["angle"]) == pytest.approx(120.0)
    none = {key: fact.now(opened(ChooseTwoExample("two"))).value for key, fact in FACTS.facts.items()}
    assert (none["solutions"], none["joints"], none["name"]) == (0, None, None)


def test_the_circle_of_b_is_drawn_as_dashes():
    dashes = circle(np.array([1.0, 2.0, 0.0]), 2.0, (0, 0, 0))
    for start, end, _ in dashes:
        for point in (start, end):
            assert np.linalg.norm(point - [1.0, 2.0, 0.0]) == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetRobotBase("C", 0, 1.0), "robot: unknown name 'C'"),
        (SetRobotBase("A", 2, 1.0), "base: expected index 0 or 1, got 2"),
        (SetRobotBase("A", 0, 1e9), "base_a"),
        (TurnRobotBase("B", 1e9), "turn_b"),
        (SetJointOfA(2, 0.0), "joint: expected index 0 or 1"),
        (Set(TwoRobots, "selected", "C"), "selected: unknown name 'C'"),
        (Set(TwoRobots, "link", 0.0), "link"),
        (Set(TwoRobots, "version", "7r"), "7r"),
        (ChooseTwoExample("all"), "all"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())
