"""One tab of the dock: its pages, of which one is shown, built when first seen, and updated only while seen."""

from __future__ import annotations

import logging
from collections.abc import Callable
from functools import partial
from typing import Any

from armlab.errors import PluginError
from armlab.page import Page
from armlab.session.parts.lesson import LessonPart
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, Post, State
from armlab.ui.form import Form
from armlab.ui.html import tag
from armlab.ui.markup import verdict_box
from armlab.ui.plugin import Panel, Show
from armlab.ui.plugin import panel as panel_of
from armlab.ui.widgets import Gui

log = logging.getLogger(__name__)

COVERED = "Answer the question of the lesson first."
"""Text in place of a page that would show the answer."""


class Tab:
    """One tab of the dock.

    Parameters
    ----------
    pages : tuple of Page
        The first gives the tab its name.
    container : viser tab handle
    make_gui : callable
        Returns a new maker of controls.
    post : callable
    on_page : callable
        Called when a person has turned to another page.
    """

    def __init__(
        self,
        pages: tuple[Page, ...],
        container: Any,
        make_gui: Callable[[], Gui],
        post: Post,
        on_page: Callable[[], None],
    ) -> None:
        self.pages, self.page = {page.key: page for page in pages}, pages[0].key
        self._container, self._gui, self._post = container, make_gui(), post
        self._gui.again = self._show_again
        self._head: Form | None = None
        self._on_page = on_page
        self._show: Show | None = None
        self._shown: State | None = None
        self._outside: object = None
        self._built = ""
        self._hidden: frozenset[str] = frozenset()
        with container:
            head = make_gui()
            # The page's script tells by this mark which tabs are seen.
            head.html(tag("i", hidden=True, data_tab=pages[0].key))
            if len(pages) > 1:
                self._head = head.form(post)
                self._show_head()

    @property
    def key(self) -> str:
        """The key of the tab."""
        return next(iter(self.pages))

    @property
    def panel(self) -> Panel | None:
        """The panel of the present page, or None if it cannot be imported, which the page says."""
        try:
            return panel_of(self.page)
        except PluginError:
            return None

    def turn_to(self, key: str) -> None:
        """Choose another page for the next `show`."""
        if key in self.pages and key != self.page:
            self.page = key
            self._show_head()

    def _turned(self, key: str) -> tuple[Command, ...]:
        self.turn_to(key)
        self._on_page()
        return ()

    def _show_head(self) -> None:
        if self._head is None:
            return
        pages = [
            self._head.button(
                key,
                page.page or page.title,
                partial(self._turned, key),
                "page",
                role="tab",
                aria_selected=str(key == self.page).lower(),
            )
            for key, page in self.pages.items()
            if key not in self._hidden
        ]
        self._head.show(tag("div.pages", pages, role="tablist"))

    def show(self, state: State, again: bool = False, hidden: frozenset[str] = frozenset()) -> None:
        """Show a state on the present page.

        Parameters
        ----------
        state : State
        again : bool
            Also when it is the one shown, over what a person typed.
        hidden : frozenset of str
            Pages that are not there now.
        """
        self._leave_out(hidden)
        page = self.pages[self.page]
        if self._cover(page, state):
            return
        panel = self.panel
        if panel is None:
            self._tell_broken()
            return
        before, self._shown = self._shown, state
        other, self._outside = self._outside, panel.outside()
        new = before is None or self._built != self.page or _differ(panel.rebuilds, state, before)
        again = again or other is not self._outside
        with self._container:
            if new:
                # What was pressed for another arm must not reach this one.
                same = before is not None and state[RobotPart] is before[RobotPart]
                self._gui.clear(linger=same and self._built == self.page)
                self._built = self.page
                self._gui.scope = page.scope
                self._show = self._try(panel.build, self._gui, state, self._post)
            if self._show is not None and (new or again or before is None or _differ(panel.watches, state, before)):
                self._try(_done(self._show), state)

    def _show_again(self) -> None:
        if self._shown is not None:
            self.show(self._shown, again=True, hidden=self._hidden)

    def _leave_out(self, hidden: frozenset[str]) -> None:
        """Remove pages, or bring them back, and show one that remains."""
        left = [key for key in self.pages if key not in hidden]
        if hidden & set(self.pages) == self._hidden or not left:
            return
        self._hidden = hidden & set(self.pages)
        self.page = self.page if self.page in left else left[0]
        self._show_head()

    def _cover(self, page: Page, state: State) -> bool:
        """Show a sentence instead of a page that would show the answer to a prediction."""
        covered = bool(state[LessonPart].hides) and not page.always
        if covered and self._built != COVERED:
            with self._container:
                self._gui.clear()
                self._gui.html(tag("p.dim", COVERED))
            self._built, self._show, self._shown = COVERED, None, state
        return covered

    def _tell_broken(self) -> None:
        """Show once for each choice of the page that it is broken; the reason is in the log."""
        if self._built != self.page:
            self._built, self._show, self._shown = self.page, None, None
            with self._container:
                self._try(panel_of, self.page)

    def _try(self, call: Callable[..., Any], *arguments: Any) -> Any:
        """Return the result; a panel that fails is replaced by a line, and the rest of the lab goes on."""
        try:
            return call(*arguments)
        except Exception:
            log.exception("panel %s failed", self.page)
        self._show = None
        self._gui.clear()
        title = self.pages[self.page].title
        self._gui.html(verdict_box("no", f"{title} has failed", "The rest works on."))
        return None


def _differ(kinds: tuple[Any, ...], state: State, before: State) -> bool:
    return any(state[kind] is not before[kind] for kind in kinds)


def _done(show: Show) -> Callable[[State], bool]:
    def call(state: State) -> bool:
        show(state)
        return True

    return call
