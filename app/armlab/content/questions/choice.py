"""Questions with options, one or several of which are right."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from armlab.content.question import (
    NOT_YET,
    RIGHT,
    Asked,
    Choices,
    QuestionType,
    ToHtml,
    Verdict,
    Wrong,
    says,
    unreadable,
)
from armlab.content.reader import Table, shown

FEWEST, MOST = 2, 12
"""Least and largest number of options."""


@dataclass(frozen=True)
class WrongChoice:
    """A wrong choice that a lesson expects, and the lesson's text on it (HTML).

    ``exact`` is the whole choice, options from 1; ``option`` is one that is chosen and should not be, or the reverse.
    """

    says: str
    exact: frozenset[int] = frozenset()
    option: int = 0


@dataclass(frozen=True)
class ChoiceQuestion:
    """A question with options; ``answer`` holds the right ones, from 1, and ``options`` are HTML."""

    html: str
    options: tuple[str, ...]
    answer: frozenset[int]
    several: bool
    mistakes: tuple[WrongChoice, ...] = ()
    hide: tuple[str, ...] = ()
    fixed: bool = False

    @property
    def form(self) -> Choices:
        """The options."""
        return Choices(self.options, self.several, self.fixed)

    @property
    def right_answer(self) -> str:
        """The right options, such as ``1,3``."""
        return _typed(self.answer)

    @property
    def wrong(self) -> tuple[Wrong, ...]:
        """The wrong choices that the lesson names."""
        return tuple(Wrong(_typed(wrong.exact or self.answer ^ {wrong.option}), wrong.says) for wrong in self.mistakes)

    def judge(self, text: str) -> Verdict:
        """Return the verdict on numbers of options, from 1, such as ``2`` or ``1,3``."""
        words = re.split(r"[\s,;]+", text.strip().strip(",;"))
        numbers = [int(word) if re.fullmatch(r"\d{1,2}", word, re.ASCII) else 0 for word in words]
        if not all(1 <= number <= len(self.options) for number in numbers):
            return unreadable(f"Choose from the options 1 to {len(self.options)}.")
        chosen = frozenset(numbers)
        if not self.several and len(chosen) > 1:
            return unreadable("Choose one option only.")
        if chosen == self.answer:
            return RIGHT
        for i, wrong in sorted(enumerate(self.mistakes, start=1), key=lambda item: not item[1].exact):
            if wrong.exact == chosen or wrong.option in chosen ^ self.answer:
                return Verdict(False, wrong.says, f"wrong[{i}]")
        return self._mistake(chosen) if self.several else Verdict(False, NOT_YET)

    def _mistake(self, chosen: frozenset[int]) -> Verdict:
        if chosen < self.answer:
            return Verdict(False, "All you chose is right, but something is missing.", "missing")
        if chosen > self.answer:
            return Verdict(False, "All that is right is chosen, and something more that is not.", "too many")
        return Verdict(False, "Something chosen is not right, and something right is missing.", "other")


def _typed(options: Iterable[int]) -> str:
    return ",".join(map(str, sorted(options)))


def read(table: Table, asked: Asked, to_html: ToHtml) -> ChoiceQuestion:
    """Read ``options``, ``answer`` (from 1, or a list if several may be chosen), ``fixed`` and ``wrong``."""
    written = table.value("options")
    if not isinstance(written, list) or not all(isinstance(option, str) and option.strip() for option in written):
        raise table.fail("options", f"expected a list of texts, got {shown(written)}")
    if not FEWEST <= len(written) <= MOST or len(set(written)) < len(written):
        raise table.fail("options", f"expected {FEWEST} to {MOST} different options, got {len(written)}")
    options = tuple(to_html(option, f"{table.where}.options[{i}]") for i, option in enumerate(written, start=1))
    several = isinstance(table.value("answer"), list)
    fixed = table.boolean("fixed", False)
    answer = _options(table, len(options))
    wrong = []
    for entry in table.tables("wrong"):
        whole = not several or isinstance(entry.value("answer"), list)
        given, said = _options(entry, len(options)), says(entry, to_html)
        if given == answer:
            raise entry.fail("answer", f"{_typed(given)} is the right answer" + ("" if whole else "; give a list"))
        if not several and len(given) > 1:
            raise entry.fail("answer", f"expected one option, got {_typed(given)}")
        wrong.append(WrongChoice(said, exact=given) if whole else WrongChoice(said, option=min(given)))
        entry.done()
    return ChoiceQuestion(asked.html, options, answer, several, tuple(wrong), asked.hide, fixed)


def _options(table: Table, count: int) -> frozenset[int]:
    """Take ``answer``: an option, or a list of them."""
    given = table.value("answer")
    numbers = given if isinstance(given, list) else [given]
    # What follows from values of the variant is 2.0.
    if not numbers or not all(type(each) in (int, float) and each in range(1, count + 1) for each in numbers):
        raise table.fail("answer", f"expected options from 1 to {count}, got {shown(given)}")
    return frozenset(map(int, numbers))


QUESTION = QuestionType("choice", 20, read)
