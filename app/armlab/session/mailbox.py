"""The commands a student has posted and that are not applied yet."""

from __future__ import annotations

import threading
from collections import deque

from armlab.session.state import Command

MOST = 500
"""Commands that may wait. A hand leaves a few; only a flood of dear ones is faster than the lab for so long."""


class Mailbox:
    """A queue in which a snapshot replaces a waiting one of its channel, if nothing else came in between.

    So events keep their order with respect to everything, a drag before its end, and a student who moves the hand
    faster than the lab can solve never waits for poses already left.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: deque[Command] = deque()

    def post(self, command: Command) -> bool:
        """Add a command; return False where so many wait already that it is not taken."""
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
        """Return the command that has waited longest, and forget it; None when none waits."""
        with self._lock:
            return self._waiting.popleft() if self._waiting else None

    def __len__(self) -> int:
        return len(self._waiting)
