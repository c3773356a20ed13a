"""Lessons played by their own solutions: what a file that can be read may still have wrong."""

import numpy as np
import pytest

from armlab import check_lesson
from armlab.content.actions import SetCell, Wait
from armlab.content.lessons import lesson
from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.session.parts.joints import Joints
from armlab.teaching.parts.lesson import observed
from armlab.teaching.play import MOST_BY_CHANCE, RANDOM_STATES, Player, problems, random_states
from support.lesson_texts import RICH
from support.small_lessons import VARIED, library_fixture

own = pytest.fixture(library_fixture, name="own")

FRONT = """+++
title = "T"
chapter = "1"
teaches = ["S4.0-2R"]
robot = "planar_2r"
q_deg = [10, 20]
panel = "joints"
+++
"""


def said(own, text, variant=0):
    own(x=text)
    return [(problem.step, problem.says) for problem in problems("x", variant)]


def step(*blocks):
    return FRONT + "## A\n" + "".join(f"```{name}\n{text}\n```\n" for name, text in blocks)


CHECK = 'kind = "joint_at"\njoint = 1\nvalue_deg = 90\ntolerance_deg = 1\n'
NUMBER = 'kind = "number"\ntext = "?"\nanswer = 2\ntolerance = 0.1\n'


@pytest.mark.parametrize("variant", [0, 1, 2, 77])
def test_a_good_lesson_has_no_problems(own, variant):
    assert problems("v", variant) == []


def test_a_lesson_without_tasks_has_no_problems(own):
    assert said(own, FRONT + "## A\nRead.\n## B\nMore.\n") == []


def test_a_check_needs_a_solution(own):
    own(x=step(("check", CHECK)))
    (problem,) = problems("x")
    assert (problem.step, problem.line, problem.says) == (1, 9, "it has a check and no block 'solution'")


def test_a_solution_that_misses_is_told_by_how_much(own):
    ((number, says),) = said(own, step(("check", CHECK), ("solution", "q_deg = [80, 20]")))
    assert number == 1
    assert says.startswith("its solution does not meet its check: Joint 1 is at 80.0°")


def test_a_check_that_is_met_before_anything_is_done(own):
    found = said(own, step(("check", CHECK.replace("90", "10")), ("solution", "q_deg = [10, 20]")))
    assert found == [(1, "its check is met already when the step begins")]


def test_the_second_step_begins_where_the_first_ended(own):
    one = step(("check", CHECK), ("solution", "q_deg = [90, 20]"))
    assert said(own, one + one.partition("+++\n## A\n")[2].join(["## B\n", ""])) == [
        (2, "its check is met already when the step begins")
    ]


def test_the_second_step_is_not_done_for_who_passed_over_the_first(own):
    """The first step alone turns the arm away from where the second wants it."""
    one = step(("check", CHECK), ("solution", "q_deg = [90, 20]"))
    back = step(("check", CHECK.replace("90", "10")), ("solution", "q_deg = [10, 20]")).partition("+++\n## A\n")[2]
    told = "its check is met already when nothing was done in the steps before: give it a block 'start'"
    assert said(own, f"{one}## B\n{back}") == [(2, told)]
    begun = '```start\n[[do]]\nkind = "move"\nq_deg = [90, 20]\n```\n'
    assert said(own, f"{one}## B\n{begun}{back}") == []


def test_a_refused_action_is_told_with_its_number(own):
    solution = '[[do]]\nkind = "wait"\nseconds = 1\n[[do]]\nkind = "cell"\nrow = 1\nfield = "a"\nvalue = 2\n'
    text = step(("check", CHECK), ("solution", solution)).replace("panel", 'locked = ["table"]\npanel')
    ((_, says),) = said(own, text)
    assert says.startswith("action 2 of its solution is refused: This lesson keeps the DH table")


def test_a_solution_that_takes_another_arm_says_so(own):
    solution = '[[do]]\nkind = "robot"\nkey = "planar_3r"\n'
    ((_, says),) = said(own, step(("check", CHECK), ("solution", solution)))
    assert says == "its solution does not meet its check: the arm is no longer that of the lesson"


def test_an_answer_of_the_solution_is_the_one_that_is_tried(own):
    solution = '[[do]]\nkind = "answer"\ntext = "3"\n'
    ((_, says),) = said(own, step(("question", NUMBER), ("solution", solution)))
    assert says.startswith("its own answer is not right")
    assert said(own, step(("question", NUMBER), ("solution", solution.replace("3", "2")))) == []


def test_a_wrong_answer_has_to_get_its_own_words(own):
    """The second is never reached: the first is as near."""
    wrong = '[[wrong]]\nanswer = 5\nsays = "One."\n[[wrong]]\nanswer = 5.05\nsays = "Two."\n'
    ((_, says),) = said(own, step(("question", NUMBER + wrong)))
    assert says == "question.wrong[2] (5.05) gets another verdict: One."


WRONG = '[[wrong]]\nsays = "W."\nkind = "joint_at"\njoint = 1\nvalue_deg = -90\ntolerance_deg = 1\n'


def test_a_wrong_state_needs_its_configuration(own):
    ((_, says),) = said(own, step(("check", CHECK + WRONG), ("solution", "q_deg = [90, 20]")))
    assert says.startswith("check.wrong[1] needs q_deg")


@pytest.mark.parametrize(("q", "count"), [("[-90, 20]", 0), ("[-80, 20]", 1), ("[90, 20]", 1)])
def test_a_wrong_state_has_to_get_its_own_words(own, q, count):
    found = said(own, step(("check", f"{CHECK}{WRONG}q_deg = {q}\n"), ("solution", "q_deg = [90, 20]")))
    assert len(found) == count
    assert all(says.startswith("check.wrong[1] gets another verdict") for _, says in found)


def test_a_wrong_table_needs_no_configuration(own):
    check = 'kind = "table_is"\nrows = [{type="R", a=1.5}, {type="R", a=1}]\n'
    wrong = '[[wrong]]\nsays = "W."\nkind = "table_is"\nrows = [{type="R", a=2.5}, {type="R", a=1}]\n'
    solution = '[[do]]\nkind = "cell"\nrow = 1\nfield = "a"\nvalue = 1.5\n'
    assert said(own, step(("check", check + wrong), ("solution", solution))) == []


def test_a_check_that_random_states_meet_is_told(own):
    check = CHECK.replace("tolerance_deg = 1", "tolerance_deg = 40")
    ((_, says),) = said(own, step(("check", check), ("solution", "q_deg = [90, 20]")))
    count = int(says.split()[0])
    assert MOST_BY_CHANCE < count < RANDOM_STATES / 2
    assert "random states" in says


def test_a_panel_is_opened_without_a_solution(own):
    assert said(own, step(("check", 'kind = "looked_at"\npanel = "film"'))) == []
    met = said(own, step(("check", 'kind = "looked_at"\npanel = "joints"'), ("solution", "q_deg = [0, 0]")))
    assert (1, "its check is met already when the step begins") in met


def test_a_film_is_played_to_its_end(own):
    check = 'kind = "all_of"\nchecks = [{ kind = "looked_at", film = "film" }, { kind = "looked_at", panel = "film" }]'
    assert said(own, step(("check", check), ("solution", '[[do]]\nkind = "film"\n'))) == []


def test_waiting_makes_it_too_late(own):
    timed = 'kind = "all_of"\nchecks = [{ kind = "within_seconds", at_most_s = 5 }, { %s }]'
    check = timed % CHECK.strip().replace("\n", ", ")
    solution = '[[do]]\nkind = "wait"\nseconds = %d\n[[do]]\nkind = "move"\nq_deg = [90, 20]\n'
    assert said(own, step(("check", check), ("solution", solution % 4))) == []
    ((_, says),) = said(own, step(("check", check), ("solution", solution % 6)))
    assert "at most 5 s are allowed" in says


def test_a_variant_can_be_wrong_where_the_first_is_right(own):
    text = VARIED.replace('q_deg = ["= goal", 20]\n```\n## Predict', "q_deg = [30, 20]\n```\n## Predict")
    assert said(own, text, 0) == []
    ((number, says),) = said(own, text, 1)
    assert (number, "does not meet" in says) == (1, True)


def test_every_kind_of_action_is_played_against_the_locks_of_the_lesson(own):
    own(x=RICH)
    (held, kept) = problems("x", 0)
    assert (held.step, kept.step) == (1, 2)
    assert "y is 0.171 m" in held.says  # joint 2 is locked where it stands
    assert kept.says.startswith("action 3 of its solution is refused: This lesson keeps the DH table")
    own(x=RICH.replace('locked = ["robot", "table"]\nlocked_joints = [2]\n', ""))
    assert problems("x", 0) == []


def test_the_clock_of_a_player_moves_with_its_waits(own):
    player = Player(lesson("v", 0))
    assert player.act(Wait(2.5)) == ""
    assert player.act(SetCell(0, "a", 0.7)) == ""
    assert observed(player.session.state).seconds == 2.5
    assert player.session.state[Joints].arm.rows[0].a == 0.7


def test_random_states_are_the_same_each_time_and_inside_the_limits(own):
    one, other = ([seen.q for seen in random_states(lesson("v", 0))] for _ in range(2))
    np.testing.assert_array_equal(one, other)
    limits = catalogue()["planar_2r"].arm.limits
    assert np.all(one >= limits[:, 0])
    assert np.all(one <= limits[:, 1])
    assert len(one) == RANDOM_STATES


# --- In a notebook


def test_the_verdict_on_joint_values_alone(own):
    goal = lesson("v", 9).values["goal"]
    assert check_lesson("v", np.radians([goal, 0]), 1, 9)[0]
    assert check_lesson("v", np.radians([-goal, 20]), 1, 9) == (False, "The other way round.")


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (([0, 0], 2), "nothing is checked in step 2 of 'v'; steps with a check: 1"),
        (([0, 0], 4), "expected 1 to 3, got 4"),
        (([0, 0], 0), "a whole number, at least 1"),
        (([0],), "2 joint values"),
        (([99, 0],), "outside the joint limits"),
    ],
)
def test_what_cannot_be_checked_is_refused(own, arguments, says):
    with pytest.raises(InputError, match=says):
        check_lesson("v", *arguments)


def test_an_unknown_lesson_is_refused():
    with pytest.raises(UnknownName, match="first_arm"):
        check_lesson("first_leg", [0, 0])
