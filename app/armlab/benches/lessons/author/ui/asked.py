"""Questions for a number, put together with fields; each makes a step of the lesson that is saved."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

from armlab.benches.lessons.author.write_lesson import NumberAsked
from armlab.content.quantities import UNITS
from armlab.errors import InputError
from armlab.ui.form import Form, Typed
from armlab.ui.html import Markup, tag
from armlab.ui.markup import fold, row
from armlab.ui.units import plain_number

MOST = 8
"""Largest number of questions of a lesson that is saved from the page."""

LONGEST = 300
"""Longest text of a question, in characters."""

ABOUT = "Each question becomes a step behind the pose. Write formulas between $ signs, as in $p_x$."

PURE = "number"
"""The choice of no unit."""

_SAID = {"answer": "answer", "tolerance": "largest difference"}
"""Names of the numbers in refusals."""


@dataclass(frozen=True)
class _Draft:
    text: str = ""
    answer: str = ""
    tolerance: str = ""
    unit: str = ""


class Questions:
    """The questions that the lesson will have, and the one that is being written.

    Attributes
    ----------
    asked : tuple of NumberAsked
    """

    def __init__(self) -> None:
        self.asked: tuple[NumberAsked, ...] = ()
        self._draft = _Draft()

    def shown(self, form: Form) -> Markup:
        """Return the questions with their fields, folded until somebody asks for them."""
        draft = self._draft
        units = {unit or PURE: unit or "no unit" for unit in UNITS}
        text = row("Question", form.area("ask-text", draft.text, "What is asked", 2, self._typed("text")))
        fields = (
            row("Answer", (self._number(form, "answer"), self._unit(form, units)), cells=True),
            row("± at most", self._number(form, "tolerance"), hint="The largest difference that still counts as right"),
        )
        add = form.chip("ask-add", "Add the question", self._add)
        there = [self._one(form, k, each) for k, each in enumerate(self.asked)]
        count = f" ({len(self.asked)})" if self.asked else ""
        return fold(
            f"Ask for numbers, too{count}", tag("p", ABOUT), there, text, fields, tag("div.bar", add), key="ask"
        )

    def _number(self, form: Form, name: str) -> Markup:
        label = {"answer": "Right answer", "tolerance": "Largest difference"}[name]
        return form.field(f"ask-{name}", getattr(self._draft, name), label, self._typed(name))

    def _unit(self, form: Form, units: dict[str, str]) -> Markup:
        def chosen(key: str) -> None:
            self._draft = replace(self._draft, unit="" if key == PURE else key)

        return form.select("ask-unit", "Unit", units, self._draft.unit or PURE, chosen)

    def _typed(self, name: str) -> Typed:
        def typed(text: str) -> None:
            # Kept even where it is refused: what is added is what the fields show.
            self._draft = replace(self._draft, **{name: " ".join(text.split())[:LONGEST]})
            if name in _SAID and text.strip():
                self._number_in(name)

        return typed

    def _number_in(self, name: str) -> float:
        return plain_number(getattr(self._draft, name), _SAID[name], "a number")

    def _add(self) -> None:
        draft = self._draft
        if not draft.text:
            raise InputError("question: expected a text that says what is asked")
        if len(self.asked) >= MOST:
            raise InputError(f"expected at most {MOST} questions; write more in the file")
        answer, tolerance = self._number_in("answer"), self._number_in("tolerance")
        if tolerance <= 0.0:
            raise InputError(f"largest difference: expected a positive number, got {draft.tolerance}")
        self.asked = (*self.asked, NumberAsked(draft.text, answer, draft.unit, tolerance))
        self._draft = _Draft(unit=draft.unit)

    def _one(self, form: Form, place: int, asked: NumberAsked) -> Markup:
        says = f"{asked.answer:g} ± {asked.tolerance:g} {asked.unit}".rstrip()
        away = f"Remove question {place + 1}"
        remove = form.button(f"ask-remove {place}", "✕", partial(self._remove, place), "chip", away, away)
        return tag("div.al-own", tag("div", tag("b", asked.text), tag("span", says)), remove)

    def _remove(self, place: int) -> None:
        self.asked = self.asked[:place] + self.asked[place + 1 :]
