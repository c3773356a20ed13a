"""The pages to print: courses, guides for their teachers, formulas; what one needs is imported when it is asked for.

They belong to no browser and need no lab behind the front: the address, or else the browser, tells their language.
"""

from __future__ import annotations

import gzip
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources.abc import Traversable
from pathlib import Path
from threading import Lock
from typing import Any, NamedTuple

from armlab import resources

POLICY = "default-src 'none'; style-src 'unsafe-inline'; form-action 'none'; base-uri 'none'; frame-ancestors 'self'"
"""Content-Security-Policy of these pages, which hold no script."""


LOOK_INTERVAL = 1.0
"""Time between two looks at the files, seconds: whoever asks more often gets the page that was made."""

Folders = Sequence[Traversable]
"""Folders of lessons, of which the first is the lab's own."""


@dataclass(frozen=True)
class Printed:
    """A page, also gzipped."""

    html: bytes
    compressed: bytes


class _Kind(NamedTuple):
    """A kind of page: what is looked at, which is the same thing as long as no file changes, and what is made of it.

    It is made for the key of a course and that of the language of its reader, in which it is said afterwards.
    """

    look: Callable[[], Any]
    made: Callable[[Any, str, str], str | None]


def _course(folders: Folders) -> _Kind:
    from armlab.content.outline import Outlines
    from armlab.window.course_page import course_page

    return _Kind(Outlines(folders).look, course_page)


def _guide(folders: Folders) -> _Kind:
    from armlab.content.guidebook import Guidebooks
    from armlab.window.guide_page import guide_page

    return _Kind(Guidebooks(folders).look, lambda book, key, language: guide_page(book, key))


def _formulas(folders: Folders) -> _Kind:
    del folders  # there is one sheet, whatever the lessons
    from armlab.content.formulas import sheet
    from armlab.window.formulas_page import formulas_page

    return _Kind(sheet, lambda found, key, language: formulas_page(found, key))


KINDS: Mapping[str, Callable[[Folders], _Kind]] = {"course": _course, "guide": _guide, "formulas": _formulas}
"""The kinds by the first word of their addresses."""


class _Pages:
    """The pages of one kind, made anew when a file has changed; to be used from one thread at a time."""

    def __init__(self, kind: _Kind, interval: float) -> None:
        self._kind, self._interval = kind, interval
        self._seen: Any = None
        self._until = 0.0
        self._made: dict[tuple[str, str], Printed] = {}

    def page(self, key: str, language: str) -> Printed | None:
        now = time.monotonic()
        if self._seen is None or now >= self._until:
            seen, self._until = self._kind.look(), now + self._interval
            if seen is not self._seen:
                self._seen, self._made = seen, {}
        if (key, language) not in self._made:
            made = self._kind.made(self._seen, key, language)
            if made is None:
                return None
            said = _in_language(made, language).encode()
            self._made[key, language] = Printed(said, gzip.compress(said, 6))
        return self._made[key, language]


def _language(asked: str, accepted: str) -> str:
    from armlab.content.languages import keys, preferred

    return asked if asked in keys() else preferred(accepted)


def _in_language(page: str, language: str) -> str:
    from armlab.ui.paper import in_language

    return in_language(page, language)


def in_their_language(page: str, asked: str, accepted: str) -> str:
    """Return a page, or a sentence, in the language of its reader; languages as in `PaperPages.page`."""
    from armlab.content.languages import ENGLISH

    language = _language(asked, accepted)
    return page if language == ENGLISH else _in_language(page, language)


class PaperPages:
    """All pages to print. Safe to use from several threads.

    Parameters
    ----------
    folders : sequence of Path
        Folders of lessons besides those of the lab.
    interval : float
        See `LOOK_INTERVAL`.
    """

    def __init__(self, folders: Sequence[Path] = (), interval: float = LOOK_INTERVAL) -> None:
        self._folders, self._interval, self._lock = folders, interval, Lock()
        self._pages: dict[str, _Pages] = {}

    def page(self, kind: str, key: str = "", asked: str = "", accepted: str = "") -> Printed | None:
        """Return a page; None where there is none such.

        Parameters
        ----------
        kind : str
            One of `KINDS`.
        key : str
            That of a course; empty for the first.
        asked : str
            Key of the language in which it is to be; empty, or unknown, for that of the browser.
        accepted : str
            The languages that the browser asks for, as in the header ``Accept-Language``.
        """
        with self._lock:
            if kind not in self._pages:
                folders = [resources.folder("lessons"), *(path.resolve() for path in self._folders)]
                self._pages[kind] = _Pages(KINDS[kind](folders), self._interval)
            return self._pages[kind].page(key, _language(asked, accepted))
