"""The course in another order: its lessons moved and left out, and its file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Self

from armlab.benches.lessons.course_order import course_text, mistakes
from armlab.benches.lessons.own_commands import ArrangeCourse, LeaveOut, MoveInCourse
from armlab.content.as_written import as_part
from armlab.content.course import Course, sound
from armlab.content.desk import desk
from armlab.content.lesson_folder import COURSE
from armlab.content.lessons import Lessons, lessons
from armlab.content.upload import COURSE_KIND, Upload
from armlab.errors import ArmlabError, InputError
from armlab.session.state import Post, State
from armlab.teaching.parts.own_lessons import OwnLessons
from armlab.teaching.parts.teacher import Teacher
from armlab.ui.format import so_many
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold, row, verdict_box
from armlab.ui.widgets import Gui

ABOUT = "Move lessons up and down or leave them out, and save the order as course.toml."
BESIDE = f"What a course names has to lie in the folder of {COURSE}, too."


@dataclass(frozen=True)
class _There:
    """The lessons that may stand in the course: those of the lab, and those that this person has loaded.

    A course names a lesson by its file, and so does this. Where two have one name, that of the lab counts.

    Attributes
    ----------
    known : frozenset of str
    needs : mapping of str to tuple of str
        By lesson, the names of those that it needs.
    titles : mapping of str to str
    offered : tuple of str
        Those that are listed, one's own last.
    files : mapping of str to str
        By name, the files of one's own.
    """

    known: frozenset[str]
    needs: Mapping[str, tuple[str, ...]]
    titles: Mapping[str, str]
    offered: tuple[str, ...]
    files: Mapping[str, str]

    @classmethod
    def of(cls, own: OwnLessons, found: Lessons) -> Self:
        """Return what there is for whoever has loaded some."""
        of_lab = {*found.lessons, *found.broken}
        loaded = {key: lesson for key, lesson in own.lessons.items() if key not in of_lab}
        every = {**found.lessons, **loaded}
        return cls(
            frozenset({*of_lab, *loaded}),
            sound({**found.needs, **{key: lesson.after for key, lesson in loaded.items()}}, every),
            {key: lesson.title for key, lesson in every.items()},
            (*(each.key for each in found.listed), *(key for key, lesson in loaded.items() if lesson.listed)),
            {key: lesson.file for key, lesson in loaded.items()},
        )


class Order:
    """The list of the lessons of a course.

    Parameters
    ----------
    gui : Gui
    post : callable
    """

    def __init__(self, gui: Gui, post: Post) -> None:
        self._gui, self._form = gui, gui.form(post)
        self._given = ""

    def show(self, state: State) -> None:
        """Show the course of a state that is being put in order."""
        own, found, may_give = state[OwnLessons], lessons(), state[Teacher].let_in
        if self._form.shows(own.course, own.held, found, may_give, self._given):
            return
        begin = self._form.chip("order-begin", "Begin with the course shown", ArrangeCourse())
        inside: Inside = tag("p", ABOUT), tag("div.bar", begin)
        if own.course is not None:
            inside = self._course(own.course, _There.of(own, found), may_give)
        self._form.show(fold("Order of the course", inside, opened=own.course is not None, key="order"))

    def _course(self, course: Course, there: _There, may_give: bool) -> Inside:
        form = self._form
        wrong = mistakes(course, there.known, there.needs)
        save = form.button("order-save", f"Save {COURSE}", partial(self._save, course), "main")
        give = None
        if may_give and desk() is not None:
            give = form.chip("order-give", "For everybody", partial(self._give, course, there), off=bool(wrong))
        away = form.chip("order-end", "Forget it", ArrangeCourse(False), "Forget this order; the course is as it was")
        head = f"{so_many(len(wrong), 'mistake')} in this order"
        box = verdict_box("no", head, [tag("p", str(each)) for each in wrong], role="status") if wrong else None
        alone = [there.files[key] for key in course.lessons if key in there.files]
        yours = tag("p", f"So far only you see {', '.join(alone)}. {BESIDE}") if alone else None
        given = tag("p", self._given, role="status") if self._given else None
        bar = tag("div.bar", save, give, away)
        return box, bar, given, yours, self._lessons(course, there), self._others(course, there)

    def _lessons(self, course: Course, there: _There) -> Inside:
        return [
            (
                tag("h4.al-order-title", chapter.title),
                tag("ol.al-order", [self._line(key, course, there) for key in chapter.lessons]),
            )
            for chapter in course.chapters
        ]

    def _line(self, key: str, course: Course, there: _There) -> Markup:
        """Return a lesson with its buttons, which keep the focus when it moves."""
        form, title = self._form, there.titles.get(key, key)
        name = as_part(title)
        up, down, out = f"Move “{name}” up", f"Move “{name}” down", f"Leave “{name}” out"
        ends = course.lessons[0] == key, course.lessons[-1] == key
        return tag(
            "li",
            tag("span", title),
            form.button(f"up {key}", "↑", MoveInCourse(key, -1), "chip", up, up, off=ends[0]),
            form.button(f"down {key}", "↓", MoveInCourse(key, 1), "chip", down, down, off=ends[1]),
            form.button(f"out {key}", "✕", LeaveOut(key), "chip", out, out),
        )

    def _others(self, course: Course, there: _There) -> Markup | None:
        """Return the choice of a lesson that is not in the course."""
        left = {key: there.titles[key] for key in there.offered if key not in course.lessons}
        if not left:
            return None
        texts = {"": "Put in at the end …", **left}
        return row("Left out", self._form.select("order-in", "Put in", texts, "", lambda key: LeaveOut(key, back=True)))

    def _save(self, course: Course) -> None:
        self._gui.save(COURSE, course_text(course))

    def _give(self, course: Course, there: _There) -> None:
        """Put the course into the folder for everybody."""
        found = desk()
        if found is None:
            raise InputError("This lab has no folder for what is loaded.")
        try:
            found.put(Upload(COURSE_KIND, "course", course_text(course)), there.files)
        except ArmlabError as refusal:
            raise InputError(str(refusal)) from None
        self._given = f"✓ {COURSE} is there for everybody."
