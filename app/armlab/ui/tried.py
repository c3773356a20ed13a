"""What a person types or presses in fields: tried, and where it is refused, said beside what was typed."""

from __future__ import annotations

from collections.abc import Callable

from armlab.errors import InputError
from armlab.session.state import Command, Post, State
from armlab.ui.fields import Fields


def tried(
    fields: Fields, cell: str, text: str, commands: Callable[[], tuple[Command, ...]], state: State, post: Post
) -> bool:
    """Hand in the commands that follow from a field; return whether they may be.

    They are tried on the state on screen first, because a notice would stand far from the field. What is refused stays
    as it was typed, with the reason below, and nothing is handed in.
    """
    try:
        asked = commands()
        for command in asked:
            command.apply(state)
    except InputError as refusal:
        fields.refuse(cell, text, str(refusal))
        return False
    for command in asked:
        post(command)
    return True


def plain_number(text: str) -> float:
    """Return a typed number without a unit; `InputError` when it is none."""
    plain = text.strip().replace("−", "-").replace(",", ".")
    try:
        return float(plain)
    except ValueError:
        raise InputError(f"expected a number, got {text.strip()[:40]!r}") from None
