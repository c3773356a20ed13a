"""The step for which an answer or a hint is asked: pages of one student may show a step that has been left."""

from __future__ import annotations

from armlab.errors import Outdated
from armlab.teaching.parts.lesson import LessonPart

MOVED_ON = (
    "This page has moved on, maybe in another tab. "
    "What you did at the step or task shown before was not taken: go back to it first."
)
"""The sentence for whoever has answered too late: at a step of a lesson, or at a task of any other page."""


def shown_step(part: LessonPart) -> str:
    """Return what tells the shown step from all others, of other lessons and variants too."""
    return f"{part.where} {part.name}"


def refuse_of_another(part: LessonPart, of: str | None) -> None:
    """Raise `Outdated` for what is asked of another step than the shown one; None is asked of whichever is shown."""
    if of not in (None, shown_step(part)):
        raise Outdated(MOVED_ON)
