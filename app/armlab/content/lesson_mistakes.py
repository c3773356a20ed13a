"""The mistakes that a lesson names, read from its file without the rest, which would take seconds for a course."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

from armlab.content.as_written import AsWritten
from armlab.content.lesson_head import filled_front, split
from armlab.content.lesson_lines import located
from armlab.content.lesson_steps import sections_of
from armlab.content.lesson_values import filled
from armlab.content.markdown import to_html, tokens_of
from armlab.content.reader import Table
from armlab.content.variants import Value
from armlab.errors import ContentError, InputError

if TYPE_CHECKING:
    from markdown_it.token import Token

JUDGED = ("check", "question")
"""Blocks of a step that name mistakes."""

_LIVE = re.compile(r"\{\{[^{}=\n][^{}\n]*\}\}")
"""Pattern of a live value, which a text on paper does not have."""


class Mistakes(NamedTuple):
    """The mistakes that a step names.

    Attributes
    ----------
    step : str
        Title of the step.
    says : tuple of str
        What is said to those who make them, as HTML, in the order of the file, without repetitions.
    """

    step: str
    says: tuple[str, ...]


class Named(NamedTuple):
    """Summary of a lesson for its teacher: whether its variants differ, and the steps that name mistakes."""

    varies: bool = False
    steps: tuple[Mistakes, ...] = ()


def mistakes_of(key: str, text: str, file: str, own: bool = False) -> Named:
    """Return the mistakes that a lesson names in its variant 0, step by step; steps that name none are left out.

    Parameters
    ----------
    key, text, file : str
        Key of the lesson, and the text and the name of its file.
    own : bool
        Whether it is a teacher's own, whose words are not translated.

    Raises
    ------
    ContentError
        The file is no lesson, or one of these texts cannot be converted.
    """
    toml, markdown, _ = split(file, text)
    with located(file, "", toml, 1):
        _, values, varies = filled_front(key, file, toml, 0)
    found = []
    for number, (heading, title, *blocks) in enumerate(sections_of(tokens_of(markdown))[1:], start=1):
        del heading
        says = tuple(dict.fromkeys(_said(blocks, values, file, f"step {number}", own)))
        if says:
            step = _title(title.content, values, file, f"step {number}")
            found.append(Mistakes(AsWritten(step) if own else step, says))
    return Named(varies, tuple(found))


def _title(text: str, values: Mapping[str, Value], file: str, step: str) -> str:
    try:
        return filled(text, values)
    except InputError as error:
        raise ContentError(file, f"{step}.title", str(error)) from None


def _said(blocks: list[Token], values: Mapping[str, Value], file: str, step: str, own: bool) -> Iterator[str]:
    for token in blocks:
        name = token.info.strip() if token.type == "fence" else ""
        if name not in JUDGED:
            continue
        for wrong in Table.parse(file, token.content).tables("wrong"):
            where = f"{step}.{name}.{wrong.where}.says"
            try:
                said = filled(wrong.text("says"), values)
            except InputError as error:
                raise wrong.fail("says", str(error)) from None
            yield to_html(_LIVE.sub("…", said), file, where, own).strip()
