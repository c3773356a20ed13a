"""Lessons in words of benches: they begin with commands, are solved by commands, and check facts."""

import json
import math

import numpy as np
import pytest

from armlab.benches.iterate.runs.job import with_films
from armlab.benches.iterate.runs.state import Iterations
from armlab.benches.velocity.speeds.commands import SetSpeed
from armlab.benches.velocity.speeds.state import Velocity
from armlab.benches.velocity.statics.state import SetComponent, Statics
from armlab.content.lesson_file import parse_lesson
from armlab.content.lessons import lesson
from armlab.content.robots import catalogue
from armlab.errors import ContentError
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.teaching.hand_in import hand_in, judge
from armlab.teaching.hand_in_open import OpenWork
from armlab.teaching.lesson_commands import CloseLesson, GoToStep, OpenLesson, TakeLessonArm
from armlab.teaching.parts.lesson import LessonPart, check_line, observed
from armlab.teaching.play import Player, check_at, problems
from support.bench_lesson import BENCHES
from support.done import done
from support.small_lessons import library_fixture

own = pytest.fixture(library_fixture, name="own")


@pytest.fixture
def benches(own):
    """The lesson among those of the lab."""
    own(benches=BENCHES)
    return own


SPEED = 'command = "velocity.speeds.set_speed"'


def opened(variant=0):
    return done(State.initial(catalogue()["planar_2r"]), OpenLesson("benches", variant=variant))


def force(value):
    return SetComponent("force", 1, value)


def solved(variant=0):
    """Return the student who has done everything as the solutions say."""
    player = Player(lesson("benches", variant))
    for i, step in enumerate(player.lesson.steps):
        assert player.go_to(i) == ""
        assert [player.act(action) for action in step.solution] == [""] * len(step.solution)
    return player.session.state


def steps_of(state):
    report = judge(hand_in(state))
    return [(step.met, step.says) for step in report.steps]


def forged(state, change):
    """Return the verdicts on the hand-in after a change of its progress."""
    data = json.loads(hand_in(state))
    change(data["progress"]["evidence"])
    return [(step.met, step.says) for step in judge(json.dumps(data)).steps]


# --- Start and solution


def test_the_lesson_plays_in_every_variant(benches):
    for variant in range(3):
        assert problems("benches", variant) == []


def test_a_lesson_begins_with_its_commands_in_order_and_with_the_values_of_the_variant(benches):
    for variant in range(3):
        given = lesson("benches", variant).values["most"]
        assert opened(variant)[Statics].force == (0.0, 4.0 * given, 0.0)
        np.testing.assert_allclose(opened(variant)[Joints].q, np.radians([30, 60]), rtol=0, atol=1e-12)


def test_a_step_begins_with_its_commands_although_the_joints_are_locked(benches):
    state = done(opened(), GoToStep(1))
    np.testing.assert_allclose(state[Joints].q, (0.0, math.pi / 2), rtol=0, atol=1e-12)
    np.testing.assert_allclose(state[Velocity].qdot, (0.0, math.radians(30)), rtol=0, atol=1e-12)
    assert state[LessonPart].bench == "velocity"


def test_who_goes_back_finds_the_benches_as_the_earlier_step_begins(benches):
    state = done(opened(), force(7.0), GoToStep(1), GoToStep(0))
    assert state[Statics].force == opened()[Statics].force


def test_who_goes_forward_keeps_what_was_done_on_other_benches(benches):
    assert done(opened(), force(7.0), GoToStep(1))[Statics].force == (0.0, 7.0, 0.0)


def test_what_a_start_passes_through_is_not_the_students_work(benches):
    through = '[[do]]\ncommand = "velocity.speeds.set_speed"\njoint = {}\nvalue_deg = {}\n\n'
    passing = through.format(1, 30) + through.format(0, 60)
    benches(benches=BENCHES.replace('[[do]]\ncommand = "velocity.speeds.set_speed"', f"{passing}[[do]]\n" + SPEED, 1))
    state = done(opened(), GoToStep(1))
    assert state[Velocity].qdot[0] == 0.0
    assert not state[LessonPart].progress.met
    assert not state[LessonPart].progress.tried


def test_who_goes_forward_over_a_step_finds_what_it_begins_with(benches):
    straight = done(opened(), GoToStep(2))
    np.testing.assert_allclose(straight[Velocity].qdot, (0.0, math.radians(30)), rtol=0, atol=1e-12)


def test_a_step_without_commands_goes_on_with_what_is_there(benches):
    state = done(opened(), GoToStep(1), SetSpeed(0, 0.4), GoToStep(2))
    assert state[Velocity].qdot[0] == 0.4


def test_set_up_again_puts_the_benches_back(benches):
    state = done(opened(), GoToStep(1), SetSpeed(0, 0.4), force(1.0), TakeLessonArm())
    assert state[Velocity].qdot[0] == 0.0
    assert state[Statics].force == opened()[Statics].force


def test_what_was_made_on_a_bench_before_is_not_there_when_the_lesson_opens(benches):
    worked = done(State.initial(catalogue()["planar_2r"]), SetComponent("moment", 2, 3.0), SetSpeed(1, 0.1))
    state = done(worked, OpenLesson("benches", variant=0))
    assert state[Statics].moment == (0.0, 0.0, 0.0)
    assert done(state, CloseLesson())[Statics].force == state[Statics].force


def test_the_start_is_no_work_of_the_student(benches):
    state = opened()
    assert not state[LessonPart].progress.tried
    assert not state[LessonPart].progress.met
    assert done(state, force(9.0))[LessonPart].progress.tried


# --- Facts


def test_a_fact_is_checked_while_the_student_works(benches):
    state = opened()
    met, says = check_line(state)
    torques = np.abs(observed(state).facts["velocity.statics.torques"].value)
    assert not met
    assert says == f"The largest torque of a joint: {torques.max():.4g} N m. Required: at most 5 N m."
    state = done(state, force(2.0))
    assert "Less torque" in state[LessonPart].progress.met


def test_only_facts_a_step_asks_for_are_looked_at(benches):
    assert set(observed(opened()).facts) == {"velocity.statics.largest_torque", "velocity.statics.torques"}
    assert set(observed(solved()).facts) == {"velocity.statics.torques"}


def test_a_mistake_of_the_lesson_speaks(benches):
    state = done(opened(), GoToStep(1), SetSpeed(0, -math.radians(120)))
    assert check_line(state) == (False, '<p translate="no">The other way round.</p>\n')


def test_what_is_still_being_worked_out_is_not_known_yet(benches):
    state = done(opened(), GoToStep(2))
    assert check_line(state) == (False, "How the run ends: not known yet.")
    assert "at the target" in check_line(with_films(state))[1]


def test_joint_values_can_be_tried_from_a_program(benches):
    met, says = check_at("benches", np.radians([90, 0]), 1)
    assert (met, "0 N m" in says) == (True, True)
    assert check_at("benches", np.radians([0, 0]), 1)[0] is False


# --- The hand-in


def test_a_hand_in_is_judged_again_from_its_inputs(benches):
    state = solved()
    assert [met for met, _ in steps_of(state)] == [True, True, True]


def test_of_what_is_told_nothing_is_believed(benches):
    def other_wrench(evidence):
        evidence["Less torque"]["facts"]["parts"]["statics"]["force"] = [0, 50, 0]

    def other_speeds(evidence):
        evidence["Turn"]["facts"]["parts"]["velocity"]["qdot"] = [0, 0]

    def other_end(evidence):
        evidence["Iterate"]["facts"]["parts"]["iterations"]["most"] = 50
        assert evidence["Iterate"]["facts"]["told"] == {"iterate.runs.status": "most"}

    state = solved()
    for k, change in enumerate((other_wrench, other_speeds, other_end)):
        found = forged(state, change)
        assert [met for met, _ in found] == [i != k for i in range(3)]
        assert "Required:" in found[k][1]


def test_other_joint_values_give_other_facts(benches):
    def straight(evidence):
        evidence["Less torque"]["q"] = [0.0, 0.0]
        evidence["Less torque"]["facts"]["parts"]["statics"]["force"] = [0, 3, 0]

    assert forged(solved(), straight)[0] == (
        False,
        "The largest torque of a joint: 6 N m. Required: at most 5 N m.",
    )


@pytest.mark.parametrize("what", ["facts", "parts", "statics"])
def test_evidence_that_is_not_whole_is_said(benches, what):
    def without(evidence):
        seen = evidence["Less torque"]
        inside = {"facts": seen, "parts": seen["facts"], "statics": seen["facts"]["parts"]}[what]
        del inside[what]

    met, says = forged(solved(), without)[0]
    assert not met
    assert says.startswith("The evidence is not usable: facts:")


def test_saved_work_is_opened_with_its_benches(benches):
    state = solved()
    again = done(State.initial(catalogue()["puma560"]), OpenWork(hand_in(state)))
    assert again[LessonPart].progress.met == state[LessonPart].progress.met
    assert again[Statics].force == state[Statics].force
    assert again[Iterations].most == 2


# --- Mistakes


def test_a_lesson_with_a_wrong_word_at_its_start_is_not_opened(benches):
    benches(benches=BENCHES.replace("velocity.speeds.set_speed", "velocity.speeds.set_sped"))
    with pytest.raises(ContentError, match=r"line \d+: step 2.start.do\[2\].command: word: .*did you mean"):
        opened()


def test_a_lesson_with_an_unknown_fact_is_not_opened(benches):
    benches(benches=BENCHES.replace("largest_torque", "largest_tork"))
    with pytest.raises(ContentError, match=r"line 27: step 1.check: fact of velocity.statics: unknown name"):
        opened()


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ('kind = "move"\nq_deg', 'kind = "wait"\nq_deg', r"step 2.start.do\[1\].kind: unknown value 'wait'.*target"),
        ('kind = "move"\nq_deg', "q_deg", r"do\[1\].kind: missing; .* or command, a word of a bench"),
        ("velocity.speeds.set_speed", "set_speed", r"do\[2\].command: expected TAB.PAGE.NAME such as"),
        ('fact = "iterate.runs.status"', 'fact = "status"', "fact: expected TAB.PAGE.NAME such as"),
        ("{{velocity.statics.torques}}", "$x = {{velocity.statics.torques}}$", "cannot stand in a formula"),
    ],
)
def test_mistakes_in_the_file_are_told_when_it_is_read(old, new, says):
    with pytest.raises(ContentError, match=says):
        parse_lesson("benches", BENCHES.replace(old, new, 1))


def test_a_command_that_is_refused_names_the_step_and_why(benches):
    benches(benches=BENCHES.replace("most = 2\n", "most = 0\n"))
    (problem,) = problems("benches")
    assert problem.step == 3
    assert problem.says.startswith("action 1 of its solution is refused: most: expected a whole number")


def test_facts_and_an_edited_table_do_not_go_together():
    table = '[[checks]]\nkind = "table_is"\nrows = [{ type = "R", a = 1.5 }, { type = "R", a = 1 }]\n\n[[wrong]]'
    with pytest.raises(ContentError, match="is judged with the arm of the lesson"):
        parse_lesson("benches", BENCHES.replace("[[wrong]]", table, 1))
