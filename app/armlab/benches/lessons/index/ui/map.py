"""The map of a course: its chapters and lessons with their minutes, what is done, where one is, what comes next."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from armlab.content.as_written import as_part
from armlab.content.course import Chapter
from armlab.content.languages import ENGLISH, only_english
from armlab.content.lesson import Lesson
from armlab.content.lesson_head import time_said
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.way import Way
from armlab.ui.form import Form
from armlab.ui.format import so_many
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold

SIGNS = {"done": "✓", "here": "●", "next": "▸", "begun": "◐", "early": "◌", "open": "○"}
"""Signs of the states of a lesson, in the order in which one goes before another."""

WORDS = {
    "done": "done",
    "here": "open now",
    "next": "comes next",
    "begun": "begun",
    "early": "needs others first",
}
"""Words of the signs, for the legend and for screen readers."""


class Map:
    """The map of a way.

    Parameters
    ----------
    form : Form
    way : Way
    found : mapping of str to Lesson
        All lessons by key.
    language : str
        Key of that in which the map is read.
    """

    def __init__(self, form: Form, way: Way, found: Mapping[str, Lesson], language: str = ENGLISH) -> None:
        self._form, self._way, self._found, self._language = form, way, found, language
        self._next = way.next

    def markup(self, chapters: Sequence[Chapter], others: Sequence[Chapter]) -> Inside:
        """Return the chapters of the course, and behind them, open, those of lessons that no course names.

        In the course that chapter is open which holds the open lesson or the next one.
        """
        present = self._way.here or self._next
        opened = next((each.title for each in chapters if present in each.lessons), "")
        more = tag("h3", "More lessons") if others else None
        return (
            [self._chapter(each, each.title == opened) for each in chapters],
            more,
            [self._chapter(each, True) for each in others],
            _legend(),
        )

    def now(self) -> Markup | None:
        """Return where the student is and what comes next, with a button to begin it."""
        here, coming = self._found.get(self._way.here), self._found.get(self._next)
        if here is None and coming is None:
            return None
        free = here is None or here.key in self._way.done
        lines = (
            self._here(here) if here is not None else None,
            self._coming(coming, free) if coming is not None else None,
        )
        return tag("div.lm-now", lines)

    def _here(self, lesson: Lesson) -> Markup:
        passed, steps = self._way.standings.get(lesson.key, (0, len(lesson.steps)))
        return tag("p", tag("small", "Open now"), tag("b", lesson.title), tag("i", f"{passed} of {steps} steps done"))

    def _coming(self, lesson: Lesson, free: bool) -> Inside:
        """Return the lesson that comes next, with its button unless the student is in the middle of another one."""
        begun = lesson.key in self._way.standings
        line = tag("p", tag("small", "Next"), tag("b", lesson.title), tag("i", time_said(lesson.minutes)))
        word = "Go on" if begun else "Begin"
        label = f"{word}: {as_part(lesson.title)}"
        go = self._form.button("lesson-begin", word, OpenLesson(lesson.key), "main", label=label) if free else None
        return line, go

    def _chapter(self, chapter: Chapter, opened: bool) -> Markup:
        """Return a chapter, with how much of it is done."""
        lessons = [self._found[key] for key in chapter.lessons]
        states = [self._state(lesson.key) for lesson in lessons]
        done, minutes = len(self._way.done & set(chapter.lessons)), time_said(sum(each.minutes for each in lessons))
        count = f"{done} of {len(lessons)}" if done else so_many(len(lessons), "lesson")
        told = tag("small", ", ".join(filter(None, (count, minutes))))
        marks = [tag(f"u.{self._marks(lesson.key, state)}") for lesson, state in zip(lessons, states, strict=True)]
        strip = tag("span.lm-strip", marks, aria_hidden="true")
        about = tag("p.dim", chapter.about) if chapter.about else None
        inside = [self._lesson(lesson, state) for lesson, state in zip(lessons, states, strict=True)]
        return fold(
            (tag("span", chapter.title), told, strip), about, inside, opened=opened, kind="lm", key=chapter.title
        )

    def _lesson(self, lesson: Lesson, state: str) -> Markup:
        """Return one line: sign, title, language if it is another one, minutes; below it what is to be done first."""
        passed, steps = self._way.standings.get(lesson.key, (0, len(lesson.steps)))
        minutes = time_said(lesson.minutes)
        count = f"{passed} of {steps}" if 0 < passed < steps else ""
        lacks = [as_part(self._found[key].title) for key in self._way.lacks(lesson.key)] if state == "early" else []
        first = f"first: {', '.join(lacks)}" if lacks else ""
        english = "in English" if only_english(lesson, self._language) else ""
        used = f"{lesson.robot_used.name}, {so_many(steps, 'step')}"
        hint = " · ".join(filter(None, (used, english)))
        done = "done" if lesson.key in self._way.done else state
        words = dict.fromkeys((WORDS.get(done, ""), WORDS.get(state, "")))
        said = ", ".join(filter(None, (as_part(lesson.title), *words, first, count, minutes)))
        inside = (
            tag("u", SIGNS[done], aria_hidden="true"),
            tag("b", lesson.title),
            tag("small", english) if english else None,
            tag("i", count or minutes),
            tag("span", first) if first else None,
        )
        kind = f"pick lm-lesson {self._marks(lesson.key, state).replace('.', ' ')}"
        here = "true" if state == "here" else ""
        cell = f"lesson:{lesson.key}"
        return self._form.button(cell, inside, OpenLesson(lesson.key), kind, hint, said, aria_current=here)

    def _marks(self, key: str, state: str) -> str:
        """Return the classes of a lesson; one that is open may be done besides."""
        return f"lm-{state}.lm-done" if state == "here" and key in self._way.done else f"lm-{state}"

    def _state(self, key: str) -> str:
        standing = self._way.standings.get(key)
        if key == self._way.here:
            return "here"
        if standing is not None and standing.done:
            return "done"
        if key == self._next:
            return "next"
        if standing is not None and standing.passed:
            return "begun"
        return "early" if self._way.lacks(key) else "open"


def _legend() -> Markup:
    return tag("p.lm-legend", [tag("span", f"{SIGNS[state]} {words}") for state, words in WORDS.items()])
