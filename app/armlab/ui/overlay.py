"""The layer over the scene: the search, the verdict or the next step, undo and redo, and notes to the page's script.

The markup is put into viser's own main window, which the style sheet hides except for these children; so it stays
mounted whatever tab is open.
"""

from __future__ import annotations

import json
import logging
import secrets
from collections.abc import Callable
from typing import NamedTuple

import viser

from armlab.session.panel_commands import hidden_tabs
from armlab.session.parts.lesson import LessonPart, at_place
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.shelf import SANDBOX, SHARED, BackFromShared, BackToLesson, Shelf
from armlab.session.parts.target import Target, verdict
from armlab.session.session import Redo, Session, Undo
from armlab.session.state import Post
from armlab.ui.fields import Fields
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.search.markup import search_button
from armlab.ui.units import units_of
from armlab.ui.verdicts import verdict_line

log = logging.getLogger(__name__)

FIRST_HINT = "Drag the handle: the arm follows"


class Screen(NamedTuple):
    """The wishes of a person's system and room.

    Attributes
    ----------
    dark : bool
        The system asks for dark pages.
    still : bool
        The system asks for few moving pictures.
    large : bool
        The page is on a projector.
    """

    dark: bool
    still: bool
    large: bool


class Overlay:
    """The layer of HTML over the scene of one browser."""

    def __init__(
        self,
        client: viser.ClientHandle,
        post: Post,
        on_tabs: Callable[[str], None],
        on_screen: Callable[[Screen], None],
    ) -> None:
        self._form = Form(lambda on_input: Fields(client.gui, on_input), post, lambda: None, beside=False)
        self._on_tabs, self._on_screen = on_tabs, on_screen
        self._tab, self._asked = "", ""

    def open_tab(self, title: str) -> None:
        """Let the page's script bring a tab to the front at the next `show`."""
        # Another word each time: the page may outlive the server that asked before.
        self._tab, self._asked = title, secrets.token_hex(4)

    def show(self, session: Session, handle: bool) -> None:
        """Show the state of a session; the line on the target appears only while its handle is in the scene."""
        line: Inside = None
        if handle and session.state[Target].pose is not None:
            line = verdict_line(session.state.derived(verdict), units_of(session.state))
        elif handle and session.history.only(ChooseRobot.label):
            line = FIRST_HINT
        if self._form.shows(line, *self._made_of(session)):
            return
        hint = tag("div.al-over.al-hint", line, role="status") if line else None
        self._form.show(hint, self._top(), self._place(session), self._steps(session), self._notes(session))

    def _made_of(self, session: Session) -> tuple[object, ...]:
        """Return all values on which the layer depends besides the line."""
        shelf, robot, history = session.state[Shelf], session.state[RobotPart], session.history
        return (
            (shelf.place, _waits(shelf)),
            (history.undo_label, history.redo_label),
            (robot.own, robot.robot.key, session.state[LessonPart].open, hidden_tabs(session.state)),
            (self._tab, self._asked),
        )

    def _top(self) -> Markup:
        """Return the row at the top left of the scene."""
        return tag("div.al-over.al-top", search_button("Search"))

    def _place(self, session: Session) -> Markup | None:
        """Return a sentence on where the student is, unless at the lesson or own work, with the button back."""
        shelf = session.state[Shelf]
        if shelf.place == SANDBOX:
            says, way = "Your sandbox", self._form.button("home", f"‹ Back to {_waits(shelf)}", BackToLesson(), "chip")
        elif shelf.place == SHARED:
            says, way = "A shared arm", self._form.button("own", "‹ Back to my work", BackFromShared(), "chip")
        else:
            return None
        return tag("div.al-over.al-place", tag("b", says), way, role="status")

    def _tabs_said(self, text: str) -> None:
        self._on_tabs(text)

    def _screen_said(self, text: str) -> None:
        try:
            said = json.loads(text)
            screen = Screen(*(bool(said[name]) for name in Screen._fields))
        except (ValueError, TypeError, KeyError, IndexError):
            log.warning("a page that is not ours told of its screen")
            return
        self._on_screen(screen)

    def _steps(self, session: Session) -> Markup:
        labels = {
            "undo": ("↶", Undo(), "Undo", session.history.undo_label, "Ctrl+Z"),
            "redo": ("↷", Redo(), "Redo", session.history.redo_label, "Ctrl+Shift+Z"),
        }
        buttons = []
        for cell, (sign, command, word, what, key) in labels.items():
            title = f"{word}: {what} ({key})" if what else f"Nothing to {word.lower()}"
            buttons.append(self._form.button(cell, sign, command, hint=title, label=word, off=not what))
        return tag("div.al-over.al-steps", buttons)

    def _notes(self, session: Session) -> Markup:
        """Return the notes to the page's script: the address of this lesson or arm, and the tab to open."""
        self._form.takes("tabs", self._tabs_said)
        self._form.takes("screen", self._screen_said)
        robot = session.state[RobotPart]
        path = "/" if robot.own else f"/robot/{robot.robot.key}"
        if lesson := session.state[LessonPart].open:
            path = f"/lesson/{lesson}"
        notes = {
            "path": path,
            "tab": self._tab,
            "asked": self._asked,
            "hidden": hidden_tabs(session.state),
            "chan": self._form.channel_id,
        }
        return tag("i", id="al-notes", hidden=True, data_notes=json.dumps(notes))


def _waits(shelf: Shelf) -> str:
    """Return the name of the work that the student has left for a while."""
    return at_place(shelf.waiting).title if shelf.waiting else "my work"
