"""Symbols whose indices are typed after an underscore."""

from __future__ import annotations

import re
import unicodedata

from armlab.ui.html import Markup, joined, tag

_INDEX = re.compile(r"_([^\s/]+?)(?=, | = |/|$)")


def with_indices(text: str) -> Markup:
    """Return a symbol with the text after an underscore as its index.

    >>> print(with_indices("Δt_k−1,k"), with_indices("t_a, t_b = 1"), with_indices("T_s/T"))
    Δt<sub>k−1,k</sub> t<sub>a</sub>, t<sub>b</sub> = 1 T<sub>s</sub>/T
    """
    parts = _INDEX.split(text)  # texts, and the indices between them
    return joined(tag("sub", part) if i % 2 else part for i, part in enumerate(parts))


def named(text: str) -> Markup:
    """Return the symbol before a field: a letter is in italics, as in formulas, so that I and l differ; a word is not.

    >>> print(named("T_s"), named("turns"))
    <span class="sym">T<sub>s</sub></span> <span>turns</span>
    """
    letter = text.removesuffix(" =").partition("_")[0]
    alone = sum(not unicodedata.combining(each) for each in letter) == 1
    return tag("span.sym" if alone else "span", with_indices(text))


def with_symbol(text: str, symbol: str) -> Markup:
    """Return a text in which one symbol, typed with an underscore, has its index as a subscript everywhere.

    >>> print(with_symbol("v < v_d, v_d = 1", "v_d"))
    v &lt; v<sub>d</sub>, v<sub>d</sub> = 1
    """
    return joined(text.split(symbol), between=with_indices(symbol))
