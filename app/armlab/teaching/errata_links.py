"""The command behind a link to an erratum, in a lesson or in an address: the page Errata opens at it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.content.errata import erratum
from armlab.errors import InputError
from armlab.session.panel_commands import OpenPanel, hidden_panels
from armlab.session.state import Command, State
from armlab.session.words import word
from armlab.teaching.parts.lesson import LessonPart

PAGE = "errata"
"""Key of the page."""

CHOOSE = "lessons.errata.choose"
"""Word of the command of the page, which is found by folder as those of all benches are."""


@dataclass(frozen=True)
class LookUp(Command):
    """Open the page Errata at an erratum.

    Parameters
    ----------
    key : str
        Its id, such as ``5.58``.
    window : int, optional
        In which the page opens; in all of them when left out.
    """

    key: str
    window: int | None = None
    undoable: ClassVar[bool] = False

    def asked_in(self, window: int) -> LookUp:
        """Return the command for this window."""
        return replace(self, window=window)

    def apply(self, state: State) -> State:
        """Return the state with the page open.

        Raises
        ------
        UnknownName
            There is no such erratum.
        InputError
            The open lesson or assignment closes the page.
        """
        if PAGE in hidden_panels(state):
            what = "assignment" if state[LessonPart].assignment else "lesson"
            raise InputError(f"The page Errata is closed while this {what} is open.")
        chosen = word(CHOOSE).make(key=erratum(self.key).id).apply(state)
        return OpenPanel(PAGE, self.window).apply(chosen)
