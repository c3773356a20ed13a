"""Symbols whose indices are typed after a low line."""

from __future__ import annotations

import re

from armlab.ui.html import Markup, joined, tag

_INDEX = re.compile(r"_([^\s/]+?)(?=, |/|$)")


def with_indices(text: str) -> Markup:
    """Return a symbol with what follows a low line set as its index.

    >>> print(with_indices("Δt_k−1,k"), with_indices("t_a, t_b"), with_indices("T_s/T"))
    Δt<sub>k−1,k</sub> t<sub>a</sub>, t<sub>b</sub> T<sub>s</sub>/T
    """
    parts = _INDEX.split(text)  # texts, and the indices between them
    return joined(tag("sub", part) if i % 2 else part for i, part in enumerate(parts))
