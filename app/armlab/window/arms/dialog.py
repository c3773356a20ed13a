"""The dialog over the scene: all arms as pictures, and the form of a new one."""

from __future__ import annotations

import asyncio
import logging
from functools import partial
from typing import Any

import viser

from armlab.content.robots import Robot
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.session import Session
from armlab.session.state import Post
from armlab.ui import adapter
from armlab.ui.fields import Fields
from armlab.ui.figure.drawn import Gallery
from armlab.ui.form import Form, Wish
from armlab.ui.html import Inside, Markup, tag
from armlab.window.arms.choice import choice_markup, groups, picture_rules
from armlab.window.arms.draft import Draft
from armlab.window.arms.new_arm import NewArmForm

log = logging.getLogger(__name__)

CLOSED, ARMS, NEW = "", "arms", "new"


class ArmsDialog:
    """The dialog of one page. It is made when it is first opened, and shows nothing while it is closed.

    Parameters
    ----------
    client : viser.ClientHandle
    post : callable
    gallery : Gallery
        Paints the pictures.
    session : Session
    language : str
        In which the person looks for an arm.
    """

    def __init__(
        self, client: viser.ClientHandle, post: Post, gallery: Gallery, session: Session, language: str
    ) -> None:
        self._client, self._gallery, self._session, self._language = client, gallery, session, language
        self._form = Form(lambda on_input: Fields(client.gui, on_input), post, self.show, beside=False)
        self._loop = asyncio.get_running_loop()
        self._hung: dict[str, Any] = {}
        self._painted: dict[str, tuple[Robot, ...]] = {}
        self._page, self._asked = CLOSED, ""
        self._new: NewArmForm | None = None
        self._gone = False

    def open(self) -> None:
        """Show all arms."""
        self._page, self._asked = ARMS, ""
        wanted = {family: tuple(robots) for family, robots in groups(self._own()).items()}
        wanted = {family: robots for family, robots in wanted.items() if self._painted.get(family) != robots}
        if wanted:
            self._painted |= wanted
            self._loop.run_in_executor(self._gallery.painter, self._paint, wanted)
        self.show()

    def show(self) -> None:
        """Show the dialog for the present state of the session."""
        state = self._session.state
        robot = state[RobotPart].robot
        if self._form.shows(self._page, robot):
            return
        if self._page == CLOSED:
            self._form.show()
        elif self._page == NEW and self._new is not None:
            back = self._form.button("arms-back", "‹ All arms", self.open, "chip")
            self._form.show(self._around("New arm", back, self._new.markup(robot.name)))
        else:
            asked = self._asked, self._language
            arms = choice_markup(self._form, self._own(), robot, asked, self._choose, self._begin)
            self._form.show(self._around("Choose an arm", self._field(), arms))

    def close(self) -> None:
        """Stop painting, because the browser has closed."""
        self._gone = True

    # -- markup --------------------------------------------------------------------------------------------------

    def _around(self, title: str, beside: Markup, content: Inside) -> Markup:
        shut = self._form.button("arms-close", "✕", self._leave, "chip", "Close (Esc)", "Close")
        head = tag("header", tag("h2", title, id="al-dialog-title"), beside, shut)
        said = {"role": "dialog", "aria_modal": "true", "aria_labelledby": "al-dialog-title"}
        inside = head, tag("div.scroll", content)
        looks = {"data_page": self._page, "data_query": self._asked}
        dialog = tag("div.al-dialog", inside, tabindex="-1", **looks, **said)
        return tag("div.al-over.al-scrim", dialog)

    def _field(self) -> Markup:
        hint = "Find: a name, a family, RRP, 7 joints …"
        looks: dict[str, Any] = {
            "inputmode": "",
            "data_live": "1",
            "data_first": "1",
            "type": "search",
            "placeholder": hint,
        }
        return self._form.field("arms-find", self._asked, "Find an arm", self._narrow, **looks)

    def _own(self) -> list[Robot]:
        """Return the arms of the student's own: that on the table, if it is one."""
        part = self._session.state[RobotPart]
        return [part.robot] if part.own else []

    # -- what a person does --------------------------------------------------------------------------------------

    def _narrow(self, text: str) -> Wish:
        self._asked = text
        return None

    def _choose(self, robot: Robot) -> Wish:
        self._leave()
        return None if robot is self._session.state[RobotPart].robot else ChooseRobot(robot.key)

    def _begin(self) -> Wish:
        self._page = NEW
        self._new = NewArmForm(self._form, Draft(self._session.state[Notation]), self._leave)
        return None

    def _leave(self) -> Wish:
        self._page = CLOSED
        self.show()
        return None

    # -- pictures ------------------------------------------------------------------------------------------------

    def _paint(self, wanted: dict[str, tuple[Robot, ...]]) -> None:
        """Paint the arms of some families, outside the event loop, and send each family to the page when it is done."""
        for family, robots in wanted.items():
            pictures = {}
            for robot in robots:
                if self._gone:
                    return
                try:
                    pictures[robot] = self._gallery.picture(robot)
                except Exception:
                    # An arm that cannot be drawn stays without a picture; its name and joints are there.
                    log.exception("the picture of %s cannot be painted", robot.name)
            try:
                self._loop.call_soon_threadsafe(partial(self._hang, family, pictures))
            except RuntimeError:
                log.debug("the server has stopped")
                return

    def _hang(self, family: str, pictures: dict[Robot, bytes]) -> None:
        """Send the pictures of a family to the page, instead of those it has."""
        if self._gone:
            return
        with self._client.atomic():
            if family not in self._hung:
                self._hung[family] = self._client.gui.add_html("")
            adapter.set_content(self._hung[family], picture_rules(family, pictures))
