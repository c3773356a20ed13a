"""The first reading of all lessons, which takes seconds: it gives way to others, and all who wait get the same."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor
from functools import cache

import pytest

from armlab.content import lessons as module
from armlab.content.lessons import Library, lessons
from support.own_lessons import lesson, write


@pytest.fixture
def lab(tmp_path):
    folder = tmp_path / "lab"
    folder.mkdir()
    return write(folder, first=lesson(title="First"))


def test_the_first_reading_pauses_after_each_lesson_and_later_ones_do_not(lab):
    write(lab, second=lesson(title="Second"))
    pauses = []
    found = Library([lab], pause=pauses.append)
    assert len(pauses) == 2
    assert min(pauses) > 0.0
    write(lab, third=lesson(title="Third"))
    assert found.changed() == {"third"}
    assert len(pauses) == 2


def test_who_needs_the_lessons_ends_the_pauses(lab, monkeypatch):
    needed, reading = threading.Event(), threading.Event()
    monkeypatch.setattr(module, "_NEEDED", needed)
    monkeypatch.setattr(module, "folders_of_the_lab", lambda: reading.set() or [lab])
    monkeypatch.setattr(module, "GIVING_WAY", 1e6)
    monkeypatch.setattr(module, "_library", cache(module._library.__wrapped__))
    slowly = threading.Thread(target=module.read_unhurried)
    slowly.start()
    assert reading.wait(10.0)
    assert module.lessons_read() is None
    assert "first" in lessons().lessons
    slowly.join()


def test_two_who_ask_at_once_get_one_library(monkeypatch):
    made, begun = [], threading.Barrier(2)

    class Slow:
        def __init__(self, folders, pause):
            time.sleep(0.1)
            made.append(self)

    def ask(_):
        begun.wait()
        return module.library()

    monkeypatch.setattr(module, "Library", Slow)
    monkeypatch.setattr(module, "_library", cache(module._library.__wrapped__))
    with ThreadPoolExecutor(2) as both:
        assert list(both.map(ask, range(2))) == made * 2
