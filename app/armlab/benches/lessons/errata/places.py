"""Where in the course errata are met: lessons that name them by a link, and lessons on the same topics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType

from armlab.content.errata import Erratum, linked
from armlab.content.lesson import Lesson
from armlab.content.lessons import Lessons


@dataclass(frozen=True)
class Named:
    """A step of a lesson that names an erratum.

    Attributes
    ----------
    lesson, title : str
        Key and title of the lesson.
    step : int
        Counted from 0; -1 for its introduction.
    """

    lesson: str
    title: str
    step: int


def named_in(found: Lessons) -> Mapping[str, tuple[Named, ...]]:
    """Return by id where lessons name errata, in the order of the lessons; once for each lesson and erratum."""
    return _named(tuple(found.listed))


@lru_cache(maxsize=4)
def _named(lessons: tuple[Lesson, ...]) -> Mapping[str, tuple[Named, ...]]:
    places: dict[str, dict[str, Named]] = {}
    for each in lessons:
        for step, text in enumerate((each.intro_html, *(step.texts for step in each.steps)), start=-1):
            for key in linked(text):
                places.setdefault(key, {}).setdefault(each.key, Named(each.key, each.title, step))
    return MappingProxyType({key: tuple(lessons.values()) for key, lessons in places.items()})


def taught_in(each: Erratum, found: Lessons) -> tuple[tuple[str, str], ...]:
    """Return key and title of the lessons on a topic of an erratum that do not name it."""
    named = {place.lesson for place in named_in(found).get(each.id, ())}
    rows = set(each.rows)
    return tuple(
        (lesson.key, lesson.title)
        for lesson in found.listed
        if lesson.key not in named and rows.intersection(lesson.teaches)
    )
