"""The choice of a lesson by chapter, and the search for one by an equation, a section or a word of the notes."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
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
from armlab.ui.markup import fold
from armlab.ui.picks import broken_files, pick
from armlab.ui.plugin import Panel, Show
from armlab.ui.search.markup import search_button
from armlab.ui.widgets import Gui

NOTES = (
    "“The notes” in the lessons are the lecture notes of the course Robotics 1. You need none of them: whatever a "
    "lesson uses stands in it. Where it says that they err, a number leads to the page "
)


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the button of the search and the list of lessons."""
    gui.html(search_button("Find: 3.66, section 4.1, quaternion …", "field"))
    saved, entries, notes = gui.form(post, MOST), gui.form(post), gui.form(post)

    def show(state: State) -> None:
        saved.show(tag("div.chips", load_work(saved)))
        entries.show(_all(entries, state))
        errata = notes.button("errata", "Errata", partial(gui.open_panel, "errata"), "copy", "Open the page Errata")
        notes.show(tag("p.dim", NOTES, errata, "."))

    return show


def _all(form: Form, state: State) -> Inside:
    """Return the lessons by chapter, each with its arm and the student's progress."""
    part = state[LessonPart]
    chapters = [
        (chapter, list(found)) for chapter, found in groupby(lessons().lessons.values(), lambda lesson: lesson.chapter)
    ]
    here = part.open.partition("/")[0]
    present = next((chapter for chapter, found in chapters if any(each.key == here for each in found)), None)
    listed = [
        _chapter(form, chapter, found, part, chapter == present if present else i == 0)
        for i, (chapter, found) in enumerate(chapters)
    ]
    return listed, broken_files("lesson", lessons().problems)


def _chapter(form: Form, chapter: str, found: Sequence[Lesson], part: LessonPart, opened: bool) -> Markup:
    """Return a chapter, which is open where it holds the open lesson, or is the first when none is open."""
    done = sum(_passed(lesson, part) == len(lesson.steps) for lesson in found)
    count = f"{done} of {len(found)} done" if done else f"{len(found)} lesson{'s' if len(found) > 1 else ''}"
    inside = [_lesson(form, lesson, part) for lesson in found]
    return fold((chapter, " ", tag("small", count)), inside, opened=opened, key=chapter)


def _passed(lesson: Lesson, part: LessonPart) -> int:
    """Return the number of steps passed, in the variant in which most were."""
    progress = [each for place, each in part.progress_of.items() if place.partition("/")[0] == lesson.key]
    return max((len(each.passed(lesson)) for each in progress), default=0)


def _lesson(form: Form, lesson: Lesson, part: LessonPart) -> Markup:
    count = len(lesson.steps)
    steps = f"{count} step{'s' if count > 1 else ''}"
    passed = _passed(lesson, part)
    begun = any(place.partition("/")[0] == lesson.key for place in part.progress_of)
    come = "✓ done" if passed == count else f"{passed} of {count}" if begun else ""
    about = f"{lesson.robot_used.name}, {steps}"
    here = lesson.key == part.open.partition("/")[0]
    return pick(form, f"lesson:{lesson.key}", OpenLesson(lesson.key), lesson.title, come, about, here)


PANEL = Panel((LessonPart,), build, rebuilds=(), outside=lessons)
