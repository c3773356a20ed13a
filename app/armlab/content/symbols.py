"""Typographic characters, replaced by those of a keyboard."""

from __future__ import annotations

import re
import unicodedata

MINUS_SIGNS = "−–—‒﹣－‐‑"
"""Minus signs as people paste them."""

_SYMBOLS = str.maketrans(
    {
        **dict.fromkeys(MINUS_SIGNS, "-"),
        **dict.fromkeys("·×⋅∙∗", "*"),
        **dict.fromkeys("º˚∘", "°"),
        **dict.fromkeys("\u00a0\u2007\u2009\u202f\u200a", " "),
        **dict.fromkeys("\u200b\ufeff\u2061\u2062", ""),
        "√": "sqrt",
        "⁄": "/",
        "∕": "/",
    }
)

# These characters would merge with a digit before them when they are folded: 1½ to 11/2, 3² to 32.
# A number begins where no digit stands before it: to look from each digit on would take the square of their count.
_MIXED = re.compile(r"(?:(?<!\d)(\d+(?:\.\d*)?)\s*)?([¼½¾⅐-⅞↉])")
_POWER = re.compile("(?<![ⁱʲᵏⁿᵐ⁰¹²³⁴-⁻])([⁺⁻]?[⁰¹²³⁴-⁹]+)")
_ROOT = re.compile(r"√\s*(\d+(?:\.\d*)?|\.\d+|π)")
_RUN_TOGETHER = re.compile(r"(?<=\d)(?=[₀-₉⅟])")


def plain_symbols(text: str) -> str:
    """Return text with the signs of print and of screens replaced by those of a keyboard; ``°`` stays.

    Superscripts become powers, but a zero alone, which is a degree sign to those who type it.

    >>> plain_symbols("−½·π, aⱼ₋₁"), plain_symbols("1½, 10⁻³, √2")
    ('-(1/2)*pi, aj-1', '(1+1/2), 10^(-3), sqrt(2)')
    """
    text = _POWER.sub(lambda power: "°" if power[1] == "⁰" else f"^({power[1]})", text)
    text = _ROOT.sub(r"√(\1)", _MIXED.sub(_mixed, _RUN_TOGETHER.sub(" ", text)))
    folded = unicodedata.normalize("NFKC", text.translate(_SYMBOLS)).translate(_SYMBOLS)
    return re.sub("[πΠϖ]", "pi", folded)


def _mixed(found: re.Match[str]) -> str:
    """Return a vulgar fraction in brackets, with the whole number before it, which must not be a decimal number."""
    whole, fraction = found.groups()
    if whole and "." in whole:
        return f"{whole} {unicodedata.numeric(fraction)}"
    return f"({whole}+{fraction})" if whole else f"({fraction})"
