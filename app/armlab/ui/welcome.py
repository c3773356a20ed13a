"""The first visit: the card that says where to start, and the stops of the tour, each beside the real thing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from armlab.content.lesson_head import Headed, time_said
from armlab.content.lessons import lessons_read
from armlab.content.outline import first_heads
from armlab.session.pages import pages
from armlab.session.panel_commands import OpenPanel
from armlab.session.state import Command, State
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.welcome import CARD, LEFT, LeaveWelcome, TakeTour, Welcome
from armlab.teaching.way import Way
from armlab.ui.form import Form
from armlab.ui.html import Markup, tag

OFFERED = 3
"""Number of lessons on the card."""


@dataclass(frozen=True)
class Stop:
    """A stop of the tour.

    Attributes
    ----------
    at : str
        What it points at; the page's script, ``tour.js``, knows where that is.
    title, text : str
    opens : str
        The page that has to be open for it; empty for any.
    tab : str
        The page at whose tab it points where there is nothing else to see of it; empty for none.
    """

    at: str
    title: str
    text: str
    opens: str = ""
    tab: str = ""


STOPS = (
    Stop(
        "handle",
        "Drag the handle",
        "Pull one of its arrows: the arm follows by inverse kinematics. The line at the bottom says whether the "
        "tool reaches the target and, if not, why.",
    ),
    Stop(
        "sliders",
        "Move single joints",
        "There is one slider for each joint. Ctrl+Z undoes whatever you do.",
        opens="joints",
        tab="joints",
    ),
    Stop(
        "arm",
        "Choose an arm",
        "Press the name to see pictures of all arms of the lab, and New arm for one of your own.",
    ),
    Stop(
        "lessons",
        "Learn with lessons",
        "The map shows all lessons in order, and what comes next. Lessons ask questions, check what you do with the "
        "arm, and give hints.",
        tab="lessons",
    ),
)


def offered(state: State) -> tuple[Headed, ...]:
    """Return the lessons that the card offers: those that come next; none while there is no card.

    As long as nobody has needed a lesson none is read for it: the first page has only the heads of the first ones.
    """
    if state[Welcome].at != CARD:
        return ()
    found = lessons_read()
    if found is None:
        return first_heads(OFFERED)
    return tuple(found[key] for key in Way.of(state[LessonPart], found).coming(OFFERED))


def welcome_markup(form: Form, welcome: Welcome, lessons: Sequence[Headed]) -> Markup | None:
    """Return the card with these lessons or the stop at which a student is; nothing for somebody who has left both."""
    if welcome.at == LEFT:
        return None
    return _card(form, lessons) if welcome.at == CARD else _stop(form, welcome.stop)


def tour_from(stop: int) -> tuple[Command, ...]:
    """Return the commands that lead to a stop of the tour."""
    opens = STOPS[stop].opens
    return (*((OpenPanel(opens),) if opens else ()), TakeTour(stop))


def _card(form: Form, lessons: Sequence[Headed]) -> Markup:
    begin = [_lesson(form, lesson, "start main" if i == 0 else "start") for i, lesson in enumerate(lessons)]
    tour = form.button("start-tour", "Show me around", tour_from(0), "chip", f"A tour of {len(STOPS)} stops")
    course = form.button("start-course", "All lessons", OpenPanel("lessons"), "chip", "The map of the course")
    shut = form.button("welcome-leave", "✕", LeaveWelcome(), "chip", "Close; you will find it again in Help", "Close")
    head = tag("header", tag("h2", "Start here"), shut)
    return tag("section.al-over.al-card", head, begin, tag("footer", tour, course), aria_label="Start here")


def _lesson(form: Form, lesson: Headed, kind: str) -> Markup:
    """Return one lesson: its title, the minutes, and what one can do afterwards."""
    can = tag("span", lesson.can[0]) if lesson.can else None
    inside = tag("b", lesson.title), tag("i", time_said(lesson.minutes)), can
    return form.button(f"start-{lesson.key}", inside, OpenLesson(lesson.key), kind)


def _stop(form: Form, number: int) -> Markup:
    stop, last = STOPS[number], number == len(STOPS) - 1
    leave = "Leave the tour; you will find it again in Help"
    shut = form.button("welcome-leave", "✕", LeaveWelcome(), "chip", leave, "Leave the tour")
    back = form.button("tour-back", "‹ Back", tour_from(number - 1), "chip") if number else None
    word, way = ("Done", (LeaveWelcome(),)) if last else ("Next ›", tour_from(number + 1))
    on = form.button("tour-on", word, way, "main")
    foot = tag("footer", tag("span.dim", f"{number + 1} of {len(STOPS)}"), back, on)
    head = tag("header", tag("h2", stop.title), shut)
    title = pages()[stop.tab].title if stop.tab else ""
    return tag(
        "section.al-over.al-tour",
        head,
        tag("p", stop.text),
        foot,
        data_at=stop.at,
        data_title=title,
        role="dialog",
        aria_label=f"Tour: {stop.title}",
    )
