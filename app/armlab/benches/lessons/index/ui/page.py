"""The choice of a lesson by chapter, and the search for one by an equation, a section or a word of the notes."""

from __future__ import annotations

from itertools import groupby

from armlab.content.lesson import Lesson
from armlab.content.lessons import lessons
from armlab.session.hand_in import MOST
from armlab.session.lesson_commands import OpenLesson
from armlab.session.parts.lesson import LessonPart
from armlab.session.state import Post, State
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.lesson.load import load_work
from armlab.ui.picks import broken_files, pick
from armlab.ui.plugin import Panel, Show
from armlab.ui.search.markup import search_button
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the button of the search and the list of lessons."""
    gui.html(search_button("Find: 3.66, section 4.1, quaternion …", "field"))
    saved, entries = gui.form(post, MOST), gui.form(post)

    def show(state: State) -> None:
        saved.show(tag("div.chips", load_work(saved)))
        entries.show(_all(entries, state))

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
    return pick(form, f"lesson:{lesson.key}", OpenLesson(lesson.key), lesson.title, come, about, here)


PANEL = Panel((LessonPart,), build, rebuilds=(), outside=lessons)
