"""The course in another order: its lessons moved and left out, and its file."""

from __future__ import annotations

from functools import partial

from armlab.content.course import Course
from armlab.content.course_order import course_text, mistakes
from armlab.content.desk import desk
from armlab.content.lesson_folder import COURSE
from armlab.content.lessons import Lessons, lessons
from armlab.content.upload import COURSE_KIND, Upload
from armlab.errors import ArmlabError, InputError
from armlab.session.own_commands import ArrangeCourse, LeaveOut, MoveInCourse
from armlab.session.parts.own_lessons import OwnLessons
from armlab.session.parts.teacher import Teacher
from armlab.session.state import Post, State
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold, row, verdict_box
from armlab.ui.widgets import Gui

ABOUT = "Move lessons up and down or leave them out, and save the order as course.toml."


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
        course, found = state[OwnLessons].course, lessons()
        if self._form.shows(course, found, state[Teacher].let_in, self._given):
            return
        begin = self._form.chip("order-begin", "Begin with the course shown", ArrangeCourse())
        inside: Inside = tag("p", ABOUT), tag("div.bar", begin)
        if course is not None:
            inside = self._course(course, found, state[Teacher].let_in)
        self._form.show(fold("Order of the course", inside, opened=course is not None, key="order"))

    def _course(self, course: Course, found: Lessons, may_give: bool) -> Inside:
        form = self._form
        wrong = mistakes(course, {*found.lessons, *found.broken}, found.needs)
        save = form.button("order-save", f"Save {COURSE}", partial(self._save, course), "main")
        give = None
        if may_give and desk() is not None:
            give = form.chip("order-give", "For everybody", partial(self._give, course), off=bool(wrong))
        away = form.chip("order-end", "Forget it", ArrangeCourse(False), "Forget this order; the course is as it was")
        head = f"{len(wrong)} mistake{'s' if len(wrong) > 1 else ''} in this order"
        box = verdict_box("no", head, [tag("p", str(each)) for each in wrong], role="status") if wrong else None
        given = tag("p", self._given, role="status") if self._given else None
        return box, tag("div.bar", save, give, away), given, self._lessons(course, found), self._others(course, found)

    def _lessons(self, course: Course, found: Lessons) -> Inside:
        return [
            (
                tag("h4.al-order-title", chapter.title),
                tag("ol.al-order", [self._line(key, course, found) for key in chapter.lessons]),
            )
            for chapter in course.chapters
        ]

    def _line(self, key: str, course: Course, found: Lessons) -> Markup:
        """Return a lesson with its buttons, which keep the focus when it moves."""
        form, title = self._form, found.lessons[key].title if key in found.lessons else key
        up, down, out = f"Move “{title}” up", f"Move “{title}” down", f"Leave “{title}” out"
        ends = course.lessons[0] == key, course.lessons[-1] == key
        return tag(
            "li",
            tag("span", title),
            form.button(f"up {key}", "↑", MoveInCourse(key, -1), "chip", up, up, off=ends[0]),
            form.button(f"down {key}", "↓", MoveInCourse(key, 1), "chip", down, down, off=ends[1]),
            form.button(f"out {key}", "✕", LeaveOut(key), "chip", out, out),
        )

    def _others(self, course: Course, found: Lessons) -> Markup | None:
        """Return the choice of a lesson that is not in the course."""
        left = {each.key: each.title for each in found.listed if each.key not in course.lessons}
        if not left:
            return None
        texts = {"": "Put in at the end …", **left}
        return row("Left out", self._form.select("order-in", "Put in", texts, "", lambda key: LeaveOut(key, back=True)))

    def _save(self, course: Course) -> None:
        self._gui.save(COURSE, course_text(course))

    def _give(self, course: Course) -> None:
        """Put the course into the folder for everybody."""
        found = desk()
        if found is None:
            raise InputError("This lab has no folder for what is loaded.")
        try:
            found.put(Upload(COURSE_KIND, "course", course_text(course)))
        except ArmlabError as refusal:
            raise InputError(str(refusal)) from None
        self._given = f"✓ {COURSE} is there for everybody."
