"""Share what is on the table: a link with its QR code, a worksheet; and the way back to one's own work."""

from __future__ import annotations

from dataclasses import dataclass

from armlab.content.worksheet import worksheet
from armlab.errors import InputError
from armlab.session.parts.joints import Joints
from armlab.session.parts.lesson import at_place
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.shelf import SANDBOX, SHARED, BackFromShared, BackToLesson, Shelf
from armlab.session.parts.target import Target
from armlab.session.session import Refuse
from armlab.session.share import short
from armlab.session.state import Command, Post, State
from armlab.ui.file_names import file_name
from armlab.ui.format import escaped
from armlab.ui.markup import chip
from armlab.ui.plugin import Panel, Show
from armlab.ui.qr import qr_svg
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

FORMATS = {"markdown": ("Markdown", "md"), "latex": ("LaTeX", "tex")}

TRAVELS = (
    "A link holds the arm with its table, its pose and target, and what the picture shows. Your name, answers and "
    "progress in lessons stay here. Who opens it keeps their own work."
)

BACK: dict[str, Command] = {"back-mine": BackFromShared(), "back-lesson": BackToLesson()}

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
        self._gui, self._state, self._post = gui, state, post
        self._link: Link | None = None
        self._place = gui.fields(self._pressed)
        gui.heading("Link")
        self._made = gui.fields(self._pressed)
        gui.html(f'<p class="dim">{TRAVELS}</p>')
        gui.heading("Worksheet")
        sheets = gui.fields(self._pressed)
        hint = "The table, every A, T and J of this pose, with their numbers"
        sheets.show(
            '<div class="bar">'
            + "".join(chip(sheets.channel_id, key, title, hint) for key, (title, _) in FORMATS.items())
            + "</div>"
        )

    def show(self, state: State) -> None:
        """Show where the student is, and the link."""
        self._state = state
        self._place.show(_place(state[Shelf], self._place.channel_id))
        channel = self._made.channel_id
        if self._link is None:
            self._made.show(f'<div class="bar">{chip(channel, "make-link", "Make link")}</div>')
            return
        copied = f'<button class="chip" data-copy="{escaped(self._link.address)}">Copy link</button>'
        bar = chip(channel, "make-link", "Make link again") + copied
        self._made.show(f'<div class="bar">{bar}</div>{self._link.markup(state)}')

    def _pressed(self, cell: str, _text: str) -> None:
        state = self._state
        if cell in BACK:
            self._post(BACK[cell])
        elif cell == "make-link":
            self._make(state)
        elif cell in FORMATS:
            robot, angle = state[RobotPart].robot, "deg" if units_of(state).in_degrees else "rad"
            text = worksheet(robot, state[Joints].q, cell, angle=angle)
            self._gui.save(f"{file_name(robot.name)}.{FORMATS[cell][1]}", text)

    def _make(self, state: State) -> None:
        try:
            self._link = Link(f"{self._gui.origin}/state/{short(state)}", state)
        except InputError as refusal:
            self._link = None
            self._post(Refuse(str(refusal)))
        self.show(state)


def _place(shelf: Shelf, channel: str) -> str:
    """Return what waits, and the way back to it; nothing when the student is at home."""
    if shelf.place == SHARED:
        back = chip(channel, "back-mine", "Back to my work")
        return f'<div class="verdict warn"><b>◐ A shared arm is open</b>Your own work waits as it was. {back}</div>'
    if shelf.place == SANDBOX and shelf.waiting:
        title = escaped(at_place(shelf.waiting).title)
        back = chip(channel, "back-lesson", "Back to the lesson")
        return f'<div class="verdict warn"><b>◐ Your own sandbox</b>{title} waits as it was. {back}</div>'
    return ""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the page."""
    return SharePage(gui, state, post).show


PANEL = Panel((Shelf, *TABLE), build, rebuilds=())
