"""The first visit: the card that says where to start, and the stops of the tour, each beside the real thing."""

from __future__ import annotations

from dataclasses import dataclass

from armlab.session.lesson_commands import OpenLesson
from armlab.session.pages import pages
from armlab.session.panel_commands import OpenPanel
from armlab.session.parts.welcome import CARD, LEFT, LeaveWelcome, TakeTour, Welcome
from armlab.session.state import Command
from armlab.ui.form import Form
from armlab.ui.html import Markup, tag

LESSONS = {
    "joint_types": ("Joints that turn or slide", "Read a kinematic chain from its base to its tool."),
    "first_arm": ("Where is the hand?", "Two angles, and the point they lead to."),
    "ik_2r": ("Two elbows for one point", "The way back: from the point to the angles."),
}
"""Lessons to begin with: title and a line about each. They are written here since the first page reads no lesson."""


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
        "Lessons ask questions, check what you do with the arm, and give hints. Your progress is saved.",
        tab="lessons",
    ),
)


def welcome_markup(form: Form, welcome: Welcome) -> Markup | None:
    """Return the card or the stop at which a student is; nothing for somebody who has left both."""
    if welcome.at == LEFT:
        return None
    return _card(form) if welcome.at == CARD else _stop(form, welcome.stop)


def tour_from(stop: int) -> tuple[Command, ...]:
    """Return the commands that lead to a stop of the tour."""
    opens = STOPS[stop].opens
    return (*((OpenPanel(opens),) if opens else ()), TakeTour(stop))


def _card(form: Form) -> Markup:
    lessons = [
        form.button(f"start-{key}", (tag("b", title), tag("span", about)), OpenLesson(key), "start")
        for key, (title, about) in LESSONS.items()
    ]
    tour = form.button("start-tour", "Show me around", tour_from(0), "main", f"A tour of {len(STOPS)} stops")
    shut = form.button("welcome-leave", "✕", LeaveWelcome(), "chip", "Close; you will find it again in Help", "Close")
    head = tag("header", tag("h2", "Start here"), shut)
    return tag("section.al-over.al-card", head, lessons, tour, aria_label="Start here")


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
