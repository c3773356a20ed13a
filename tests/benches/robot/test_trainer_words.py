"""Sentences of the trainer and of the card on the closed form that carry a condition."""

from armlab.benches.robot.table.ui.facts import closed_form_card, facts_of
from armlab.benches.robot.trainer.commands import CheckAxes, CheckTable, ChooseDirection, SetAnswer, StartTrainer
from armlab.benches.robot.trainer.state import Trainer
from armlab.benches.robot.trainer.ui.words import AXES_RULE, open_line, parallel_line, pose_line, rule
from armlab.content.robots import catalogue
from armlab.session.state import State, apply
from armlab.ui.units import units_of

UNITS = units_of(State.initial(catalogue()["scara"]))


def test_the_number_of_solutions_comes_with_its_conditions():
    conditions = ", apart from full turns and away from singular configurations."
    assert f"At most 8 solutions{conditions}" in closed_form_card(facts_of(catalogue()["puma560"].arm).structure)
    assert f"One solution{conditions}" in closed_form_card(facts_of(catalogue()["cartesian_3p"].arm).structure)
    assert conditions not in closed_form_card(facts_of(catalogue()["iiwa7"].arm).structure)


def test_the_rule_of_the_axes_says_where_a_slide_is_taken():
    assert "The axis of a prismatic joint is taken where it is drawn." in AXES_RULE


def test_an_exercise_with_parallel_axes_says_that_its_origins_need_not_lie_on_the_arm():
    scara = Trainer.initial(catalogue()["scara"])
    assert parallel_line(scara).startswith("Axes 1 to 4 are parallel: an origin may lie anywhere on its axis.")
    assert parallel_line(Trainer.initial(catalogue()["planar_2r"])) == ""


def test_the_rest_of_the_joints_is_told_in_the_right_number():
    assert pose_line(Trainer.initial(catalogue()["cylindrical_rpp"]), UNITS).endswith(", the other at 0.")
    assert pose_line(Trainer.initial(catalogue()["stanford"]), UNITS).endswith(", the others at 0.")


def table_of(key):
    """Return the exercise of an arm at its table, with the frames of the solution."""
    state = apply(State.initial(catalogue()[key]), StartTrainer())
    for i, (z, x) in enumerate(state[Trainer].exercise.solution):
        state = apply(apply(state, ChooseDirection(i, "z", z)), ChooseDirection(i, "x", x))
    return apply(state, CheckAxes())


def test_the_direction_of_a_sum_is_told_only_where_axes_point_against_each_other():
    scara, planar = (table_of(key)[Trainer] for key in ("scara", "planar_2r"))
    assert parallel_line(scara).endswith("with the right sum, taken along z₀, are correct too.")
    assert "with the right sum, taken along z₀, are correct." in rule(scara, 3, "d", UNITS)
    assert "with the right sum are correct." in rule(planar, 1, "d", UNITS)


def test_a_d_without_a_mark_is_told_to_wait_for_the_others():
    state = apply(apply(table_of("scara"), SetAnswer(0, "d", 0.5)), CheckTable())
    assert state[Trainer].cell_marks[0] == {}
    assert state[Trainer].answers.cell_misses[0] == (0, 0, 0, 0)
    told = "d₁: only the sum of d over rows 1 to 4, taken along z₀, counts, and a value of d is still missing."
    assert open_line(state[Trainer], 0, "d", UNITS) == told
    assert open_line(apply(state, SetAnswer(0, "d", 0.6))[Trainer], 0, "d", UNITS) == ""
    assert open_line(state[Trainer], 1, "d", UNITS) == ""
