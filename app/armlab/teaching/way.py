"""A student's way through a course: what is done, where the student is, what comes next."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from armlab.content.course import Course
from armlab.content.lessons import Lessons
from armlab.teaching.lesson_places import kept_at
from armlab.teaching.parts.lesson import LessonPart


class Standing(NamedTuple):
    """How far a student is in a lesson that was opened.

    Attributes
    ----------
    passed : int
        Number of steps that are done, in the variant in which most are.
    steps : int
    """

    passed: int
    steps: int

    @property
    def done(self) -> bool:
        """Whether all steps are done."""
        return self.passed == self.steps


@dataclass(frozen=True)
class Way:
    """The way of a student through a course.

    Attributes
    ----------
    course : Course
    here : str
        Key of the open lesson; empty when none is open.
    standings : mapping of str to Standing
        Of each lesson that was ever opened.
    needs : mapping of str to tuple of str
        Lessons that each one needs.
    """

    course: Course
    here: str
    standings: Mapping[str, Standing]
    needs: Mapping[str, tuple[str, ...]]

    @classmethod
    def of(cls, part: LessonPart, found: Lessons) -> Way:
        """Return the way through the course that the student has chosen among all lessons."""
        return cls(found.course(part.course), part.open.partition("/")[0], standings(part, found), found.needs)

    @cached_property
    def done(self) -> frozenset[str]:
        """Keys of the lessons that are done."""
        return frozenset(key for key, standing in self.standings.items() if standing.done)

    def lacks(self, key: str) -> tuple[str, ...]:
        """Return the lessons of the course that are to be done before one; what is not in the course is no matter."""
        return tuple(other for other in self._needs(key) if other not in self.done)

    @property
    def next(self) -> str:
        """Key of the lesson that comes next; empty when there is none."""
        return next(self._coming(), "")

    def coming(self, count: int) -> tuple[str, ...]:
        """Return so many lessons that come next, each as if those before it were done."""
        return tuple(key for key, _ in zip(self._coming(), range(count), strict=False))

    def _coming(self) -> Iterator[str]:
        """Yield lessons in the order in which they are to be done.

        Each is the first in the course whose needs are done and which is not done itself. The open lesson counts as
        done, and those behind it come first: who has left one out on purpose is not sent back at every end.
        """
        order = self.course.lessons
        at = order.index(self.here) + 1 if self.here in order else 0
        done = {*self.done, self.here}
        while True:
            open_ones = (key for key in (*order[at:], *order[:at]) if key not in done)
            found = next((key for key in open_ones if done.issuperset(self._needs(key))), "")
            if not found:
                return
            yield found
            done.add(found)

    def _needs(self, key: str) -> tuple[str, ...]:
        return tuple(other for other in self.needs.get(key, ()) if other in self.course.chapter_of)


def standings(part: LessonPart, found: Lessons) -> dict[str, Standing]:
    """Return how far a student is in each lesson that was opened and still is there."""
    reached: dict[str, Standing] = {}
    for place, progress in part.progress_of.items():
        key = place.partition("/")[0]
        if key in found.lessons:
            # The titles of its steps may hold values of the variant.
            lesson = kept_at(place) if "/" in place else found.lessons[key]
            standing = Standing(len(progress.passed(lesson)), len(lesson.steps))
            reached[key] = max(standing, reached.get(key, standing))
    return reached
