"""Markdown with LaTeX to HTML that can do no harm: no raw HTML, links to the web and to the lab only.

Pictures are those that are given, written into the page. ``{{name}}`` is a live value, see `armlab.content.live`.

MathML comes from a converter that leaves the text of ``\\text{...}`` as it is and knows ``\\href``; so every formula
is parsed again, and anything but the elements and attributes of plain mathematics is refused.
"""

from __future__ import annotations

import html
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, lru_cache
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from armlab.content.as_written import STAYS
from armlab.content.bench_words import is_word
from armlab.content.formula_room import NAMESPACE, add_room, without_namespace
from armlab.errors import ContentError, InputError, suggestion

if TYPE_CHECKING:
    from markdown_it import MarkdownIt
    from markdown_it.renderer import RendererHTML
    from markdown_it.rules_inline import StateInline
    from markdown_it.token import Token

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
_REASONS = {
    "NoAvailableTokens": "it ends too early; a brace or an argument is missing",
    "Index": "it ends too early; a brace or an argument is missing",
    "MissingEnd": "a \\end{...} is missing",
    "ExtraLeftOrMissingRight": "a \\right to a \\left is missing",
    "MissingSuperScriptOrSubscript": "something is missing after ^ or _",
    "DoubleSubscripts": "there are two indices _ in a row",
    "DoubleSuperscripts": "there are two exponents ^ in a row",
}
"""Explanations of the converter's exceptions."""

_PARTS = {
    **dict.fromkeys(("mfrac", "mroot", "msub", "msup", "munder", "mover"), 2),
    **dict.fromkeys(("msubsup", "munderover"), 3),
}
IN_METRES = "m"
"""Suffix of the name of a live length that is shown in metres whatever the unit on the screen."""

_LIVE = re.compile(r"\{\{([^{}\n]*)\}\}")
_LIVE_BEGUN = re.compile(r"\{\{\s*([A-Za-z][^{}\n]{0,40})")
MOST_FORMULAS = 8192
"""Number of formulas that are cached; the lessons of the lab have some 2400 different ones."""

MOST_TEXTS = 4096
"""Number of texts that are cached: hints, answers and verdicts are mostly the same in all variants of a lesson."""


@lru_cache(MOST_FORMULAS)
def formula(latex: str, block: bool = False) -> str:
    """Return a formula as MathML; the same few stand in most texts.

    Raises
    ------
    InputError
        It cannot be converted, or is more than mathematics; the text names it.
    """
    import latex2mathml.converter  # with the first text: the lab opens without one

    try:
        hyphens = latex.replace("\u2212", "-")  # the converter knows them as minus signs, and no others
        converted: str = latex2mathml.converter.convert(hyphens, display="block" if block else "inline")
    except Exception as error:  # the converter has no common exception, and fails with IndexError as well
        name = type(error).__name__.removesuffix("Error")
        reason = _REASONS.get(name) or re.sub(r"(?<!^)(?=[A-Z])", " ", name).lower()
        raise InputError(f"the formula ${latex}$ cannot be converted: {reason}") from None
    try:
        root = ElementTree.fromstring(_well_formed(converted))
    except ElementTree.ParseError:
        raise InputError(f"the formula ${latex}$ cannot be converted: it does not give MathML") from None
    without_namespace(root)
    for element in root.iter():
        _check(element, latex)
    for element in root.iter():
        _mark_matrices(element)
    add_room(root)
    root.set("xmlns", NAMESPACE)
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


def _mark_matrices(parent: ElementTree.Element) -> None:
    """Mark tables in square brackets, which the page draws itself: few fonts have brackets that grow with a table."""
    for before, table, after in zip(parent, parent[1:], parent[2:], strict=False):
        if table.tag == "mtable" and (before.text, after.text) == ("[", "]"):
            table.set("class", "matrix")


def tokens_of(text: str) -> list[Token]:
    """Return the blocks of a Markdown text."""
    return _parser().parse(text)


class TextError(InputError):
    """A Markdown text cannot be used.

    Parameters
    ----------
    problem : str
    line : int
        Line, from 0 for the first one of the text.
    """

    def __init__(self, problem: str, line: int) -> None:
        super().__init__(problem)
        self.line = line


@dataclass(frozen=True)
class Extras:
    """Additional elements that a text may contain besides Markdown.

    Parameters
    ----------
    live : mapping of str to str
        Names of live values; to each why it is missing, empty where it is there.
    pictures : mapping of str to str or None
        Names of files to ``data:`` addresses; None where there can be none.
    used : set of str
        Gets the names of the live values that are used.
    stays : bool
        Whether no text is translated; see `armlab.content.as_written`.
    """

    live: Mapping[str, str] = field(default_factory=dict)
    pictures: Mapping[str, str] | None = None
    used: set[str] = field(default_factory=set)
    stays: bool = False


def html_of(tokens: Sequence[Token], extras: Extras | None = None) -> str:
    """Return the HTML of blocks.

    Raises
    ------
    TextError
        A formula cannot be converted, a live value or a picture is not there.
    """
    extras = extras or Extras()
    for line, token in _parts(tokens):
        try:
            if token.type.startswith("math_"):
                _convert(token, extras)
            elif token.type == "live":
                _look_up(token, extras)
            elif token.type == "image":
                _embed(token, extras)
        except InputError as error:
            raise TextError(str(error), line) from None
    for token in tokens if extras.stays else ():
        if token.level == 0 and token.nesting == 1:
            token.attrSet(*STAYS)
    parser = _parser()
    rendered: str = parser.renderer.render(tokens, parser.options, {})
    return rendered


def _parts(tokens: Sequence[Token]) -> Iterator[tuple[int, Token]]:
    """Yield blocks and inline pieces, with their lines."""
    line = 0
    for token in tokens:
        line = token.map[0] if token.map else line
        yield line, token
        breaks = 0
        for child in token.children or ():
            breaks += child.type in ("softbreak", "hardbreak")
            yield line + breaks, child


def _convert(token: Token, extras: Extras) -> None:
    """Convert a formula, in which live values are not allowed."""
    for found in _LIVE.finditer(token.content):
        name = _name(found[1])
        if name in extras.live or is_word(name):
            raise InputError(f"{{{{{name}}}}} is a live value and cannot stand in a formula; write it between formulas")
    token.meta = {"html": formula(token.content.strip(), token.type != "math_inline")}


def _name(text: str) -> str:
    return " ".join(text.split())


def _look_up(token: Token, extras: Extras) -> None:
    if token.meta["open"]:
        raise InputError(f"expected }}}} after {{{{{_name(token.content)}")
    name, colon, unit = (part.strip() for part in _name(token.content).partition(":"))
    if colon and (unit != IN_METRES or not is_length(name)):
        raise InputError(
            f"expected {{{{name}}}}, or of a length {{{{name:m}}}} for metres, got {{{{{token.content}}}}}"
        )
    if is_word(name):
        extras.used.add(name)
        return
    if name not in extras.live:
        there = [each for each, missing in extras.live.items() if not missing]
        raise InputError(f"unknown live value {name!r}{suggestion(name, there)}")
    if extras.live[name]:
        raise InputError(f"the live value {name!r} is not there for this arm: {extras.live[name]}")
    extras.used.add(name)


def is_length(name: str) -> bool:
    """Return whether a live value may be a length: a coordinate, a distance, or the value of a prismatic joint."""
    return name in ("px", "py", "pz", "r") or re.fullmatch(r"q\d+", name) is not None


def _embed(token: Token, extras: Extras) -> None:
    name = str(token.attrGet("src"))
    if extras.pictures is None:
        raise InputError(
            f"the picture {name[:60]!r} cannot be shown: a lesson with pictures is a folder NAME with lesson.md and "
            f"the pictures beside it"
        )
    if name not in extras.pictures:
        raise InputError(f"unknown picture {name[:60]!r}{suggestion(name[:60], extras.pictures)}")
    token.attrSet("src", extras.pictures[name])


def text_html(text: str, extras: Extras | None = None) -> str:
    """Return the HTML of a Markdown text; see `html_of`."""
    if extras is not None and (extras.stays or "{{" in text or "![" in text):
        return html_of(tokens_of(text), extras)
    return _html_of_plain(text)


@lru_cache(MOST_TEXTS)
def _html_of_plain(text: str) -> str:
    return html_of(tokens_of(text))


def to_html(text: str, file: str, where: str = "", own: bool = False) -> str:
    """Return the HTML of a Markdown text without live values and pictures; an ``own`` one is not translated.

    Raises
    ------
    ContentError
        A formula cannot be converted; ``where`` is its place in the file.
    """
    try:
        return text_html(text, Extras(stays=True) if own else None)
    except TextError as error:
        raise ContentError(file, where, str(error)) from None


def is_allowed(address: str) -> bool:
    """Return whether a link may be followed: to the web, or to a place in the lab.

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
    from markdown_it import MarkdownIt  # with the first text: the lab opens without one
    from mdit_py_plugins.dollarmath import dollarmath_plugin
    from mdit_py_plugins.dollarmath.index import math_inline_dollar

    parser = MarkdownIt("commonmark", {"html": False}).enable("table")
    parser.validateLink = is_allowed  # type: ignore[method-assign, assignment]
    dollarmath_plugin(parser, allow_labels=False, allow_blank_lines=False, double_inline=True)
    of_plugin = math_inline_dollar(allow_space=False, allow_double=True)
    parser.inline.ruler.at("math_inline", lambda state, silent: _in_dollars(of_plugin, state, silent))
    parser.inline.ruler.after("escape", "live", _live)
    parser.add_render_rule("link_open", _link)
    parser.add_render_rule("live", _output)
    for kind in ("math_inline", "math_inline_double", "math_block"):
        parser.add_render_rule(kind, _formula)
    return parser


def _in_dollars(of_plugin: Callable[[StateInline, bool], bool], state: StateInline, silent: bool) -> bool:
    """Parse a formula between dollar signs; one before a digit ends none, since it is the sign of a price.

    The plugin's own way to ask for this refuses a formula behind a digit, too.
    """
    first = state.pos
    found = of_plugin(state, True)
    price = found and state.src[state.pos : state.pos + 1].isdigit()
    if found and (price or not silent):
        state.pos = first
    return found and not price and (silent or of_plugin(state, False))


def _live(state: StateInline, silent: bool) -> bool:
    """Parse ``{{name}}``; two braces before anything but a letter are text."""
    begun = _LIVE_BEGUN.match(state.src, state.pos, state.posMax)
    if begun is None:
        return False
    found = _LIVE.match(state.src, state.pos, state.posMax)
    if not silent:
        token = state.push("live", "output", 0)
        token.content, token.meta = found[1] if found else begun[1], {"open": found is None}
    state.pos = found.end() if found else begun.end()
    return True


def _output(renderer: RendererHTML, tokens: Sequence[Token], index: int, options: Any, env: Any) -> str:
    del renderer, options, env
    return f'<output class="live" data-live="{html.escape(_name(tokens[index].content))}">…</output>'


def _formula(renderer: RendererHTML, tokens: Sequence[Token], index: int, options: Any, env: Any) -> str:
    del renderer, options, env
    token = tokens[index]
    if token.type == "math_inline":
        return f'<span class="math inline">{token.meta["html"]}</span>'
    if token.type == "math_inline_double":
        return f'<div class="math inline">{token.meta["html"]}</div>'
    return f'<div class="math block">\n{token.meta["html"]}\n</div>\n'


def _link(renderer: RendererHTML, tokens: Sequence[Token], index: int, options: Any, env: Any) -> str:
    """Render a link; pages of the web open beside the lab."""
    token = tokens[index]
    if urlsplit(str(token.attrGet("href"))).scheme:
        token.attrSet("target", "_blank")
        token.attrSet("rel", "noopener noreferrer")
    return renderer.renderToken(tokens, index, options, env)
