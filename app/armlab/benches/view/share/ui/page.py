"""The page for sharing the present state: a link with its QR code, a worksheet, and the way back to one's own work."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from ipaddress import ip_address
from urllib.parse import urlsplit

from armlab.benches.view.share.ui.qr import qr_svg
from armlab.benches.view.share.worksheet import worksheet
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.share import short
from armlab.session.state import Post, State
from armlab.teaching.lesson_places import at_place
from armlab.teaching.parts.shelf import SANDBOX, SHARED, BackFromShared, BackToLesson, Shelf
from armlab.ui.file_names import file_name
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

FORMATS = {"markdown": ("Markdown", "md"), "latex": ("LaTeX", "tex")}

NOT_YET = "A link, and a code that a phone can scan, to the arm exactly as it stands now."

SHEET = (
    "The table of the arm, every transform and the Jacobian of the present pose in numbers, and in symbols where they "
    "are short enough to read, to print or to hand in."
)

TRAVELS = (
    "A link holds the arm with its table, its pose and target, and what the picture shows. Your name, answers and "
    "progress in lessons stay here. Who opens it keeps their own work."
)

HERE = (
    "Only this computer can open this link: a phone would look for the lab in itself. Start the lab with "
    "--host 0.0.0.0, and make the link at the address it then prints."
)

TABLE = (RobotPart, Joints, Target)
"""Parts of the state whose change makes a link out of date."""


@dataclass(frozen=True, eq=False)
class Link:
    """A link to a state."""

    address: str
    state: State

    def markup(self, present: State) -> Inside:
        """Return the link with its length, and its code if that can be scanned."""
        code = qr_svg(self.address)
        old = any(present[kind] is not self.state[kind] for kind in TABLE)
        about = f"{len(self.address)} characters." + (" It holds the arm as it was before." if old else "")
        line = tag("input.field", readonly=True, aria_label="Link", value=self.address)
        here = tag("p.warn", f"◐ {HERE}") if is_loopback(self.address) else None
        shown = tag("div.qr", code) if code else tag("p.dim", "Too long for a QR code.")
        return line, tag("p.dim", about), here, shown


def is_loopback(address: str) -> bool:
    """Return whether an address means the computer on which it is opened, such as ``http://127.0.0.1:8080/``."""
    host = urlsplit(address).hostname or ""
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost" or host.endswith(".localhost")


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
        gui.html(tag("p.dim", TRAVELS))
        gui.heading("Worksheet")
        self._sheets = gui.form(post)

    def show(self, state: State) -> None:
        """Show the student's place, the link, and the worksheets."""
        self._state = state
        self._place.show(_place(self._place, state[Shelf]))
        self._made.show(self._linked(self._made))
        self._sheets.show(self._worksheets(self._sheets))

    def _linked(self, form: Form) -> Inside:
        if self._link is None:
            return tag("p", NOT_YET), tag("div.bar", form.button("make-link", "Make link", self._make, "main"))
        copied = tag("button.chip", "Copy link", data_copy=self._link.address)
        bar = tag("div.bar", form.chip("make-link", "Make link again", self._make), copied)
        return bar, self._link.markup(self._state)

    def _worksheets(self, form: Form) -> Inside:
        chips = (
            form.chip(key, f"Save as {title}", partial(self._save, key), f"A file that ends with .{ending}")
            for key, (title, ending) in FORMATS.items()
        )
        return tag("p", SHEET), tag("div.bar", chips)

    def _make(self) -> None:
        self._link = None
        self._link = Link(f"{self._gui.origin}/state/{short(self._state)}", self._state)

    def _save(self, key: str) -> None:
        robot, angle = self._state[RobotPart].robot, "deg" if units_of(self._state).in_degrees else "rad"
        text = worksheet(robot, self._state[Joints].q, key, angle=angle)
        self._gui.save(f"{file_name(robot.name)}.{FORMATS[key][1]}", text)


def _place(form: Form, shelf: Shelf) -> Markup | None:
    """Return the work that waits, with the button back to it, or nothing if the student's own work is open."""
    if shelf.place == SHARED:
        back = form.chip("back-mine", "Back to my work", BackFromShared())
        return verdict_box("warn", "A shared arm is open", "Your own work waits as it was. ", back)
    if shelf.place == SANDBOX and shelf.waiting:
        title = at_place(shelf.waiting).title
        back = form.chip("back-lesson", "Back to the lesson", BackToLesson())
        return verdict_box("warn", "Your own sandbox", f"{title} waits as it was. ", back)
    return None


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the page."""
    return SharePage(gui, state, post).show


PANEL = Panel((Shelf, *TABLE), build, rebuilds=())
