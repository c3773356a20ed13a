"""The choice of a lesson: by chapter, or by an equation, a section or a word of the notes."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from itertools import groupby

from armlab.content.index import Bench, Entry, search
from armlab.content.lesson import Lesson
from armlab.content.lessons import lessons
from armlab.session.hand_in import MOST
from armlab.session.lesson_commands import OpenLesson
from armlab.session.pages import pages
from armlab.session.panel_commands import hidden_panels
from armlab.session.parts.lesson import LessonPart
from armlab.session.state import Post, State
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.lesson.load import load_work
from armlab.ui.markup import copy_button
from armlab.ui.picks import broken_files, pick
from armlab.ui.plugin import Panel, Show
from armlab.ui.widgets import Gui

LESSON, BENCH = "lesson:", "bench:"


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the field of the index and the list of lessons."""
    query = ""

    def asked(text: str) -> None:
        nonlocal query
        query = text.strip()

    field, saved, entries = gui.form(post), gui.form(post, MOST), gui.form(post)
    hint = "Find: 3.66, section 4.1, quaternion …"
    line = field.field("query", "", "Find", asked, inputmode="", data_live="1", type="search", placeholder=hint)
    field.show(tag("div.find", line))  # once: a person is typing in it

    def show(state: State) -> None:
        saved.show(tag("div.chips", load_work(saved)))
        entries.show(_found(entries, query, state, gui.open_panel) if query else _all(entries, state))

    return show


def _all(form: Form, state: State) -> Inside:
    """Return the lessons by chapter, each with its arm and the student's progress."""
    part = state[LessonPart]
    chapters = groupby(lessons().lessons.values(), lambda lesson: lesson.chapter)
    listed = [(tag("h3", chapter), [_lesson(form, lesson, part) for lesson in found]) for chapter, found in chapters]
    return listed, broken_files("lesson", lessons().problems)


def _lesson(form: Form, lesson: Lesson, part: LessonPart) -> Markup:
    count = len(lesson.steps)
    steps = f"{count} step{'s' if count > 1 else ''}"
    progress = [each for place, each in part.progress_of.items() if place.partition("/")[0] == lesson.key]
    passed = max((len(each.passed(lesson)) for each in progress), default=0)
    come = "✓ done" if passed == count else f"{passed} of {count}" if progress else ""
    about = f"{lesson.robot_used.name}, {steps}"
    here = lesson.key == part.open.partition("/")[0]
    return pick(form, LESSON + lesson.key, OpenLesson(lesson.key), lesson.title, come, about, here)


@cache
def _benches() -> tuple[Bench, ...]:
    return tuple(Bench(key, panel.title, panel.about) for key, panel in pages().items())


def _found(form: Form, query: str, state: State, turn_to: Callable[[str], None]) -> Inside:
    """Return the finds of the index: lessons and benches to open, rows of the course, functions of the core.

    ``turn_to`` gets the key of a bench.
    """
    hidden = hidden_panels(state)
    found = search(query, benches=tuple(bench for bench in _benches() if bench.key not in hidden))
    if not found:
        return tag("p.dim", "Nothing is found. Try an equation (3.66), a section (4.1) or a word.")
    return [_entry(form, entry, turn_to) for entry in found]


def _entry(form: Form, entry: Entry, turn_to: Callable[[str], None]) -> Markup:
    if entry.kind == "lesson":
        return pick(form, LESSON + entry.key, OpenLesson(entry.key), entry.title, "lesson", entry.detail, False)
    if entry.kind == "bench":
        return pick(form, BENCH + entry.key, partial(turn_to, entry.key), entry.title, "bench", entry.detail, False)
    if entry.kind == "function":
        name = entry.key.removeprefix("armlab.kin.")
        return _row(name, "function", entry.detail, copy_button("import line", _import_line(entry.key)))
    ways = [
        *(form.chip(LESSON + key, lessons()[key].title, OpenLesson(key), "Lesson") for key in entry.lessons),
        *(form.chip(BENCH + key, pages()[key].title, partial(turn_to, key), "Bench") for key in entry.benches),
    ]
    kind = "chapter" if entry.kind == "chapter" else "topic"
    return _row(entry.title, kind, entry.detail, tag("div.chips", ways) if ways else None)


def _row(title: str, kind: str, detail: str, below: Markup | None) -> Markup:
    return tag("div.found", tag("b", title), tag("i", kind), tag("span", detail), below)


def _import_line(key: str) -> str:
    module, _, name = key.rpartition(".")
    return f"from {module} import {name}"


PANEL = Panel((LessonPart,), build, rebuilds=(), outside=lessons)
