"""The state of the page Errata: what is chosen and listed, the job that runs both forms, examples and facts."""

import json
import math

import pytest

from armlab.benches.lessons.errata.commands import Correct, NextTask, PointAt, TryAgain, task_key
from armlab.benches.lessons.errata.examples import EXAMPLES, ChooseErrataExample
from armlab.benches.lessons.errata.facts import FACTS
from armlab.benches.lessons.errata.job import JOB, PANEL, run_at_once, running
from armlab.benches.lessons.errata.state import FIRST, LARGEST_SEED, Choose, Errata, Found, RunAgain
from armlab.content.errata import errata
from armlab.content.errata_task import task_of, with_tasks
from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.kin.errata import POINTS, run, trials
from armlab.session.facts import facts_again, worked_out
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.panels import Panels
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.share import from_short, short
from armlab.session.state import State, apply
from armlab.teaching.errata_links import LookUp
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.parts.errata_practice import LONGEST, Practice
from support.done import done

OPEN = frozenset({PANEL})


@pytest.fixture
def state():
    return State.initial(catalogue()["puma560"])


def fact(state, name):
    return FACTS.facts[name].now(state).value


def test_the_page_opens_with_one_that_is_wrong_at_every_point(state):
    found = run_at_once(state)[Errata].run
    assert state[Errata].erratum.id == FIRST
    assert min(found.printed) > 1e-3
    assert max(found.correct) < 1e-12


def test_the_job_runs_the_chosen_erratum_while_its_page_is_seen(state):
    assert JOB.wanted(state, frozenset({"joints"})) is None
    wanted = JOB.wanted(state, OPEN)
    pieces = [piece for piece in JOB.run(wanted.inputs) if piece is not None]
    assert pieces[-1].complete
    whole = JOB.delivered(state, wanted.inputs, pieces[-1])
    assert JOB.wanted(whole, OPEN) is None
    again = run(trials()[FIRST], 1)
    assert whole[Errata].run.printed == tuple(again.printed)
    assert whole[Errata].run.correct == tuple(again.correct)
    assert len(again.printed) == POINTS


def test_results_of_another_erratum_are_dropped(state):
    wanted = JOB.wanted(state, OPEN)
    *_, last = JOB.run(wanted.inputs)
    other = apply(state, Choose("4.82"))
    assert JOB.delivered(other, wanted.inputs, last) is other
    assert other[Errata].run is None


def test_what_cannot_be_run_is_not_asked_for(state):
    assert JOB.wanted(apply(state, Choose("1.37")), OPEN) is None


def test_run_again_takes_other_points_and_comes_back_after_the_last_seed(state):
    first, other = run_at_once(state)[Errata].run, run_at_once(apply(state, RunAgain()))[Errata].run
    assert (first.seed, other.seed) == (1, 2)
    assert first.printed != other.printed
    state = apply(state, Set(Errata, "seed", LARGEST_SEED))
    assert apply(state, RunAgain())[Errata].seed == 1


def test_where_the_error_is_not_seen_both_forms_hold(state):
    state = run_at_once(apply(apply(state, Choose("6.95")), Set(Errata, "quiet", True)))
    assert state[Errata].run.worst_printed < 1e-8
    assert apply(state, Choose("4.35"))[Errata].quiet is False


def test_an_erratum_that_the_filters_hide_is_shown_when_it_is_chosen(state):
    state = apply(state, Set(Errata, "query", "spline"))
    assert errata()["5.58"] not in state[Errata].listed
    assert errata()["5.58"] in apply(state, Choose("5.58"))[Errata].listed
    assert apply(state, Choose("6.91"))[Errata].query == "spline"


@pytest.mark.parametrize("command", [Choose("9.99"), Set(Errata, "chosen", "9.99"), LookUp("9.99")])
def test_an_erratum_that_is_not_there_is_refused(state, command):
    with pytest.raises(UnknownName, match=r"erratum: unknown name '9\.99'"):
        apply(state, command)


def test_what_is_looked_at_survives_another_arm_and_a_file(state):
    state = apply(apply(state, Choose("3.66")), ChooseRobot("scara"))
    part = state[Errata]
    assert part.chosen == "3.66"
    again = Errata.from_json(json.loads(json.dumps(part.to_json())), state[RobotPart].robot)
    assert again.to_json() == part.to_json()
    assert "found" not in part.to_json()


def test_a_link_to_an_erratum_opens_the_page_at_it(state):
    state = apply(state, LookUp("4.94"))
    assert state[Errata].chosen == "4.94"
    assert state[Panels].last == PANEL


def test_looking_is_no_step_of_undo(state):
    assert not Choose("4.94").undoable
    assert not Set(Errata, "severity", "A").undoable


@pytest.mark.parametrize("example", EXAMPLES.values(), ids=lambda example: example.key)
def test_an_example_is_put_in_place_with_its_arm(state, example):
    state = run_at_once(apply(state, ChooseErrataExample(example.key)))
    part = state[Errata]
    assert (part.chosen, part.quiet, part.example) == (example.erratum, example.quiet, example.key)
    assert state[RobotPart].robot.key == (example.robot or "puma560")
    assert part.run.worst_correct <= part.run.trial.tolerance
    assert (part.run.worst_printed > part.run.trial.tolerance) != example.quiet
    assert apply(state, Choose("1.41"))[Errata].example == ""


# --- facts


def test_facts_of_a_run_are_there_when_it_has_ended(state):
    assert fact(state, "residual_printed") is None
    state = worked_out(state, FACTS)
    assert fact(state, "residual_printed") == pytest.approx(run(trials()[FIRST], 1).worst_printed)
    assert fact(state, "residual_correct") < 1e-12
    assert fact(state, "printed_exists") is True
    assert fact(state, "severity") == "wrong if copied"


def test_a_form_without_a_value_has_no_residual(state):
    state = worked_out(apply(state, Choose("5.113")), FACTS)
    assert fact(state, "residual_printed") is None
    assert fact(state, "printed_exists") is False


def test_a_fact_is_worked_out_again_from_what_was_chosen(state):
    chosen = apply(state, Choose("7.23"))
    evidence = {"parts": {part.key: chosen[part].to_json() for part in FACTS.parts}, "told": {}}
    seen = chosen[Joints]
    words = ["lessons.errata.chosen", "lessons.errata.residual_printed"]
    observed = type("Seen", (), {"arm": seen.arm, "q": seen.q, "target": None})()
    found = facts_again(evidence, words, observed, chosen[RobotPart].robot, True)
    assert found[words[0]].value == "7.23"
    assert found[words[1]].value == pytest.approx(run(trials()["7.23"], 1).worst_printed)


# --- spot the error


def test_a_task_is_done_when_the_wrong_part_was_found_and_put_right(state):
    state = done(state, Choose("4.110"), PointAt((1,)))
    assert state[Practice].of("4.110").spotted == ()
    state = done(state, PointAt((2,)), Correct("f/d"))
    assert state[Practice].done == frozenset()
    state = done(state, Correct("x - f/d"))
    assert state[Practice].done == {"4.110"}
    assert fact(state, "put_right") == 1
    assert fact(state, "spotted") is True
    # Another try takes nothing back.
    state = done(state, PointAt((1,)), Correct("x + f/d"))
    assert state[Practice].done == {"4.110"}
    assert apply(state, TryAgain())[Practice].done == frozenset()


def test_a_correction_alone_is_not_enough(state):
    assert done(state, Choose("4.110"), Correct("x - f/d"))[Practice].done == frozenset()


def test_a_right_correction_in_other_words_counts(state):
    state = done(
        state,
        Choose("3.82"),
        PointAt((2, 1)),
        Correct("sin φ".replace(" φ", "(phi)") + "*cos(psi) + cos(theta)*cos(phi)*sin(psi)"),
    )
    assert state[Practice].done == {"3.82"}


@pytest.mark.parametrize(
    ("command", "says"),
    [
        (PointAt((9,)), r"part: expected one of \(1,\), \(2,\), \(3,\), \(4,\), got \(9,\)"),
        (PointAt((1, 1)), "part: expected one of"),
        (Correct("x" * (LONGEST + 1)), "correction: expected at most 600 characters, got 601"),
    ],
)
def test_what_is_no_part_or_too_long_is_refused(state, command, says):
    with pytest.raises(InputError, match=says):
        apply(state, command)


def test_the_task_shown_is_that_of_the_chosen_erratum_or_the_next(state):
    assert task_key(state) == FIRST
    assert task_key(apply(state, Choose("1.2"))) == "1.41"
    assert task_key(apply(state, Choose("7.27"))) == "A.arg"


def test_on_goes_to_tasks_that_are_not_done(state):
    keys = with_tasks()
    assert task_key(apply(state, NextTask(1))) == keys[keys.index(FIRST) + 1]
    assert task_key(apply(state, NextTask(-1))) == keys[keys.index(FIRST) - 1]
    for key in (keys[2], keys[3]):
        task = task_of(key)
        state = done(state, Choose(key), PointAt(sorted(task.at)[0]), Correct(task.question.right_answer))
    assert task_key(done(state, Choose(keys[1]), NextTask())) == keys[4]
    assert task_key(done(state, Choose(keys[-1]), NextTask())) == keys[0]


def test_answers_stay_with_the_student_and_go_into_no_link(state):
    state = done(state, Choose("4.110"), PointAt((2,)), Correct("x - f/d"))
    assert from_short(short(state))[Practice] == Practice()
    assert apply(state, ChooseRobot("scara"))[Practice].done == {"4.110"}
    assert apply(state, OpenLesson("first_arm"))[Practice].done == {"4.110"}


def test_answers_are_written_and_judged_again_when_they_are_read(state):
    state = done(state, Choose("4.110"), PointAt((2,)), Correct("x - f/d"))
    robot, data = state[RobotPart].robot, json.loads(json.dumps(state[Practice].to_json()))
    assert Practice.from_json(data, robot).done == {"4.110"}
    assert Practice.from_json({**data, "0.0": data["4.110"]}, robot).tried.keys() == {"4.110"}
    data["4.110"]["right"] = "f/d"
    assert Practice.from_json(data, robot).done == frozenset()


@pytest.mark.parametrize(
    "data",
    [
        [],
        {"4.110": {"pointed": [], "spotted": [], "typed": 1, "right": ""}},
        {"4.110": {"pointed": [1, 2, 3], "spotted": [], "typed": "", "right": ""}},
        {"4.110": {"pointed": [0], "spotted": [], "typed": "", "right": ""}},
        {"4.110": {"pointed": "1", "spotted": [], "typed": "", "right": ""}},
        {"4.110": {"pointed": [1], "spotted": [], "typed": "x" * 601, "right": ""}},
    ],
)
def test_junk_in_saved_answers_is_refused(state, data):
    with pytest.raises(InputError):
        Practice.from_json(data, state[RobotPart].robot)


def test_residuals_are_finite_or_said_to_be_missing():
    for key, trial in trials().items():
        found = run(trial, 1)
        assert all(value >= 0.0 for value in (*found.printed, *found.correct)), key
        assert all(math.isfinite(value) for value in found.correct), key


def test_a_wish_for_other_inputs_where_there_are_none_changes_nothing():
    """A press of a page that still shows another erratum comes late."""
    asked = Found("3.103b", 1, True)
    assert trials()["3.103b"].quiet is None
    found = [each for each in running(asked) if each is not None][-1]
    usual = [each for each in running(Found("3.103b", 1, False)) if each is not None][-1]
    assert found.complete
    assert found.printed == usual.printed
