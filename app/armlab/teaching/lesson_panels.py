"""The panels that a lesson brings to the front, by being opened and by its steps."""

from __future__ import annotations

from armlab.session.pages import pages
from armlab.session.parts.panels import Panels
from armlab.session.state import State
from armlab.teaching.parts.lesson import LessonPart


def lesson_followed(before: State, now: State) -> State:
    """Return a state with the panel open that a lesson, or a step of it, brings to the front by being opened.

    Another lesson brings its bench to the front, or any other panel where that in front is hidden now. A step does so
    when it names a panel or is on another bench than the one before.
    """
    was, part, panels = before[LessonPart], now[LessonPart], now[Panels]
    if part.lesson is None or (part.open, part.name) == (was.open, was.name):
        return now
    hidden = part.hidden
    there = [key for key in pages() if key not in hidden]
    if part.open == was.open:
        step = part.step
        wanted = part.bench if part.bench != was.bench or (step is not None and step.panel) else ""
    else:
        wanted = part.bench
        if wanted not in there and not set(panels.open()) <= set(there):
            wanted = next(iter(there), "")
    return now.replace(panels.opening(wanted)) if wanted in there else now
