"""Lists of files to choose from: arms and lessons."""

from __future__ import annotations

from collections.abc import Sequence

from armlab.errors import ContentError
from armlab.ui.form import Form, Pressed
from armlab.ui.format import escaped


def pick(form: Form, cell: str, action: Pressed, name: str, aside: str, about: str, here: bool) -> str:
    """Return one entry: its name, a word beside it, a line below; ``here`` marks the one in use."""
    inside = f"<b>{escaped(name)}</b><i>{escaped(aside)}</i><span>{escaped(about)}</span>"
    return form.button(cell, inside, action, "pick", aria_current="true" if here else "")


def broken_files(kind: str, problems: Sequence[ContentError]) -> str:
    """Return what is wrong with files of a kind that cannot be used; nothing without any."""
    if not problems:
        return ""
    head = f"✕ {len(problems)} broken {kind} file{'s' if len(problems) > 1 else ''}"
    texts = "".join(f"<p>{escaped(str(problem))}</p>" for problem in problems)
    return f'<div class="verdict no"><b>{head}</b>{texts}</div>'
