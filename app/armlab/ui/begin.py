"""The question before an assignment whose clock begins to run."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from armlab.content.as_written import as_part
from armlab.content.assignment import Assignment, said_date
from armlab.content.lesson_head import time_said
from armlab.session.state import Post
from armlab.teaching.assignment_commands import OpenAssignment
from armlab.ui.html import tag
from armlab.ui.widgets import Gui


def ask_to_begin(gui: Gui, post: Post, found: Assignment, number: int | None = None) -> Callable[[], None]:
    """Ask whether an assignment is to begin now; until then nothing has begun.

    Parameters
    ----------
    gui : Gui
    post : callable
    found : Assignment
    number : int, optional
        The variant of its lessons, as in `OpenAssignment`.

    Returns
    -------
    callable
        Takes the question away, if it is still there.
    """
    says = f"“{as_part(found.title)}” takes {time_said(found.minutes)}. It can be begun only once."
    more = [tag("p", sentence) for sentence in (_CLOCK, *_dates(found), _NOT_YET)]
    # The page keeps the address as long as it asks, so that it asks again when it is loaded anew.
    path = f"/assignment/{found.key}" + ("" if number is None else f"/{number}")
    more.append(tag("i", id="al-asks", hidden=True, data_path=path))
    begin = OpenAssignment(found.key, number)
    return gui.confirm("Begin now?", says, "Begin", lambda: post(begin), more, "Not now")


_CLOCK = (
    "The clock runs from the moment you begin, also while you are away. "
    "When the time is over, your work is closed as it stands, and the page saves the file to give to your teacher."
)
_NOT_YET = "Nothing has begun yet. You can come back to this question later."


def _dates(found: Assignment) -> Iterator[str]:
    """Yield a sentence with the moments between which it is open, and one with that at which it is due."""
    if found.opens is not None and found.closes is not None:
        yield f"It is open from {said_date(found.opens)} to {said_date(found.closes)}; then it ends for everybody."
    elif found.closes is not None:
        yield f"It is open until {said_date(found.closes)}; then it ends for everybody."
    elif found.opens is not None:
        yield f"It has been open since {said_date(found.opens)}."
    if found.due is not None and found.due != found.closes:
        yield f"It is due on {said_date(found.due)}."
