"""Printed formulas as elements that a narrow panel can break, and the symbols they use."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from armlab.kin.arm import Arm
from armlab.kin.graph.printing import latex_number
from armlab.kin.symbolic import QUARTER, angle_offsets
from armlab.ui.format import MINUS, mathml, subscript
from armlab.ui.html import Markup, joined, tag
from armlab.ui.units import Units

LONGEST = 300
"""Largest number of characters of LaTeX of a formula that is shown whole: about 8 lines of the panel."""

DIGITS = 5
"""Number of significant digits in formulas on screen and in LaTeX; Python keeps all of them."""

OFFSET_DIGITS = 3
"""Number of digits by which offsets of angles exceed moving angles, because students compute with them."""

MOST_TERMS = 100
"""Largest number of terms of a formula that is printed; seven joints of a real arm have a quarter of it."""

_VARIABLE = re.compile(r"q_(?:(\d)|\{(\d+)\})")
_POWER = r"\\cdot 10\^\{-?\d+\}"
_NUMBER = re.compile(rf"\d+(?:\.\d+)?{_POWER}|\d+\.\d+")
_CONSTANT = re.compile(rf"-?[\d.]+(?:{_POWER})?")
_SHORT = re.compile(r"\b([cs])_(?:(\d)|\{(\d+)\})")


@dataclass(frozen=True)
class Written:
    """A formula in the form in which it is shown.

    Attributes
    ----------
    latex : str
        The whole formula.
    markup : Markup
        The formula, or its beginning.
    left_out : int
        How many terms the markup lacks.
    """

    latex: str
    markup: Markup
    left_out: int

    @property
    def constant(self) -> bool:
        """Whether the formula is a mere number."""
        return _CONSTANT.fullmatch(self.latex) is not None


def written(arm: Arm, units: Units, latex: str) -> Written:
    """Return a printed formula in the names of the student."""
    shown = _NUMBER.sub(_rounded, latex)
    theta = units.latex("theta")
    shown = shown.replace(r"\theta_", f"{theta}_")
    if units.notation.variable != "q":
        shown = _VARIABLE.sub(lambda found: _variable(arm, int(found[1] or found[2]), theta), shown)
    terms = _terms(shown)
    kept, length = 0, 0
    for _, term in terms:
        length += len(term) + 3
        if length > LONGEST and kept:
            break
        kept += 1
    return Written(shown, _markup(terms[:kept]), len(terms) - kept)


def _rounded(number: re.Match[str]) -> str:
    return latex_number(float(number[0].replace(r"\cdot 10^{", "e").rstrip("}")), DIGITS)


def _variable(arm: Arm, joint: int, theta: str) -> str:
    """Return the LaTeX of a joint variable as in the table, or q if the table gives it an offset."""
    row = arm.rows[joint - 1]
    if (row.theta if row.revolute else row.d) != 0.0:
        return f"q_{{{joint}}}"
    return f"{theta}_{{{joint}}}" if row.revolute else f"d_{{{joint}}}"


def _terms(latex: str) -> list[tuple[str, str]]:
    """Return the parts between plus and minus signs, also inside parentheses, each with the sign before it.

    Each becomes a formula of its own, so that lines can break there. Parts in braces or under a function stay whole.
    """
    terms: list[tuple[str, str]] = []
    sign, start, whole = "", 0, 0
    depths: list[bool] = []
    for at, letter in enumerate(latex):
        if letter in "{(":
            function = letter == "{" or latex.endswith((r"\sin", r"\cos"), 0, at)
            depths.append(function)
            whole += function
        elif letter in "})":
            whole -= depths.pop()
        elif letter in "+-" and whole == 0 and latex[at - 1 : at] == " " and latex[at + 1 : at + 2] == " ":
            terms.append((sign, latex[start : at - 1]))
            sign, start = letter, at + 2
    return [*terms, (sign, latex[start:])]


def _markup(terms: Iterable[tuple[str, str]]) -> Markup:
    signs = {"": "", "+": "+\u00a0", "-": f"{MINUS}\u00a0"}
    return joined((tag("span.term", signs[sign], mathml(term)) for sign, term in terms), between=" ")


def short_forms(arm: Arm, units: Units, formulas: Iterable[str]) -> list[str]:
    """Return the meaning of c and s with indices, by examples that occur: one with one index, one with more.

    Angles have different letters where joints have offsets; there is an example for each letter.
    """
    letters = _letters(arm, units)
    found: dict[tuple[bool, str], str] = {}
    for formula in formulas:
        for letter, one, more in _SHORT.findall(formula):
            used = "".join(sorted({letters[int(digit)] for digit in one or more}))
            found.setdefault((bool(more), used), f"{letter}{one or more}")
    texts = []
    for (several, _), name in sorted(found.items()):
        function = {"c": "cos", "s": "sin"}[name[0]]
        angles = " + ".join(subscript(letters[int(digit)], int(digit)) for digit in name[1:])
        texts.append(f"{subscript(name[0], int(name[1:]))} = {function}{f'({angles})' if several else f' {angles}'}")
    return texts


def _letters(arm: Arm, units: Units) -> dict[int, str]:
    """Return the letter of each revolute joint's angle in the formulas, by joint (1-based).

    With an offset it is theta of the table, unless the offset is a quarter turn, which is worked into the formulas.
    """
    theta, offsets = units.book.symbols["theta"], angle_offsets(arm)
    free = "q" if units.notation.variable == "q" else theta
    return {
        joint: theta if joint in offsets else "q" if row.theta != 0.0 else free
        for joint, row in enumerate(arm.rows, start=1)
        if row.revolute
    }


def offset_lines(arm: Arm, units: Units) -> list[str]:
    """Return theta of the table as a function of the joint variable, for each revolute joint with an offset."""
    theta = units.book.symbols["theta"]
    return [
        f"{subscript(theta, joint)} = {subscript('q', joint)} {MINUS if row.theta < 0.0 else '+'} "
        f"{units.constant(abs(row.theta), True, OFFSET_DIGITS)}"
        for joint, row in enumerate(arm.rows, start=1)
        if row.revolute and abs(row.theta) > QUARTER
    ]


def used_constants(formulas: Iterable[str]) -> list[str]:
    """Return the names of the lengths and twists that occur in formulas of the text style, in order."""
    names = {name for formula in formulas for name in re.findall(r"\b(?:a|d|alpha)\d+\b", formula)}
    return sorted(names, key=lambda name: (name.rstrip("0123456789"), int(re.sub(r"\D", "", name))))
