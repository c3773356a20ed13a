"""An assignment in a session: its dates, its clock, its silence in an exam, and how it is handed in."""

import json
import re

import numpy as np
import pytest

from armlab.content.lessons import changed, lessons
from armlab.content.robots import catalogue
from armlab.errors import ContentError, InputError
from armlab.session.panel_commands import hidden_panels
from armlab.session.parts.display import SYSTEM_DARK, Show
from armlab.session.parts.joints import MoveJoint
from armlab.session.parts.timeline import OpenClip, Timeline
from armlab.session.share import short
from armlab.session.state import apply
from armlab.teaching.assignment_commands import HandIn, LookAtClock, OpenAssignment, OpenTask, TakeUp, clock_of
from armlab.teaching.errata_links import LookUp
from armlab.teaching.hand_in import hand_in, hand_in_name, judge
from armlab.teaching.hand_in_assignment import judge_assignment
from armlab.teaching.hand_in_class import looked_at_together
from armlab.teaching.hand_in_open import OpenWork
from armlab.teaching.hand_in_reports import Judged, gradescope, rows, table
from armlab.teaching.lesson_commands import Answer, CloseLesson, GoToStep, OpenLesson, SignAs, UnlockHint
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.shelf import ToSandbox
from armlab.ui.html import tag
from armlab.ui.speech import speech_in
from armlab.window.lesson.assigned import Sheet
from armlab.window.lesson.missing import still_missing
from armlab.window.lesson.page import LessonPage
from armlab.window.wished import wished
from support.assigned import NOON, done, exam, folder_fixture, fresh_fixture, goal, named, points, refused, solved
from support.bare_gui import BareGui, content
from support.small_lessons import library_fixture

own = pytest.fixture(library_fixture, name="own")
folder = pytest.fixture(folder_fixture, name="folder")
fresh = pytest.fixture(fresh_fixture, name="fresh")


def words_in(inside):
    """Return what is said in markup."""
    return " ".join(re.sub(r"<[^>]+>", " ", str(tag("div", inside))).split()).replace(" ,", ",")


# --- Opening


def test_it_opens_in_the_variant_of_the_student_and_keeps_its_own_progress(fresh):
    practised = done(fresh, OpenLesson("v", variant=3), UnlockHint(), CloseLesson())
    state = exam(practised)
    part = state[LessonPart]
    assert (part.where, part.lesson.variant, part.work.begun) == ("exam:v/3", 3, NOON)
    assert part.progress.hints == {}
    second = done(state, OpenTask(1))[LessonPart]
    assert second.where == "exam:t"  # does not vary
    left = done(state, CloseLesson())
    assert (left[LessonPart].assignment, left[LessonPart].works["exam"].left) == ("", 1)
    assert done(left, OpenLesson("v", variant=3))[LessonPart].progress.hints == {"Turn": 1}
    again = done(left, OpenAssignment("exam"), at=NOON + 60)[LessonPart]
    assert (again.where, again.work.begun) == ("exam:v/3", NOON)


def test_it_opens_and_closes_at_its_dates(fresh):
    refused(fresh, OpenAssignment("exam"), f"The assignment {named('Exam')} opens on ", NOON - 1)
    refused(fresh, OpenAssignment("exam"), f"The assignment {named('Exam')} closed on ", NOON + 3600)
    refused(fresh, OpenAssignment("exma"), "assignment: unknown name 'exma'; did you mean 'exam'")
    refused(fresh, OpenAssignment("exam", 10_000), "variant: expected 0 to 9999, got 10000")
    assert done(fresh, wished(fresh, "assignment/exam/8"))[LessonPart].where == "exam:v/8"


def test_whether_a_clock_would_begin_to_run_is_known_beforehand(fresh):
    assert clock_of(OpenAssignment("exam"), fresh, NOON).title == "Exam"
    refused_or_without = (OpenAssignment("exma"), OpenAssignment("exam", 10_000), OpenAssignment("homework"), None)
    assert [clock_of(command, fresh, NOON) for command in refused_or_without] == [None] * 4
    assert [clock_of(OpenAssignment("exam"), fresh, at) for at in (NOON - 1, NOON + 3600)] == [None, None]
    left = done(exam(fresh), CloseLesson())
    assert clock_of(OpenAssignment("exam", 5), left, NOON) is None  # it runs already
    assert clock_of(OpenAssignment("exam"), done(fresh, OpenAssignment("homework")), NOON) is None


def test_a_page_that_does_not_exist_is_told(fresh, folder):
    text = (folder / "homework.toml").read_text()
    (folder / "homework.toml").unlink()
    (folder / "homework.toml").write_text(f'pages = ["jionts"]\n{text}')
    changed()
    with pytest.raises(ContentError, match=r"homework\.toml, line 1: pages\[1\]: unknown page 'jionts'; did"):
        apply(fresh, OpenAssignment("homework"), NOON)


def test_nothing_else_opens_meanwhile_and_other_pages_are_closed(fresh):
    state = exam(fresh)
    assert "joints" not in hidden_panels(state)
    assert {"lessons", "solutions", "pose", "robot"} <= hidden_panels(state)
    for command in (OpenLesson("t"), ToSandbox(), wished(state, f"state/{short(fresh)}"), OpenWork("{}")):
        refused(state, command, f"The assignment {named('Exam')} is open. Leave it before")
    refused(state, OpenAssignment("homework"), f"The assignment {named('Exam')} is open. Leave it before")
    assert hidden_panels(done(state, CloseLesson())) == frozenset()


@pytest.mark.parametrize("command", [OpenAssignment("exam"), OpenLesson("t")])
def test_a_refusal_in_another_language_leaves_the_title_as_it_was_written(fresh, command):
    state = done(fresh, OpenAssignment("homework"))
    with pytest.raises(InputError) as refusal:
        apply(state, command, NOON)
    said = speech_in("it").text(str(refusal.value))
    assert named("Homework").strip("“”") in said
    assert "assignment" not in said


def test_a_lesson_of_assignments_opens_with_them_only(fresh, own, folder):
    own(w='+++\ntitle = "W"\nchapter = "1"\nlisted = false\nteaches = []\nrobot = "planar_2r"\n+++\n## A\nRead.\n')
    refused(fresh, OpenLesson("w"), "The lesson 'w' belongs to an assignment, and is opened with it")


# --- The exam


def test_an_exam_is_silent_gives_no_hints_and_counts_what_stands_last(fresh):
    state = exam(fresh)
    assert state[LessonPart].silent
    refused(state, UnlockHint(), "This assignment gives no hints")
    refused(state, LookUp("5.58"), "The page Errata is closed while this assignment is open")
    state = solved(state)
    assert points(done(state, HandIn())) == 7.0
    # Another answer, and the arm moved on at its step, take the place of what was right.
    assert points(done(state, Answer("1"), HandIn())) == 5.0
    moved = done(state, GoToStep(0), MoveJoint(0, 0.1))
    assert points(done(moved, HandIn())) == 3.0
    back = done(moved, MoveJoint(0, np.radians(goal(state))))
    assert points(done(back, HandIn())) == 7.0
    # Passing by at another step takes nothing away.
    passed = done(state, GoToStep(2), MoveJoint(0, 0.1), GoToStep(0))
    assert points(done(passed, HandIn())) == 7.0


def test_who_only_looks_back_in_an_exam_keeps_what_was_met(fresh):
    state = done(solved(exam(fresh)), GoToStep(2), MoveJoint(0, 0.1), OpenClip("motion", play=True))
    assert state[Timeline].playing
    state = done(state, GoToStep(0))
    assert not state[Timeline].playing
    for look in (Show("dark", True), Show(SYSTEM_DARK, True), Show("frames", True)):
        state = done(state, look)
    assert points(done(state, HandIn())) == 7.0


def test_a_wrong_prediction_gives_no_points_in_an_exam(fresh):
    state = exam(fresh)
    state = done(state, GoToStep(1), Answer("-1"), HandIn())
    assert points(state) == 0.0
    homework = done(fresh, SignAs("Ada"), OpenAssignment("homework", 3), GoToStep(1), Answer("-1"), HandIn())
    assert points(homework, "homework") == 2.0  # as on screen


def test_a_step_that_was_not_begun_asks_nobody_to_begin_once_the_work_is_handed_in(fresh):
    gui = BareGui()
    page = LessonPage(gui, print)
    begun = done(fresh, SignAs("Ada"), OpenAssignment("homework", 3))
    for state, says in ((begun, "As soon as you begin"), (done(begun, HandIn()), "This step was not begun.")):
        page.show(state)
        assert says in " ".join(map(content, gui.has))


def test_the_dock_of_an_exam_says_that_a_prediction_cannot_be_changed_and_an_answer_can(fresh):
    gui = BareGui()
    page = LessonPage(gui, print)
    for step, fixed in ((1, True), (2, False)):
        state = done(exam(fresh), GoToStep(step), Answer("1"))
        page.show(state)
        shown = " ".join(map(content, gui.has))
        assert ("only the first one counts" in shown, "You can change it" in shown) == (fixed, not fixed)


def test_a_forged_answer_that_was_right_before_does_not_count_in_an_exam(fresh):
    state = done(exam(fresh), GoToStep(2), Answer("1"), HandIn())
    data = json.loads(hand_in(state))
    data["works"][0]["progress"]["right"] = {"Double": [f"{2 * goal(state):g}", 3.0]}
    assert judge_assignment(json.dumps(data), "exam").points == 0.0


def test_when_the_time_is_over_the_work_is_handed_in_as_it_stands(fresh):
    state, late = solved(exam(fresh)), NOON + 30 * 60
    refused(state, Answer("1"), "The time for this work is over", late)
    for command in (LookAtClock(), HandIn(), MoveJoint(0, 0.1)):
        over = done(state, command, at=late + 5)
        assert over[LessonPart].work.handed == late
        assert over[LessonPart].work.by_clock
        assert points(over) == 7.0
    refused(over, TakeUp(), "its time is over", late + 6)
    assert done(state, LookAtClock(), at=late - 1) is state


def test_one_page_saves_the_file_at_the_end_of_the_clock_and_all_say_that_it_has_to_be_given(fresh):
    pages, saved = (), set()
    for _ in range(3):
        gui = BareGui()
        gui.save = lambda name, text, gui=gui: gui.files.append((name, text))
        gui.files = []
        pages += ((gui, LessonPage(gui, print, saved=saved)),)
    state = solved(exam(fresh))
    over = done(state, LookAtClock(), at=NOON + 30 * 60)
    for gui, page in pages[:2]:  # the third is opened later
        page.show(state)
        assert not gui.files
    for gui, page in (*pages, *pages):
        page.show(over)
        shown = " ".join([*map(content, gui.has), *(each.handle._impl.props.content for each in gui.said)])
        for part in ("Give the file to your teacher", "The time is over", "only when", "exam_ada.json", "Closed on"):
            assert part in shown
        assert "anded in on" not in shown
        assert "name is missing" not in shown
    assert [gui.files for gui, _ in pages] == [[("exam_ada.json", hand_in(over))], [], []]


def test_whose_work_is_closed_without_a_name_is_told_so(fresh):
    gui = BareGui()
    state = done(fresh, OpenAssignment("exam", 3))
    LessonPage(gui, print).show(done(state, LookAtClock(), at=NOON + 30 * 60))
    assert "Your name is missing in it" in " ".join(map(content, gui.has))


def named_before(state, sent=()):
    return words_in(still_missing(Sheet.open(state[LessonPart]), state[LessonPart].where, dict(sent)))


def test_homework_names_all_that_is_not_done_before_it_is_handed_in_and_an_exam_answers_alone(fresh):
    begun = done(fresh, OpenAssignment("homework", 3), GoToStep(2))
    unanswered = "Without an answer: Task 1, steps 2, 3"
    assert re.fullmatch(rf"{unanswered} .*button at the question\. Not done yet: Task 1, step 1", named_before(begun))
    wrong = done(begun, Answer("1"))
    assert named_before(wrong).endswith("Not done yet: Task 1, steps 1, 3")
    assert named_before(begun, {"Double": f"{2 * goal(begun):g}"}).endswith("Not done yet: Task 1, step 1")
    assert named_before(solved(begun)) == ""
    assert "In an exam only missing answers are named" in named_before(exam(fresh))
    assert "Not done yet" not in named_before(exam(fresh))
    assert named_before(solved(exam(fresh))) == named_before(done(solved(exam(fresh)), Answer("1")))


def test_a_missing_name_is_told_before_work_is_handed_in(fresh):
    for name, told in (("", True), ("Ada", False)):
        gui, asked = BareGui(), []
        gui.confirm = lambda *said, asked=asked: asked.append(words_in(said[-1]))
        page = LessonPage(gui, print)
        state = exam(fresh, name=name)
        page.show(state)
        page._hand_in(Sheet.open(state[LessonPart]))
        assert ("Your name is missing: write it" in asked[0]) == told


def test_work_that_was_handed_in_rests_until_it_is_taken_up_again(fresh):
    refused(done(fresh, OpenAssignment("exam", 3)), HandIn(), "Write your name at “Name” first")
    with pytest.raises(InputError, match="This work has not been handed in yet"):
        hand_in(exam(fresh))
    state = done(solved(exam(fresh)), HandIn())
    part = state[LessonPart]
    assert (part.silent, part.rests, part.work.attempts) == (False, True, 1)
    refused(state, Answer("1"), "This work has been handed in")
    moved = done(state, GoToStep(0), MoveJoint(0, 0.1))
    assert points(moved) == 7.0
    again = done(moved, TakeUp(), GoToStep(2), Answer("1"), HandIn())
    assert (points(again), again[LessonPart].work.attempts) == (5.0, 2)
    assert hand_in_name(again) == "exam_ada_2.json"
    refused(again, TakeUp(), "all 2 attempts are used")


def test_the_work_is_kept_over_a_restart(fresh, folder):
    part = done(solved(exam(fresh)), HandIn())[LessonPart]
    kept = LessonPart.from_json(json.loads(json.dumps(part.to_json())), catalogue()["puma560"])
    assert (kept.where, kept.works, kept.progress.right) == (part.where, part.works, part.progress.right)
    (folder / "exam.toml").unlink()
    changed()
    lessons().assignments_gone.clear()
    without = LessonPart.from_json(part.to_json(), catalogue()["puma560"])
    assert (without.open, without.assignment) == ("", "")


# --- Its file


def test_hand_ins_of_something_else_are_refused(fresh, folder):
    file, lesson = hand_in(done(exam(fresh), HandIn())), hand_in(done(fresh, OpenLesson("t")))
    for text, key, says in (
        (lesson, "exam", "this is work on the lesson 't', not on the assignment 'exam'"),
        (file, "homework", "this is work on the assignment 'exam', not 'homework'"),
    ):
        with pytest.raises(InputError, match=says):
            judge_assignment(text, key)
    with pytest.raises(InputError, match="this is work on the assignment 'exam', not on a lesson"):
        judge(file)
    text = (folder / "exam.toml").read_text()
    (folder / "exam.toml").unlink()
    (folder / "exam.toml").write_text(f"version = 2\n{text}")
    changed()
    with pytest.raises(InputError, match="this is work on version 1 of the assignment 'exam', not version 2"):
        judge_assignment(file, "exam")


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"handed_in": NOON - 5}, "the times in this file are damaged"),
        ({"attempt": 0}, "the times in this file are damaged"),
        ({"works": []}, "expected work on the lessons v, t; the file holds others"),
        ({"works": [1, 2]}, "expected work on the lessons v, t; the file holds others"),
        ({"variant": 5}, "task 1 is in variant 3; expected 5"),
        ({"version": "1"}, "version is missing or not usable"),
    ],
)
def test_a_damaged_file_is_told(fresh, change, says):
    data = {**json.loads(hand_in(done(exam(fresh), HandIn()))), **change}
    with pytest.raises(InputError, match=says):
        judge_assignment(json.dumps(data), "exam")


def judged(*files):
    return looked_at_together([Judged(name, judge_assignment(text, key)) for name, text, key in files], None)


def test_late_work_loses_its_part_and_the_table_says_so(fresh):
    state = solved(done(fresh, SignAs("Ada"), OpenAssignment("homework", 3)))
    state = done(state, GoToStep(0), UnlockHint())
    one = judged(("a", hand_in(done(state, HandIn(), at=NOON + 7200 + 90 * 60)), "homework"))
    lines = table(one).splitlines()
    assert lines[0].split() == ["student", "variant", "1.1", "1.2", "1.3", "attempt", "hints", "score"]
    assert lines[1].split()[:8] == ["Ada", "3", "ok", "ok", "ok", "1", "1", "3"]
    assert "3 of 6" in lines[1]
    assert "Late by 1 h 30 min." in lines[1]
    graded = gradescope(one[0])
    assert (graded["score"], [test["max_score"] for test in graded["tests"]]) == (3.0, [2.0, 2.0, 2.0])
    head, row = (line.split(",") for line in rows(one).splitlines())
    cells = dict(zip(head, row, strict=True))
    assert (cells["points"], cells["of"], cells["score"], cells["late min"]) == ("3.0", "6.0", "50", "90")
    assert (cells["1.1 points"], cells["1.1 hints"]) == ("2.0", "1")


def test_the_last_hint_costs_what_the_assignment_says_on_screen_and_in_the_table(fresh, folder):
    file = folder / "homework.toml"
    file.write_text(file.read_text().replace("late_percent", "last_hint_percent = 25\nlate_percent"))
    changed()
    state = solved(done(fresh, SignAs("Ada"), OpenAssignment("homework", 3)))
    assert Sheet.open(state[LessonPart]).points == (6.0, 6.0)
    hinted = done(state, GoToStep(0), UnlockHint())
    assert Sheet.open(hinted[LessonPart]).points == (6.0, 6.0), "only the last one costs"
    hinted = done(hinted, UnlockHint())
    assert Sheet.open(hinted[LessonPart]).points == (5.5, 6.0)
    assert points(done(hinted, HandIn()), "homework") == 5.5


def test_of_several_attempts_the_last_one_counts(fresh):
    first = done(solved(exam(fresh)), HandIn())
    second = done(first, TakeUp(), Answer("1"), HandIn(), at=NOON + 60)
    forged = {**json.loads(hand_in(second)), "attempt": 3}
    stranger = done(solved(exam(fresh, name="Bob")), HandIn(), at=NOON + 7)
    files = [hand_in(first), hand_in(second), json.dumps(forged), hand_in(stranger)]
    found = judged(*((str(i), text, "exam") for i, text in enumerate(files)))
    assert [one.problem for one in found] == [
        "Another attempt counts: 1.",
        "",
        "This is attempt 3; 2 can be handed in.",
        "",
    ]
    assert [one.points for one in found] == [0.0, 5.0, 0.0, 7.0]


def test_work_after_its_time_or_before_it_opened_does_not_count(fresh):
    data = json.loads(hand_in(done(exam(fresh), HandIn())))
    later = judged(("a", json.dumps({**data, "handed_in": NOON + 31 * 60}), "exam"))[0]
    assert later.problem.startswith("It was handed in on ")
    sooner = judged(("a", json.dumps({**data, "begun": NOON - 60}), "exam"))[0]
    assert sooner.problem.startswith("It was begun before the assignment opened on ")


# --- At another computer


def test_homework_goes_on_at_another_computer_and_is_judged_anew_there(fresh):
    state = done(fresh, SignAs("Ada"), OpenAssignment("homework", 3), GoToStep(2))
    state = done(state, Answer(f"{2 * goal(state):g}"), GoToStep(1), HandIn())
    data = json.loads(hand_in(state))
    data["works"][0]["progress"]["met"] = ["Turn", "Predict", "Double"]  # of the first nothing was seen
    there = done(fresh, OpenWork(json.dumps(data)), at=NOON + 60)
    part = there[LessonPart]
    assert (part.where, part.student, part.work.attempts, part.rests) == ("homework:v/3", "Ada", 1, True)
    assert points(there, "homework") == 2.0
    again = done(there, TakeUp(), GoToStep(0), MoveJoint(0, np.radians(goal(there))), HandIn(), at=NOON + 90)
    assert (points(again, "homework"), again[LessonPart].work.attempts) == (4.0, 2)
    refused(fresh, OpenWork(hand_in(done(exam(fresh), HandIn()))), "Work on an exam goes on only in the browser")


def test_what_a_task_locks_is_said_without_a_way_out_that_is_closed(fresh, folder, own):
    text = (folder / "v.md").read_text(encoding="utf-8")
    own(v=text.replace("\n[variants]", 'locked = ["joints", "target"]\n[variants]'))
    with pytest.raises(InputError, match=r"keeps the joints as they are\. In your own sandbox"):
        apply(done(fresh, OpenLesson("v", variant=3)), MoveJoint(0, 0.1), NOON)
    with pytest.raises(InputError, match=r"keeps the joints as they are\.$"):
        apply(exam(fresh), MoveJoint(0, 0.1), NOON)
