"""Choose a lesson: by chapter, each with its arm and how far the student has come."""

from __future__ import annotations

from itertools import groupby

from armlab.content.lessons import Lesson, lessons
from armlab.content.robots import catalogue
from armlab.session.parts.lesson import LessonPart, OpenLesson
from armlab.session.state import State
from armlab.ui.format import escaped
from armlab.ui.plugin import Panel, Post, Show
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the list of lessons."""
    del state
    entries = gui.fields(lambda key, _: post(OpenLesson(key)))

    def show(state: State) -> None:
        part = state[LessonPart]
        chapters = groupby(lessons().lessons.values(), lambda lesson: lesson.chapter)
        entries.show(
            "".join(
                f"<h3>{escaped(chapter)}</h3>" + "".join(_entry(lesson, part, entries.channel_id) for lesson in found)
                for chapter, found in chapters
            )
            + _problems()
        )

    return show


def _entry(lesson: Lesson, part: LessonPart, channel: str) -> str:
    mark = ' aria-current="true"' if lesson.key == part.open else ""
    count = len(lesson.steps)
    steps = f"{count} step{'s' if count > 1 else ''}"
    progress = part.progress_of.get(lesson.key)
    passed = len(progress.passed(lesson)) if progress else 0
    come = "✓ done" if passed == count else f"{passed} of {count}" if progress else ""
    return (
        f'<button class="pick" data-chan="{channel}" data-cell="{lesson.key}"{mark}>'
        f"<b>{escaped(lesson.title)}</b><i>{come}</i>"
        f"<span>{escaped(catalogue()[lesson.robot].name)}, {steps}</span></button>"
    )


def _problems() -> str:
    """Return what is wrong with lesson files that cannot be used."""
    problems = lessons().problems
    if not problems:
        return ""
    head = f"✕ {len(problems)} broken lesson file{'s' if len(problems) > 1 else ''}"
    texts = "".join(f"<p>{escaped(str(problem))}</p>" for problem in problems)
    return f'<div class="verdict no"><b>{head}</b>{texts}</div>'


PANEL = Panel("lessons", "Lessons", "BOOK", 5, (LessonPart,), build, rebuilds=())
