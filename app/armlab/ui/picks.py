"""Lists of files to choose from, for arms and lessons."""

from __future__ import annotations

from collections.abc import Sequence

from armlab.content.lessons import hurry, lessons_read
from armlab.errors import ContentError
from armlab.ui.form import Form, Pressed
from armlab.ui.format import so_many
from armlab.ui.html import Markup, tag
from armlab.ui.markup import verdict_box

READING = "The lessons are being read …"


def lessons_to_come() -> str:
    """Return what a page of lessons says until all have been read, which takes seconds, and have them read faster."""
    if lessons_read() is not None:
        return ""
    hurry()
    return READING


def pick(form: Form, cell: str, action: Pressed, name: str, aside: str, about: str, here: bool) -> Markup:
    """Return one entry: its name, a word beside it, a line below; ``here`` marks the present one."""
    inside = (tag("b", name), tag("i", aside), tag("span", about))
    return form.button(cell, inside, action, "pick", aria_current="true" if here else "")


def broken_files(kind: str, problems: Sequence[ContentError]) -> Markup | None:
    """Return the mistakes in files of a kind, or nothing if there are none."""
    if not problems:
        return None
    head = f"{so_many(len(problems), 'mistake')} in {kind} files"
    return verdict_box("no", head, [tag("p", str(problem)) for problem in problems])
