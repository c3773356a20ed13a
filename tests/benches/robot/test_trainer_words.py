"""Sentences of the trainer and of the card on the closed form that carry a condition."""

from armlab.benches.robot.table.ui.facts import closed_form_card, facts_of
from armlab.benches.robot.trainer.state import Trainer
from armlab.benches.robot.trainer.ui.words import AXES_RULE, parallel_line
from armlab.content.robots import catalogue


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
