"""The thread that does the long work of all students, in pieces taken in turn."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from armlab.session.job import Deliver, Job, Wanted, jobs
from armlab.session.load import Load, of_others
from armlab.session.session import Refuse, Session
from armlab.session.state import Command

log = logging.getLogger(__name__)

FULL = 0.75
LEAST, MOST = 0.03, 0.8
"""Least and largest part of a core for long work, which otherwise takes what the rest of the lab leaves: people
dragging the arm come first, but nobody waits for ever."""

Post = Callable[[Session, Command], None]


@dataclass(eq=False)
class Task:
    """One job of one student.

    Attributes
    ----------
    wanted : Wanted or None
        Input of the work that the state needs now.
    begun : Wanted or None
        Input of the work begun last, possibly finished.
    pieces : iterator or None
        The work under way.
    due : float
        Earliest start of the next piece of work, in seconds of the clock.
    """

    session: Session
    job: Job
    wanted: Wanted | None = None
    begun: Wanted | None = None
    pieces: Iterator[Any] | None = None
    due: float = 0.0

    @property
    def has_work(self) -> bool:
        """Whether work is in progress, or to be started or cancelled."""
        return self.pieces is not None or self.is_outdated

    @property
    def is_outdated(self) -> bool:
        """Whether the work in progress is no longer what is wanted."""
        wanted, begun = self.wanted, self.begun
        return (wanted is None) != (begun is None) or (wanted and wanted.key) != (begun and begun.key)


class Runner(threading.Thread):
    """Does what the jobs of all students want, a piece of each in turn.

    Parameters
    ----------
    post : callable
        ``post(session, command)`` hands in a command, from any thread.
    clock : callable
        Seconds of a steady clock.
    """

    def __init__(self, post: Post, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__(daemon=True, name="armlab-jobs")
        self._post, self._clock = post, clock
        self._changed = threading.Condition()
        self._tasks: dict[tuple[str, str], Task] = {}
        self._stopping = False

    @property
    def idle(self) -> bool:
        """Whether all work is done and handed in."""
        with self._changed:
            return not any(task.has_work for task in self._tasks.values())

    def follow(self, session: Session, panels: frozenset[str]) -> None:
        """Read from the state of a session what work it needs; returns at once, from any thread."""
        state, token = session.state, session.token
        for job in jobs().values():
            try:
                wanted = job.wanted(state, panels)
            except Exception:
                # One job that fails must stop neither the others nor the showing of the state.
                log.exception("job %s cannot tell what it wants", job.key)
                wanted = None
            if wanted is None and (token, job.key) not in self._tasks:
                continue
            with self._changed:
                task = self._tasks.get((token, job.key))
                if task is None:
                    task = self._tasks[token, job.key] = Task(session, job)
                task.wanted = wanted
                if task.has_work:
                    self._changed.notify()

    def forget(self, session: Session) -> None:
        """Cancel the work for a student who has left."""
        with self._changed:
            for key in [key for key in self._tasks if key[0] == session.token]:
                self._tasks.pop(key).wanted = None

    def stop(self) -> None:
        """End after the present piece."""
        with self._changed:
            self._stopping = True
            self._changed.notify()

    def run(self) -> None:
        """Work until `stop`."""
        others = Load(of_others)
        while (task := self._next()) is not None:
            began = self._clock()
            self._work(task)
            took = self._clock() - began
            share = min(max(FULL - others(), LEAST), MOST)
            with self._changed:
                if not self._stopping:
                    self._changed.wait_for(lambda: self._stopping, took * (1.0 / share - 1.0))

    def _next(self) -> Task | None:
        """Wait for the next task in turn; return None at the end."""
        with self._changed:
            while not self._stopping:
                now = self._clock()
                waiting = [task for task in self._tasks.values() if task.has_work]
                ready = [task for task in waiting if task.due <= now]
                if ready:
                    # First due, first served: nobody waits for another's long work longer than for a piece of it.
                    return min(ready, key=lambda task: task.due)
                self._changed.wait(min((task.due for task in waiting), default=now + 3600.0) - now)
        return None

    def _work(self, task: Task) -> None:
        with self._changed:
            wanted, outdated = task.wanted, task.is_outdated
        now = self._clock()
        task.due = now + task.job.interval
        try:
            if outdated:
                task.begun, task.pieces = wanted, None
                task.pieces = None if wanted is None else task.job.run(wanted.inputs)
            if task.pieces is None or task.begun is None:
                return
            found = next(task.pieces)
        except StopIteration:
            task.pieces = None
        except Exception:
            log.exception("job %s failed", task.job.key)
            self._post(
                task.session, Refuse(f"{task.job.title} has failed inside the lab. The rest of the lab still works.")
            )
            task.pieces = None
        else:
            if found is not None:
                self._post(task.session, Deliver(task.job, task.begun.inputs, found))
