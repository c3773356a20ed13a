"""Which panels a student has open. This is kept here and nowhere else: pages, lessons and long work read it."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.session.pages import tab_of, tabs
from armlab.session.state import Part, PartType

NONE: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Window:
    """A window of the student's browser. Each has pages of its own, so that two can stand side by side.

    Attributes
    ----------
    seen : tuple of str
        Keys of the tabs that are seen, which only the browser knows; the one that came last first.
    pages : mapping of str to str
        The page on which a tab stands, where that is not its first.
    wanted : str
        Key of the tab that the browser was last asked to bring to the front.
    asked : int
        How often it was asked.
    before : str
        Key of the panel that was in front before the tab that is now; empty where there was none.
    """

    seen: tuple[str, ...]
    pages: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    wanted: str = ""
    asked: int = 0
    before: str = ""

    @classmethod
    def on(cls, panel: str) -> Self:
        """Return a window that has just come and shows a panel."""
        tab = tab_of(panel)
        return cls((tab,), MappingProxyType({tab: panel}), tab, 1)

    def page_of(self, tab: str, hidden: Collection[str] = NONE) -> str:
        """Return the page on which a tab stands; another one of it instead of one that is hidden now."""
        page = self.pages.get(tab, tab)
        return page if page not in hidden else next((each.key for each in tabs()[tab] if each.key not in hidden), page)

    def panels(self, hidden: Collection[str] = NONE) -> tuple[str, ...]:
        """Return the keys of the panels that are seen in it and not hidden now, the one that came last first."""
        return tuple(page for tab in self.seen if (page := self.page_of(tab, hidden)) not in hidden)

    def beside(self, panel: str, hidden: Collection[str] = NONE) -> str:
        """Return the panel beside one: of another tab that is seen, or else the one that was in front before."""
        others = (each for each in self.panels(hidden) if tab_of(each) != tab_of(panel))
        return next(others, "" if self.before in hidden else self.before)

    def _left_by(self, seen: tuple[str, ...]) -> str:
        """Return the panel that was in front before when other tabs are seen."""
        return self.page_of(self.seen[0]) if self.seen and seen[:1] != self.seen[:1] else self.before

    def opening(self, panel: str) -> Self:
        """Return the window with a panel turned to, and its browser asked to bring the tab to the front."""
        tab = tab_of(panel)
        first = tuple(each for each in self.seen if each == tab)
        seen = (*first, *(each for each in self.seen if each != tab))
        pages = MappingProxyType({**self.pages, tab: panel})
        before = self._left_by(seen)
        return replace(self, seen=seen, pages=pages, wanted=tab, asked=self.asked + 1, before=before)

    def seeing(self, seen: Collection[str]) -> Self:
        """Return the window with other tabs seen."""
        new = (tab for tab in tabs() if tab in seen and tab not in self.seen)
        seen = (*new, *(tab for tab in self.seen if tab in seen))
        return replace(self, seen=seen, before=self._left_by(seen))


@dataclass(frozen=True)
class Panels(Part):
    """The windows of a student, and what is open in them. It is of the moment: neither saved nor taken back.

    Attributes
    ----------
    last : str
        Key of the panel last opened in any of them, with which the next one begins; empty when there was none.
    windows : mapping of int to Window
        By the number of the browser's connection, the one in which a panel was opened last at the end.
    """

    key: ClassVar[str] = "panels"
    kept_by_undo: ClassVar[bool] = True
    saved: ClassVar[bool] = False

    last: str = ""
    windows: Mapping[int, Window] = field(default_factory=lambda: MappingProxyType({}))

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return no window."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything."""
        return self

    def open(self, hidden: Collection[str] = NONE) -> tuple[str, ...]:
        """Return the keys of all panels that are seen, the one last opened first; that one where there is no window."""
        if not self.windows:
            return (self.last,) if self.last else ()
        return tuple(panel for window in reversed(tuple(self.windows.values())) for panel in window.panels(hidden))

    def with_window(self, number: int, window: Window) -> Self:
        """Return the part with a window that has just come, or in which a person has just opened something."""
        others = {key: each for key, each in self.windows.items() if key != number}
        last = next(iter(window.panels()), self.last)
        return replace(self, last=last, windows=MappingProxyType({**others, number: window}))

    def without_window(self, number: int) -> Self:
        """Return the part without a window."""
        return replace(self, windows=MappingProxyType({k: each for k, each in self.windows.items() if k != number}))

    def opening(self, panel: str, number: int | None = None) -> Self:
        """Return the part with a panel opened in one window, or in all of them."""
        windows = dict(self.windows)
        for key in self.windows if number is None else {number} & self.windows.keys():
            windows[key] = windows.pop(key).opening(panel)
        return replace(self, last=panel, windows=MappingProxyType(windows))


PART = PartType(Panels, order=94)
