"""The formulas of the course as a page to print on two sheets A4."""

from __future__ import annotations

import re

from armlab.content.formulas import FILE, Formula, Sheet
from armlab.content.markdown import formula as mathml
from armlab.content.markdown import to_html
from armlab.ui.html import Markup, tag
from armlab.ui.paper import document, text

LOOK = """
body { max-width: 78em; font-size: 10pt; line-height: 1.3; }
header { border: 0; padding: 0; }
header p { color: var(--dim); font-size: .92em; }
main { columns: 2 26em; column-gap: 2em; column-rule: 1px solid var(--line); }
h2 { font-size: 1em; color: var(--mark); border-bottom: 1px solid var(--rule); margin: .7em 0 .15em; }
h2 { break-after: avoid; }
main > h2:first-child { margin-top: .2em; }
main > p { margin: 0; padding: .16em 0; break-inside: avoid; }
main > p > i { color: var(--dim); margin-right: .6em; }
main > p > span.f { display: inline-block; margin-right: .9em; }
main > p > small { font-size: 1em; }
span.f math { math-style: normal; }
math mo:has(+ mtable.matrix), math mtable.matrix + mo { display: none; }
math mtable.matrix {
  margin: 1px 3px; padding: 0 3px; print-color-adjust: exact; -webkit-print-color-adjust: exact;
  background: linear-gradient(currentColor 0 0) left / .8px 100%, linear-gradient(currentColor 0 0) right / .8px 100%,
    linear-gradient(currentColor 0 0) left top / 3px .8px, linear-gradient(currentColor 0 0) left bottom / 3px .8px,
    linear-gradient(currentColor 0 0) right top / 3px .8px, linear-gradient(currentColor 0 0) right bottom / 3px .8px;
  background-repeat: no-repeat;
}
math mtable.matrix mtd { padding: .05em .22em; }
@page { size: A4 portrait; margin: 8mm; }
@media print {
  body { font-size: 7.6pt; line-height: 1.2; }
  main { columns: 2; column-gap: 5mm; column-fill: auto; }
  main + main { break-before: page; }
  h2 { color: inherit; }
}
"""
"""Rules of style besides those of all pages on paper."""

_PRIMES = re.compile(r"\^\{(?:\\prime)+\}")
_FUNCTION = re.compile(r"(\\(?:sin|cos|tan|sinh|cosh|arctan)\b)\s*(?=(.?))")
"""A function, and the sign behind it: before a bracket or an exponent it needs no room."""

HINT = "Ctrl+P prints this on two sheets A4. “armlab formulas” writes it in LaTeX."


def formulas_page(sheet: Sheet, key: str = "") -> str | None:
    """Return the formulas as a document; None with a key, since there is one sheet alone."""
    if key:
        return None
    head = tag("header", tag("p.small.hint", HINT), tag("p", tag("b", "Formulas. "), _text(sheet.about)))
    pages = [
        tag("main", [(tag("h2", title), [_formula(each) for each in formulas]) for title, formulas in page.items()])
        for page in sheet.pages
    ]
    return document("Formulas", LOOK, head, pages)


def _formula(formula: Formula) -> Markup:
    shown = [tag("span.f", text(mathml(spaced(tex)))) for tex in formula.tex]
    note = tag("small", _text(formula.note)) if formula.note else None
    return tag("p", tag("i", _text(formula.name)), shown, note)


def spaced(tex: str) -> str:
    r"""Return a formula as MathML needs it: with room around functions, and with primes that are raised already.

    >>> print(spaced(r"2\sin a\cos(b)"), spaced(r"p^{\prime\prime}"))
    2\,\sin\,a\,\cos(b) p″
    """
    tex = _PRIMES.sub(lambda found: "′″‴"[found[0].count("prime") - 1], tex)
    return _FUNCTION.sub(lambda found: rf"\,{found[1]}" + ("" if found[2] in "(^" else r"\,"), tex)


def _text(given: str) -> Markup:
    parts = given.split("$")
    return text(to_html("$".join(spaced(part) if i % 2 else part for i, part in enumerate(parts)), FILE))
