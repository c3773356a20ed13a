"""Pages to print: documents of their own, light whatever look the lab has."""

from __future__ import annotations

import re

from armlab.content.as_written import STAYS, as_part
from armlab.content.languages import ENGLISH
from armlab.content.notes import for_reader
from armlab.ui.html import Inside, Markup, joined, styles, tag
from armlab.ui.speech import speech_in

LOOK = """
:root { color-scheme: light; }
body { --ink: #1f2733; --dim: #5f6a78; --line: #e1e6ec; --rule: #858f9c; --mark: #0072b2; }
body { font: 11pt/1.4 system-ui, sans-serif; color: var(--ink); background: #fff; }
body { max-width: 46em; margin: 2em auto; padding: 0 1.2em; }
h1 { font-size: 1.7em; line-height: 1.2; margin: 0 0 .3em; }
h2 { font-size: 1.15em; margin: 0; }
p { margin: .2em 0; }
a { color: inherit; text-decoration-color: var(--rule); text-underline-offset: 2px; }
.small, small { color: var(--dim); font-size: .85em; font-weight: 400; }
header { border-bottom: 2px solid var(--mark); padding-bottom: .8em; }
nav { margin-top: 2em; }
math { font-family: "Cambria Math", "STIX Two Math", "Latin Modern Math", "DejaVu Math TeX Gyre", serif; }
@page { size: A4; margin: 16mm 15mm; }
@media print {
  body { max-width: none; margin: 0; padding: 0; font-size: 10pt; }
  nav, .hint { display: none; }
  a { text-decoration: none; }
}
"""
"""Rules of style that all of them share."""

_PARAGRAPH = re.compile(r"<p( {}=\"{}\")?>((?:(?!<p\b).)*)</p>".format(*STAYS), re.DOTALL)
"""One paragraph, with the attribute of a text that is not translated, and what is inside."""


def document(title: str, look: str, *body: Inside) -> str:
    """Return a page as a document.

    Parameters
    ----------
    title : str
    look : str
        Rules of style besides `LOOK`.
    *body : str, Markup, iterable of them or None
    """
    meta = joined(
        tag("meta", charset="utf-8"),
        tag("meta", name="viewport", content="width=device-width"),
        tag("title", f"{as_part(title)} – Armlab"),
        styles((LOOK, look)),
    )
    page = tag("html", tag("head", meta), tag("body", body), lang=ENGLISH)
    return for_reader(f"<!doctype html>\n{page}\n")


def in_language(page: str, language: str) -> str:
    """Return a page to print in a language: the door of paper, as `armlab.ui.door` is that of the lab."""
    return page if language == ENGLISH else speech_in(language).markup(page)


def address(kind: str, key: str = "") -> str:
    """Return the address of a page to print, in English; on a page in another language it leads to the same language.

    Parameters
    ----------
    kind : str
        First word of the address, such as ``course``.
    key : str
        The course; empty for the first.

    Examples
    --------
    >>> address("course", "lab")
    '/course/lab?lang=en'
    """
    return f"/{kind}/{key}?lang={ENGLISH}" if key else f"/{kind}?lang={ENGLISH}"


def text(html: str) -> Markup:
    """Return the HTML of a text, which its reader has checked, as markup; that of one paragraph without its element.

    >>> print(text("<p>One.</p>")), print(text("<p>One.</p><p>Two.</p>"))
    One.
    <p>One.</p><p>Two.</p>
    (None, None)
    """
    alone = _PARAGRAPH.fullmatch(html.strip())
    if alone is None:
        return Markup(html)
    inside = Markup(alone[2])
    return tag("span", inside, translate=STAYS[1]) if alone[1] else inside
