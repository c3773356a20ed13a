"""Commands that open panels: for a window that comes, a person who turns to one, a lesson and its steps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.registry import known_name
from armlab.session.pages import FIRST, pages, tabs
from armlab.session.parts.lesson import LessonPart
from armlab.session.parts.panels import Panels, Window
from armlab.session.state import Command, State


def hidden_panels(state: State) -> frozenset[str]:
    """Return the keys of the panels that the open lesson hides."""
    return state[LessonPart].hidden


def hidden_tabs(state: State) -> tuple[str, ...]:
    """Return the titles of the tabs all of whose pages the open lesson hides."""
    hidden = hidden_panels(state)
    return tuple(pages[0].title for pages in tabs().values() if all(page.key in hidden for page in pages))


def first_window(state: State) -> Window:
    """Return a window as it opens: at the bench of the lesson, or else where the student was last."""
    there = [key for key in pages() if key not in hidden_panels(state)]
    wanted = (state[LessonPart].bench, state[Panels].last or FIRST)
    return Window.on(next((key for key in (*wanted, *there) if key in there), FIRST))


def lesson_followed(before: State, now: State) -> State:
    """Return a state with the panel open that a lesson, or a step of it, brings to the front by being opened.

    Another lesson brings its bench to the front, or any other panel where that in front is hidden now. A step does so
    when it names a panel or is on another bench than the one before.
    """
    was, part, panels = before[LessonPart], now[LessonPart], now[Panels]
    if part.lesson is None or (part.open, part.name) == (was.open, was.name):
        return now
    there = [key for key in pages() if key not in part.hidden]
    if part.open == was.open:
        step = part.step
        wanted = part.bench if part.bench != was.bench or (step is not None and step.panel) else ""
    else:
        wanted = part.bench
        if wanted not in there and not set(panels.open()) <= set(there):
            wanted = next(iter(there), "")
    return now.replace(panels.opening(wanted)) if wanted in there else now


@dataclass(frozen=True)
class OpenPanel(Command):
    """Bring a panel to the front, unless the open lesson hides it.

    Parameters
    ----------
    panel : str
    window : int, optional
        In which it is to be opened; in all of them when left out.
    """

    panel: str
    window: int | None = None
    undoable: ClassVar[bool] = False

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
