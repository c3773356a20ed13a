"""Texts that stay in the language in which somebody wrote them: a teacher's own lessons, courses and assignments.

The words of the lab that stand in them by chance are not those of the lab.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

T = TypeVar("T", bound="DataclassInstance")

STAYS = ("translate", "no")
"""Attribute of an element whose texts stay, and its value: that of HTML."""

FIRST, LAST = "\N{FIRST STRONG ISOLATE}", "\N{POP DIRECTIONAL ISOLATE}"
"""Signs, which nobody sees, around a text that stays within another one."""


class AsWritten(str):
    """A text that is not translated where it is shown as it stands; see `armlab.ui.html`."""

    __slots__ = ()


def as_written(found: T, *names: str) -> T:
    """Return a dataclass in which some texts, or tuples of texts, are not translated."""
    return replace(found, **{name: _kept(getattr(found, name)) for name in names})


def as_part(text: str) -> str:
    """Return a text to stand within a sentence of the lab, where no element can tell that it stays."""
    return f"{FIRST}{text}{LAST}" if isinstance(text, AsWritten) else text


def is_part(text: str) -> bool:
    """Return whether a part of a sentence is a text that stays."""
    return text.startswith(FIRST) and text.endswith(LAST)


def _kept(value: Any) -> Any:
    return tuple(map(AsWritten, value)) if isinstance(value, tuple) else AsWritten(value)
