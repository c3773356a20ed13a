"""Files that are read again when they change: as one is, and as it last could be used."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Generic, Self, TypeVar

from armlab.content.lesson_folder import Source
from armlab.errors import ContentError

T = TypeVar("T")


@dataclass(frozen=True)
class Watched(Generic[T]):
    """A file. One with a mistake changes nothing: what it held stays as it was before.

    Attributes
    ----------
    source : Source
    text : str
        Empty when it cannot be read.
    content : T or None
        As the file is now; None when it has a mistake of its own.
    problem : ContentError or None
        That mistake.
    good : T or None
        As it last could be used.
    """

    source: Source
    text: str
    content: T | None
    problem: ContentError | None
    good: T | None = None

    @classmethod
    def read(cls, source: Source, before: Self | None, parse: Callable[[str, str], T]) -> Self:
        """Return the file as it is; the same object as before where nobody has written it since.

        Parameters
        ----------
        source : Source
        before : Watched or None
        parse : callable
            ``parse(text, name of the file)``; raises `ContentError`.
        """
        if before is not None and (before.source.file, before.source.stamp) == (source.file, source.stamp):
            return before
        good = before.good if before is not None else None
        text = ""
        try:
            text, _ = source.read()
            return cls(source, text, parse(text, source.file), None, good)
        except ContentError as error:
            return cls(source, text, None, error, good)

    def judged(self, amiss: Callable[[T, str], Iterable[ContentError]]) -> tuple[Self, list[ContentError]]:
        """Return the file with what can be used of it, and its mistakes.

        Parameters
        ----------
        amiss : callable
            ``amiss(content, text)`` returns the mistakes beside those of the file by itself.
        """
        wrong = [self.problem] if self.problem is not None else []
        if self.content is not None:
            wrong += amiss(self.content, self.text)
        return (self if wrong else replace(self, good=self.content)), wrong
