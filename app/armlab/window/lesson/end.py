"""The end of a lesson: what one can do now, and the lesson that comes next."""

from __future__ import annotations

from armlab.content.lesson import Lesson
from armlab.content.lesson_head import time_said
from armlab.content.lessons import Lessons, lessons_read
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.way import Way
from armlab.ui.form import Form
from armlab.ui.html import Markup, joined, tag

ONWARD = "lesson-onward"
"""Cell of the button that opens the next lesson."""


def with_end(form: Form, lesson: Lesson, part: LessonPart, foot: Markup) -> Markup:
    """Return the foot of the last step with the lesson that comes next.

    That is a main button when all steps are done, with what one can do now; until then it stands below the foot, and
    can be pressed all the same. Which one it is nobody knows until all lessons have been read.
    """
    done = len(part.progress.passed(lesson)) == len(lesson.steps)
    there = lessons_read()
    onward = None if there is None else _onward(form, Way.of(part, there), there, done)
    return joined(_can_now(lesson.can), onward, foot) if done else joined(foot, onward)


def _can_now(can: tuple[str, ...]) -> Markup | None:
    said = tag("ul", [tag("li", sentence) for sentence in can])
    return tag("div.lesson-can", tag("b", "You can now"), said) if can else None


def _onward(form: Form, way: Way, there: Lessons, done: bool) -> Markup | None:
    """Return the button of the next lesson, or that there is none left."""
    key = way.next
    if not key:
        whole = done and way.done.issuperset(way.course.lessons)
        return tag("p.lesson-whole", "You have done all lessons of the course.") if whole else None
    found = there[key]
    minutes = time_said(found.minutes)
    inside = "Next lesson: ", tag("b", found.title), f", {minutes}" if minutes else None
    return form.button(ONWARD, inside, OpenLesson(key), "main onward" if done else "way onward")
