"""The thread that applies the commands of all students."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from armlab.session.clock import now
from armlab.session.session import Session
from armlab.session.state import Command

log = logging.getLogger(__name__)

TURN = 0.02
"""Time, seconds, after which the next student's turn comes, when the present command is done."""

TOO_MANY = "More was asked for than the lab can do at one time; the last request was not carried out."


@dataclass
class Counts:
    """Counters of the worker since the start."""

    posted: int = 0
    applied: int = 0
    runs: int = 0


class Worker(threading.Thread):
    """Serves students in turn: the waiting commands of one, but not for longer than `TURN`, then those of the next.

    Parameters
    ----------
    publish : callable
        Called with a session after its commands were applied, in this thread; it must return at once.
    """

    def __init__(self, publish: Callable[[Session], None]) -> None:
        super().__init__(daemon=True, name="armlab-worker")
        self.counts = Counts()
        self._publish = publish
        self._lock, self._wake = threading.Lock(), threading.Event()
        self._waiting: dict[str, Session] = {}
        self._serving = False
        self._stopping = False

    @property
    def idle(self) -> bool:
        """Whether every command handed in has been applied and published."""
        with self._lock:
            return not self._waiting and not self._serving

    def post(self, session: Session, command: Command, window: int | None = None) -> None:
        """Hand in a command of a window, None for the lab itself; returns at once, from any thread."""
        if not session.mailbox.post(command, window):
            session.tell(TOO_MANY)
        with self._lock:
            self._waiting[session.token] = session
            self.counts.posted += 1
        self._wake.set()

    def stop(self) -> None:
        """Finish the present student's commands and end."""
        self._stopping = True
        self._wake.set()

    def run(self) -> None:
        """Serve until `stop`."""
        while not self._stopping:
            self._wake.wait()
            self._wake.clear()
            while not self._stopping and (session := self._next()) is not None:
                self._serve(session)

    def _next(self) -> Session | None:
        with self._lock:
            self._serving = bool(self._waiting)
            return self._waiting.pop(next(iter(self._waiting))) if self._waiting else None

    def _serve(self, session: Session) -> None:
        end = time.monotonic() + TURN
        while (letter := session.mailbox.take()) is not None:
            session.apply(letter.command, now(), letter.window)  # assignments have dates
            self.counts.applied += 1
            if time.monotonic() > end:
                break
        if len(session.mailbox):
            with self._lock:
                self._waiting[session.token] = session
        self.counts.runs += 1
        try:
            self._publish(session)
        except Exception:
            # A student whose page cannot be told must not stop the others.
            log.exception("cannot publish")
