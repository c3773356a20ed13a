"""Markdown with LaTeX to HTML that can do no harm: no raw HTML, no images, links to the web and to the lab only.

MathML comes from a converter that leaves the text of ``\\text{...}`` as it is and knows ``\\href``; so every formula
is parsed again, and anything but the elements and attributes of plain mathematics is refused.
"""

from __future__ import annotations

import html
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Sequence
from functools import cache
from typing import Any
from urllib.parse import urlsplit

import latex2mathml.converter
from markdown_it import MarkdownIt
from markdown_it.renderer import RendererHTML
from markdown_it.token import Token
from mdit_py_plugins.dollarmath import dollarmath_plugin

from armlab.errors import ContentError, InputError

_ELEMENTS = re.compile(
    "math|mrow|mi|mn|mo|mtext|mspace|mfrac|msqrt|mroot|msub|msup|msubsup|munder|mover|munderover|mtable|mtr|mtd|mstyle"
    "|mpadded|mphantom|mfenced|menclose"
)
_ATTRIBUTES = re.compile(
    "display|stretchy|fence|form|separator|lspace|rspace|largeop|movablelimits|symmetric|minsize|maxsize|mathvariant"
    "|mathcolor|width|height|depth|linethickness|columnalign|rowspacing|columnspacing|columnlines|rowlines|accent"
    "|accentunder|displaystyle|scriptlevel|notation"
)
_VALUE = re.compile(r"[\w .,%#+-]*")
_PARTS = {
    **dict.fromkeys(("mfrac", "mroot", "msub", "msup", "munder", "mover"), 2),
    **dict.fromkeys(("msubsup", "munderover"), 3),
}
_NAMESPACE = "http://www.w3.org/1998/Math/MathML"


def formula(latex: str, block: bool = False) -> str:
    """Return a formula as MathML.

    Raises
    ------
    InputError
        It cannot be converted, or is more than mathematics; the text names it.
    """
    try:
        converted: str = latex2mathml.converter.convert(latex, display="block" if block else "inline")
    except Exception as error:  # the converter has no common exception, and fails with IndexError as well
        reason = type(error).__name__.removesuffix("Error")
        raise InputError(f"the formula ${latex}$ cannot be converted: {reason}") from None
    try:
        root = ElementTree.fromstring(_well_formed(converted))
    except ElementTree.ParseError:
        raise InputError(f"the formula ${latex}$ cannot be converted: it does not give MathML") from None
    for element in root.iter():
        element.tag = element.tag.removeprefix(f"{{{_NAMESPACE}}}")
        _check(element, latex)
    root.set("xmlns", _NAMESPACE)
    return ElementTree.tostring(root, encoding="unicode", short_empty_elements=False)


def _well_formed(mathml: str) -> str:
    """Return MathML with the letters &, < and > of its texts escaped."""

    def escaped(match: re.Match[str]) -> str:
        return f"<{match[1]}{match[2]}>{html.escape(html.unescape(match[3]), quote=False)}</{match[1]}>"

    return re.sub(r"<(mtext|mi|mn|mo)((?:\s[^>]*)?)(?<!/)>(.*?)</\1>", escaped, mathml, flags=re.DOTALL)


def _check(element: ElementTree.Element, latex: str) -> None:
    if not _ELEMENTS.fullmatch(element.tag):
        raise InputError(f"the formula ${latex}$ may not contain {element.tag}")
    for attribute, value in element.attrib.items():
        if not (_ATTRIBUTES.fullmatch(attribute) and _VALUE.fullmatch(value)):
            raise InputError(f"the formula ${latex}$ may not contain {attribute}={value!r}")
    if len(element) != _PARTS.get(element.tag, len(element)):
        raise InputError(f"the formula ${latex}$ is not complete: {element.tag} has {len(element)} part")
    unknown = re.search(r"\\[a-zA-Z]+|\\", element.text or "")
    if unknown:
        raise InputError(f"the formula ${latex}$ has an unknown command {unknown[0]}")


def tokens_of(text: str) -> list[Token]:
    """Return the blocks of a Markdown text."""
    return _parser().parse(text)


def render(tokens: Sequence[Token], file: str, where: str) -> str:
    """Return the HTML of blocks.

    Raises
    ------
    ContentError
        A formula cannot be converted; ``where`` is its place in the file.
    """
    parser = _parser()
    try:
        rendered: str = parser.renderer.render(tokens, parser.options, {})
    except InputError as error:
        raise ContentError(file, where, str(error)) from None
    return rendered


def to_html(text: str, file: str, where: str = "") -> str:
    """Return the HTML of a Markdown text; see `render`."""
    return render(tokens_of(text), file, where)


def is_allowed(address: str) -> bool:
    """Whether a link may go there: the web, or a place of the lab itself.

    >>> is_allowed("https://example.org"), is_allowed("javascript:alert(1)"), is_allowed("//example.org")
    (True, False, False)
    """
    try:
        parts = urlsplit(address)
    except ValueError:
        return False
    if parts.scheme:
        return parts.scheme in ("http", "https") and bool(parts.netloc)
    return not parts.netloc and not address.startswith(("//", "\\", "/\\"))


@cache
def _parser() -> MarkdownIt:
    parser = MarkdownIt("commonmark", {"html": False}).enable("table").disable("image")
    parser.validateLink = is_allowed  # type: ignore[method-assign, assignment]
    dollarmath_plugin(
        parser,
        allow_labels=False,
        allow_blank_lines=False,
        double_inline=True,
        renderer=lambda latex, options: formula(latex.strip(), bool(options["display_mode"])),
    )
    parser.add_render_rule("link_open", _link)
    return parser


def _link(renderer: RendererHTML, tokens: Sequence[Token], index: int, options: Any, env: Any) -> str:
    """Open pages of the web beside the lab."""
    token = tokens[index]
    if urlsplit(str(token.attrGet("href"))).scheme:
        token.attrSet("target", "_blank")
        token.attrSet("rel", "noopener noreferrer")
    return renderer.renderToken(tokens, index, options, env)
