"""Remarks on what a person typed: made where the text is read, and shown at the field by the form that sent it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_heard: ContextVar[list[str] | None] = ContextVar("remarks", default=None)


def remark(text: str) -> None:
    """Make a remark on the text that is being read; nobody hears it where no form has sent the text."""
    heard = _heard.get()
    if heard is not None:
        heard.append(text)


@contextmanager
def remarks() -> Iterator[list[str]]:
    """Collect the remarks that are made in the block."""
    heard: list[str] = []
    before = _heard.set(heard)
    try:
        yield heard
    finally:
        _heard.reset(before)
