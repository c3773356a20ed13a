"""Find and choose a lesson: by chapter, or by an equation, a section or a word of the notes."""

from __future__ import annotations

from functools import cache
from itertools import groupby

from armlab.content.index import Bench, Entry, search
from armlab.content.lesson import Lesson
from armlab.content.lessons import lessons
from armlab.session.hand_in import MOST
from armlab.session.lesson_commands import OpenLesson
from armlab.session.parts.lesson import LessonPart
from armlab.session.state import Post, State
from armlab.ui import markup
from armlab.ui.format import escaped
from armlab.ui.lesson.load import load_work
from armlab.ui.picks import broken_files, pick
from armlab.ui.plugin import Panel, Show, hidden_panels, pages
from armlab.ui.widgets import Gui

LESSON, BENCH = "lesson:", "bench:"


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the field of the index and the list of lessons."""
    query, shown = "", state

    def asked(cell: str, text: str) -> None:
        nonlocal query
        if cell.startswith(LESSON):
            post(OpenLesson(cell.removeprefix(LESSON)))
        elif cell.startswith(BENCH):
            gui.open_panel(cell.removeprefix(BENCH))
        elif cell == "query":
            query = text.strip()
            show(shown)

    field = gui.fields(asked)
    saved = gui.form(post, MOST)
    entries = gui.fields(asked)

    hint = "Find: 3.66, section 4.1, quaternion …"
    line = markup.field(field.channel_id, "query", "", "Find", data_live="1", type="search", placeholder=hint)
    field.show(f'<div class="find">{line}</div>')
    saved.show(f'<div class="chips">{load_work(saved)}</div>')

    def show(state: State) -> None:
        nonlocal shown
        shown = state
        entries.show(_found(query, state, entries.channel_id) if query else _all(state, entries.channel_id))

    return show


def _all(state: State, channel: str) -> str:
    """Return the lessons by chapter, each with its arm and how far the student has come."""
    part = state[LessonPart]
    chapters = groupby(lessons().lessons.values(), lambda lesson: lesson.chapter)
    return "".join(
        f"<h3>{escaped(chapter)}</h3>" + "".join(_lesson(lesson, part, channel) for lesson in found)
        for chapter, found in chapters
    ) + broken_files("lesson", lessons().problems)


def _lesson(lesson: Lesson, part: LessonPart, channel: str) -> str:
    count = len(lesson.steps)
    steps = f"{count} step{'s' if count > 1 else ''}"
    progress = [each for place, each in part.progress_of.items() if place.partition("/")[0] == lesson.key]
    passed = max((len(each.passed(lesson)) for each in progress), default=0)
    come = "✓ done" if passed == count else f"{passed} of {count}" if progress else ""
    about = f"{lesson.robot_used.name}, {steps}"
    return pick(channel, LESSON + lesson.key, lesson.title, come, about, lesson.key == part.open.partition("/")[0])


@cache
def _benches() -> tuple[Bench, ...]:
    return tuple(Bench(key, panel.title, panel.about) for key, panel in pages().items())


def _found(query: str, state: State, channel: str) -> str:
    """Return what the index finds: lessons and benches to go to, rows of the course, functions of the core."""
    hidden = hidden_panels(state)
    found = search(query, benches=tuple(bench for bench in _benches() if bench.key not in hidden))
    if not found:
        return '<p class="dim">Nothing is found. Try an equation (3.66), a section (4.1) or a word.</p>'
    return "".join(_entry(entry, channel) for entry in found)


def _entry(entry: Entry, channel: str) -> str:
    if entry.kind == "lesson":
        return pick(channel, LESSON + entry.key, entry.title, "lesson", entry.detail, False)
    if entry.kind == "bench":
        return pick(channel, BENCH + entry.key, entry.title, "bench", entry.detail, False)
    if entry.kind == "function":
        name = entry.key.removeprefix("armlab.kin.")
        return (
            f'<div class="found"><b>{escaped(name)}</b><i>function</i><span>{escaped(entry.detail)}</span>'
            f"{markup.copy_button('import line', _import_line(entry.key))}</div>"
        )
    ways = [
        *(markup.chip(channel, LESSON + key, lessons()[key].title, "Lesson") for key in entry.lessons),
        *(markup.chip(channel, BENCH + key, pages()[key].title, "Bench") for key in entry.benches),
    ]
    kind = "chapter" if entry.kind == "chapter" else "topic"
    chips = f'<div class="chips">{"".join(ways)}</div>' if ways else ""
    head = f"<b>{escaped(entry.title)}</b><i>{kind}</i><span>{escaped(entry.detail)}</span>"
    return f'<div class="found">{head}{chips}</div>'


def _import_line(key: str) -> str:
    module, _, name = key.rpartition(".")
    return f"from {module} import {name}"


PANEL = Panel((LessonPart,), build, rebuilds=(), outside=lessons)
