"""One browser: its scene and panels, showing the state of one session."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from typing import Any

import viser

from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.session import Session
from armlab.session.state import Command, Part, State
from armlab.ui import commands
from armlab.ui.camera import Camera
from armlab.ui.canvas import Canvas
from armlab.ui.colours import BLUE
from armlab.ui.figure.drawn import Gallery
from armlab.ui.overlay import Overlay
from armlab.ui.plugin import Layer, Panel, Show, layers, panels
from armlab.ui.widgets import Gui

log = logging.getLogger(__name__)

PANEL_INTERVAL = 0.125
"""Seconds between refreshes of panels: the scene follows a hand at once, numbers at a pace they can be read."""

DOCK_WIDTH = 345
"""Pixels: leaves the scene 75 % of a window of 1400, 66 % of 1024 and 58 % of a tablet's 820."""


class View:
    """One browser.

    Attributes
    ----------
    client : viser.ClientHandle
    session : Session
    camera : Camera
    """

    def __init__(
        self, client: viser.ClientHandle, session: Session, gallery: Gallery, post: Callable[[Command], None]
    ) -> None:
        self.client, self.session, self.post = client, session, post
        self.camera = Camera(client, lambda: session.state[Joints].q)
        self._gallery = gallery
        self._loop = asyncio.get_running_loop()
        self._canvas: Canvas | None = None
        self._canvases = 0
        self._layers: list[tuple[Layer, Show]] = []
        self._panels: list[_Tab] = []
        self._shown: State | None = None
        self._told = session.notice_seen
        self._refresh: asyncio.TimerHandle | None = None
        self._refreshed = 0.0
        self._closed = False
        with client.atomic():
            self._theme(session.state)
            self._overlay = Overlay(client, post)
            self._dock()
            commands.register(self)
        self.open_tab("Joints")
        self.show()

    def _dock(self) -> None:
        dock = self.client.gui.add_panel()
        for panel in panels().values():
            tab = dock.add_tab(panel.title, getattr(viser.Icon, panel.icon))
            self._panels.append(_Tab(panel, tab, Gui(self.client, self.camera), self.post))
        dock.dock_right()
        dock.set_width(DOCK_WIDTH)

    def open_tab(self, title: str) -> None:
        """Bring a tab to the front."""
        self._overlay.open_tab(title)
        self._overlay.show(self.session)
        self.client.flush()

    def show(self) -> None:
        """Show the present state: the scene at once, the panels soon."""
        if self._closed:
            return
        state, before = self.session.state, self._shown
        if state is not before:
            self._shown = state
            with self.client.atomic():
                if before is None or state[RobotPart] is not before[RobotPart]:
                    self._change_robot(state)
                else:
                    self._show_layers(state, before)
                if before is not None and state[Display].dark != before[Display].dark:
                    self._theme(state)
            self.client.flush()
        self._refresh_soon()

    def _show_layers(self, state: State, before: State | None) -> None:
        for layer, show in self._layers:
            if before is None or _differ(layer.watches, state, before):
                _guarded(f"layer {layer.key}", show, state)

    def _change_robot(self, state: State) -> None:
        """Clear the scene and draw another arm; a figure that is new is made outside the event loop."""
        robot = state[RobotPart].robot
        drawn = self._gallery.ready(robot.arm)
        if self._canvas is not None:
            self._canvas.close()
            self._canvas, self._layers = None, []
        self.client.scene.reset()
        if drawn is None:
            making = self._loop.run_in_executor(None, self._gallery.make, robot.arm)
            making.add_done_callback(lambda future: self._figure_made(robot.arm, future.exception()))
            return
        q = state[Joints].q
        self._canvases += 1
        self._canvas = Canvas(self.client, drawn, self.post, q, self._canvases)
        for layer in layers().values():
            show = _guarded(f"layer {layer.key}", layer.build, self._canvas, state)
            if show is not None:
                self._layers.append((layer, show))
                _guarded(f"layer {layer.key}", show, state)
        self.camera.follow(robot, drawn.figure)

    def _figure_made(self, arm: object, problem: BaseException | None) -> None:
        if problem is not None:
            log.error("the arm cannot be drawn", exc_info=problem)
            self.client.add_notification("Not drawn", "This arm cannot be drawn; the numbers are right.", color="red")
            return
        if not self._closed and self.session.robot.arm is arm and self._gallery.ready(self.session.robot.arm):
            with self.client.atomic():
                self._change_robot(self.session.state)
                self._shown = self.session.state
            self.client.flush()

    def _refresh_soon(self) -> None:
        if self._refresh is None:
            wait = max(0.0, self._refreshed + PANEL_INTERVAL - self._loop.time())
            if wait == 0.0:
                self._refresh_now()
            else:
                self._refresh = self._loop.call_later(wait, self._refresh_now)

    def _refresh_now(self) -> None:
        self._refresh = None
        if self._closed:
            return
        self._refreshed = self._loop.time()
        with self.client.atomic():
            for tab in self._panels:
                tab.show(self.session.state)
            self._overlay.show(self.session)
            self._tell()
        self.client.flush()

    def _tell(self) -> None:
        notice = self.session.notice
        if notice is not None and notice.number > self._told:
            self._told = self.session.notice_seen = notice.number
            self.client.add_notification("Not done", notice.text, color="orange", auto_close_seconds=8.0)

    def _theme(self, state: State) -> None:
        self.client.gui.configure_theme(
            dark_mode=state[Display].dark, show_logo=False, show_share_button=False, brand_color=BLUE
        )

    def close(self) -> None:
        """Stop; the browser is gone."""
        self._closed = True
        if self._refresh is not None:
            self._refresh.cancel()
        if self._canvas is not None:
            self._canvas.close()


class _Tab:
    """One panel in its tab; one that fails is replaced by a line, and the rest lives on."""

    def __init__(self, panel: Panel, tab: Any, gui: Gui, post: Callable[[Command], None]) -> None:
        self._panel, self._tab, self._gui, self._post = panel, tab, gui, post
        self._show: Show | None = None
        self._shown: State | None = None

    def show(self, state: State) -> None:
        before, self._shown = self._shown, state
        new = before is None or state[RobotPart] is not before[RobotPart]
        with self._tab:
            if new:
                self._gui.clear()
                self._show = self._try(self._panel.build, self._gui, state, self._post)
            if self._show is not None and (new or before is None or _differ(self._panel.watches, state, before)):
                self._try(_done(self._show), state)

    def _try(self, call: Callable[..., Any], *arguments: Any) -> Any:
        result = _guarded(f"panel {self._panel.key}", call, *arguments)
        if result is None:
            self._fail()
        return result

    def _fail(self) -> None:
        self._show = None
        self._gui.clear()
        self._gui.html(f'<div class="verdict no"><b>✕ {self._panel.title} has failed</b>The rest works on.</div>')


def _differ(watched: tuple[type[Part], ...], state: State, before: State) -> bool:
    return any(state[kind] is not before[kind] for kind in watched)


def _done(show: Show) -> Callable[[State], bool]:
    def call(state: State) -> bool:
        show(state)
        return True

    return call


def _guarded(what: str, call: Callable[..., Any], *arguments: Any) -> Any:
    """Return the result of a call, or None when it raised; the log gets the traceback."""
    try:
        return call(*arguments)
    except Exception:
        log.exception("%s failed", what)
        return None
