"""The rules of an open assignment: nothing else is opened, and what was handed in stays."""

from __future__ import annotations

from armlab.errors import InputError
from armlab.teaching.assignment_work import is_open
from armlab.teaching.parts.lesson import LessonPart


def refuse_in_assignment(part: LessonPart) -> None:
    """Raise `InputError` while an assignment is open, which other work would replace."""
    if part.assigned is not None:
        raise InputError(f"{is_open(part.assigned)} Leave it before you open anything else.")


def refuse_late(part: LessonPart, now: float) -> None:
    """Raise `InputError` where the open assignment has been handed in, or its time is over."""
    if part.rests:
        raise InputError("This work has been handed in; it cannot be changed any more.")
    if part.assigned is not None and part.work is not None and part.work.over(part.assigned, now):
        raise InputError("The time for this work is over; what was answered before is handed in.")
