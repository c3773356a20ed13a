"""Places of the progress in lessons: the key of a lesson, with the number of the variant where it has some."""

from __future__ import annotations

from armlab.content.lesson import Lesson
from armlab.content.lessons import kept_lesson, lesson, lessons


def place_of(key: str, variant: int) -> str:
    """Return under which key the progress in a variant is kept.

    Raises
    ------
    UnknownName, ContentError
        There is no such lesson, or it cannot be used.
    """
    return f"{key}/{variant}" if lesson(key).varies else key


def where_in(assignment: str, place: str) -> str:
    """Return under which key the progress in a lesson is kept that belongs to an assignment, or to none."""
    return f"{assignment}:{place}" if assignment else place


def at_place(place: str) -> Lesson:
    """Return the lesson of a place as written by `place_of`."""
    key, _, variant = place.partition("/")
    return lesson(key, int(variant or 0))


def kept_at(place: str) -> Lesson:
    """Return the lesson of a place for somebody who is there, also while its file has a mistake."""
    key, _, variant = place.partition("/")
    return kept_lesson(key, int(variant or 0))


def is_place(place: str) -> bool:
    """Return whether a lesson exists for this place."""
    if not place:
        return False
    key, slash, variant = place.partition("/")
    there = lessons()
    return there.has(key) and bool(slash) == there[key].varies and (not slash or variant.isdecimal())
