"""Steps are done by whatever is right, also where it is reached in another way than the solution goes."""

import math
import tomllib

import pytest

from armlab.benches.body.forms.commands import SetBodyAngle, SetBodyTurn, SetBodyTurns, SetWholeAxis
from armlab.benches.drive.joint.state import PlaceEncoder, SetDrive
from armlab.benches.iterate.runs.commands import SetParameter
from armlab.benches.iterate.runs.job import with_films
from armlab.benches.iterate.runs.state import Iterations
from armlab.content.actions import read_solution
from armlab.content.lessons import lesson
from armlab.content.reader import Table
from armlab.session.parts.joints import MoveJoint
from armlab.teaching.parts.lesson import check_line
from armlab.teaching.plain_text import plain
from armlab.teaching.play import Player


def at(key, title, variant=0):
    """Return a student at a step."""
    found = lesson(key, variant)
    player = Player(found)
    assert player.go_to([step.title for step in found.steps].index(title)) == ""
    return player


def verdict(player):
    met, says = check_line(player.session.state)
    return met, plain(says)


def test_a_triple_of_angles_is_right_with_whole_turns_more():
    player = at("zxz_angles", "Two triples")
    for i, degrees in enumerate((210.0, -50.0, 220.0)):
        assert not verdict(player)[0]
        player.do(SetBodyAngle(i, math.radians(degrees)))
    assert verdict(player)[0]


def test_half_a_turn_back_is_half_a_turn():
    player = at("zxz_angles", "Two turns about one line")
    player.do(SetBodyTurns("zxz", False, tuple(math.radians(each) for each in (50.0, -180.0, 60.0))))
    assert verdict(player)[0]


def test_an_angle_about_an_axis_is_right_with_a_whole_turn_more():
    player = at("axis_from_matrix", "Two answers")
    player.do(SetWholeAxis((-2.0, 2.0, -1.0)))
    player.do(SetBodyTurn(math.radians(310.0)))
    assert verdict(player)[0]


def test_the_sign_of_an_angle_is_not_blamed_where_the_axis_is_turned_as_well():
    player = at("axis_three_steps", "Three steps")
    t = player.lesson.values["t"]
    player.do(SetWholeAxis((1.0, 2.0, 2.0)))
    player.do(SetBodyTurn(math.radians(-t)))
    assert "wrong sign" in verdict(player)[1]
    player.do(SetWholeAxis((-1.0, -2.0, -2.0)))
    player.do(SetBodyTurn(math.radians(-t)))
    assert "wrong sign" not in verdict(player)[1]


def test_a_roll_of_270_degrees_is_not_reached_by_turning_back():
    player = at("axis_angle_quaternion", "Twice around")
    assert not verdict(player)[0]
    player.do(MoveJoint(2, math.radians(-90.0)))
    met, says = verdict(player)
    assert not met
    assert "same pose" in says
    player.do(MoveJoint(2, math.radians(270.0)))
    assert verdict(player)[0]


@pytest.mark.parametrize("alpha", [0.5, 0.95])
def test_a_step_size_that_takes_too_many_steps_is_not_called_too_small_where_it_is_near_the_bound(alpha):
    player = at("gradient", "Make it converge")
    player.do(SetParameter(0, "alpha", alpha))
    met, says = verdict(player)
    assert not met
    assert "too many steps" in says
    assert "larger step size is faster" not in says
    assert "one near the bound" in says


def test_the_runs_beside_how_fast_take_the_steps_that_it_asks_for():
    player = at("gradient", "How fast?")
    films = with_films(player.session.state)[Iterations].films
    newton, gradient = films.values()
    assert (newton.last, gradient.last) == (3, 84)
    assert [round(float(error), 3) for error in gradient.position_error[1:5]] == [0.169, 0.136, 0.111, 0.093]


def test_encoders_on_both_sides_of_their_gears_reach_the_accuracy_as_well():
    player = at("count_to_tool", "Where the encoder has to be")
    own = (
        MoveJoint(0, 0.0),
        MoveJoint(1, 0.0),
        SetDrive(0, "backlash", math.radians(player.lesson.values["play"])),
        PlaceEncoder(0, "joint"),
        SetDrive(0, "counts", 131072),
        SetDrive(1, "counts", 20000),
        SetDrive(1, "ratio", 100),
    )
    assert [player.do(each) for each in own] == [""] * 7
    assert verdict(player)[0], verdict(player)


ONE_PIECE = """
[[do]]
command = "body.integral.remove_piece"
law = 1
piece = 1

[[do]]
command = "body.integral.set_piece"
law = 1
piece = 0
what = 2
value = 1

[[do]]
command = "body.integral.set_piece"
law = 1
piece = 0
what = 3
value_deg = {rate}
"""


@pytest.mark.parametrize("variant", range(6))
def test_the_rate_in_whole_degrees_is_right_as_an_answer_and_on_the_page(variant):
    player = at("two_orders", "Equal integrals", variant)
    question = player.part.step.question
    rate = round(float(question.answer))
    assert question.judge(f"{rate} deg/s").right
    typed = Table("piece", tomllib.loads(ONE_PIECE.format(rate=rate)))
    assert [player.act(action) for action in read_solution(typed, player.lesson.robot_used)] == [""] * 3
    assert verdict(player)[0], verdict(player)
