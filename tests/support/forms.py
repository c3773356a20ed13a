"""Fill a form as a person would, without a browser: what its controls ask for, and what they refuse."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from armlab.errors import InputError
from armlab.session.session import Asked
from armlab.session.state import Command
from armlab.ui import markup
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, joined


class BareFields:
    """What a `Form` needs of `Fields`."""

    channel_id = "chan"
    stale = outdated = False

    def __init__(self, on_input: Callable[[str, str], None]) -> None:
        self.send, self.content, self.refused = on_input, Markup(), ""
        self.remarks: list[str] = []

    def field(self, cell: str, value: str, label: str, disabled: bool = False, below: str = "", **more: str) -> Markup:
        return markup.field(self.channel_id, cell, value, label, disabled, **more)

    def area(self, cell: str, value: str, label: str, lines: int) -> Markup:
        return markup.area(self.channel_id, cell, value, label, lines)

    def show(self, *inside: Inside) -> None:
        self.content = joined(inside)

    def refuse(self, cell: str, text: str, why: str) -> None:
        self.refused = why

    def refuse_later(self, cell: str, text: str) -> Callable[[str], bool]:
        return lambda why: self.refuse(cell, text, why) is None

    def remark(self, text: str) -> None:
        self.remarks.append(text)

    def forgive(self) -> None:
        self.refused = ""


class BareForm(Form):
    """A form whose commands are kept in ``posted``."""

    def __init__(self) -> None:
        self.posted: list[Command] = []
        self.fields: Any = None
        super().__init__(self._make, self.posted.append, lambda: None)

    def _make(self, on_input: Callable[[str, str], None]) -> Any:
        self.fields = BareFields(on_input)
        return self.fields

    def press(self, cell: str, text: str = "") -> None:
        """Press a control, or fill it; `InputError` when it refuses."""
        self.fields.send(cell, text)
        if self.fields.refused:
            raise InputError(self.fields.refused)

    @property
    def commands(self) -> tuple[Command, ...]:
        """What has been asked for."""
        found: list[Command] = []
        for command in self.posted:
            found += command.commands if isinstance(command, Asked) else (command,)
        return tuple(found)


def asked(made: Callable[[Form], Inside], cell: str, text: str = "") -> tuple[Command, ...]:
    """Return what a control of a form asks for; nothing when there is none of this name. `InputError` is raised."""
    form = BareForm()
    form.show(made(form))
    form.press(cell, text)
    return form.commands
