"""The arm of the student's table."""

import math
from dataclasses import replace

import pytest

from armlab.benches.robot.trainer.answers import FIELDS, Answers
from armlab.benches.robot.trainer.exercise import Exercise
from armlab.benches.robot.trainer.state import Trainer
from armlab.content.robots import catalogue


def with_first_row(**values):
    """Return the exercise of the planar 2R with these values in its first row, checked, and none in its second."""
    exercise = Exercise(catalogue()["planar_2r"])
    row = {"a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0} | values
    cells = (tuple(row[name] for name in FIELDS), (None,) * len(FIELDS))
    answers = replace(Answers.empty(2), axes=exercise.solution, placed=True, cells=cells, checked_cells=cells)
    return Trainer(exercise, answers, started=True)


def test_it_is_drawn_as_far_as_rows_are_filled():
    assert with_first_row(theta=None).student_arm is None
    assert with_first_row().student_arm.n == 1
    # Millimetres in a field of metres are marked, but not drawn.
    far = with_first_row(a=1000.0)
    assert far.student_arm is None
    assert far.cell_marks[0]["a"].mistake == "millimetres"


@pytest.mark.parametrize("angle", [math.radians(450.0), -90.0])
@pytest.mark.parametrize("field", ["alpha", "theta"])
def test_an_angle_beyond_a_full_turn_is_drawn_as_the_direction_it_gives(field, angle):
    (drawn,) = with_first_row(**{field: angle}).student_arm.rows
    assert abs(getattr(drawn, field)) <= math.pi
    assert math.cos(getattr(drawn, field) - angle) == pytest.approx(1.0, abs=1e-12)
