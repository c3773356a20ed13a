"""The commands that a student has posted and that are not applied yet."""

from __future__ import annotations

import threading
from collections import deque

from armlab.session.state import Command

MOST = 500
"""Largest number of waiting commands. A person leaves a few; only a flood of expensive ones exceeds it."""


class Mailbox:
    """A queue in which a snapshot replaces a waiting one of its channel, if nothing else came in between.

    So events keep their order with respect to everything, a drag before its end, and a student who moves the hand
    faster than the lab can solve never waits for poses already left.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: deque[Command] = deque()

    def post(self, command: Command) -> bool:
        """Add a command; return False when too many are waiting."""
        with self._lock:
            last = self._waiting[-1] if self._waiting else None
            if last is not None and last.snapshot and command.snapshot and last.channel == command.channel:
                self._waiting[-1] = command
            elif len(self._waiting) >= MOST:
                return False
            else:
                self._waiting.append(command)
            return True

    def take(self) -> Command | None:
        """Remove and return the command that has waited longest; None when none waits."""
        with self._lock:
            return self._waiting.popleft() if self._waiting else None

    def __len__(self) -> int:
        return len(self._waiting)
