"""The threads that apply the commands of all students."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from armlab.session.clock import now
from armlab.session.served import Served
from armlab.session.session import Session
from armlab.session.state import Command

log = logging.getLogger(__name__)

TURN = 0.005
"""Time, seconds, after which the next student's turn comes, when the present command is done."""

DEAR = 0.003
"""Time, seconds, after which a turn is one that others do not wait for."""

TOO_MANY = "More was asked for than the lab can do at one time; the last request was not carried out."


@dataclass
class Counts:
    """Counters of the worker since the start."""

    posted: int = 0
    applied: int = 0
    runs: int = 0


class Worker:
    """Serves students in turn: the waiting commands of one, but not for longer than `TURN`, then those of the next.

    The next is whoever has taken least time lately. A command that takes long, such as to draw another arm, cannot be
    interrupted: meanwhile a second thread serves those who ask for little, so that a hand that drags goes on.

    Parameters
    ----------
    publish : callable
        Called with a session after its commands were applied, in the thread that did it; it must return at once.
    """

    def __init__(self, publish: Callable[[Session], None]) -> None:
        self.counts = Counts()
        self._publish = publish
        self._lock, self._wake, self._pass = threading.Lock(), threading.Event(), threading.Event()
        self._waiting: dict[str, Session] = {}
        self._serving: set[str] = set()
        self._served = Served()
        self._turn_began: float | None = None
        self._stopping = False
        self._threads = (
            threading.Thread(target=self._serve_all, daemon=True, name="armlab-worker"),
            threading.Thread(target=self._serve_held_up, daemon=True, name="armlab-passing"),
        )

    @property
    def idle(self) -> bool:
        """Whether every command handed in has been applied and published."""
        with self._lock:
            return not self._waiting and not self._serving

    def start(self) -> None:
        """Begin to serve."""
        for thread in self._threads:
            thread.start()

    def post(self, session: Session, command: Command, window: int | None = None) -> None:
        """Hand in a command of a window, None for the lab itself; returns at once, from any thread."""
        if not session.mailbox.post(command, window):
            session.tell(TOO_MANY)
        with self._lock:
            self._waiting[session.token] = session
            self.counts.posted += 1
            busy = bool(self._serving)
        self._wake.set()
        if busy:
            self._pass.set()

    def stop(self) -> None:
        """Finish the present students' commands and end."""
        self._stopping = True
        self._wake.set()
        self._pass.set()

    def join(self, timeout: float) -> bool:
        """Wait for the end, for so many seconds at most; return whether it has come."""
        until = time.monotonic() + timeout
        for thread in self._threads:
            thread.join(max(0.0, until - time.monotonic()))
        return not any(thread.is_alive() for thread in self._threads)

    def _serve_all(self) -> None:
        """Serve until `stop`."""
        while not self._stopping:
            self._wake.wait()
            self._wake.clear()
            while not self._stopping and (session := self._next()) is not None:
                self._turn_began = time.monotonic()
                if self._waiting:
                    self._pass.set()
                self._serve(session)
                self._turn_began = None

    def _serve_held_up(self) -> None:
        """Serve, until `stop`, who asks for little while the other thread is held up."""
        while not self._stopping:
            self._pass.wait()
            self._pass.clear()
            while not self._stopping and self._turn_began is not None and self._waiting:
                time.sleep(DEAR)
                while self._is_held_up() and (session := self._next(modest=True)) is not None:
                    self._serve(session)

    def _is_held_up(self) -> bool:
        began = self._turn_began
        return began is not None and time.monotonic() - began > DEAR

    def _next(self, modest: bool = False) -> Session | None:
        """Take the next student out of those who wait, if there is one, or a modest one, whom nobody serves."""
        with self._lock:
            waiting = self._waiting.keys() - self._serving if self._serving else self._waiting.keys()
            if modest:
                waiting = {token for token in waiting if self._served.is_modest(token)}
            if not waiting:
                return None
            token = self._served.least(token for token in self._waiting if token in waiting)
            self._serving.add(token)
            return self._waiting.pop(token)

    def _serve(self, session: Session) -> None:
        began, end, applied = time.thread_time(), time.monotonic() + TURN, 0
        while (letter := session.mailbox.take()) is not None:
            session.apply(letter.command, now(), letter.window)  # assignments have dates
            applied += 1
            if time.monotonic() > end:
                break
        if applied:  # else its command was served while it was handed in
            with self._lock:
                self.counts.applied += applied
                self.counts.runs += 1
            self._tell(session)
        with self._lock:
            self._served.add(session.token, time.thread_time() - began)
            self._serving.discard(session.token)
            if len(session.mailbox):
                self._waiting[session.token] = session
            if self._waiting:
                self._wake.set()

    def _tell(self, session: Session) -> None:
        try:
            self._publish(session)
        except Exception:
            # A student whose page cannot be told must not stop the others.
            log.exception("cannot publish")
