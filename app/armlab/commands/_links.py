"""Links of texts into the lab, and whether they lead anywhere."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from html import unescape
from urllib.parse import unquote

from armlab.content.errata import errata
from armlab.content.lessons import lessons
from armlab.content.robots import catalogue
from armlab.errors import suggestion
from armlab.session.bench import benches
from armlab.session.pages import pages

_LINK = re.compile(r'href="/(?P<kind>[^"/?#]*)/?(?P<key>[^"?#]*)')
"""Pattern of a link into the lab."""

_RELATIVE = re.compile(r'<a href="(?P<place>(?!/|[A-Za-z][A-Za-z0-9+.-]*:)[^"]*)"')
"""Pattern of a link without a scheme that is none into the lab: there is no file beside the page of a lesson."""


def _examples() -> Iterable[str]:
    return [f"{bench.key}/{name}" for bench in benches().values() for name in bench.examples]


def _courses() -> Iterable[str]:
    return ["", *(course.key for course in lessons().courses)]


PLACES: Mapping[str, Callable[[], Iterable[str]]] = {
    "": lambda: [""],
    "lesson": lambda: lessons().lessons,
    "robot": lambda: catalogue().robots,
    "page": pages,
    "example": _examples,
    "assignment": lambda: lessons().assignments,
    "erratum": errata,
    "course": _courses,
    "guide": _courses,
    "formulas": lambda: [""],
}
"""First words of links, and what may follow each; that of a shared state, which holds it all, is not looked at."""

WITH_VARIANT = ("lesson", "assignment")
"""Those behind which a variant may stand."""


def leading_nowhere(html: str) -> Iterator[str]:
    """Yield what is wrong with the links of a text into the lab, and which lead neither there nor into the web."""
    for link in _RELATIVE.finditer(html):
        place = unquote(unescape(link["place"]))
        yield f"link: expected https://... or a place of the lab such as /lesson/first_arm, got {place!r}"
    for link in _LINK.finditer(html):
        kind, key = link["kind"], unquote(link["key"])
        if kind == "state":
            continue
        if kind not in PLACES:
            yield f"link: unknown place {kind!r} of the lab{suggestion(kind, PLACES)}"
            continue
        name, there = key.partition("/")[0] if kind in WITH_VARIANT else key, list(PLACES[kind]())
        if name not in there:
            yield f"link: unknown {kind} {name!r}{suggestion(name, there)}"
