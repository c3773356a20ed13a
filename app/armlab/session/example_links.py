"""The command behind a link to an example of a bench: it is put in place, and its page opens."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.session.bench import PutInPlace, page_of
from armlab.session.panel_commands import OpenPanel
from armlab.session.state import Command, State


@dataclass(frozen=True)
class LookAt(Command):
    """Put an example in place and open its page.

    Parameters
    ----------
    name : str
        Its name in lessons, such as ``laws/triangle``.
    """

    name: str
    label: ClassVar[str] = "example"

    def apply(self, state: State) -> State:
        """Return the state with the example; `UnknownName` when there is none such."""
        return OpenPanel(page_of(self.name)).apply(PutInPlace(self.name).apply(state))
