"""A link to an assignment whose clock it would start: the page that it opens asks first."""

from __future__ import annotations

from collections.abc import Callable

from armlab.session.clock import now
from armlab.session.state import Command, State
from armlab.teaching.assignment_commands import OpenAssignment, clock_of
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui.begin import ask_to_begin
from armlab.ui.widgets import Gui
from armlab.window.view import View


class Beginning:
    """The question of one page, from when its link was followed until it is answered.

    Attributes
    ----------
    at_once : Command or None
        What is to be carried out without a question.

    Parameters
    ----------
    command : Command or None
        The request of the link.
    state : State
    """

    def __init__(self, command: Command | None, state: State) -> None:
        self._of = clock_of(command, state, now())
        self._command = command
        self.at_once = command if self._of is None else None
        self._close: Callable[[], None] | None = None

    def ask(self, view: View) -> None:
        """Show the question, if there is one, on the page that has been built."""
        if self._of is not None and isinstance(self._command, OpenAssignment):
            gui = Gui(view.client, view.camera, view.open_tab)
            self._close = ask_to_begin(gui, view.post, self._of, self._command.number)
            self.show(view.session.state)

    def show(self, state: State) -> None:
        """Take the question away where another page has begun."""
        if self._close is not None and self._of is not None and self._of.key in state[LessonPart].works:
            self._close()
            self._close = None
