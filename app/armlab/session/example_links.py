"""The command behind a link to an example of a bench: it is put in place, and its page opens."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.errors import InputError
from armlab.session.bench import PutInPlace, page_of
from armlab.session.panel_commands import OpenPanel, hidden_panels
from armlab.session.state import Command, State


@dataclass(frozen=True)
class LookAt(Command):
    """Put an example in place and open its page.

    Parameters
    ----------
    name : str
        Its name in lessons, such as ``laws/triangle``.
    window : int, optional
        In which the page opens; in all of them when left out.
    """

    name: str
    window: int | None = None
    label: ClassVar[str] = "example"

    def asked_in(self, window: int) -> LookAt:
        """Return the command for this window."""
        return replace(self, window=window)

    def apply(self, state: State) -> State:
        """Return the state with the example; `UnknownName` when there is none such.

        Raises
        ------
        InputError
            Its page is closed while the open lesson is.
        """
        page = page_of(self.name)
        if page in hidden_panels(state):
            raise InputError("The page of this example is closed while this lesson is open.")
        return OpenPanel(page, self.window).apply(PutInPlace(self.name).apply(state))
