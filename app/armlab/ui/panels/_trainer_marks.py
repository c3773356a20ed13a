"""Marks and buttons of the trainer."""

from __future__ import annotations

from armlab.ui.format import escaped


def mark(ok: bool, text: str) -> str:
    """Return ✓ or ✕ with its sentence as a hint."""
    return f'<i class="{"ok" if ok else "no"}" title="{escaped(text)}">{"✓" if ok else "✕"}</i>'


def button(channel: str, cell: str, inside: str, hint: str, kind: str, pressed: bool | None = None) -> str:
    """Return a button; ``inside`` is the caller's markup."""
    state = "" if pressed is None else f' aria-pressed="{str(pressed).lower()}"'
    return (
        f'<button class="{kind}" data-chan="{channel}" data-cell="{cell}" title="{escaped(hint)}"{state}>'
        f"{inside}</button>"
    )
