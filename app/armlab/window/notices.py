"""Notices of a page: what could not be done, and what has changed without a hand on this page."""

from __future__ import annotations

from typing import Literal

import viser

from armlab.content.as_written import as_part
from armlab.content.lesson import Lesson
from armlab.session.parts.robot import RobotPart
from armlab.session.session import Session


class Notices:
    """The notices of one browser.

    Parameters
    ----------
    client : viser.ClientHandle
    session : Session
    """

    def __init__(self, client: viser.ClientHandle, session: Session) -> None:
        self._client, self._session = client, session
        self._told = session.notice_seen

    def not_done(self) -> None:
        """Tell the newest refusal of the session that has no place of its own, or what of its files is lost, once."""
        newest = self._session.notice
        for notice in () if newest is None else (newest.before, newest):
            if notice is None or notice.number <= self._told:
                continue
            self._told = self._session.notice_seen = notice.number
            if notice.heading:
                self._say(notice.heading, notice.text, "orange", None)
            else:
                self._say("Not done", notice.text, "orange")

    def replaced(self, now: RobotPart, before: RobotPart) -> None:
        """Tell that an example has put its own arm on the table."""
        if now.replaced and now is not before:
            text = f"This example uses the {now.robot.name}. Undo (Ctrl+Z) brings back the {now.replaced}."
            self._say("Another arm", text, "blue")

    def elsewhere(self, lesson: Lesson | None) -> None:
        """Tell that another page of this browser has opened a lesson, or closed it."""
        now = "has closed the lesson" if lesson is None else f"has opened the lesson “{as_part(lesson.title)}”"
        self._say("Another tab", f"Another tab of this browser {now}. All of them show the same work.", "blue", 12.0)

    def not_drawn(self) -> None:
        """Tell that there is no picture of the present arm."""
        self._say("Not drawn", "This arm cannot be drawn; the numbers are right.", "red", None)

    def _say(self, title: str, text: str, color: Literal["blue", "orange", "red"], seconds: float | None = 8.0) -> None:
        self._client.add_notification(title, text, color=color, auto_close_seconds=seconds)
