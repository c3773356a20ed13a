"""The first reading of all lessons, which takes seconds: it gives way to others, and all who wait get the same."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor
from functools import cache

import pytest

from armlab.content import lessons as module
from armlab.content.lesson_reading import Readings
from armlab.content.lessons import lesson, lessons
from armlab.content.robots import catalogue
from armlab.errors import ArmlabError
from armlab.session.state import State, apply
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.parts.lesson import LessonPart
from armlab.window import lab as lab_module
from armlab.window.lesson.page import _choice
from support.forms import BareForm
from support.lab import running_lab
from support.own_lessons import lesson as lesson_text
from support.own_lessons import write
from support.patience import WAIT
from support.small_lessons import VARIED


@pytest.fixture(autouse=True)
def no_lab_looks(monkeypatch):
    """Let the lab that browsers of this process share not look at the lessons meanwhile, for it reads them then."""
    there = module.lessons_read()
    monkeypatch.setattr(lab_module, "changed", frozenset)
    monkeypatch.setattr(lab_module, "lessons", lambda: there)


@pytest.fixture
def lab(tmp_path):
    folder = tmp_path / "lab"
    folder.mkdir()
    return write(folder, first=lesson_text(title="First"))


@pytest.fixture
def unread(lab, monkeypatch):
    """Let nobody have needed the lessons of the lab yet, which are those of a test."""
    monkeypatch.setattr(module, "_READINGS", Readings())
    monkeypatch.setattr(module, "_library", cache(module._library.__wrapped__))
    monkeypatch.setattr(module, "folders_of_the_lab", lambda: [lab])


class Pauses:
    """Stands in for the event that ends the pauses; what is to be done in the first of them is done then."""

    def __init__(self, meanwhile=lambda: None):
        self.seconds, self._meanwhile = [], meanwhile

    def wait(self, seconds):
        self.seconds.append(seconds)
        self._meanwhile()

    def set(self):
        """Let somebody need the lessons."""


def test_the_first_reading_pauses_after_each_lesson_and_later_ones_do_not(lab, unread, monkeypatch):
    write(lab, second=lesson_text(title="Second"))
    pauses = Pauses()
    monkeypatch.setattr(module, "_NEEDED", pauses)
    assert module.read_unhurried(threading.Event())
    assert len(pauses.seconds) == 2
    assert min(pauses.seconds) > 0.0
    write(lab, third=lesson_text(title="Third"))
    assert module.changed() == {"third"}
    assert module.read_unhurried(threading.Event())
    assert len(pauses.seconds) == 2


def test_a_reading_that_is_given_up_stops_after_a_lesson_and_who_needs_them_reads_the_rest(lab, unread, monkeypatch):
    write(lab, second=lesson_text(title="Second"))
    ended = threading.Event()
    pauses = Pauses(ended.set)
    monkeypatch.setattr(module, "_NEEDED", pauses)
    assert not module.read_unhurried(ended)
    assert len(pauses.seconds) == 1
    assert module.lessons_read() is None
    assert module._READINGS.known("first") is not None
    assert module._READINGS.known("second") is None
    monkeypatch.setattr(module, "_NEEDED", threading.Event())
    assert set(lessons().lessons) == {"first", "second"}


def test_who_needs_the_lessons_ends_the_pauses(lab, unread, monkeypatch):
    reading = threading.Event()
    monkeypatch.setattr(module, "_NEEDED", threading.Event())
    monkeypatch.setattr(module, "folders_of_the_lab", lambda: reading.set() or [lab])
    monkeypatch.setattr(module, "GIVING_WAY", 1e6)
    slowly = threading.Thread(target=module.read_unhurried, args=(threading.Event(),))
    slowly.start()
    assert reading.wait(10.0)
    assert module.lessons_read() is None
    assert "first" in lessons().lessons
    slowly.join()


def test_who_opens_a_lesson_does_not_wait_for_all_others(lab, unread):
    write(lab, varied=VARIED, broken="hello")
    state = State.initial(catalogue()["puma560"])
    part = apply(apply(state, OpenLesson("first")), OpenLesson("varied", variant=3))[LessonPart]
    assert module.lessons_read() is None
    early = part.lesson, lesson("first")
    form = BareForm()
    form.show(_choice(form, early[0], "", tuple))
    assert form.fields.content.count("<option") == 1
    assert lessons()["first"] is early[1]
    assert part.lesson is early[0]
    form.show(_choice(form, early[0], "", tuple))
    assert form.fields.content.count("<option") == 2


@pytest.mark.parametrize(("key", "says"), [("none", "unknown name 'none'"), ("broken", "expected a first line")])
def test_a_lesson_that_is_none_is_told_with_all_there_are(lab, unread, key, says):
    write(lab, broken="hello")
    with pytest.raises(ArmlabError, match=says):
        lesson(key)
    assert module.lessons_read() is not None


def test_two_who_ask_at_once_get_one_library(monkeypatch):
    made, begun = [], threading.Barrier(2)

    class Slow:
        def __init__(self, folders, readings):
            time.sleep(0.1)
            made.append(self)

    def ask(_):
        begun.wait()
        return module.library()

    monkeypatch.setattr(module, "Library", Slow)
    monkeypatch.setattr(module, "_library", cache(module._library.__wrapped__))
    with ThreadPoolExecutor(2) as both:
        assert list(both.map(ask, range(2))) == made * 2


def test_a_lab_that_ends_does_not_read_to_the_end(monkeypatch):
    reading, told = threading.Event(), []

    def read(given_up):
        reading.set()
        told.append(given_up.wait(WAIT))
        return False

    for name, there in {"lessons_read": lambda: None, "read_unhurried": read, "UNVISITED": 0.0}.items():
        monkeypatch.setattr(lab_module, name, there)
    with running_lab():
        assert reading.wait(WAIT)
        assert told == []
    assert told == [True]
