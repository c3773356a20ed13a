"""A folder of content files: those that can be used, and the problems of the others."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib.resources.abc import Traversable
from typing import Any, ClassVar, Generic, Protocol, Self, TypeVar

from armlab.errors import ContentError, UnknownName

log = logging.getLogger(__name__)


class Keyed(Protocol):
    """The content of a file."""

    @property
    def key(self) -> str:
        """The name of the file without its ending."""
        ...


T = TypeVar("T", bound=Keyed)


@dataclass(frozen=True)
class Folder(Generic[T]):
    """The files of a folder. Subclasses define their kind and how one is read.

    Attributes
    ----------
    found : dict
        Key to content, in order.
    problems : tuple of ContentError
        One for each file that cannot be used; they disturb nothing else.
    """

    kind: ClassVar[str]
    ending: ClassVar[str]

    found: dict[str, T]
    problems: tuple[ContentError, ...]

    @classmethod
    def read(cls, files: Iterable[Traversable], parse: Callable[[str, str, str], T], order: Callable[[T], Any]) -> Self:
        """Read files.

        Parameters
        ----------
        files : iterable of Traversable
        parse : callable
            ``parse(key, text, name of the file)``; raises `ContentError`.
        order : callable
            The key by which the contents are sorted.
        """
        found, problems = [], []
        for file in files:
            try:
                found.append(_read(file, cls.ending, parse))
            except ContentError as error:
                problems.append(error)
        return cls({content.key: content for content in sorted(found, key=order)}, tuple(problems))

    def __getitem__(self, key: str) -> T:
        """Return the content of a file by key; the error lists the available ones, or tells what is wrong with it."""
        if key in self.found:
            return self.found[key]
        for problem in self.problems:
            if problem.file == f"{key}{self.ending}":
                raise problem
        raise UnknownName(self.kind, key, self.found)


def _read(file: Traversable, ending: str, parse: Callable[[str, str, str], T]) -> T:
    """Read one file; every failure becomes a `ContentError`."""
    try:
        return parse(file.name.removesuffix(ending), file.read_text(encoding="utf-8"), file.name)
    except ContentError:
        raise
    except UnicodeDecodeError as error:
        raise ContentError(file.name, "", f"not a text in UTF-8: {error.reason}") from None
    except OSError as error:
        raise ContentError(file.name, "", f"cannot be read: {error.strerror}") from error
    except Exception as error:
        # A mistake in our reading: it belongs into the log, and the class still gets the other files.
        log.exception("%s cannot be read", file.name)
        raise ContentError(file.name, "", f"cannot be used: {error!r}") from error
