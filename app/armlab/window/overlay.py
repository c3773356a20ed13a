"""The layer over the scene: the arm's name and the search, the verdict or the next step, undo and redo, the first
visit, and notes to the page's script.

The markup is put into viser's own main window, which the style sheet hides except for these children; so it stays
mounted whatever tab is open.
"""

from __future__ import annotations

import json
import logging
import secrets
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import viser

from armlab.content.as_written import as_part
from armlab.session.panel_commands import hidden_tabs
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.target import Target, verdict
from armlab.session.session import Redo, Session, Undo
from armlab.session.state import Post, State
from armlab.teaching.lesson_places import at_place
from armlab.teaching.parts.former import BackToFormer, ForgetFormer, offered
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.preview import Preview
from armlab.teaching.parts.shelf import SANDBOX, SHARED, BackFromShared, BackToLesson, Shelf
from armlab.teaching.parts.welcome import CARD, LeaveWelcome, Welcome
from armlab.teaching.preview_commands import EndPreview
from armlab.ui.fields import Fields
from armlab.ui.figure.drawn import Gallery
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.search_button import search_button
from armlab.ui.units import units_of
from armlab.ui.verdicts import verdict_line
from armlab.ui.welcome import offered as offered_lessons
from armlab.ui.welcome import welcome_markup

if TYPE_CHECKING:
    from armlab.window.arms.dialog import ArmsDialog

log = logging.getLogger(__name__)

FIRST_HINT = "Drag the handle: the arm follows"

APART = "The pictures of this page are in the panel; the arm has no part in it"


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
    """The layer of HTML over the scene of one browser.

    Parameters
    ----------
    client : viser.ClientHandle
    session : Session
    post : callable
    gallery : Gallery
        Paints the pictures of the arms to choose from.
    on_tabs : callable
        Called with the text in which the page's script tells which tabs are seen.
    on_screen : callable
        Called with the wishes of the person's system and room.
    language : str
        In which the person looks for an arm.
    """

    def __init__(
        self,
        client: viser.ClientHandle,
        session: Session,
        post: Post,
        gallery: Gallery,
        on_tabs: Callable[[str], None],
        on_screen: Callable[[Screen], None],
        language: str,
    ) -> None:
        self._client, self._session, self._post, self._gallery = client, session, post, gallery
        self._form = Form(lambda on_input: Fields(client.gui, on_input), post, lambda: None, beside=False)
        self._on_tabs, self._on_screen, self._language = on_tabs, on_screen, language
        self._arms: ArmsDialog | None = None
        self._tab, self._asked, self._begun = "", "", False
        self._refused: tuple[tuple[State, State | None, State | None], tuple[str, str]] | None = None

    def open_tab(self, title: str) -> None:
        """Let the page's script bring a tab to the front at the next `show`."""
        # Another word each time: the page may outlive the server that asked before.
        self._tab, self._asked = title, secrets.token_hex(4)

    def close(self) -> None:
        """Stop all work, because the browser has closed."""
        if self._arms is not None:
            self._arms.close()

    def show(self, handle: bool, coming: bool, apart: bool = False) -> None:
        """Show the present state of the session.

        Parameters
        ----------
        handle : bool
            Whether the target's handle is in the scene; without it there is no line on the target.
        coming : bool
            Whether the picture of the arm is still being made.
        apart : bool
            Whether nothing that is open has to do with the arm: the first hint says so.
        """
        session = self._session
        self._let_work()
        if self._arms is not None:
            self._arms.show()
        line: Inside = None
        if handle and not coming and session.state[Target].pose is not None:
            line = verdict_line(session.state.derived(verdict), units_of(session.state))
        elif handle and not coming and session.history.only(ChooseRobot.label):
            line = APART if apart else FIRST_HINT
        if self._form.shows(line, handle, coming, *self._made_of(session)):
            return
        hint = tag("div.al-over.al-hint", line, role="status") if line else None
        welcome = welcome_markup(self._form, session.state[Welcome], offered_lessons(session.state))
        top, place = self._top(session.state), self._place(session)
        self._form.show(top, hint, place, self._steps(session), welcome, self._notes(session, handle, coming))

    def _let_work(self) -> None:
        """Take the card of the first visit away when the person begins to work: the scene is needed."""
        begun = not self._session.history.only(ChooseRobot.label)
        if begun and not self._begun and self._session.state[Welcome].at == CARD:
            self._post(LeaveWelcome())
        self._begun = begun

    def _made_of(self, session: Session) -> tuple[object, ...]:
        """Return all values on which the layer depends besides the line."""
        state, history = session.state, session.history
        shelf, robot = state[Shelf], state[RobotPart]
        return (
            (
                shelf.place,
                _waits(shelf),
                state[Preview].before is None,
                offered(state),
                state[Welcome],
                offered_lessons(state),
            ),
            (history.undo_label, history.redo_label, *self._refusals()),
            (robot.title, robot.own, robot.robot.key, state[LessonPart].open, hidden_tabs(state)),
            state[LessonPart].lesson,  # its file may be loaded again
            (self._tab, self._asked),
        )

    def _open_arms(self) -> None:
        """Open the dialog in which an arm is chosen, which is imported for it."""
        from armlab.window.arms.dialog import ArmsDialog

        if self._arms is None:
            self._arms = ArmsDialog(self._client, self._post, self._gallery, self._session, self._language)
        self._arms.open()

    def _top(self, state: State) -> Markup:
        """Return the row at the top of the scene: the arm's name, and the search."""
        return tag("div.al-over.al-top", self._name(state), search_button("Search"))

    def _name(self, state: State) -> Markup:
        """Return the arm's name, which is the switch to another one unless a lesson keeps the arm."""
        name, lesson = state[RobotPart].title, state[LessonPart].lesson
        if lesson is not None and "robot" in lesson.locked:
            own = "" if state[LessonPart].assignment else " Its button “My sandbox” lets you choose any arm."
            why = f"The lesson “{as_part(lesson.title)}” is about this arm.{own}"
            return tag("span.arm-name", tag("b", name), tag("small", "set by the lesson"), title=why)
        inside = tag("b", name), tag("span", "▾", aria_hidden="true")
        about = f"{name}: choose another arm, or make a new one"
        return self._form.button("arms", inside, self._open_arms, "arm-name", about, about, aria_haspopup="dialog")

    def _place(self, session: Session) -> Markup | None:
        """Return a sentence on where the student is, unless at the lesson or own work, with the button back."""
        shelf, former = session.state[Shelf], offered(session.state)
        way: Inside
        if session.state[Preview].before is not None and shelf.place != SHARED:
            says, way = (
                "As a student sees it",
                self._form.button("preview-end", "‹ Back to my work", EndPreview(), "chip"),
            )
        elif shelf.place == SANDBOX:
            says, way = "Your sandbox", self._form.button("home", f"‹ Back to {_waits(shelf)}", BackToLesson(), "chip")
        elif shelf.place == SHARED:
            says, way = "A shared arm", self._form.button("own", "‹ Back to my work", BackFromShared(), "chip")
        elif former is not None:
            back = f"‹ Back to {former.name}" if former.name.startswith("My ") else f"‹ Back to my {former.name}"
            stay = "Keep the lesson's arm"
            says = "The lesson is closed"
            way = (
                self._form.button("former", back, BackToFormer(), "chip"),
                self._form.button("stay", "✕", ForgetFormer(), "chip", stay, stay),
            )
        else:
            return None
        beside = session.state[LessonPart].open  # which leaves no room in the row at the top
        kind = "div.al-over.al-place.al-under" if beside else "div.al-over.al-place"
        return tag(kind, tag("b", says), way, role="status")

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

    def _refusals(self) -> tuple[str, str]:
        """Return why an undo and a redo would be refused, as where a lesson keeps its arm."""
        state, history = self._session.state, self._session.history
        of = state, history.undone, history.redone
        if self._refused is None or any(now is not was for now, was in zip(of, self._refused[0], strict=True)):
            self._refused = of, (self._session.refusal(of[1]), self._session.refusal(of[2]))
        return self._refused[1]

    def _steps(self, session: Session) -> Markup:
        no_undo, no_redo = self._refusals()
        labels = {
            "undo": ("↶", Undo(), "Undo", session.history.undo_label, no_undo, "Ctrl+Z"),
            "redo": ("↷", Redo(), "Redo", session.history.redo_label, no_redo, "Ctrl+Shift+Z"),
        }
        buttons = []
        for cell, (sign, command, word, what, refused, key) in labels.items():
            title = refused or (f"{word}: {what} ({key})" if what else f"Nothing to {word.lower()}")
            buttons.append(
                self._form.button(cell, sign, command, hint=title, label=word, off=not what or bool(refused))
            )
        return tag("div.al-over.al-steps", buttons)

    def _notes(self, session: Session, handle: bool, coming: bool) -> Markup:
        """Return the notes to the page's script: the address of this lesson or arm, the tab to open, what is coming."""
        self._form.takes("tabs", self._tabs_said)
        self._form.takes("screen", self._screen_said)
        robot = session.state[RobotPart]
        path = "/" if robot.own else f"/robot/{robot.robot.key}"
        if lesson := session.state[LessonPart].open:
            path = f"/lesson/{lesson}"
        if (assigned := session.state[LessonPart].assigned) is not None:
            path = f"/assignment/{assigned.key}"
        if session.state[Preview].before is not None:
            path = "/"  # of one's own files others have none
        notes = {
            "path": path,
            "arm": robot.title,
            "coming": coming,
            "handle": handle,
            "tab": self._tab,
            "asked": self._asked,
            "hidden": hidden_tabs(session.state),
            "chan": self._form.channel_id,
        }
        return tag("i", id="al-notes", hidden=True, data_notes=json.dumps(notes))


def _waits(shelf: Shelf) -> str:
    """Return the name of the work that the student has left for a while."""
    return at_place(shelf.waiting).title if shelf.waiting else "my work"
