"""Whether the translations of a lesson say all that it says, and nothing that it says no more."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any

from armlab import resources
from armlab.content.languages import keys
from armlab.content.lesson import Lesson
from armlab.content.po import Message, read_po
from armlab.content.words import Words
from armlab.errors import ContentError
from armlab.ui.speech import Speech

TOLD = frozenset({"title", "can", "html", "hints", "intro_html", "reveal_html", "text", "options", "says", "labels"})
"""Fields of lessons, steps, questions and checks that hold texts."""


def of_translations(lesson: Lesson) -> Iterator[str]:
    """Yield a line for each translation that is broken, or lags behind the lesson."""
    for language in keys()[1:]:
        place = resources.folder("lessons").joinpath(language, f"{lesson.key}.po")
        if place.is_file():
            yield from compared(lesson, f"{language}/{lesson.key}.po", place.read_text(encoding="utf-8"))


def compared(lesson: Lesson, file: str, text: str) -> Iterator[str]:
    """Yield a line for each text of a lesson that its translation does not have, and for each that it has too many."""
    try:
        messages = read_po(file, text)[1]
    except ContentError as error:
        yield str(error)
        return
    missing, used = heard(lesson, messages)
    for source in missing:
        yield f"{file}: no translation of {source[:60]!r}"
    for message in messages:
        if message.source not in used:
            yield f"{file}:{message.line}: the lesson does not say {message.source[:60]!r} any more"


def heard(lesson: Lesson, messages: list[Message]) -> tuple[list[str], set[str]]:
    """Return the texts of a lesson that are no messages, and the sources of those that are."""
    missing: dict[str, None] = {}
    used: set[str] = set()
    speech = Speech(Words(messages, lambda text: missing.setdefault(text), used.add))
    for text in told(lesson):
        speech.markup(text) if "<" in text else speech.text(text)
    return list(missing), used


def told(thing: Any, name: str = "") -> Iterator[str]:
    """Yield all texts of a lesson, in their order; those with elements are markup."""
    if isinstance(thing, str):
        if name in TOLD:
            yield thing
    elif isinstance(thing, Mapping):
        for each in thing.values():
            yield from told(each, name)
    elif isinstance(thing, tuple | list):
        for each in thing:
            yield from told(each, name)
    elif dataclasses.is_dataclass(thing) and type(thing).__module__.startswith("armlab.content"):
        for field in dataclasses.fields(thing):
            if field.name not in ("robot_used", "start", "begin", "solution"):
                yield from told(getattr(thing, field.name), field.name)
