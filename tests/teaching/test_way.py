"""A student's way through a course: what is done, what is lacking, what comes next."""

import pytest

from armlab.content.courses import OF_THE_LAB
from armlab.content.lessons import changed, lessons
from armlab.content.robots import catalogue
from armlab.session.session import Session, Undo
from armlab.session.share import STAYS
from armlab.teaching.lesson_commands import Answer, ChooseCourse, CloseLesson, GoToStep, OpenLesson
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.way import Standing, Way, standings
from support.small_lessons import VARIED, library_fixture
from support.trips import applied, reloaded

PUMA = catalogue()["puma560"]

library = pytest.fixture(library_fixture)

LESSON = """+++
title = "Lesson {key}"
chapter = "1"
after = {after}
minutes = 5
teaches = []
robot = "planar_2r"
+++
## One
```question
kind = "number"
text = "One?"
answer = 1
tolerance = 0.1
```
## Two
Read.
"""

COURSE = """title = "A course"
[[chapters]]
title = "One"
lessons = ["a", "b", "c"]
[[chapters]]
title = "Two"
lessons = ["d", "e", "f"]
"""

NEEDS = {"a": (), "b": ("a",), "c": ("a",), "d": ("b", "other"), "e": ("d",), "f": ("c",), "other": ()}
"""What lessons need; that which a course does not hold is taken for known."""


@pytest.fixture
def session(library, tmp_path):
    """A new student, in a library with a course of six lessons and one that it does not name."""
    (tmp_path / "mine" / "course.toml").write_text(COURSE, encoding="utf-8")
    library(t=None, v=None, **{key: LESSON.format(key=key, after=list(after)) for key, after in NEEDS.items()})
    assert lessons().problems == ()
    return Session.fresh("token", PUMA)


def do(session, *keys):
    """Do lessons whole, and close the last one."""
    for key in keys:
        applied(session, OpenLesson(key), Answer("1"), GoToStep(1))
    return applied(session, CloseLesson())


def way(session):
    return Way.of(session.state[LessonPart], lessons())


def test_a_newcomer_begins_with_the_first_lesson_and_sees_what_follows(session):
    assert way(session).next == "a"
    assert way(session).coming(3) == ("a", "b", "c")
    assert way(session).coming(9) == ("a", "b", "c", "d", "e", "f")
    assert way(session).done == frozenset()


def test_the_next_is_the_first_that_is_not_done_and_has_all_it_needs(session):
    do(session, "a")
    assert (way(session).next, way(session).done) == ("b", {"a"})
    do(session, "c")
    assert way(session).next == "b"
    do(session, "b", "d")
    assert way(session).next == "e"
    do(session, "e", "f")
    assert (way(session).next, way(session).coming(3)) == ("", ())


def test_what_is_lacking_is_told_and_what_the_course_does_not_hold_is_no_matter(session):
    assert way(session).lacks("d") == ("b",)
    assert way(session).lacks("e") == ("d",)
    assert way(session).lacks("a") == ()
    do(session, "a", "b")
    assert way(session).lacks("d") == ()


def test_nothing_is_locked(session):
    applied(session, OpenLesson("e"))
    assert session.state[LessonPart].open == "e"


def test_from_an_open_lesson_one_goes_on_behind_it_and_comes_back_to_what_was_left_out(session):
    do(session, "a")
    applied(session, OpenLesson("c"))
    assert way(session).next == "f", "the open lesson counts as done, and d still lacks what was left out"
    assert way(session).coming(3) == ("f", "b", "d")
    do(session, "c", "f")
    assert way(session).next == "b"
    applied(session, OpenLesson("b"))
    assert way(session).next == "d"
    do(session, "b", "d")
    applied(session, OpenLesson("e"))
    assert way(session).next == ""


def test_a_lesson_of_no_course_is_followed_by_the_first_of_the_course(session):
    applied(session, OpenLesson("other"))
    assert way(session).next == "a"


def test_how_far_one_is(session):
    applied(session, OpenLesson("a"), Answer("1"))
    assert standings(session.state[LessonPart], lessons()) == {"a": Standing(1, 2)}
    assert not way(session).standings["a"].done
    do(session, "a")
    assert way(session).standings["a"].done


def test_of_several_variants_the_one_with_most_counts(session, library):
    library(v=VARIED)
    applied(session, OpenLesson("v", variant=3), GoToStep(1), Answer("1"))
    goal = session.state[LessonPart].lesson.values["goal"]
    applied(session, GoToStep(2), Answer(f"{2 * goal:g}"), OpenLesson("v", variant=5))
    assert way(session).standings["v"] == Standing(2, 3)


def test_a_lesson_whose_file_is_gone_counts_no_more(session, library):
    do(session, "a")
    library(a=None)
    assert way(session).standings == {}
    assert way(session).next == "b"


def test_the_course_is_chosen_kept_and_no_step_of_undo(session, tmp_path):
    assert session.state[LessonPart].course == ""
    assert "course" not in session.state.to_json()["lesson"]
    applied(session, ChooseCourse(OF_THE_LAB))
    assert way(session).course.title == "A course"
    applied(session, Undo())
    assert session.state[LessonPart].course == OF_THE_LAB
    assert reloaded(session.state)[LessonPart].course == OF_THE_LAB
    assert LessonPart.key in STAYS
    applied(session, ChooseCourse("none"))
    assert session.notice.text == "course: unknown name 'none'. Available: lab"
    (tmp_path / "mine" / "course.toml").unlink()
    changed()
    assert way(session).course.title == "All lessons"
    assert reloaded(session.state)[LessonPart].course == OF_THE_LAB
