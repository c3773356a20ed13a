"""Fill a page of the lab by the names of its controls, and read what it says."""

from __future__ import annotations

import re
from html import unescape

from armlab.content.robots import catalogue
from armlab.session.session import Undo
from armlab.session.state import Command, State
from support.bare_gui import BarePage, content, words


class Filled:
    """One page without a browser.

    Parameters
    ----------
    key : str
        Of the page.
    robot : str
    """

    def __init__(self, key: str, robot: str = "planar_2r") -> None:
        self._page = BarePage(key, catalogue()[robot])
        self._drags = 0

    @property
    def state(self) -> State:
        """The present state."""
        return self._page.session.state

    def do(self, *commands: Command) -> None:
        """Apply commands, each a second after the other, and show what comes of it."""
        for command in commands:
            self._page._post(command)
        self._page.show()

    def undo(self) -> None:
        """Take the last step back."""
        self.do(Undo())

    def fill(self, cell: str, text: str = "") -> None:
        """Fill a field, choose an option or press a button; the last one on the page of this name."""
        *_, (fields, _, _) = (
            each for each in self._page.controls("input", "select", "button", "textarea") if each[1] == cell
        )
        self._page.send(fields, cell, text)

    def drag(self, cell: str, *places: float) -> None:
        """Drag a picture sideways through places, in parts of its width; every call is another drag."""
        self._drags += 1
        fields = next(each for each in self._page._gui.has if f'data-cell="{cell}" data-pick="drag"' in content(each))
        for x in places:
            self._page.send(fields, cell, f"{x},0.5,{self._drags}")

    def value(self, cell: str) -> str:
        """Return what stands in a field."""
        shown = "".join(map(content, self._page._gui.has))
        (found,) = re.findall(rf'<input[^>]* value="([^"]*)"[^>]* data-cell="{cell}"', shown)
        return unescape(found)

    @property
    def markup(self) -> str:
        """Everything that the page shows."""
        return "".join(map(content, self._page._gui.has))

    @property
    def text(self) -> str:
        """Everything that the page says, without tags."""
        return words(self._page)
