"""The commands a student has posted and that are not applied yet."""

from __future__ import annotations

import threading
from collections import deque

from armlab.session.state import Command


class Mailbox:
    """A queue in which a snapshot replaces a waiting one of its channel, if nothing else came in between.

    So events keep their order with respect to everything, a drag before its end, and a student who moves the hand
    faster than the lab can solve never waits for poses already left.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: deque[Command] = deque()

    def post(self, command: Command) -> None:
        """Add a command."""
        with self._lock:
            last = self._waiting[-1] if self._waiting else None
            if last is not None and last.snapshot and command.snapshot and last.channel == command.channel:
                self._waiting[-1] = command
            else:
                self._waiting.append(command)

    def take(self) -> list[Command]:
        """Return all waiting commands in order, and leave none."""
        with self._lock:
            commands = list(self._waiting)
            self._waiting.clear()
        return commands
