"""Share what is on the table: a link with its QR code, a worksheet; and the way back to one's own work."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from armlab.content.worksheet import worksheet
from armlab.session.parts.joints import Joints
from armlab.session.parts.lesson import at_place
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.shelf import SANDBOX, SHARED, BackFromShared, BackToLesson, Shelf
from armlab.session.parts.target import Target
from armlab.session.share import short
from armlab.session.state import Post, State
from armlab.ui.file_names import file_name
from armlab.ui.form import Form
from armlab.ui.format import escaped
from armlab.ui.plugin import Panel, Show
from armlab.ui.qr import qr_svg
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

FORMATS = {"markdown": ("Markdown", "md"), "latex": ("LaTeX", "tex")}

TRAVELS = (
    "A link holds the arm with its table, its pose and target, and what the picture shows. Your name, answers and "
    "progress in lessons stay here. Who opens it keeps their own work."
)

TABLE = (RobotPart, Joints, Target)
"""Parts of which a link that was made can be out of date."""


@dataclass(frozen=True, eq=False)
class Link:
    """A link that was made, of a state."""

    address: str
    state: State

    def markup(self, present: State) -> str:
        """Return it with its length, and its code where that can be read."""
        code = qr_svg(self.address)
        old = any(present[kind] is not self.state[kind] for kind in TABLE)
        about = f"{len(self.address)} characters." + (" It holds the arm as it was before." if old else "")
        return (
            f'<input class="field" readonly aria-label="Link" value="{escaped(self.address)}">'
            f'<p class="dim">{about}</p>'
            + (f'<div class="qr">{code}</div>' if code else '<p class="dim">Too long for a QR code.</p>')
        )


class SharePage:
    """The page.

    Parameters
    ----------
    gui : Gui
    state : State
    post : callable
    """

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        self._gui, self._state = gui, state
        self._link: Link | None = None
        self._place = gui.form(post)
        gui.heading("Link")
        self._made = gui.form(post)
        gui.html(f'<p class="dim">{TRAVELS}</p>')
        gui.heading("Worksheet")
        self._sheets = gui.form(post)

    def show(self, state: State) -> None:
        """Show where the student is, the link, and the worksheets."""
        self._state = state
        self._place.show(_place(self._place, state[Shelf]))
        self._made.show(self._linked(self._made))
        self._sheets.show(self._worksheets(self._sheets))

    def _linked(self, form: Form) -> str:
        if self._link is None:
            return f'<div class="bar">{form.chip("make-link", "Make link", self._make)}</div>'
        copied = f'<button class="chip" data-copy="{escaped(self._link.address)}">Copy link</button>'
        bar = form.chip("make-link", "Make link again", self._make) + copied
        return f'<div class="bar">{bar}</div>{self._link.markup(self._state)}'

    def _worksheets(self, form: Form) -> str:
        hint = "The table, every A, T and J of this pose, with their numbers"
        chips = (form.chip(key, title, partial(self._save, key), hint) for key, (title, _) in FORMATS.items())
        return f'<div class="bar">{"".join(chips)}</div>'

    def _make(self) -> None:
        self._link = None
        self._link = Link(f"{self._gui.origin}/state/{short(self._state)}", self._state)

    def _save(self, key: str) -> None:
        robot, angle = self._state[RobotPart].robot, "deg" if units_of(self._state).in_degrees else "rad"
        text = worksheet(robot, self._state[Joints].q, key, angle=angle)
        self._gui.save(f"{file_name(robot.name)}.{FORMATS[key][1]}", text)


def _place(form: Form, shelf: Shelf) -> str:
    """Return what waits, and the way back to it; nothing when the student is at home."""
    if shelf.place == SHARED:
        back = form.chip("back-mine", "Back to my work", BackFromShared())
        return f'<div class="verdict warn"><b>◐ A shared arm is open</b>Your own work waits as it was. {back}</div>'
    if shelf.place == SANDBOX and shelf.waiting:
        title = escaped(at_place(shelf.waiting).title)
        back = form.chip("back-lesson", "Back to the lesson", BackToLesson())
        return f'<div class="verdict warn"><b>◐ Your own sandbox</b>{title} waits as it was. {back}</div>'
    return ""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the page."""
    return SharePage(gui, state, post).show


PANEL = Panel((Shelf, *TABLE), build, rebuilds=())
