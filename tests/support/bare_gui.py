"""A page of the lab without viser, network and threads: it shows a session, and its fields are filled at once.

It is for tests that fill thousands of fields; what takes a browser, such as files and cameras, does nothing.
"""

from __future__ import annotations

import contextlib
import itertools
import json
import re
from collections.abc import Callable, Iterator
from html import unescape
from inspect import signature
from types import SimpleNamespace
from typing import Any

import viser

from armlab.content.languages import ENGLISH
from armlab.content.robots import Robot
from armlab.session.session import Session
from armlab.session.state import Command, State
from armlab.ui.fields import Fields
from armlab.ui.html import Inside
from armlab.ui.plugin import panel
from armlab.ui.widgets import Gui, Html

_COUNT = itertools.count(1)
_CONTROL = re.compile(r"<((select)|input|textarea|button)\b([^>]*)>(?(2)(.*?)(?=</select>))", re.S)
_OPTION = re.compile(r'<option value="([^"]*)"')


class Handle:
    """A control of any kind: what it was made with, by the names that viser gives it."""

    def __init__(self, **given: Any) -> None:
        props = SimpleNamespace(content="")
        self._impl = SimpleNamespace(
            uuid=f"u{next(_COUNT)}", removed=False, value=given.get("initial_value"), props=props, gui_api=self
        )
        self._websock_interface = self
        self.heard: list[Callable[[Any], Any]] = []
        self.visible, self.disabled, self.value = True, False, self._impl.value
        vars(self).update(given)

    def on_update(self, callback: Callable[[Any], Any]) -> None:
        """Keep who wants to know."""
        self.heard.append(callback)

    on_click = on_hold = on_update

    def queue_message(self, message: object) -> None:
        """Send to nobody."""

    def remove(self) -> None:
        """Take it from the page."""
        self._impl.removed = True

    close = remove

    @property
    def closed(self) -> bool:
        """Whether it was a question and has been answered."""
        return bool(self._impl.removed)

    def __enter__(self) -> Handle:
        return self

    def __exit__(self, *_: object) -> None:
        pass


class Maker:
    """Takes what `viser.GuiApi` takes."""

    def __getattr__(self, name: str) -> Callable[..., Handle]:
        takes = signature(getattr(viser.GuiApi, name))

        def made(*arguments: Any, **more: Any) -> Handle:
            bound = takes.bind(self, *arguments, **more)
            bound.apply_defaults()
            return Handle(**{key: value for key, value in bound.arguments.items() if key not in ("self", "visible")})

        return made


class BareGui(Gui):
    """Controls that are nowhere."""

    def __init__(self) -> None:
        client: Any = SimpleNamespace(gui=Maker(), client_id=1)
        camera: Any = SimpleNamespace(look_from=print, as_view=lambda: None)
        super().__init__(client, camera, lambda key: None)
        self.has: list[Fields] = []
        self.said: list[Html] = []

    @property
    def origin(self) -> str:
        """Some address."""
        return "http://127.0.0.1:8080"

    @property
    def reader(self) -> tuple[str, str]:
        """Some browser."""
        return "browser", "127.0.0.1"

    def save(self, name: str, content: str | bytes) -> None:
        """Save nothing."""

    def save_picture(self, name: str, on_failure: Callable[[str], None]) -> None:
        """Draw nothing."""

    def html(self, *inside: Inside) -> Html:
        """Keep the markup, too."""
        self.said.append(super().html(*inside))
        return self.said[-1]

    def fields(self, on_input: Callable[[str, str], None], longest: int | None = None) -> Fields:
        """Keep the fields."""
        self.has.append(super().fields(on_input, longest))
        return self.has[-1]

    def clear(self, linger: bool = False) -> None:
        """Forget the fields, too."""
        super().clear()
        self.has, self.said = [], []


class BarePage:
    """One page that shows the state of a session.

    Attributes
    ----------
    session : Session
    """

    makes: type[BareGui] = BareGui
    """Kind of its controls."""

    def __init__(self, key: str, robot: Robot, language: str = ENGLISH) -> None:
        self.session = Session.fresh("bare", robot)
        self._panel, self._gui = panel(key), self.makes()
        self._gui.page, self._gui.again, self._gui.language = key, lambda: None, language
        self._seconds = itertools.count()
        self._built: State | None = None
        self.show()

    def show(self) -> None:
        """Show the present state, as the tab of a page does."""
        state, before = self.session.state, self._built
        if before is None or any(state[kind] is not before[kind] for kind in self._panel.rebuilds):
            self._gui.clear()
            self._show = self._panel.build(self._gui, state, self._post)
        self._built = state
        self._show(state)

    def _post(self, command: Command) -> None:
        self.session.apply(command, float(next(self._seconds)))

    def controls(self, *kinds: str) -> Iterator[tuple[Fields, str, str]]:
        """Yield fields, kind and cell of each control that can be used, in the order of the page."""
        for fields in self._gui.has:
            if not fields.html.visible:
                continue
            for kind, _, attributes, inside in _CONTROL.findall(content(fields)):
                cell = re.search(r'data-cell="([^"]*)"', attributes)
                if kind in kinds and cell and " disabled" not in attributes:
                    yield fields, unescape(cell[1]), inside

    def send(self, fields: Fields, cell: str, text: str = "", *of: str) -> None:
        """Fill a field, press a button or choose an option, perhaps of a question, and show what comes of it."""
        channel: Any = fields.channel
        channel.value = channel._impl.value = json.dumps([cell, text, next(_COUNT), *of])
        for callback in channel.heard:
            with contextlib.suppress(StopIteration):
                callback(SimpleNamespace(client=self)).send(None)
        self.show()


def words(page: BarePage) -> str:
    """Return everything that a page shows, without tags."""
    gui = page._gui
    shown = [content(fields) for fields in gui.has] + [each.handle._impl.props.content for each in gui.said]
    return unescape(re.sub(r"<[^>]+>", " ", " ".join(shown)))


def content(fields: Fields) -> str:
    """Return the markup that the page shows."""
    shown: str = fields.html._impl.props.content
    return shown
