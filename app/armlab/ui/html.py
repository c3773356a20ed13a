"""Elements of a page: texts and attributes are escaped when an element is made, so that no text becomes markup.

`tag` makes one, with what is inside; a `Markup` that it returns stands as it is in another. This is the only place
where text becomes markup; formulas and the text of lessons come from their own readers, which check them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache

from markupsafe import Markup, escape

from armlab.content.as_written import STAYS, AsWritten

__all__ = ["Attribute", "Inside", "Markup", "classes", "joined", "styles", "tag"]

Inside = str | Iterable["Inside"] | None
"""Content of an element: a text, which is escaped; markup; several of these in a row; or nothing. An `AsWritten` is
not translated."""

Attribute = str | int | bool | None
"""Value of an attribute: a text, which is escaped; True for one without a value; False and None for one that is
absent."""

_KIND = re.compile(r"([a-z][a-zA-Z0-9]*)((?:\.[\w-]+)*)")

_VOID = frozenset({"br", "hr", "img", "input", "meta"})

SHORT = 40
"""Largest number of characters of a text whose escaped form is kept: most names, signs and numbers come again."""

_STAYS = ' {}="{}"'.format(*STAYS)

_new = str.__new__  # three times as quick as `Markup`, which first asks what it was given


def tag(kind: str, /, *inside: Inside, **attributes: Attribute) -> Markup:
    """Return an element.

    Parameters
    ----------
    kind : str
        Its name, and its classes after dots.
    *inside : str, Markup, iterable of them or None
    **attributes : str, int, bool or None
        ``_`` stands for ``-``; one at the end is left out, as in ``for_``.

    Raises
    ------
    ValueError
        The kind is none.
    TypeError
        The value of an attribute is markup, whose quotes would end it.

    Examples
    --------
    >>> print(tag("p.dim", "a < b, ", tag("b", "c"), title='"'))
    <p class="dim" title="&#34;">a &lt; b, <b>c</b></p>
    """
    start, end = _ends(kind)
    if len(inside) == 1 and type(inside[0]) is AsWritten:
        start, inside = f"{start}{_STAYS}", (str(inside[0]),)
    if attributes:
        start += "".join(
            [
                _known_attribute(name, value) if type(value) is str and len(value) <= SHORT else _attribute(name, value)
                for name, value in attributes.items()
            ]
        )
    return _new(Markup, f"{start}>{_text(inside)}{end}")


def joined(*inside: Inside, between: str = "") -> Markup:
    """Return markup of several things in a row.

    >>> print(joined("a & b", [tag("i", "c")], None, between=", "))
    a &amp; b, <i>c</i>
    """
    if between:
        return _new(Markup, escape(between).join([_text(each) for each in _flat(inside)]))
    return _new(Markup, _text(inside))


def styles(rules: Iterable[str]) -> Markup:
    """Return style rules in an element, where nothing is escaped; `ValueError` for a rule that could end it."""
    text = "".join(rules)
    if "<" in text:
        raise ValueError(f"expected rules of a style sheet, got {text!r}")
    return _new(Markup, f"<style>{text}</style>")


def classes(kind: str, **more: bool) -> str:
    """Return the kind of an element with those classes whose values are true.

    >>> classes("td.a", zero=True, lit=False)
    'td.a.zero'
    """
    return kind + "".join([f".{name}" for name, on in more.items() if on])


@lru_cache(maxsize=4096)
def _ends(kind: str) -> tuple[str, str]:
    match = _KIND.fullmatch(kind)
    if match is None:
        raise ValueError(f"expected an element and its classes, such as 'div.row', got {kind!r}")
    name, rest = match.groups()
    start = f'<{name} class="{rest[1:].replace(".", " ")}"' if rest else f"<{name}"
    return start, "" if name in _VOID else f"</{name}>"


def _attribute(name: str, value: Attribute) -> str:
    if value is None or value is False:
        return ""
    if type(value) is Markup:  # would stand as it is, with its quotes
        raise TypeError(f"{name}: expected a text, got markup {value!r}")
    name = name.rstrip("_").replace("_", "-")
    return f" {name}" if value is True else f' {name}="{escape(value)}"'


_known_attribute = lru_cache(maxsize=8192)(_attribute)
_known_text = lru_cache(maxsize=8192)(escape)


def _text(inside: Inside) -> str:
    """Return the markup of the content of an element."""
    if type(inside) is Markup:
        return inside
    if isinstance(inside, str):
        if type(inside) is AsWritten:
            return f"<span{_STAYS}>{escape(str(inside))}</span>"
        return _known_text(inside) if type(inside) is str and len(inside) <= SHORT else escape(inside)
    return "" if inside is None else "".join([_text(each) for each in inside])


def _flat(inside: Iterable[Inside]) -> Iterable[str]:
    for each in inside:
        if isinstance(each, str):
            yield each
        elif each is not None:
            yield from _flat(each)
