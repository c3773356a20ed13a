"""One tab of the dock: its pages, of which one is shown, built when first seen, and updated only while seen."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from typing import Any

from armlab.page import Page
from armlab.session.panel_commands import OpenPanel, hidden_panels
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Post, State
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui.form import Form
from armlab.ui.html import tag
from armlab.ui.markup import verdict_box
from armlab.ui.plugin import Show, whole_panel
from armlab.ui.plugin import panel as panel_of
from armlab.ui.tray import Enlarged
from armlab.ui.widgets import Gui

log = logging.getLogger(__name__)

COVERED = "Answer the question of the lesson first."
"""Text in place of a page that would show the answer."""

CLOSED = "This page is closed while the lesson is open."
"""Text in place of a page whose tab is hidden, which a browser can be made to show all the same."""


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
    window : int
        The window in which it is; see `armlab.session.parts.panels`.
    page_of : callable
        Returns the key of the page on which the tab stands in a state.
    """

    def __init__(
        self,
        pages: tuple[Page, ...],
        container: Any,
        make_gui: Callable[[], Gui],
        post: Post,
        window: int,
        page_of: Callable[[State], str],
    ) -> None:
        self.pages = {page.key: page for page in pages}
        self._name = f"Pages of {pages[0].title}"
        self._container, self._gui, self._post = container, make_gui(), post
        self._gui.again = self._show_again
        self._head: Form | None = None
        self._headed: tuple[str, frozenset[str]] | None = None
        self._window, self._page_of = window, page_of
        self._show: Show | None = None
        self._shown: State | None = None
        self._outside: object = None
        self._built = ""
        with container:
            head = make_gui()
            # The page's script tells by this mark which tabs are seen.
            head.html(tag("i", hidden=True, data_tab=pages[0].key))
            if len(pages) > 1:
                self._head = head.form(post)

    def show_head(self, state: State) -> None:
        """Show the pages of the tab in a state, with the present one marked."""
        headed = stands, hidden = self._page_of(state), hidden_panels(state)
        if self._head is None or headed == self._headed:
            return
        self._headed = headed
        pages = [
            self._head.button(
                key,
                page.name,
                OpenPanel(key, self._window),
                "page",
                role="tab",
                aria_selected=str(key == stands).lower(),
                data_name=page.name,
            )
            for key, page in self.pages.items()
            if key not in hidden
        ]
        self._head.show(tag("div.pages", pages, role="tablist", aria_label=self._name))

    def show(self, state: State, again: bool = False) -> None:
        """Show a state on the present page of the tab.

        Parameters
        ----------
        state : State
        again : bool
            Also when it is the one shown, over a typed text.
        """
        page = self.pages[self._page_of(state)]
        panel = whole_panel(page.key)
        if self._cover(page, state, "" if panel is None else panel.waits()):
            return
        if panel is None:
            self._tell_broken(page)
            return
        before, self._shown = self._shown, state
        other, self._outside = self._outside, panel.outside()
        new = before is None or self._built != page.key or _differ(panel.rebuilds, state, before)
        again = again or other is not self._outside
        with self._container:
            if new:
                # What was pressed for another arm must not reach this one.
                same = before is not None and state[RobotPart] is before[RobotPart]
                self._gui.clear(linger=same and self._built == page.key)
                self._built = page.key
                self._gui.scope, self._gui.page = page.scope, page.key
                self._gui.has_notes = state[Notation].notes == "on"
                self._show = self._try(panel.build, self._gui, state, self._post)
            if self._show is not None and (new or again or before is None or _differ(panel.watches, state, before)):
                self._try(_done(self._show), state)

    @property
    def plots(self) -> tuple[str, Sequence[Enlarged]]:
        """The key of the page that is shown, and its plots; none where it is covered or broken."""
        return self._built, self._gui.plots

    def _show_again(self) -> None:
        if self._shown is not None:
            self.show(self._shown, again=True)
            if self._gui.tray is not None:
                self._gui.tray.follow()

    def _cover(self, page: Page, state: State, waits: str) -> bool:
        """Show a sentence instead of a page that waits, is closed, or would show the answer to a prediction."""
        says = COVERED if state[LessonPart].hides and not page.always else waits
        if page.key in hidden_panels(state):
            says = CLOSED
        if says and self._built != says:
            with self._container:
                self._gui.clear()
                self._gui.html(tag("p.dim", says))
            self._built, self._show, self._shown = says, None, state
        return bool(says)

    def _tell_broken(self, page: Page) -> None:
        """Show once for each choice of the page that it is broken; the reason is in the log."""
        if self._built != page.key:
            self._built, self._show, self._shown = page.key, None, None
            with self._container:
                self._try(panel_of, page.key)

    def _try(self, call: Callable[..., Any], *arguments: Any) -> Any:
        """Return the result; a panel that fails is replaced by a line, and the rest of the lab goes on."""
        try:
            return call(*arguments)
        except Exception:
            log.exception("panel %s failed", self._built)
        self._show = None
        self._gui.clear()
        name = self.pages[self._built].name
        self._gui.html(verdict_box("no", f"{name} has failed", "The rest of the lab still works."))
        return None


def _differ(kinds: tuple[Any, ...], state: State, before: State) -> bool:
    return any(state[kind] is not before[kind] for kind in kinds)


def _done(show: Show) -> Callable[[State], bool]:
    def call(state: State) -> bool:
        show(state)
        return True

    return call
