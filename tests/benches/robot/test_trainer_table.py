"""Offsets along parallel axes are marked by their sum."""

import math

import numpy as np
import pytest

from armlab.benches.robot.trainer.exercise import Exercise, choices_of
from armlab.benches.robot.trainer.table import judge_table, parallel_runs
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.assignment import expected_table
from armlab.kin.dh import Row
from support.arms import random_q

TEXTBOOK = ["planar_2r", "planar_3r", "scara", "elbow_3r", "polar_rrp", "cylindrical_rpp", "stanford", "puma560"]


@pytest.fixture
def rng():
    return np.random.default_rng(12)


def turned(axes, rng):
    """Turn some of the directions against themselves, which keeps them legal."""
    return tuple(tuple(rng.choice(["+", "-"]) + direction[1] for direction in pair) for pair in axes)


def cells_of(row):
    return {"a": row.a, "alpha": row.alpha, "d": row.d, "theta": row.theta}


def wrong_cells(verdicts):
    return {(i, name) for i, row in enumerate(verdicts) for name, verdict in row.items() if not verdict.ok}


def test_runs_of_parallel_axes_are_read_off_the_twists():
    runs = {key: [list(run) for run in parallel_runs(catalogue()[key].arm.rows)] for key in TEXTBOOK}
    assert runs["planar_2r"] == [[0, 1]]
    assert runs["scara"] == [[0, 1, 2, 3]]
    assert runs["elbow_3r"] == [[1, 2]]
    assert runs["puma560"] == [[1, 2]]
    # Axis 1 of this arm lies in one line with axis 2; axes 2 and 3 are at a right angle.
    assert runs["cylindrical_rpp"] == [[0, 1]]
    assert parallel_runs([Row("R")]) == []


@pytest.mark.parametrize("key", TEXTBOOK)
def test_shifted_origins_along_parallel_axes_are_right_and_move_the_arm_alike(key, rng):
    arm = catalogue()[key].arm
    exercise = Exercise(catalogue()[key])
    found = expected_table(arm, exercise.pose, choices_of(turned(exercise.solution, rng)))
    table = [cells_of(row) for row in found.rows]
    assert wrong_cells(judge_table(found.rows, table)) == set()
    for run in parallel_runs(found.rows):
        i, shift = run[rng.integers(len(run) - 1)], rng.uniform(0.1, 0.3)
        table[i]["d"] += shift
        assert {(i, "d")} <= wrong_cells(judge_table(found.rows, table)) <= {(i, "d"), (i, "a")}
        table[i + 1]["d"] -= shift * round(math.cos(found.rows[i].alpha))
    verdicts = judge_table(found.rows, table)
    assert wrong_cells(verdicts) == set()
    rows = [Row(row.kind, **cells) for row, cells in zip(found.rows, table, strict=True)]
    shifted = Arm.from_dh(rows, base=found.base, tool=found.tool)
    for values in random_q(arm, rng, 4):
        np.testing.assert_allclose(shifted.fk(found.signs * values), arm.fk(values), rtol=0, atol=1e-9)


def test_the_sentence_on_a_free_sum_names_the_rows():
    rows = [Row("R", 1.0, 0.0, 0.0), Row("R", 0.5, 0.0, 0.7)]
    table = [cells_of(rows[0]) | {"d": 0.7}, cells_of(rows[1]) | {"d": 0.0}]
    assert judge_table(rows, table)[1]["d"].text == "right: only the sum of d over rows 1 to 2 is defined"


def test_a_sum_along_axes_that_point_against_each_other_says_in_which_direction_it_is_counted():
    rows = [Row("R", 0.3, math.pi, 0.4), Row("P", 0.2, 0.0, 0.0)]
    table = [cells_of(rows[0]) | {"d": 0.0}, cells_of(rows[1]) | {"d": 0.4}]
    named = "only the sum of d over rows 1 to 2, taken along z0,"
    assert judge_table(rows, table)[1]["d"].text == f"{named} counts, and it is not correct yet"
    table[1]["d"] = -0.4
    assert judge_table(rows, table)[1]["d"].text == f"right: {named} is defined"


def test_no_d_is_judged_by_itself_while_another_along_parallel_axes_is_missing():
    rows = [Row("R", 1.0, 0.0, 0.0), Row("R", 0.5, 0.0, 0.7)]
    table = [cells_of(rows[0]) | {"d": 0.7}, cells_of(rows[1]) | {"d": None}]
    assert "d" not in judge_table(rows, table)[0]
    assert wrong_cells(judge_table(rows, table)) == {(1, "d")}
    table = [cells_of(rows[0]) | {"d": None}, cells_of(rows[1]) | {"d": -0.7}]
    assert "d" not in judge_table(rows, table)[1]
    # What cannot be a shifted origin is told at once.
    table[1]["d"] = 700.0
    assert judge_table(rows, table)[1]["d"].mistake == "millimetres"


def test_another_number_of_rows_is_refused():
    with pytest.raises(InputError, match="expected 1 rows, got 0"):
        judge_table([Row("R")], [])


def test_a_wrong_sum_along_parallel_axes_blames_no_cell_alone():
    rows = [Row("R", a=0.3), Row("R", a=0.3, d=0.2), Row("R", a=0.1)]
    cells = [{"a": row.a, "alpha": 0.0, "d": d, "theta": 0.0} for row, d in zip(rows, (0.2, 0.0, 0.1), strict=True)]
    texts = {verdict["d"].text for verdict in judge_table(rows, cells)}
    assert texts == {"only the sum of d over rows 1 to 3 counts, and it is not correct yet"}
    cells[2]["d"] = 0.0
    assert all(verdict["d"].ok for verdict in judge_table(rows, cells))


def test_a_sign_is_blamed_only_where_no_other_d_differs():
    rows = [Row("R", a=0.3), Row("R", a=0.3, d=0.2), Row("R", a=0.1)]
    cells = [cells_of(row) for row in rows]
    cells[1]["d"] = -0.2
    assert judge_table(rows, cells)[1]["d"].mistake == "sign"
    cells[0]["d"] = 0.5
    assert [judge_table(rows, cells)[i]["d"].mistake for i in (0, 1)] == ["wrong", "wrong"]
