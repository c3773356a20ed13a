"""The assignment trainer: wrong and right answers, marks and their names, the arm of the table, what is kept."""

import json
import math

import numpy as np
import pytest

from armlab.benches.robot.trainer.answers import FIELDS, Answers
from armlab.benches.robot.trainer.commands import (
    CheckAxes,
    CheckTable,
    ChooseDirection,
    EndTrainer,
    ReviseAxes,
    SetAnswer,
    ShowAxes,
    ShowCell,
    StartTrainer,
    TakeTrainerPose,
    at_reference,
)
from armlab.benches.robot.trainer.exercise import DIRECTIONS, Exercise, choices_of, usable_robots, vector
from armlab.benches.robot.trainer.state import Trainer
from armlab.content.robots import catalogue
from armlab.errors import ArmlabError, InputError, UnknownName
from armlab.kin.assignment import expected_table, judge_frames, own_choices
from armlab.session.edits import Convert, SetCell
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint, RandomPose
from armlab.session.parts.robot import ChooseRobot, robot_from_json
from armlab.session.session import Redo, Session, Undo
from armlab.session.state import State, apply
from support.arms import random_q

TEXTBOOK = [
    "planar_2r",
    "planar_3r",
    "elbow_3r",
    "polar_rrp",
    "cylindrical_rpp",
    "cartesian_3p",
    "scara",
    "stanford",
    "puma560",
]
H = math.pi / 2


@pytest.fixture
def rng():
    return np.random.default_rng(11)


def started(key):
    return apply(State.initial(catalogue()[key]), StartTrainer())


def legal_axes(exercise, rng):
    """Random legal axes, frame by frame from all 24 pairs of directions."""
    own, axes = own_choices(exercise.robot.arm, exercise.pose), []
    pairs = [(z, x) for z in DIRECTIONS for x in DIRECTIONS if z[1] != x[1]]
    for i in range(exercise.n + 1):
        for k in rng.permutation(len(pairs)):
            trial = (*own[:i], *choices_of((pairs[k],)), *own[i + 1 :])
            if judge_frames(exercise.robot.arm, exercise.pose, trial)[i].ok:
                axes.append(pairs[k])
                break
    return tuple(axes)


def place(state, axes):
    for i, (z, x) in enumerate(axes):
        state = apply(apply(state, ChooseDirection(i, "z", z)), ChooseDirection(i, "x", x))
    return apply(state, CheckAxes())


def placed(key):
    state = started(key)
    return place(state, state[Trainer].exercise.solution)


def fill(state, rows):
    for i, row in enumerate(rows):
        for field in FIELDS:
            state = apply(state, SetAnswer(i, field, getattr(row, field)))
    return state


def read_back(state):
    data = json.loads(json.dumps(state.to_json()))
    return State.from_json(data, robot_from_json(data["robot"]))


# -- the exercise --------------------------------------------------------------------------------------------------


def test_which_arms_are_exercises():
    keys = {robot.key for robot in usable_robots()}
    assert set(TEXTBOOK) <= keys
    # Their axes lie askew in every pose of their files.
    assert catalogue().robots.keys() - keys == {"openmanipulator_x", "panda"}
    with pytest.raises(InputError, match="no known configuration in which all joint axes"):
        started("panda")


@pytest.mark.parametrize("key", [robot.key for robot in usable_robots()])
def test_the_solution_is_legal_and_the_pose_inside_the_limits(key):
    exercise = Exercise(catalogue()[key])
    arm, choices = exercise.robot.arm, choices_of(exercise.solution)
    assert arm.within_limits(exercise.pose)
    assert all(verdict.ok for verdict in judge_frames(arm, exercise.pose, choices))
    found = expected_table(arm, exercise.pose, choices)
    np.testing.assert_allclose(found.frames[:, :3, 3], exercise.origins, atol=1e-12)


@pytest.mark.parametrize("key", TEXTBOOK)
def test_only_the_last_origin_depends_on_the_choices(key, rng):
    exercise = Exercise(catalogue()[key])
    for _ in range(6):
        axes = legal_axes(exercise, rng)
        frames = expected_table(exercise.robot.arm, exercise.pose, choices_of(axes)).frames
        np.testing.assert_allclose(frames[:-1, :3, 3], exercise.origins[:-1], atol=1e-9)


def test_directions():
    assert [vector(direction).tolist() for direction in ("+x", "-y", "+z")] == [[1, 0, 0], [0, -1, 0], [0, 0, 1]]


def test_an_edited_and_a_converted_table_can_be_exercises_too():
    state = apply(State.initial(catalogue()["puma560"]), Convert("modified"))
    assert apply(state, StartTrainer())[Trainer].exercise.origins[1] == pytest.approx([0, 0, 0.67183])
    tilted = apply(State.initial(catalogue()["elbow_3r"]), SetCell(0, "alpha", 1.0))
    assert not tilted[Trainer].exercise.usable


# -- a whole run ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", TEXTBOOK)
def test_wrongly_then_rightly_with_random_legal_choices(key, rng):
    for _ in range(3):
        state = started(key)
        exercise = state[Trainer].exercise
        axes = legal_axes(exercise, rng)
        i = int(rng.integers(exercise.n))
        wrong = next(d for d in DIRECTIONS if d[1] != axes[i][0][1])
        state = place(state, (*axes[:i], (wrong, axes[i][1]), *axes[i + 1 :]))
        trainer = state[Trainer]
        assert not trainer.answers.placed
        assert [mark.ok for mark in trainer.frame_marks] == [k != i for k in range(exercise.n + 1)]
        assert f"z{i}" in trainer.frame_marks[i].text
        state = apply(state, ChooseDirection(i, "z", axes[i][0]))
        assert state[Trainer].frame_marks[i] is None
        state = apply(state, CheckAxes())
        assert state[Trainer].answers.placed

        rows = state[Trainer].assignment.rows
        state = apply(apply(fill(state, rows), SetAnswer(i, "alpha", rows[i].alpha + 1.0)), CheckTable())
        trainer = state[Trainer]
        assert not trainer.done
        assert [(k, f) for k, m in enumerate(trainer.cell_marks) for f in FIELDS if not m[f].ok] == [(i, "alpha")]
        state = apply(apply(state, SetAnswer(i, "alpha", rows[i].alpha)), CheckTable())
        trainer = state[Trainer]
        assert trainer.done
        assert (trainer.answers.axes_checks, trainer.answers.table_checks) == (2, 2)
        assert trainer.student_arm is not None
        for q in random_q(exercise.robot.arm, rng, 3):
            moved = trainer.student_arm.fk(trainer.assignment.signs * q)
            np.testing.assert_allclose(moved, exercise.robot.arm.fk(q), rtol=0, atol=1e-9)


def test_start_takes_the_pose_and_forgets_the_answers():
    state = placed("puma560")
    assert at_reference(state)
    state = apply(state, MoveJoint(1, 0.3))
    assert not at_reference(state)
    assert at_reference(apply(state, TakeTrainerPose()))
    again = apply(state, StartTrainer())
    assert at_reference(again)
    assert again[Trainer].answers == Answers.empty(6)


def test_a_held_joint_out_of_place_is_named():
    state = apply(State.initial(catalogue()["planar_2r"]), LockJoint(1, True))
    with pytest.raises(InputError, match="joint 2 is held"):
        apply(state, StartTrainer())


# -- marks ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("field", "value", "mistake"),
    [
        ("alpha", -H, "sign"),
        ("alpha", 90.0, "degrees"),
        ("alpha", math.radians(H), "radians"),
        ("alpha", 1.0, "wrong"),
        ("theta", math.pi, "half turn"),
        ("d", -0.6, "sign"),
        ("d", 600.0, "millimetres"),
        ("d", 0.0006, "metres"),
        ("a", 0.3, "wrong"),
    ],
)
def test_mistakes_are_named(field, value, mistake):
    state = placed("elbow_3r")
    rows = state[Trainer].assignment.rows
    assert (rows[0].alpha, rows[0].d) == (pytest.approx(H), pytest.approx(0.6))
    state = apply(apply(fill(state, rows), SetAnswer(0, field, value)), CheckTable())
    mark = state[Trainer].cell_marks[0][field]
    assert (mark.ok, mark.mistake) == (False, mistake)


def test_swapped_cells_are_named_and_empty_ones_not_marked():
    state = placed("elbow_3r")
    for field, value in (("a", 0.6), ("d", 0.0), ("alpha", H)):
        state = apply(state, SetAnswer(0, field, value))
    marks = apply(state, CheckTable())[Trainer].cell_marks
    assert {name: mark.mistake for name, mark in marks[0].items()} == {"a": "swapped", "d": "swapped", "alpha": ""}
    assert marks[1] == {}


def test_a_mark_goes_with_a_change_and_comes_back_with_the_old_value():
    state = apply(apply(placed("planar_2r"), SetAnswer(0, "a", 0.5)), CheckTable())
    assert state[Trainer].cell_marks[0]["a"].mistake == "wrong"
    changed = apply(state, SetAnswer(0, "a", 1.0))
    assert changed[Trainer].cell_marks[0] == {}
    assert "a" in apply(changed, SetAnswer(0, "a", 0.5))[Trainer].cell_marks[0]
    assert apply(changed, SetAnswer(0, "a", None))[Trainer].answers.cells[0][0] is None


def test_solutions_are_shown_after_two_wrong_checks():
    state = started("planar_2r")
    state = apply(apply(state, ChooseDirection(1, "z", "+x")), ChooseDirection(1, "x", "+z"))
    for _ in range(2):
        with pytest.raises(InputError, match="after 2 wrong checks"):
            apply(state, ShowAxes(1))
        state = apply(state, CheckAxes())
    state = apply(state, ShowAxes(1))
    assert state[Trainer].answers.axes[1] == ("+z", "+x")
    state = place(state, state[Trainer].exercise.solution)
    for _ in range(2):
        state = apply(state, SetAnswer(1, "a", 5.0))
        with pytest.raises(InputError, match="after 2 wrong checks"):
            apply(state, ShowCell(1, "a"))
        state = apply(state, CheckTable())
    state = apply(state, ShowCell(1, "a"))
    assert state[Trainer].answers.cells[1][0] == pytest.approx(1.0)
    assert state[Trainer].answers.shown == 2


def test_going_back_to_the_axes_keeps_the_table_without_marks():
    state = placed("planar_2r")
    state = apply(fill(state, state[Trainer].assignment.rows), CheckTable())
    assert state[Trainer].done
    state = apply(state, ReviseAxes())
    assert state[Trainer].assignment is None
    state = apply(apply(state, ChooseDirection(1, "x", "-x")), CheckAxes())
    assert state[Trainer].cell_marks == ({}, {})
    marks = apply(state, CheckTable())[Trainer].cell_marks
    assert (marks[0]["a"].mistake, marks[0]["theta"].mistake) == ("sign", "half turn")


# -- what is refused, undone and kept ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("key", "command", "text"),
    [
        ("", ChooseDirection(0, "z", "+z"), "start the exercise first"),
        ("started", CheckAxes(), "choose z and x"),
        ("started", CheckTable(), "the table comes when"),
        ("started", ChooseDirection(3, "z", "+z"), "frame: expected 0 to 2, got 3"),
        ("started", ChooseDirection(0, "y", "+z"), "axis"),
        ("started", ChooseDirection(0, "z", "up"), "direction"),
        ("started", ShowAxes(-1), "frame: expected 0 to 2"),
        ("placed", ChooseDirection(0, "z", "+z"), "to choose them again"),
        ("placed", CheckTable(), "fill in at least one cell"),
        ("placed", SetAnswer(2, "a", 1.0), "row: expected 1 to 2, got 3"),
        ("placed", SetAnswer(0, "beta", 1.0), "cell"),
        ("placed", SetAnswer(0, "a", math.nan), "expected a length between"),
        ("placed", SetAnswer(0, "a", -2e5), "expected a length between -100000 and 100000 m, got -200000 m"),
        ("placed", SetAnswer(0, "theta", 2e5), "expected an angle between -100000 and 100000 rad, got 200000 rad"),
    ],
)
def test_refusals(key, command, text):
    state = {"": lambda: State.initial(catalogue()["planar_2r"]), "started": lambda: started("planar_2r")}.get(
        key, lambda: placed("planar_2r")
    )()
    with pytest.raises((InputError, UnknownName), match=text):
        apply(state, command)


def test_progress_is_undone_and_read_back():
    session = Session("token", catalogue()["planar_2r"], State.initial(catalogue()["planar_2r"]))
    rows = placed("planar_2r")[Trainer].assignment.rows
    commands = [StartTrainer()]
    for i in range(3):
        commands += [ChooseDirection(i, "z", "+z"), ChooseDirection(i, "x", "+x")]
    commands += [CheckAxes()]
    commands += [SetAnswer(i, field, getattr(row, field)) for i, row in enumerate(rows) for field in FIELDS]
    commands += [CheckTable()]
    states = [session.state]
    for at, command in enumerate(commands):
        session.apply(command, float(at))
        assert session.notice is None
        states.append(session.state)
    assert session.state[Trainer].done
    for state in states:
        back = read_back(state)[Trainer]
        assert (back.answers, back.started) == (state[Trainer].answers, state[Trainer].started)
        assert back.frame_marks == state[Trainer].frame_marks
        assert back.cell_marks == state[Trainer].cell_marks
    for state in reversed(states[:-1]):
        session.apply(Undo(), 100.0)
        assert session.state[Trainer].answers == state[Trainer].answers
    assert not session.state[Trainer].started
    np.testing.assert_array_equal(session.state[Joints].q, catalogue()["planar_2r"].home)
    for _ in commands:
        session.apply(Redo(), 200.0)
    assert session.state[Trainer].done


def test_the_arm_goes_back_to_where_it_was_when_the_exercise_ends():
    away = apply(State.initial(catalogue()["puma560"]), RandomPose())
    started_twice = apply(apply(away, StartTrainer()), StartTrainer())
    assert not np.array_equal(started_twice[Joints].q, away[Joints].q)
    for state in (started_twice, read_back(started_twice)):
        ended = apply(state, EndTrainer())
        np.testing.assert_array_equal(ended[Joints].q, away[Joints].q)
        assert not ended[Trainer].started
        assert ended[Trainer].before is None
        assert ended[Trainer].answers == Answers.empty(6)
    with pytest.raises(InputError, match="start the exercise first"):
        apply(away, EndTrainer())


def test_an_arm_moved_by_hand_in_the_exercise_stays_when_it_ends():
    state = apply(apply(State.initial(catalogue()["puma560"]), StartTrainer()), MoveJoint(0, 0.3))
    assert apply(state, EndTrainer())[Joints] is state[Joints]


@pytest.mark.parametrize("before", [[0.0], [0.0, float("nan")], "far"])
def test_damaged_joint_values_from_before_are_refused(before):
    data = placed("planar_2r")[Trainer].to_json()
    with pytest.raises(InputError, match="before"):
        Trainer.from_json(data | {"before": before}, catalogue()["planar_2r"])
    fresh = Trainer.initial(catalogue()["planar_2r"]).to_json()
    with pytest.raises(InputError, match="has not begun"):
        Trainer.from_json(fresh | {"before": [0.0, 0.0]}, catalogue()["planar_2r"])


def test_another_arm_begins_anew():
    state = apply(placed("planar_2r"), ChooseRobot("scara"))
    assert not state[Trainer].started
    assert state[Trainer].answers == Answers.empty(4)


@pytest.mark.parametrize(
    "damage",
    [
        {"axes": [["+z", "+x"]] * 2},
        {"axes": [["+z", "up"], ["+z", "+x"], ["+z", "+x"]]},
        {"axes": [["+z", "+z"], ["+z", "+x"], ["+z", "+x"]]},
        {"axes": None},
        {"cells": [[None] * 4] * 3},
        {"cells": [[1e9, None, None, None], [None] * 4]},
        {"cells": [["far", None, None, None], [None] * 4]},
        {"checked_cells": [[None] * 3] * 2},
        {"axes_checks": -1},
        {"table_checks": "two"},
        {"cell_misses": [[0, 0, 0, 0]]},
        {"axes_misses": [0, 0]},
        {"started": False},
    ],
)
def test_damaged_progress_is_refused(damage):
    state, robot = placed("planar_2r"), catalogue()["planar_2r"]
    data = json.loads(json.dumps(state[Trainer].to_json()))
    assert Trainer.from_json(data, robot).answers == state[Trainer].answers
    with pytest.raises((ArmlabError, TypeError, ValueError)):
        Trainer.from_json(data | damage, robot)


def test_an_arm_without_exercise_cannot_be_read_as_started():
    robot = catalogue()["panda"]
    with pytest.raises(InputError, match="no exercise"):
        Trainer.from_json(Trainer.initial(robot).to_json() | {"started": True}, robot)
