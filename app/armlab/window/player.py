"""The player of a clip: one picture after the other by the clock, never more than one on its way."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

from armlab.session.parts.timeline import Advance, Play, Timeline, duration
from armlab.session.session import Session
from armlab.session.state import Command

INTERVAL = 1.0 / 60.0
"""Time between pictures, seconds; if the lab needs longer there are fewer of them, and the clip still ends on time."""

PATIENCE = 3.0
"""Time to wait for a picture, seconds; a clip whose pictures fail is paused."""


class Player:
    """The player of one session's clip.

    Parameters
    ----------
    session : Session
    post : callable
        Hands in a command.
    watched : callable
        Whether the clip is seen; without a viewer it need not play.
    loop : asyncio.AbstractEventLoop, optional
        Whose clock counts; the running one if none is given.
    """

    def __init__(
        self,
        session: Session,
        post: Callable[[Command], None],
        watched: Callable[[], bool],
        loop: asyncio.AbstractEventLoop | None = None,
    ) -> None:
        self._session, self._post, self._watched = session, post, watched
        self._loop = loop or asyncio.get_running_loop()
        self._timer: asyncio.TimerHandle | None = None
        # Playing is counted from here: moment of the clock, time of the clip, speed.
        self._anchor: tuple[float, float, float] = (0.0, 0.0, 0.0)
        # The picture on its way, the one it follows, and when it was sent.
        self._posted: float | None = None
        self._before: float | None = None
        self._sent = 0.0
        # When the next picture is due, and whether it waits for the one before.
        self._due = 0.0
        self._late = False

    def follow(self) -> None:
        """Start or continue to play if the session wants it; call this whenever its state has been shown."""
        timeline = self._session.state[Timeline]
        if not timeline.playing:
            self._stop()
            return
        if timeline.time not in (self._posted, self._before) or timeline.speed != self._anchor[2]:
            # Begun, or moved by a hand: count from here.
            self._anchor = (self._loop.time(), timeline.time, timeline.speed)
            self._posted = self._before = timeline.time
        if self._timer is None:
            self._due = self._loop.time()
            self._wait()
        elif self._late and timeline.time == self._posted and self._watched():
            self._send_next()

    def _wait(self) -> None:
        """Come back when the next picture is due, counted from the last due time, so that delays do not add up."""
        now = self._loop.time()
        self._due += INTERVAL
        if self._due <= now:
            self._due = now + INTERVAL
        self._timer = self._loop.call_later(self._due - now, self._next)

    def _next(self) -> None:
        self._timer = None
        timeline = self._session.state[Timeline]
        if not timeline.playing or not self._watched():
            self._stop()
            return
        now = self._loop.time()
        self._wait()
        if timeline.time == self._posted:
            self._send_next()
            return
        self._late = True  # the last picture is still on its way
        if now - self._sent > PATIENCE:
            self._sent = now
            self._post(Play(False))

    def _send_next(self) -> None:
        timeline, now = self._session.state[Timeline], self._loop.time()
        self._late = False
        began, start, speed = self._anchor
        time, end = start + speed * (now - began), duration(self._session.state)
        if time < end:
            self._send(timeline.time, time)
        elif timeline.loop and end > 0.0:
            self._anchor = (now, 0.0, speed)
            self._send(timeline.time, 0.0)
        else:
            self._send(timeline.time, end, ends=True)

    def _send(self, before: float, time: float, ends: bool = False) -> None:
        self._before, self._posted, self._sent = before, time, self._loop.time()
        self._post(Advance(before, time, ends))

    def _stop(self) -> None:
        self._posted = self._before = None
        self._late = False
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
