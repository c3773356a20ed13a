"""Lessons read from their files: each once, whether it is needed alone or all are read, and again when it changes."""

from __future__ import annotations

import logging
from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from threading import Lock

from armlab.content.as_written import AsWritten
from armlab.content.lesson import Lesson
from armlab.content.lesson_file import parse_lesson
from armlab.content.lesson_folder import Source, Stamp
from armlab.content.names import named
from armlab.content.robots import Catalogue
from armlab.errors import ContentError

log = logging.getLogger(__name__)

MOST_VARIANTS = 256
"""Number of variants of lessons that are kept: a class of this size reads none twice."""


@dataclass(frozen=True)
class Good:
    """A lesson in its variant 0, and its source."""

    lesson: Lesson
    text: str
    pictures: Mapping[str, str] | None


@dataclass(frozen=True)
class Reading:
    """The content of the files of one lesson.

    Attributes
    ----------
    stamp : Stamp
    file : str
    content : tuple or None
        Text and pictures; None where they cannot be read.
    problem : ContentError or None
        The reason why it cannot be used.
    good : Good or None
        The lesson, where it can.
    """

    stamp: Stamp
    file: str
    content: tuple[str, Mapping[str, str] | None] | None
    problem: ContentError | None
    good: Good | None = field(default=None, compare=False)

    def is_of(self, source: Source) -> bool:
        """Return whether it is what the files of a source hold now."""
        return (self.stamp, self.file) == (source.stamp, source.file)

    def differs(self, before: Reading | None) -> bool:
        """Return whether the files say something else than before."""
        return before is None or replace(self, stamp=()) != replace(before, stamp=())


class Readings:
    """The lessons as they were read last. Safe to use from several threads.

    Parameters
    ----------
    catalogue : Catalogue, optional
        The robots there are; those of the lab when left out.
    """

    def __init__(self, catalogue: Catalogue | None = None) -> None:
        self._catalogue = catalogue
        self._lock = Lock()
        self._found: dict[str, Reading] = {}
        self._variants: OrderedDict[tuple[str, str, int], Lesson | ContentError] = OrderedDict()

    def known(self, key: str) -> Good | None:
        """Return a lesson as it was read last, without a look at its files; None where there is none."""
        found = self._found.get(key)
        return None if found is None else found.good

    def read(self, source: Source) -> Reading:
        """Return the content of the files of a lesson; it is the previous one when they are unchanged."""
        before = self._found.get(source.key)
        if before is not None and before.is_of(source):
            return before
        made = self._made(source, before)
        with self._lock:
            there = self._found.get(source.key)
            if there is None or not there.is_of(source):  # else another thread has read it meanwhile
                there = self._found[source.key] = made
        return there

    def variant(self, key: str, good: Good, variant: int) -> Lesson:
        """Return a lesson with the values of a variant.

        Raises
        ------
        ContentError
            This variant cannot be used.
        """
        if variant == 0 or not good.lesson.varies:
            return good.lesson
        place = (key, good.lesson.digest, variant)
        with self._lock:
            found = self._variants.get(place)
            if found is not None:
                self._variants.move_to_end(place)
        if found is None:
            made = self._variant(key, good, variant)
            with self._lock:
                found = self._variants.setdefault(place, made)
                while len(self._variants) > MOST_VARIANTS:
                    self._variants.popitem(last=False)
        if isinstance(found, ContentError):
            raise found.with_traceback(None)
        return found

    def _variant(self, key: str, good: Good, variant: int) -> Lesson | ContentError:
        """Return a variant, or why it cannot be used, which is not read again and again either."""
        try:
            own = isinstance(good.lesson.title, AsWritten)
            made = parse_lesson(named(key), good.text, good.lesson.file, self._catalogue, variant, good.pictures, own)
        except ContentError as error:
            return error
        return replace(made, key=key)

    def last(self, key: str, variant: int) -> Lesson | None:
        """Return a variant as it was when it could last be used; None where it never could."""
        with self._lock:
            found = (each for (of, _, n), each in reversed(self._variants.items()) if (of, n) == (key, variant))
            return next((each for each in found if not isinstance(each, ContentError)), None)

    def _made(self, source: Source, before: Reading | None) -> Reading:
        content = None
        try:
            content = source.read()
            if before is not None and (before.content, before.file) == (content, source.file):
                return replace(before, stamp=source.stamp)
            lesson = parse_lesson(source.key, content[0], source.file, self._catalogue, 0, content[1], source.own)
        except ContentError as error:
            return Reading(source.stamp, source.file, content, error)
        except Exception as error:
            # A mistake in our reading: it belongs into the log, and the class still gets the other files.
            log.exception("%s cannot be read", source.file)
            problem = ContentError(source.file, "", f"cannot be used: {error!r}")
            return Reading(source.stamp, source.file, content, problem)
        return Reading(source.stamp, source.file, content, None, Good(lesson, *content))
