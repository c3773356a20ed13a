"""One browser: its scene and panels, which show the state of one session."""

from __future__ import annotations

import asyncio
import json
import logging
from collections.abc import Callable, Generator, Iterator
from functools import partial

import viser

from armlab.kin.arm import Arm
from armlab.session.pages import pages, tabs
from armlab.session.panel_commands import CloseWindow, OpenPanel, OpenWindow, SeeTabs, first_window, hidden_panels
from armlab.session.parts.display import SYSTEM_DARK, Display, Show
from armlab.session.parts.joints import Joints
from armlab.session.parts.panels import Panels, Window
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.session import Session
from armlab.session.state import Post, State
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui import commands
from armlab.ui.camera import Camera
from armlab.ui.canvas import Canvas
from armlab.ui.colours import BLUE
from armlab.ui.figure.drawn import Drawn, Gallery
from armlab.ui.html import tag
from armlab.ui.pace import NEXT_EVENT, PANEL_INTERVAL, Pace
from armlab.ui.plugin import Panel, hidden_layers, layers, whole_panel, wish_of, without_the_arm
from armlab.ui.switches import DARK, SKELETON
from armlab.ui.tray import Tray
from armlab.ui.widgets import Gui
from armlab.window.layer_drawing import Drawing
from armlab.window.lesson.dock import LessonDock
from armlab.window.notices import Notices
from armlab.window.overlay import Overlay, Screen
from armlab.window.search.dialog import SearchDialog
from armlab.window.tab import Tab
from armlab.window.timeline_bar import TimelineBar
from armlab.window.turning import Turning

log = logging.getLogger(__name__)

DOCK_WIDTH = 345
"""Width of the dock without the rail of its tabs, pixels. It leaves the scene 71 % of a window of 1400, 60 % of 1024,
and 58 % of a tablet's 820, where there is no rail."""

SETTLED = 0.6
"""Time after which a move made by the lab has ended, seconds."""

LINGER = 0.15
"""Time for which the bodies of an arm stay after it was edited, seconds: the page takes as long to unpack the new
ones."""

PROJECTED = 1.7
"""Size of the labels of the scene on a projector, relative to that on a screen."""


class View:
    """One browser, which is built before it can be shown.

    Attributes
    ----------
    client : viser.ClientHandle
    session : Session
    camera : Camera
    language : str
    """

    def __init__(
        self, client: viser.ClientHandle, session: Session, gallery: Gallery, post: Post, pace: Pace, language: str
    ) -> None:
        self.client, self.post, self.language = client, post, language
        self.session: Session = session
        self.camera: Camera = Camera(
            client, lambda: self._present[Joints].q, lambda: wish_of(state := self._present, self._opened(state))
        )
        self.camera.on_move = self._eye_moved
        self._gallery, self._pace = gallery, pace
        self._loop = asyncio.get_running_loop()
        self._canvas: Canvas | None = None
        self._leaving: Canvas | None = None
        self._canvases = 0
        self._lettering = 1.0
        self._drawings: list[Drawing] = []
        self._seen_drawings: list[Drawing] = []
        self._seen_because: tuple[object, ...] = ()
        self._tabs: dict[str, Tab] = {}
        self._shown: State | None = None
        self._making: Arm | None = None
        self._undrawable: Arm | None = None
        self._robot: RobotPart | None = None
        self._notices, self._untaken = Notices(client, session), session.untaken
        self._refresh: asyncio.TimerHandle | None = None
        self._refreshed = 0.0
        self._turning = Turning(pace, self.show, session.token)
        self._closed, self._anew = False, False  # the latter once what is shown is to be shown again
        self._asked = 0

    def build(self, panel: str = "") -> Generator[None, None, None]:
        """Build the page, open at a panel that a link names, in short pieces; the browser gets it when it is whole."""
        self._first = first_window(self.session.state, panel)
        self.post(OpenWindow(self.client.client_id, self._first))
        with self.client.atomic():
            self._theme(self.session.state)
            self._overlay = Overlay(
                self.client, self.session, self.post, self._gallery, self._tabs_seen, self._screen_told, self.language
            )
            self._search = SearchDialog(self)
            self._timeline = TimelineBar(self.client, self.post)
            self._tray = Tray(self.client, self.post, self._refresh_now)
            self._lesson = LessonDock(self.client, self._gui, self.post, self.session.drafts, self.session.saved)
            yield
            yield from self._dock()
            commands.register(self)
            yield
            state = self.session.state
            drawn = self._gallery.ready(state[RobotPart].robot.arm)
            if drawn is not None:
                yield from self._draw(state, drawn)
            self.show()
            yield
            if not self._refreshed:
                yield from self._refreshing()  # part of what the browser gets at once

    def _dock(self) -> Iterator[None]:
        inside = {
            first.title: "\n".join(page.name for page in (first, *more)) for first, *more in tabs().values() if more
        }
        self._gui().html(tag("i", id="al-pages", hidden=True, data_pages=json.dumps(inside)))
        dock = self.client.gui.add_panel()
        for key, of_tab in tabs().items():
            tab = dock.add_tab(of_tab[0].title, getattr(viser.Icon, of_tab[0].icon))
            page_of = partial(self._page_of, key)
            self._tabs[key] = Tab(of_tab, tab, self._gui, self.post, self.client.client_id, page_of)
            yield
        dock.dock_right()
        dock.set_width(DOCK_WIDTH)

    def _gui(self) -> Gui:
        gui = Gui(self.client, self.camera, self.open_tab)
        gui.again, gui.tray, gui.language = self._refresh_now, self._tray, self.language
        return gui

    # -- which panels are open -----------------------------------------------------------------------------------

    def _window(self, state: State) -> Window:
        """Return the open panels of this page in a state, or those it began with until the worker knows of it."""
        return state[Panels].windows.get(self.client.client_id, self._first)

    def _page_of(self, tab: str, state: State) -> str:
        return self._window(state).page_of(tab, hidden_panels(state))

    def _open_panels(self, state: State) -> frozenset[str]:
        return frozenset(self._window(state).panels(hidden_panels(state)))

    def _opened(self, state: State) -> tuple[Panel, ...]:
        """Return the panels that are visible, without those that cannot be imported."""
        return tuple(found for key in self._open_panels(state) if (found := whole_panel(key)) is not None)

    def _hidden(self, state: State) -> frozenset[str]:
        return hidden_layers(state, self._opened(state))

    def _show_overlay(self) -> None:
        window = self._window(state := self.session.state)
        if window.asked != self._asked:
            self._asked = window.asked
            self._overlay.open_tab(pages()[window.wanted].title)
        self._overlay.show("gizmo" not in self._hidden(state), self._is_coming(), without_the_arm(self._opened(state)))

    def _is_coming(self) -> bool:
        """Return whether the picture of the present arm is still being made."""
        robot = self.session.robot
        there = self._robot is not None and self._robot.robot is robot
        return not there and self._undrawable is not robot.arm

    def _eye_moved(self) -> None:
        if self._canvas is not None:
            self._canvas.eye_moved()

    def open_tab(self, key: str) -> None:
        """Bring a panel to the front, unless the lesson hides it."""
        self.post(OpenPanel(key, self.client.client_id))

    def _tabs_seen(self, text: str) -> None:
        """Read from the page's script which tabs are visible, a list of keys."""
        try:
            seen = frozenset(key for key in json.loads(text) if key in self._tabs)
        except (ValueError, TypeError):
            log.warning("a page that is not ours told of its tabs")
            return
        self.post(SeeTabs(self.client.client_id, seen))

    def _screen_told(self, screen: Screen) -> None:
        """Follow what the person's system and room ask for."""
        self.camera.gaze.still = screen.still
        self._lettering = PROJECTED if screen.large else 1.0
        for drawing in self._drawings:
            drawing.canvas.letter(self._lettering)
        if self.session.state[Display].switches.get(SYSTEM_DARK, False) != screen.dark:
            self.post(Show(SYSTEM_DARK, screen.dark))

    # -- showing -------------------------------------------------------------------------------------------------

    def show(self) -> None:
        """Show the present state: the scene at once, the panels soon."""
        if not self._closed:
            self._turning(self._showing, self._is_much_anew())

    def _is_much_anew(self) -> bool:
        """Return whether another page, arm or lesson is to be shown; an edit of the table, maybe dragged, is none."""
        state, before, was = self.session.state, self._shown, self._robot
        if was is not None and not (state[RobotPart].robot is was.robot or state[RobotPart].edits(was)):
            return True
        lessons = {each[LessonPart].open for each in (before, state) if each is not None}
        return len(lessons) > 1 or (before is not None and self._window(before) is not self._window(state))

    def _showing(self) -> Generator[None, None, None]:
        """Show the present state, in pieces; those of the panels come soon, of another page with it."""
        state, before = self.session.state, self._shown
        if state is not before or self._anew:
            self._shown, self._anew = state, False
            with self.client.atomic():
                if self._robot is None or state[RobotPart].robot is not self._robot.robot:
                    yield from self._change_robot(state)
                else:
                    yield from self._layer_by_layer(state)
                if before is not None and DARK.on(state) != DARK.on(before):
                    self._theme(state)
                jumped = self._canvas is not None and self._canvas.gliding and state[Target].pose is None
                if jumped and self.session.history.redo_label is None:
                    # Under a hand on the handle, and when something is taken back, the eye stays where it is.
                    self._later(SETTLED, self.camera.keep_in_view)
                lesson_changed = self._lesson.open(state)
            if self._leaving is not None:  # the page hears of the new bodies only now
                self._later(LINGER, self._leaving.remove)
                self._leaving = None
            if lesson_changed:
                self._lesson_changed(state, before is not None)
            if before is not None:
                self._notices.replaced(state[RobotPart], before[RobotPart])
            if before is not None and self._window(before) is not self._window(state):
                yield
                yield from self._refreshing_now()
                return
        self._refresh_soon()

    def _lesson_changed(self, state: State, later: bool) -> None:
        """Adapt the camera to a lesson; one that was opened or closed later, by another page, is told."""
        lesson = state[LessonPart].lesson
        if later and self.session.switched_by not in (None, self.client.client_id):
            self._notices.elsewhere(lesson)
        self.camera.make_room(lesson is not None, lesson.camera if lesson else None, state[LessonPart].bench)

    @property
    def _present(self) -> State:
        """The state that the scene shows; that of the session becomes another one in the middle of a look at it."""
        return self.session.state if self._shown is None else self._shown

    def _look(self, state: State) -> None:
        """Let the camera look at what the open pages want, when that is something else than before."""
        pages = self._open_panels(state)
        found = ((key, whole_panel(key)) for key in sorted(pages))
        self.camera.attend(pages, tuple((key, panel.looks(state)) for key, panel in found if panel is not None))

    def _layer_by_layer(self, state: State) -> Iterator[None]:
        open_panels = self._open_panels(state)
        bare = SKELETON.on(state) or any(panel.see_through for panel in self._opened(state))
        hidden = self._hidden(state)
        # Which layers are seen follows from these alone, and most of them are not.
        because = (state[Display], open_panels, bare, hidden)
        same = because == self._seen_because
        for drawing in self._seen_drawings if same else self._drawings:
            drawing.show(state, open_panels, bare, hidden)
            yield
        if not same:
            self._seen_drawings = [drawing for drawing in self._drawings if drawing.seen]
            self._seen_because = because

    def _change_robot(self, state: State) -> Iterator[None]:
        """Draw another arm; a new figure is made outside the event loop, and the present one stays until then."""
        arm = state[RobotPart].robot.arm
        drawn = self._gallery.ready(arm)
        if drawn is None:
            if self._making is not arm:
                self._making = arm
                making = self._loop.run_in_executor(None, self._gallery.make, arm)
                making.add_done_callback(lambda future: self._figure_made(arm, future.exception()))
            return
        yield from self._draw(state, drawn)

    def _draw(self, state: State, drawn: Drawn) -> Iterator[None]:
        """Draw the arm of a state, one layer at a time."""
        self._remove_drawings()
        self._canvases += 1
        self._canvas = Canvas(self.client, drawn, self.post, state[Joints].q, self._canvases)
        before, self._robot = self._robot, state[RobotPart]
        self._drawings = [Drawing(layer, self._canvas, self._pace) for layer in layers().values()]
        for drawing in self._drawings:
            drawing.canvas.letter(self._lettering)
        yield
        yield from self._layer_by_layer(state)
        self._look_at(drawn, before)
        yield

    def _remove_drawings(self) -> None:
        self._leaving, self._canvas = self._canvas, None
        for drawing in self._drawings:
            if drawing.layer.key != "arm":
                drawing.canvas.remove()
        self._drawings, self._seen_because = [], ()
        if self._leaving is not None:
            self._leaving.stop()

    def _look_at(self, drawn: Drawn, before: RobotPart | None) -> None:
        """Follow another arm with the camera; an edit of the same table keeps the view."""
        assert self._robot is not None
        self.camera.follow(self._robot.robot, drawn.figure, stay=self._robot.edits(before))

    def _figure_made(self, arm: Arm, problem: BaseException | None) -> None:
        """Show the new figure. One that cannot be drawn is reported once, and not tried again."""
        if problem is not None:
            log.error("the arm cannot be drawn", exc_info=problem)
            self._undrawable = arm
            self._notices.not_drawn()
            return
        if self._making is arm:
            self._making = None
        if not self._closed and self._gallery.ready(self.session.robot.arm):
            self._anew = True
            self.show()

    def _later(self, seconds: float, call: Callable[[], object]) -> None:
        self._loop.call_later(seconds, lambda: self._closed or call())

    def _refresh_soon(self) -> None:
        soonest = self._refreshed + self._pace.interval(PANEL_INTERVAL, token := self.session.token)
        come, wait = partial(self._pace.put, token, self, self._refresh_now), soonest - self._loop.time()
        if wait <= 0.0:
            come()
        elif self._refresh is None:
            self._refresh = self._loop.call_later(wait + NEXT_EVENT, come)

    def _refresh_now(self) -> None:
        self._refresh_no_more()
        if self._turning.busy:
            self.show()  # when that has come to its end
        elif not self._closed:
            for _ in self._refreshing_now():
                pass

    def _refresh_no_more(self) -> None:
        self._pace.spread.drop(self)
        if self._refresh is not None:
            self._refresh.cancel()
            self._refresh = None

    def _refreshing_now(self) -> Iterator[None]:
        self._refresh_no_more()
        with self.client.atomic():
            yield from self._refreshing()

    def _refreshing(self) -> Iterator[None]:
        """Show the panels and what stands around them, in pieces."""
        self._refreshed = self._loop.time()
        again, self._untaken = self._untaken != self.session.untaken, self.session.untaken
        state = self.session.state
        for tab in self._tabs.values():
            tab.show_head(state)
        yield
        for key in self._window(state).seen:
            self._pace.timed(self._tabs[key].show, state, again)
            yield
        self._lesson.show(state)
        yield
        self._show_overlay()
        self._search.show(self._open_panels(state))
        self._timeline.show(state, self._open_panels(state))
        self._tray.show(dict(self._tabs[key].plots for key in self._window(state).seen))
        self._look(state)
        self._notices.not_done()

    def _theme(self, state: State) -> None:
        self.client.gui.configure_theme(
            dark_mode=DARK.on(state), show_logo=False, show_share_button=False, brand_color=BLUE
        )

    def close(self) -> None:
        """Stop all work, because the browser has closed."""
        self._closed = True
        self.post(CloseWindow(self.client.client_id))
        self._refresh_no_more()
        self._turning.stop()
        self.camera.gaze.stop()
        self._overlay.close()
        self._lesson.close()
        if self._canvas is not None:
            self._canvas.stop()
