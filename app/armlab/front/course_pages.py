"""The pages on which courses stand to be printed; what they need is imported when somebody asks for one."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING

from armlab import resources

if TYPE_CHECKING:
    from armlab.content.outline import Outline, Outlines

POLICY = "default-src 'none'; style-src 'unsafe-inline'; form-action 'none'; base-uri 'none'; frame-ancestors 'self'"
"""Content-Security-Policy of these pages, which hold no script."""


class CoursePages:
    """The pages, made anew when a file has changed. Safe to use from several threads.

    Parameters
    ----------
    folders : sequence of Path
        Folders of lessons besides those of the lab.
    """

    def __init__(self, folders: Sequence[Path] = ()) -> None:
        self._folders, self._lock = folders, Lock()
        self._made_of: Outline | None = None
        self._pages: dict[str, str] = {}

    @cached_property
    def _outlines(self) -> Outlines:
        from armlab.content.outline import Outlines

        return Outlines([resources.folder("lessons"), *(path.resolve() for path in self._folders)])

    def page(self, key: str = "") -> str | None:
        """Return the page of a course, of the first when the key is empty; None where there is no such course."""
        from armlab.ui.course_page import course_page

        with self._lock:
            outline = self._outlines.look()
            if outline is not self._made_of:
                self._made_of, self._pages = outline, {}
            if key not in self._pages:
                made = course_page(outline, key)
                if made is None:
                    return None
                self._pages[key] = made
            return self._pages[key]
