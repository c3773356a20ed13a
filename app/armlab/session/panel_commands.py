"""Commands that open panels: for a window that comes, and a person who turns to one; which panels are hidden."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.registry import known_name
from armlab.session.pages import FIRST, pages, tabs
from armlab.session.parts.panels import Panels, Window
from armlab.session.state import Command, State


def hidden_panels(state: State) -> frozenset[str]:
    """Return the keys of the panels that the parts of a state hide, such as the open lesson."""
    return frozenset().union(*(part.hidden for part in state.with_own("hidden")))


def hidden_tabs(state: State) -> tuple[str, ...]:
    """Return the titles of the tabs all of whose pages are hidden."""
    hidden = hidden_panels(state)
    return tuple(pages[0].title for pages in tabs().values() if all(page.key in hidden for page in pages))


def first_window(state: State, panel: str = "") -> Window:
    """Return a window as it opens: at a panel that a link names, at the one that a part, such as the lesson, brings to
    the front, or where the student was last.
    """
    there = [key for key in pages() if key not in hidden_panels(state)]
    wanted = (panel, *(part.bench for part in state.with_own("bench")), state[Panels].last or FIRST)
    return Window.on(next((key for key in (*wanted, *there) if key in there), FIRST))


@dataclass(frozen=True)
class OpenPanel(Command):
    """Bring a panel to the front, unless it is hidden.

    Parameters
    ----------
    panel : str
    window : int, optional
        In which it is to be opened; when left out in the one in which it is asked for, or in all of them if it is the
        lab that asks.
    """

    panel: str
    window: int | None = None
    undoable: ClassVar[bool] = False

    def asked_in(self, window: int) -> OpenPanel:
        """Return the command for this window, unless it names one."""
        return replace(self, window=window) if self.window is None else self

    def apply(self, state: State) -> State:
        """Return the state with the panel open; the same state when it is hidden."""
        known_name("panel", self.panel, pages())
        hidden = self.panel in hidden_panels(state)
        return state if hidden else state.replace(state[Panels].opening(self.panel, self.window))


@dataclass(frozen=True)
class SeeTabs(Command):
    """Note which tabs are seen in a window, as its browser tells.

    Parameters
    ----------
    window : int
    tabs : frozenset of str
    """

    window: int
    tabs: frozenset[str]
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with these tabs seen; the same state when the window has gone.

        Being told the same again is no command that was not taken: fields elsewhere keep what is typed.
        """
        window = state[Panels].windows.get(self.window)
        if window is None:
            return state
        return state.replace(state[Panels].with_window(self.window, window.seeing(self.tabs)))


@dataclass(frozen=True)
class OpenWindow(Command):
    """Take in a window as it was built."""

    number: int
    window: Window
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the window."""
        return state.replace(state[Panels].with_window(self.number, self.window))


@dataclass(frozen=True)
class CloseWindow(Command):
    """Forget a window that has gone."""

    number: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state without the window; the same state when it was not there."""
        if self.number not in state[Panels].windows:
            return state
        return state.replace(state[Panels].without_window(self.number))
