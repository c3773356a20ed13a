"""Links to errata in the texts of lessons: they open the page Errata beside the lesson, without leaving it."""

from __future__ import annotations

import re

from armlab.teaching.errata_links import LookUp
from armlab.ui.form import Form
from armlab.ui.html import Markup

_LINK = re.compile(r'<a href="/erratum/(?P<key>[^"]*)">(?P<inside>.*?)</a>', re.DOTALL)

HINT = "What the course notes print here, and what is right. The lesson can be understood without the notes."


def with_links(form: Form, html: Markup) -> Markup:
    """Return a text of a lesson with buttons in place of its links to errata."""

    def button(found: re.Match[str]) -> str:
        key, inside = found["key"], Markup(found["inside"])
        return form.button(f"erratum {key}", inside, LookUp(key), "erratum", HINT)

    return Markup(_LINK.sub(button, html))


def without_links(html: str) -> Markup:
    """Return a text with the words of its links to errata, for places from which the right answer is not to be had."""
    return Markup(_LINK.sub(lambda found: found["inside"], html))
