"""The commands that a student has posted and that are not applied yet."""

from __future__ import annotations

import threading
from collections import deque
from typing import NamedTuple

from armlab.session.state import Command

MOST = 500
"""Largest number of waiting commands. A person leaves a few; only a flood of expensive ones exceeds it."""


class Letter(NamedTuple):
    """A command, and the window of the student that has posted it, None for the lab itself."""

    command: Command
    window: int | None


class Mailbox:
    """A queue in which a snapshot replaces a waiting one of its channel, if nothing else came in between.

    So events keep their order with respect to everything, a drag before its end, and a student who moves the hand
    faster than the lab can solve never waits for poses already left.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: deque[Letter] = deque()

    def post(self, command: Command, window: int | None = None) -> bool:
        """Add a command; return False when too many are waiting."""
        letter = Letter(command, window)
        with self._lock:
            last = self._waiting[-1].command if self._waiting else None
            if last is not None and last.snapshot and command.snapshot and last.channel == command.channel:
                self._waiting[-1] = letter._replace(command=command.instead_of(last))
            elif len(self._waiting) >= MOST:
                return False
            else:
                self._waiting.append(letter)
            return True

    def take(self) -> Letter | None:
        """Remove and return the letter that has waited longest; None when none waits."""
        with self._lock:
            return self._waiting.popleft() if self._waiting else None

    def __len__(self) -> int:
        return len(self._waiting)
