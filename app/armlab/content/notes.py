"""Parts of a text for those who have the course notes: equation numbers and errata, between ⟦ and ⟧."""

from __future__ import annotations

import re

_MARKED = re.compile("⟦(.*?)⟧", re.DOTALL)
_EMPTY = re.compile(r"<details><summary></summary><p[^<>]*></p></details>|<(p|small)(?: [^<>]*)?></\1>| title=\"\"")
"""Elements and hints of which nothing is left without what was marked."""


def for_reader(text: str, has_notes: bool = False) -> str:
    """Return a text, or the markup of an element, as it is shown to a reader.

    Parameters
    ----------
    text : str
    has_notes : bool
        Whether what is marked is shown, without its marks, or left out with all elements that are empty without it.

    Examples
    --------
    >>> for_reader("The torques of a force⟦ (5.163)⟧")
    'The torques of a force'
    >>> for_reader("The torques of a force⟦ (5.163)⟧", has_notes=True)
    'The torques of a force (5.163)'
    >>> for_reader("<b>τ</b><small>⟦notes 5.160⟧</small>")
    '<b>τ</b>'
    """
    if "⟦" not in text:
        return text
    return _MARKED.sub(r"\1", text) if has_notes else _EMPTY.sub("", _MARKED.sub("", text))
