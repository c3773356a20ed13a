"""The list of assignments on the page Lessons: homework, exams and problem sets, with their dates."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

from armlab.content.as_written import as_part
from armlab.content.assignment import Assignment, said_date
from armlab.content.lesson_head import time_said
from armlab.session.state import Post
from armlab.teaching.assignment_commands import OpenAssignment
from armlab.teaching.assignment_work import Work
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui.begin import ask_to_begin
from armlab.ui.form import Form, Wish
from armlab.ui.html import Markup, tag
from armlab.ui.markup import fold
from armlab.ui.widgets import Gui


def listed(form: Form, gui: Gui, post: Post, found: Iterable[Assignment], part: LessonPart) -> Markup | None:
    """Return the assignments, folded; nothing where there are none."""
    entries = [_entry(form, gui, post, each, part) for each in found]
    count = tag("small", str(len(entries)))
    title = tag("span", "Assignments and problem sets"), count
    return fold(title, entries, opened=bool(part.assignment), kind="lm", key="assignments") if entries else None


def _entry(form: Form, gui: Gui, post: Post, found: Assignment, part: LessonPart) -> Markup:
    work = part.works.get(found.key)
    here = part.assignment == found.key
    inside = (
        tag("u", _sign(work), aria_hidden="true"),
        tag("b", found.title),
        tag("i", time_said(found.minutes)),
        tag("span", _standing(found, work)),
    )
    action = partial(_open, gui, post, found) if work is None and found.minutes else OpenAssignment(found.key)
    shown = "true" if here else ""
    hint = as_part(found.about or found.title)
    return form.button(f"assignment:{found.key}", inside, action, "pick lm-lesson", hint, aria_current=shown)


def _open(gui: Gui, post: Post, found: Assignment) -> Wish:
    """Ask before a clock begins to run."""
    ask_to_begin(gui, post, found)
    return ()


def _sign(work: Work | None) -> str:
    return "○" if work is None else "✓" if work.attempts else "◐"


def _standing(found: Assignment, work: Work | None) -> str:
    """Return the dates of an assignment, and how far the student is."""
    kind = "exam conditions" if found.exam else ""
    opens = f"opens on {said_date(found.opens)}" if found.opens is not None and work is None else ""
    due = f"due on {said_date(found.due)}" if found.due is not None else ""
    stands = "" if work is None else "begun"
    if work is not None and work.handed is not None:
        stands = f"closed on {said_date(work.handed)}"
    return ", ".join(filter(None, (kind, opens, due, stands)))
