"""The map of the course, and the search for a lesson by an equation, a section or a word of the notes."""

from __future__ import annotations

from functools import partial

from armlab.benches.lessons.index.ui.assignments import listed
from armlab.benches.lessons.index.ui.map import Map
from armlab.content.lesson_head import time_said
from armlab.content.lessons import Lessons, lessons, lessons_read
from armlab.session.state import Post, State
from armlab.teaching.hand_in import MOST
from armlab.teaching.lesson_commands import ChooseCourse
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.way import Way
from armlab.ui.form import Form
from armlab.ui.format import so_many
from armlab.ui.html import Inside, tag
from armlab.ui.load_work import load_work
from armlab.ui.markup import on_paper, row
from armlab.ui.picks import broken_files, lessons_to_come
from armlab.ui.plugin import Panel, Show
from armlab.ui.search_button import search_button
from armlab.ui.widgets import Gui

NOTES = (
    "“The notes” are those of the course Robotics 1. No lesson needs them; the page Errata has what they print wrongly"
)
FORMULAS = "The formulas of the course on two pages A4, to print; opens a page of its own"
PRINTED = "The whole course on paper, with boxes to tick; opens a page of its own"


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the map, the button of the search, and what is needed seldom."""
    now = gui.form(post)
    gui.html(search_button("Find: 3.66, section 4.1, quaternion …", "field"))
    entries, sheets, saved = gui.form(post), gui.form(post), gui.form(post, MOST)

    def show(state: State) -> None:
        found, part = lessons(), state[LessonPart]
        way = Way.of(part, found)
        now.show(_head(now, found, way), Map(now, way, found.lessons).now())
        course_map = Map(entries, way, found.lessons, gui.language).markup(way.course.chapters, found.others)
        entries.show(course_map, broken_files("lesson", found.problems))
        sheets.show(listed(sheets, gui, post, found.assignments.values(), part))
        errata = saved.chip("errata", "Errata of the notes", partial(gui.open_panel, "errata"), NOTES)
        paper = on_paper("To print", "course", way.course.key, PRINTED), on_paper("Formulas", "formulas", hint=FORMULAS)
        saved.show(tag("div.chips", load_work(saved), paper, errata))

    return show


def _head(form: Form, found: Lessons, way: Way) -> Inside:
    """Return the course that is shown, where there are several a choice, and how much of it is done."""
    courses = {course.key: course.title for course in found.courses}
    if len(courses) > 1:
        title: Inside = row("Course", form.select("course", "Course", courses, way.course.key, ChooseCourse))
    else:
        title = tag("h3", way.course.title)
    return title, tag("p.dim", _told(way, found))


def _told(way: Way, found: Lessons) -> str:
    """Return how many lessons the course has and how long they take, or how many are done."""
    count = len(way.course.lessons)
    left = [key for key in way.course.lessons if key not in way.done]
    minutes = time_said(sum(found.lessons[key].minutes for key in left))
    lessons = so_many(count, "lesson")
    if len(left) == count:
        return ", ".join(filter(None, (lessons, minutes)))
    done = f"{count - len(left)} of {lessons} done"
    return f"{done}, {minutes} left" if minutes else done


PANEL = Panel((LessonPart,), build, rebuilds=(), outside=lessons_read, waits=lessons_to_come)
