"""Tricks of students, and mistakes of teachers, from which an assignment must not suffer."""

import json

import numpy as np
import pytest

from armlab.content.lessons import changed, lessons
from armlab.content.robots import catalogue
from armlab.errors import ContentError, InputError, UnknownName
from armlab.session.example_links import LookAt
from armlab.session.panel_commands import hidden_panels
from armlab.session.parts.joints import MoveJoint
from armlab.session.session import Redo, Session, StartFresh, Undo
from armlab.teaching.assignment_commands import HandIn, LookAtClock, OpenAssignment, OpenTask, TakeUp
from armlab.teaching.hand_in import hand_in
from armlab.teaching.hand_in_assignment import judge_assignment
from armlab.teaching.hand_in_open import OpenWork
from armlab.teaching.lesson_commands import CloseLesson, GoToStep, SignAs
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui.html import joined
from armlab.window.lesson import assigned
from armlab.window.lesson.assigned import Sheet
from armlab.window.lesson.page import LessonPage
from support.assigned import NOON, done, exam, folder_fixture, fresh_fixture, goal, named, points, refused, solved
from support.bare_gui import BareGui, content
from support.forms import BareForm
from support.small_lessons import library_fixture

own = pytest.fixture(library_fixture, name="own")
folder = pytest.fixture(folder_fixture, name="folder")
fresh = pytest.fixture(fresh_fixture, name="fresh")


def session(state):
    return Session("token", catalogue()["puma560"], state)


def rewritten(folder, name, *changes):
    """Change the file of an assignment while students are in it."""
    text = (folder / f"{name}.toml").read_text()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (folder / f"{name}.toml").unlink()
    (folder / f"{name}.toml").write_text(text)
    changed()


# --- Verdicts


def test_a_step_to_which_one_comes_back_does_not_tell_whether_its_check_is_met(fresh):
    right = done(exam(fresh), MoveJoint(0, np.radians(goal(exam(fresh)))), GoToStep(1), GoToStep(0))
    wrong = done(exam(fresh), MoveJoint(0, 0.1), GoToStep(1), GoToStep(0))
    boxes = [assigned.check_box(state[LessonPart]) for state in (right, wrong)]
    assert [state[LessonPart].name in state[LessonPart].progress.met for state in (right, wrong)] == [True, False]
    assert boxes[0] == boxes[1]


def test_an_arm_that_undo_brings_back_counts_as_it_stands(fresh):
    student = session(exam(fresh))
    q = np.radians(goal(student.state))
    steps = (MoveJoint(0, q), 4.0), (MoveJoint(0, 0.1), 0.0), (Undo(), 4.0), (Redo(), 0.0)
    for i, (command, worth) in enumerate(steps):
        student.apply(command, NOON + 10.0 * i)
        assert points(done(student.state, HandIn())) == worth


def test_undo_ends_where_a_task_began(fresh):
    student = session(fresh)
    for i, command in enumerate((MoveJoint(0, 0.3), OpenAssignment("exam", 3), Undo(), OpenTask(1), Undo())):
        student.apply(command, NOON + 10.0 * i)
        if i:
            assert student.refusal(student.history.undone) == "Undo ends where this task began."
            assert student.robot.key == "planar_2r"
    assert student.state[LessonPart].where == "exam:t"
    assert student.notice.text == "Undo ends where this task began."


# --- Time, attempts and variants


def test_start_fresh_forgets_no_open_work(fresh):
    student = session(exam(fresh))
    student.apply(StartFresh(), NOON)
    assert student.notice.text == f"The assignment {named('Exam')} is open. Leave it before everything is forgotten."
    assert student.state[LessonPart].work.begun == NOON


def test_work_that_was_handed_in_stays_in_its_variant(fresh):
    state = done(solved(exam(fresh)), OpenAssignment("exam", 5), OpenAssignment("exam", 3), HandIn())
    says = f"The work on {named('Exam')} has been handed in in variant 3"
    refused(state, OpenAssignment("exam", 5), says)
    refused(done(state, CloseLesson()), OpenAssignment("exam", 5), says)
    assert done(state, OpenAssignment("exam", 3)) is state
    assert done(state, TakeUp(), OpenAssignment("exam", 5))[LessonPart].where == "exam:v/5"


def test_saved_work_gives_no_time_and_no_look_ahead(fresh, folder):
    rewritten(
        folder,
        "homework",
        ("late_percent", f"opens = {np.datetime64(int(NOON) - 60, 's')}Z\nminutes = 20\nlate_percent"),
    )
    state = done(fresh, SignAs("Ada"), OpenAssignment("homework", 3), HandIn())
    file = {**json.loads(hand_in(state)), "begun": NOON + 600, "handed_in": NOON + 601}
    later = done(done(state, TakeUp(), CloseLesson()), OpenWork(json.dumps(file)), at=NOON + 700)
    assert later[LessonPart].work.begun == NOON
    ahead = done(fresh, OpenWork(json.dumps({**file, "handed_in": NOON + 9e6, "begun": NOON + 8e6})), at=NOON + 5)
    assert ahead[LessonPart].work.begun == NOON + 5
    refused(fresh, OpenWork(json.dumps(file)), f"The assignment {named('Homework')} opens on", NOON - 100)


def test_work_that_the_clock_closed_is_told_so_at_another_computer(fresh, folder):
    rewritten(folder, "homework", ("late_percent", "minutes = 20\nlate_percent"))
    begun = done(fresh, SignAs("Ada"), OpenAssignment("homework", 3))
    closed = done(begun, LookAtClock(), at=NOON + 1300)
    there = done(fresh, OpenWork(hand_in(closed)), at=NOON + 1400)
    assert there[LessonPart].work == closed[LessonPart].work
    assert there[LessonPart].work.by_clock
    goes_on = done(done(begun, CloseLesson()), OpenWork(hand_in(closed)), at=NOON + 60)
    assert not goes_on[LessonPart].work.by_clock


def test_a_file_of_an_earlier_attempt_changes_nothing_of_a_later_one(fresh):
    state = done(fresh, SignAs("Ada"), OpenAssignment("homework", 3), HandIn())
    early = hand_in(done(solved(done(state, TakeUp())), HandIn(), at=NOON + 1))
    early = json.dumps({**json.loads(early), "attempt": 1})
    twice = done(state, TakeUp(), HandIn(), CloseLesson(), at=NOON + 2)
    refused(twice, OpenWork(early), "Attempt 2 has been handed in here; this file holds attempt 1")


def test_a_file_handed_in_time_dates_no_later_answer_back(fresh, folder):
    begun = done(fresh, SignAs("Ada"), OpenAssignment("homework", 3))
    empty = done(begun, HandIn())
    early, late = hand_in(empty), NOON + 3 * 3600
    for state in (done(empty, TakeUp(), at=late), begun):
        mixed = done(done(solved(state, late), CloseLesson(), at=late), OpenWork(early), at=late)
        assert not mixed[LessonPart].rests
        report = judge_assignment(hand_in(done(mixed, HandIn(), at=late)), "homework")
        assert (report.points, report.handed.attempt, report.handed.late > 0.0) == (3.0, 2, True)
    twice = json.dumps({**json.loads(early), "attempt": 2})
    for file in (early, twice):
        there = done(solved(begun, late), HandIn(), CloseLesson(), at=late)
        refused(there, OpenWork(file), "Work has been handed in here on .*; this file is older", late)
    assert done(done(empty, CloseLesson()), OpenWork(early), at=late)[LessonPart].rests
    rewritten(folder, "homework", ("late_percent", "attempts = 1\nlate_percent"))
    refused(done(solved(begun), CloseLesson()), OpenWork(early), "no attempt is left after the one in this file")


def test_an_example_of_a_closed_page_is_refused(fresh):
    state = exam(fresh)
    refused(state, LookAt("laws/same_time"), "The page of this example is closed while this lesson is open")


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"attempt": 10**30}, "the times in this file are damaged"),
        ({"left": 10**30}, "the times in this file are damaged"),
        ({"variant": -1}, "variant: expected 0 to 9999, got -1"),
        ({"variant": 10**30}, "variant: expected 0 to 9999, got 1000"),
    ],
)
def test_numbers_that_nobody_reaches_are_refused(fresh, change, says):
    data = {**json.loads(hand_in(done(exam(fresh), HandIn()))), **change}
    with pytest.raises(InputError, match=says):
        judge_assignment(json.dumps(data), "exam")


# --- The teacher changes the file


def test_who_has_a_variant_that_comes_to_be_broken_goes_on_in_it_and_hands_it_in(fresh, own, folder):
    state = solved(exam(fresh))
    own(v=(folder / "v.md").read_text().replace("step = 1 }\n", f'step = 1 }}\nc = "1 / (goal - {goal(state):g})"\n'))
    there = done(state, OpenTask(1), OpenTask(0), CloseLesson(), OpenAssignment("exam"))
    assert goal(there) == goal(state)
    gui = BareGui()
    for shown in (there, done(there, HandIn())):
        LessonPage(gui, print).show(shown)
    assert "7 of 10 points on screen" in " ".join(map(content, gui.has))
    with pytest.raises(ContentError, match="it has no value in variant 3"):
        exam(fresh)


def test_who_is_in_a_task_that_was_taken_away_can_go_to_another(fresh, folder):
    state = solved(exam(fresh))
    rewritten(
        folder, "exam", ('[[tasks]]\nlesson = "v"\n[tasks.points]\n"Turn" = 4\n"Predict" = 1\n"Double" = 2\n', "")
    )
    sheet = Sheet.open(state[LessonPart])
    assert (sheet.task, sheet.of.lessons) == (None, ("t",))
    form = BareForm()
    assert "The tasks have changed: choose one." in joined(assigned.head(form, sheet))
    assert "The last step" in assigned.foot(form, sheet, sheet.part.lesson, None)
    assert json.loads(hand_in(done(state, HandIn())))["works"][0]["lesson"] == "t"


def test_points_of_steps_whose_titles_hold_values_are_those_of_every_variant(fresh, folder, own):
    own(v=(folder / "v.md").read_text(encoding="utf-8").replace("## Turn", "## Turn to {{=goal}}"))
    first = lessons()["v"].steps[0].title
    rewritten(folder, "exam", ('"Turn" = 4', f'"{first}" = 4'))
    assert lessons().problems == ()
    state = solved(exam(fresh))
    assert state[LessonPart].lesson.steps[0].title != first
    assert Sheet.open(state[LessonPart]).points == (7.0, 10.0)
    assert points(done(state, HandIn())) == 7.0


def test_pages_that_are_closed_or_opened_meanwhile_are_so_at_once(fresh, folder):
    state = exam(fresh)
    assert "pose" in hidden_panels(state)
    rewritten(folder, "exam", ('pages = ["joints"]', 'pages = ["pose"]'))
    assert ("joints" in hidden_panels(state), "pose" in hidden_panels(state)) == (True, False)


def test_who_has_begun_can_come_back_whatever_becomes_of_the_file(fresh, folder):
    left = done(solved(exam(fresh)), CloseLesson())
    rewritten(folder, "exam", ('pages = ["joints"]', 'pages = ["jionts"]'))
    assert points(done(left, OpenAssignment("exam"), HandIn())) == 7.0
    (folder / "exam.toml").unlink()
    changed()
    assert points(done(left, OpenAssignment("exam"), HandIn())) == 7.0
    with pytest.raises(UnknownName, match="assignment: unknown name 'exam'"):
        done(fresh, OpenAssignment("exam"))
    assert "exam" not in lessons().assignments
