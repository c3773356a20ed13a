"""The lab of one process: viser, the sessions, the worker."""

from __future__ import annotations

import asyncio
import gc
import logging
import threading
import time
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager, suppress
from itertools import chain
from pathlib import Path

import viser

from armlab.content.languages import keys
from armlab.content.lessons import add_folder, changed, lessons, lessons_read, read_unhurried
from armlab.content.robots import Robot
from armlab.kin.ik import methods
from armlab.session.job import jobs
from armlab.session.pages import tabs
from armlab.session.panel_commands import hidden_panels
from armlab.session.parts.language import ReadIn
from armlab.session.parts.panels import Panels
from armlab.session.parts.timeline import Play, Timeline, clips
from armlab.session.runner import Runner
from armlab.session.session import Session
from armlab.session.state import Command, part_types
from armlab.session.store import Store
from armlab.session.worker import Worker
from armlab.teaching.lesson_commands import ReloadLesson
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui import adapter
from armlab.ui.figure.drawn import Gallery
from armlab.ui.manners import DEAR
from armlab.ui.pace import Pace
from armlab.ui.plugin import layers
from armlab.window.beginning import Beginning
from armlab.window.player import Player
from armlab.window.tongue import Tongue
from armlab.window.view import View
from armlab.window.wished import panel_of, wished

log = logging.getLogger(__name__)

UNVISITED = 3.0
"""Time after which lessons are read in a lab that nobody has opened yet, seconds."""

SETTLING = 1.0
"""Time that a browser has for itself to show the first page it was sent, seconds."""

GRANT_PATIENCE = 2.0
"""Time to wait for the arm or lesson that a link names before the page is built without it, seconds."""

PIECE_PATIENCE = 2.0
"""Time to wait at the end for the present piece of long work, seconds."""

SAVE_INTERVAL = 0.75
"""Time between two savings, seconds; together with the time of one, a crash loses at most a second."""

SELDOM = 30
"""Number of small garbage collections for each whole one: closed pages can wait for it, moving arms cannot."""

RECONSIDERED = 1.0
"""Time, seconds, after which one who waits for a page is asked for manners again."""

PIECE = 0.002
"""Time of building a page after which others have their turn, seconds."""

LOOK_INTERVAL = 1.0
"""Time between two looks at the files of lessons, seconds, so that a teacher soon sees a change."""


class Lab:
    """All parts of the lab behind the front.

    Parameters
    ----------
    opening : Robot
        The arm a new student begins with.
    folder : Path or None
        Where sessions are kept.
    loop : asyncio.AbstractEventLoop
        In which the lab runs. It has no port: whoever runs that loop brings it the connections of browsers.
    own_lessons : sequence of Path
        Folders of lessons besides those of the lab, read before a page is built.

    Attributes
    ----------
    serve : callable
        Serves a connection, which stands in for one of `websockets`, until it has closed.
    first_page : threading.Event
        Set when a page is on a screen, or the lab is to end: what nobody waits for is done after it.
    """

    def __init__(
        self, opening: Robot, folder: Path | None, loop: asyncio.AbstractEventLoop, own_lessons: Sequence[Path] = ()
    ) -> None:
        # Found now, so that a broken plug-in stops the start and not the first student; panels take half a second, and
        # are looked at when the lab is open.
        for found in (part_types, methods, clips, jobs, tabs, layers):
            found()
        self._own_lessons, self.loop = own_lessons, loop
        self.pace = Pace()
        self.server, self.serve = adapter.make_server(loop, self.pace.manners)
        self.gallery = Gallery(lambda: self.pace.browsers > 1)
        self.store = Store(folder, opening)
        self.worker = Worker(self._publish)
        self.runner = Runner(self.worker.post)
        self._views: dict[int, View] = {}
        self._tongues: dict[int, Tongue] = {}
        self._beginnings: dict[int, Beginning] = {}
        self._of_session: dict[str, set[View]] = {}
        self._players: dict[str, Player] = {}
        self._due: set[str] = set()
        self._waiting: dict[str, list[asyncio.Future[None]]] = {}
        self._stopped, self.first_page = threading.Event(), threading.Event()
        # One page after the other; those that are built slowly, for bad manners, hold up only each other.
        self._building = {price: asyncio.Lock() for price in (1.0, DEAR)}
        self.server.scene.configure_default_lights(False)
        self.server.scene.configure_environment_map(None)
        self.server.scene.world_axes.visible = False
        self.server.on_client_connect(self._connect)
        self.server.on_client_disconnect(self._disconnect)
        self.worker.start()
        self.runner.start()
        threading.Thread(target=self._keep_saving, daemon=True, name="armlab-saver").start()
        # The others are made when somebody first asks for them: 0.2 s once, and no work beside that of a class.
        self._figure = threading.Thread(target=self.gallery.make, args=(opening.arm,), name="armlab-figure")
        self._figure.start()
        self._looking = threading.Thread(target=self._keep_looking, daemon=True, name="armlab-lessons")
        self._looking.start()
        _set_aside()

    def stop(self) -> None:
        """Save everything and stop the lab."""
        self._stopped.set()
        self.first_page.set()
        self.runner.stop()
        self.worker.stop()
        adapter.stop_server(self.server)
        self.gallery.painter.shutdown(wait=False, cancel_futures=True)
        # A thread cut off in the middle of NumPy at the interpreter's end would abort the process.
        self._figure.join()
        self._looking.join()
        self.runner.join(PIECE_PATIENCE)
        self.store.save()

    async def _connect(self, client: viser.ClientHandle) -> None:
        headers = adapter.request_headers(self.server, client)
        if headers is None:
            return  # already gone
        found = {name.lower(): value for name, value in headers.items()}
        token = found[adapter.TOKEN_HEADER.lower()]
        if self._own_lessons:  # without them, what a student has done in one could not be read
            await self.loop.run_in_executor(None, self._add_lessons)
        # Reading all lessons takes longer than the start: only a page that shows some waits for them.
        session = await self.loop.run_in_executor(None, self.store.get, token)
        wish = found.get(adapter.WISH_HEADER.lower(), "")
        if wish.startswith(("lesson", "assignment")) or session.state[LessonPart].open or session.state[Panels].last:
            await self.loop.run_in_executor(None, lessons)
        asked = found.get(adapter.ASKED_HEADER.lower(), "")
        state = session.state
        beginning = await self.loop.run_in_executor(None, Beginning, wished(state, wish), state)
        for command in (beginning.at_once, ReadIn(asked) if asked in keys() else None):
            await self._grant(session, command, client.client_id)
        async with self._turn_to_build(token):
            if adapter.request_headers(self.server, client) is not None:  # not gone while others came in
                tongue = Tongue(client, session, found.get(adapter.LANGUAGE_HEADER.lower(), ""))
                await self._open(client, session, tongue, panel_of(wish), beginning)

    @asynccontextmanager
    async def _turn_to_build(self, token: str) -> AsyncIterator[None]:
        """Hold the place in which a page for a browser is built; who is forgiven meanwhile does not wait any longer."""
        while True:
            place = self._building[self.pace.manners.price(token)]
            with suppress(TimeoutError):
                await asyncio.wait_for(place.acquire(), RECONSIDERED)
                break
        try:
            yield
        finally:
            place.release()

    def _add_lessons(self) -> None:
        """Add the folders of lessons; those that are there already stay as they are."""
        for folder in self._own_lessons:
            add_folder(folder)

    async def _open(
        self, client: viser.ClientHandle, session: Session, tongue: Tongue, panel: str, beginning: Beginning
    ) -> None:
        """Build the page of a browser, open at this panel, in small pieces with time for other work after each."""
        view = View(
            client,
            session,
            self.gallery,
            lambda command: self.worker.post(session, command, client.client_id),
            self.pace,
            tongue.language,
        )
        pieces, went_on = view.build(panel), time.perf_counter()
        for more in chain((True for _ in pieces), (False,)):
            if adapter.request_headers(self.server, client) is None:  # gone in the meantime
                pieces.close()
                view.close()
                return
            if not more:
                self._tongues[client.client_id] = tongue
                self._beginnings[client.client_id] = beginning
                self._take_in(client, view)
                beginning.ask(view)
            took = time.perf_counter() - went_on
            if took > PIECE or not more:
                rest = self.pace.rest(session.token, took)
                await asyncio.sleep(rest if self._views.keys() - {client.client_id} else 0.0)
                went_on = time.perf_counter()

    def _take_in(self, client: viser.ClientHandle, view: View) -> None:
        """Show the session to a browser from now on."""
        session, token = view.session, view.session.token
        self._views[client.client_id] = view
        self.pace.browsers = len(self._views)
        self._of_session.setdefault(token, set()).add(view)
        self._follow_jobs(session)
        if token not in self._players:
            self._players[token] = Player(
                session, lambda command: self.worker.post(session, command), lambda: token in self._of_session
            )
        self._players[token].follow()
        self.loop.call_later(SETTLING, self.first_page.set)

    async def _grant(self, session: Session, command: Command | None, window: int) -> None:
        """Carry out the request of a link, if it has one, before the page is built.

        The session shows a notice if the request cannot be met.
        """
        if command is None:
            return
        done = self.loop.create_future()
        self._waiting.setdefault(session.token, []).append(done)
        self.worker.post(session, command, window)
        try:
            await asyncio.wait_for(done, GRANT_PATIENCE)
        except TimeoutError:
            log.warning("the worker is slow; the page is built before the link's wish is granted")

    async def _disconnect(self, client: viser.ClientHandle) -> None:
        self._tongues.pop(client.client_id, None)
        self._beginnings.pop(client.client_id, None)
        view = self._views.pop(client.client_id, None)
        self.pace.browsers = len(self._views)
        if view is not None:
            view.close()
            views = self._of_session[view.session.token]
            views.discard(view)
            if not views:
                del self._of_session[view.session.token]
                del self._players[view.session.token]
                self.runner.forget(view.session)
                if view.session.state[Timeline].playing:
                    self.worker.post(view.session, Play(False))

    def _publish(self, session: Session) -> None:
        """Let the views of a session be shown, on the event loop; called by the worker."""
        if session.token in self._due:
            return
        self._due.add(session.token)
        try:
            self.loop.call_soon_threadsafe(self.pace.put, session.token, session, lambda: self._show(session))
        except RuntimeError:
            log.debug("the server has stopped")

    def _show(self, session: Session) -> None:
        self._due.discard(session.token)
        for done in self._waiting.pop(session.token, ()):
            if not done.done():
                done.set_result(None)
        for view in tuple(self._of_session.get(session.token, ())):
            view.show()
            self._tongues[view.client.client_id].show()
            self._beginnings[view.client.client_id].show(session.state)
        if session.token in self._players:
            self._players[session.token].follow()
        self._follow_jobs(session)

    def _follow_jobs(self, session: Session) -> None:
        """Let the long work of a session be done whose panels are open."""
        if self._of_session.get(session.token):
            state = session.state
            self.runner.follow(session, frozenset(state[Panels].open(hidden_panels(state))))

    def _keep_saving(self) -> None:
        while not self._stopped.wait(SAVE_INTERVAL):
            self.store.save()
            self.store.let_go(frozenset(self._of_session), time.monotonic())

    def _keep_looking(self) -> None:
        # Another lab of this process may see a change before this one looks for the first time.
        known = lessons_read()
        self.first_page.wait(UNVISITED)
        if self._stopped.is_set():
            return
        if known is None:
            if not read_unhurried(self._stopped):
                return
            known = lessons()
            self._tell(frozenset())
        said = ""
        while not self._stopped.wait(LOOK_INTERVAL):
            try:
                # What `changed` returns is told to one lab of this process only.
                changed()
                before, known = known, lessons()
                if known is not before:
                    was = before.lessons
                    keys = frozenset(key for key, found in known.lessons.items() if was.get(key) is not found)
                    self._tell(keys)
                said = ""
            except Exception as error:
                # A folder may go away for a while; the log needs to hear of it once.
                if said != repr(error):
                    log.exception("the files of lessons cannot be looked at")
                said = repr(error)

    def _tell(self, keys: frozenset[str]) -> None:
        """Let the pages show lessons that have been read; called by another thread than theirs."""
        try:
            self.loop.call_soon_threadsafe(self._reload, keys)
        except RuntimeError:
            log.debug("the server has stopped")

    def _reload(self, keys: frozenset[str]) -> None:
        """Show changed lessons to students who have them open, and the list of lessons to all."""
        for views in tuple(self._of_session.values()):
            session = next(iter(views)).session
            key = session.state[LessonPart].open.partition("/")[0]
            if key in keys:
                self.worker.post(session, ReloadLesson(key))
            for view in views:
                view.show()


def _set_aside() -> None:
    """Exclude the objects that exist at the start from garbage collection, once in a process.

    These are 100 000 objects that stay until the end. Looking at them again and again takes a tenth of a second each
    time, during which no arm moves. Before the first page: what belongs to one must be found when it goes.
    """
    if not gc.get_freeze_count():
        gc.freeze()
        first, second, _ = gc.get_threshold()
        gc.set_threshold(first, second, SELDOM)


__all__ = ["Lab"]
