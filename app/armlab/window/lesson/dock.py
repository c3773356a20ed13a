"""The dock of the lesson, which exists only while a lesson is open.

It stands on the left. In a window with room for one dock beside the scene the style sheet puts it above the bench:
viser tells the size of the picture in pixels of the screen, from which that of the window cannot be known here.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from typing import Any

import viser

from armlab.content.lessons import Lessons, lessons_read
from armlab.session.clock import now
from armlab.session.state import Post, State
from armlab.teaching.assignment_commands import LookAtClock
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui.widgets import Gui
from armlab.window.lesson.page import Attempt, Drafts, LessonPage

log = logging.getLogger(__name__)

WIDTH = 280
"""Width of the dock, pixels, which leaves the scene 55 % of a window of 1400."""

LONGEST_WAIT = 3600.0
"""Time after which the clock is looked at again, seconds, since that of the computer may be set."""

LAG = 0.05
"""Time, seconds, after the end of an assignment at which it is certainly over."""


class LessonDock:
    """The lesson in one browser.

    Parameters
    ----------
    client : viser.ClientHandle
    make_gui : callable
        Returns a new maker of controls.
    post : callable
    drafts : dict
    saved : set
        Both of the session; see `LessonPage`.
    """

    def __init__(
        self,
        client: viser.ClientHandle,
        make_gui: Callable[[], Gui],
        post: Post,
        drafts: dict[str, Drafts],
        saved: set[Attempt],
    ) -> None:
        self._client, self._make_gui, self._post = client, make_gui, post
        self._drafts, self._saved = drafts, saved
        self._panel: Any = None
        self._page: LessonPage | None = None
        self._open = ""
        self._ends: float | None = None
        self._timer: asyncio.TimerHandle | None = None
        self._shown: tuple[State, Lessons | None] | None = None

    def open(self, state: State) -> bool:
        """Make or remove the dock for the state; return whether the lesson has changed or closed."""
        before, self._open = self._open, state[LessonPart].open
        self._follow_clock(state[LessonPart])
        if self._open and self._panel is None:
            self._make()
        elif not self._open and self._panel is not None:
            self._panel.remove()
            self._panel = self._page = None
        return self._open != before

    def show(self, state: State) -> None:
        """Show a state in the dock, if the dock exists."""
        if self._page is None or not state[LessonPart].open:
            return
        found, shown = lessons_read(), self._shown  # the page tells of other lessons, too
        if shown is None or shown[0] is not state or shown[1] is not found or self._page.stale:
            self._shown = state, found
            try:
                self._page.show(state)
            except Exception:
                # A lesson that cannot be shown must not stop the benches.
                log.exception("lesson %s cannot be shown", state[LessonPart].open)
                self._page.fail()

    def close(self) -> None:
        """Forget the clock of an assignment."""
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None

    def _follow_clock(self, part: LessonPart) -> None:
        """Let the time of an assignment end when it is over, even when nobody does anything."""
        found, work = part.assigned, part.work
        ends = None if found is None or work is None or part.rests else found.ends(work.begun)
        if ends != self._ends:
            self._ends = ends
            self._wait_for_end()

    def _wait_for_end(self) -> None:
        self.close()
        if self._ends is None:
            return
        left = self._ends - now()
        if left <= 0.0:
            self._post(LookAtClock())
        else:
            self._timer = asyncio.get_running_loop().call_later(min(left, LONGEST_WAIT) + LAG, self._wait_for_end)

    def _make(self) -> None:
        self._shown = None
        self._panel = self._client.gui.add_panel()
        with self._panel.add_tab("Lesson", viser.Icon.BOOK):
            self._page = LessonPage(self._make_gui(), self._post, self._drafts, self._saved)
        self._panel.dock_left()
        self._panel.set_width(WIDTH)
