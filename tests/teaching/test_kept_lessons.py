"""What a student keeps while files change, clocks stand, places are left and previews come and go."""

import json
import time

import numpy as np
import pytest

from armlab.content import lesson_reading
from armlab.content import lessons as library_module
from armlab.content.lessons import kept_lesson, lesson, lessons
from armlab.content.robots import catalogue
from armlab.errors import ContentError
from armlab.session import clock
from armlab.session.parts.joints import MoveJoint
from armlab.session.share import state_of_parts
from armlab.session.state import State, apply
from armlab.teaching.assignment_commands import OpenAssignment, OpenTask
from armlab.teaching.hand_in import MOST, hand_in, judge
from armlab.teaching.hand_in_open import OpenWork
from armlab.teaching.lesson_commands import Answer, CloseLesson, GoToStep, OpenLesson
from armlab.teaching.lesson_progress import Progress
from armlab.teaching.parts.errata_practice import Practice
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.shelf import BackToLesson, ToSandbox
from armlab.teaching.way import standings
from support.assigned import NOON, done, exam, folder_fixture, fresh_fixture, goal, solved
from support.small_lessons import TWO_STEPS, VARIED, library_fixture

own = pytest.fixture(library_fixture, name="own")
folder = pytest.fixture(folder_fixture, name="folder")
fresh = pytest.fixture(fresh_fixture, name="fresh")


def broken_where(value):
    """Return the lesson with variants, that of this goal broken."""
    return VARIED.replace("step = 1 }\n", f'step = 1 }}\nother = "1 / (goal - {value:g})"\n')


def saved(state):
    """Return the state as it comes back from its file."""
    return state_of_parts(json.loads(json.dumps(state.to_json())))


# --- Lessons whose files have come to be broken


def test_who_is_in_a_variant_that_has_come_to_be_broken_goes_on_in_it_as_it_was(own):
    state = done(State.initial(catalogue()["puma560"]), OpenLesson("v", variant=2))
    wanted = goal(state)
    own(v=broken_where(wanted))
    with pytest.raises(ContentError, match="other: it has no value in variant 2"):
        lesson("v", 2)
    state = done(state, MoveJoint(0, np.radians(wanted)), GoToStep(2), Answer(f"{2 * wanted:g}"))
    assert state[LessonPart].lesson.values["goal"] == wanted
    assert state[LessonPart].progress.passed(state[LessonPart].lesson) == {0, 2}
    closed = done(state, CloseLesson())
    assert closed[LessonPart].lesson is None
    with pytest.raises(ContentError, match="variant 2"):
        apply(closed, OpenLesson("v", variant=2))


def test_saved_work_in_a_variant_that_nobody_has_seen_unbroken_is_read(own):
    state = done(State.initial(catalogue()["puma560"]), OpenLesson("v", variant=2), GoToStep(1))
    own(v=broken_where(goal(state)))
    library_module.library()._readings._variants.clear()  # as after a restart
    read = saved(state)
    assert (read[LessonPart].open, read[LessonPart].lesson.variant) == ("v/2", 0)
    assert kept_lesson("v", 2) is lesson("v")
    assert json.loads(hand_in(read))["variant"] == 2, "what is handed in is judged once the file is mended"
    assert done(read, CloseLesson())[LessonPart].open == ""


def test_why_a_variant_is_broken_is_found_once(own, monkeypatch):
    own(v=broken_where(goal(done(State.initial(catalogue()["puma560"]), OpenLesson("v", variant=2)))))
    read, parse = [], lesson_reading.parse_lesson
    monkeypatch.setattr(lesson_reading, "parse_lesson", lambda *given: [read.append(given), parse(*given)][1])
    for _ in range(3):
        with pytest.raises(ContentError, match="variant 2"):
            lesson("v", 2)
    assert len(read) == 1


def test_progress_in_a_lesson_that_is_not_there_for_a_while_waits_for_it(own):
    state = done(State.initial(catalogue()["puma560"]), OpenLesson("t"), GoToStep(2), Answer("3"), CloseLesson())
    progress = state[LessonPart].progress_of["t"]
    own(t=None)
    without = saved(saved(state))
    assert "t" not in without[LessonPart].progress_of
    own(t=TWO_STEPS)
    assert saved(without)[LessonPart].progress_of["t"].right == progress.right
    opened = done(without, OpenLesson("t"))[LessonPart]
    assert opened.progress.right == progress.right
    assert opened.aside == {}


# --- Progress


def test_the_task_that_was_last_worked_on_is_opened_again(fresh):
    state = done(exam(fresh), OpenTask(1), OpenTask(0), CloseLesson())
    assert done(state, OpenAssignment("exam"))[LessonPart].where == "exam:v/3"
    opened = (OpenLesson("v", variant=number) for number in (7, 3, 7))
    state = done(fresh, *opened, CloseLesson())
    assert done(state, OpenLesson("v"))[LessonPart].open == "v/7"


def test_a_step_that_was_shown_for_weeks_can_be_handed_in(own):
    """Evidence tells of no more than a million seconds."""
    state = done(State.initial(catalogue()["puma560"]), OpenLesson("t"), GoToStep(1), at=NOON)
    late = NOON + 20 * 86400.0
    state = done(state, MoveJoint(0, np.radians(90.0)), Answer("2"), at=late)
    report = judge(hand_in(state))
    assert [step.passed for step in report.steps][:2] == [True, True]
    assert Progress(since=0.0).seconds(1e9) == 1e6


def test_a_lesson_counts_as_done_though_titles_of_steps_hold_values(own):
    own(v=VARIED.replace("## Turn\n", "## Turn to {{=goal}}\n"))
    state = solved(done(State.initial(catalogue()["puma560"]), OpenLesson("v", variant=5)))
    reached = standings(state[LessonPart], lessons())["v"]
    assert (reached.passed, reached.steps) == (3, 3)


def test_of_steps_with_text_only_those_that_were_shown_count_after_saved_work_was_opened(own):
    own(t=TWO_STEPS + "## Read on\nMore text.\n")
    state = done(State.initial(catalogue()["puma560"]), OpenLesson("t"))
    opened = apply(State.initial(catalogue()["puma560"]), OpenWork(hand_in(state)), NOON)[LessonPart]
    assert opened.progress.passed(opened.lesson) == {0}


def test_work_with_more_than_can_be_read_is_saved_without_what_is_only_to_go_on_with(own, monkeypatch):
    state = done(State.initial(catalogue()["puma560"]), OpenLesson("t"))
    whole = json.loads(hand_in(state))
    assert whole["parts"]
    monkeypatch.setattr("armlab.teaching.hand_in.MOST", len(hand_in(state)) - 1)
    saved = hand_in(state)
    assert json.loads(saved) == {**whole, "parts": {}}
    assert len(saved) < MOST
    assert judge(saved).title == "T"


# --- What is a student's own


PRACTISED = {"4.110": {"pointed": [2], "spotted": [2], "typed": "x - f/d", "right": "x - f/d"}}


def practised(state):
    return state.replace(Practice.from_json(PRACTISED, catalogue()["puma560"]))


def test_exercises_done_in_the_sandbox_come_back_with_the_student(own):
    there = practised(done(State.initial(catalogue()["puma560"]), OpenLesson("t"), ToSandbox()))
    assert there[Practice].done == {"4.110"}
    assert apply(there, BackToLesson())[Practice] is there[Practice]
    assert apply(saved(there), BackToLesson())[Practice].done == {"4.110"}


def test_a_lesson_that_asks_for_exercises_leaves_those_that_are_done(own):
    check = 'kind = "fact"\nfact = "lessons.errata.put_right"\nat_least = 3'
    own(t=TWO_STEPS.replace('kind = "joint_at"\njoint = 1\nvalue_deg = 90\ntolerance_deg = 1', check))
    state = practised(State.initial(catalogue()["puma560"]))
    assert apply(state, OpenLesson("t"))[Practice].done == {"4.110"}


# --- The clock


def test_the_clock_goes_on_while_the_computer_sleeps(monkeypatch):
    before, awake = clock.now(), time.monotonic
    steady = clock.steady
    monkeypatch.setattr(time, "monotonic", lambda: awake() - 3600.0)  # it does not count an hour of sleep
    assert 0.0 <= clock.now() - before < 60.0
    monkeypatch.setattr(clock, "steady", lambda: steady() + 3600.0)
    assert 3600.0 <= clock.now() - before < 3660.0


def test_two_times_are_hardly_ever_the_same():
    times = [clock.now() for _ in range(1000)]
    assert len(set(times)) > 50  # with steps of 16 milliseconds it would be one or two
    assert times == sorted(times)
