"""The texts of a lesson: Markdown is converted to HTML, with live values and pictures."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from armlab.content.lesson_lines import LessonError
from armlab.content.live import all_live_values
from armlab.content.markdown import Extras, TextError, html_of, text_html
from armlab.errors import ContentError
from armlab.kin.arm import MAX_JOINTS, Arm

if TYPE_CHECKING:
    from markdown_it.token import Token


@dataclass(frozen=True)
class Prose:
    """Converter of the texts of a lesson, or of one of its steps, to HTML.

    Attributes
    ----------
    file : str
    extras : Extras
        Collects the names of live values.
    """

    file: str
    extras: Extras

    @classmethod
    def of(cls, file: str, arm: Arm, pictures: Mapping[str, str] | None, own: bool = False) -> Prose:
        """Return the converter for a lesson about an arm; what is said in an ``own`` one is not translated."""
        missing = {name: value.missing(arm) for name, value in all_live_values(MAX_JOINTS).items()}
        return cls(file, Extras(missing, pictures, stays=own))

    def anew(self) -> Prose:
        """Return a copy in which no live value has been used yet."""
        return Prose(self.file, Extras(self.extras.live, self.extras.pictures, stays=self.extras.stays))

    @property
    def used(self) -> tuple[str, ...]:
        """The live values used so far, sorted."""
        return tuple(sorted(self.extras.used))

    def html(self, tokens: Sequence[Token], where: str, before: int) -> str:
        """Return the HTML of blocks of the file; ``before`` is the number of lines before the text they are of.

        Raises
        ------
        LessonError
        """
        return self._located(lambda: html_of(tokens, self.extras), where, before)

    def block(self, token: Token, where: str, before: int) -> str:
        """Return the HTML of the Markdown inside a fenced block; see `html`."""
        inside = before + (token.map[0] if token.map else 0) + 1
        return self._located(lambda: text_html(token.content, self.extras), where, inside)

    def _located(self, make: Callable[[], str], where: str, before: int) -> str:
        try:
            return make()
        except TextError as error:
            raise LessonError(self.file, where, str(error), before + error.line + 1) from None

    def of_table(self, text: str, key: str) -> str:
        """Return the HTML of a text in a table.

        Raises
        ------
        ContentError
            With its key; its line is not known here.
        """
        try:
            return text_html(text, self.extras)
        except TextError as error:
            raise ContentError(self.file, key, str(error)) from None
