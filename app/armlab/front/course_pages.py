"""The pages on which courses stand to be printed; what they need is imported when somebody asks for one."""

from __future__ import annotations

import gzip
import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING

from armlab import resources

if TYPE_CHECKING:
    from armlab.content.outline import Outline, Outlines

POLICY = "default-src 'none'; style-src 'unsafe-inline'; form-action 'none'; base-uri 'none'; frame-ancestors 'self'"
"""Content-Security-Policy of these pages, which hold no script."""


LOOK_INTERVAL = 1.0
"""Time between two looks at the files, seconds: whoever asks more often gets the page that was made."""


@dataclass(frozen=True)
class Printed:
    """The page of a course, also gzipped."""

    html: bytes
    compressed: bytes


class CoursePages:
    """The pages, made anew when a file has changed. Safe to use from several threads.

    Parameters
    ----------
    folders : sequence of Path
        Folders of lessons besides those of the lab.
    interval : float
        See `LOOK_INTERVAL`.
    """

    def __init__(self, folders: Sequence[Path] = (), interval: float = LOOK_INTERVAL) -> None:
        self._folders, self._interval, self._lock = folders, interval, Lock()
        self._outline: Outline | None = None
        self._until = 0.0
        self._pages: dict[str, Printed] = {}

    @cached_property
    def _outlines(self) -> Outlines:
        from armlab.content.outline import Outlines

        return Outlines([resources.folder("lessons"), *(path.resolve() for path in self._folders)])

    def page(self, key: str = "") -> Printed | None:
        """Return the page of a course, of the first when the key is empty; None where there is no such course."""
        with self._lock:
            outline = self._looked_at()
            if key not in self._pages:
                from armlab.ui.course_page import course_page

                made = course_page(outline, key)
                if made is None:
                    return None
                self._pages[key] = Printed(made.encode(), gzip.compress(made.encode(), 6))
            return self._pages[key]

    def _looked_at(self) -> Outline:
        """Return the outline as it is, or was a moment ago."""
        now = time.monotonic()
        if self._outline is None or now >= self._until:
            outline, self._until = self._outlines.look(), now + self._interval
            if outline is not self._outline:
                self._outline, self._pages = outline, {}
        return self._outline
