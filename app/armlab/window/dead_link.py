"""A link that leads nowhere: what is said of it, with the few addresses that come near."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches

from armlab.content.errata import errata
from armlab.content.held import is_held
from armlab.content.lessons import lessons
from armlab.content.robots import catalogue
from armlab.session.bench import benches
from armlab.session.pages import pages
from armlab.session.state import State
from armlab.teaching.parts.lesson import LessonPart

CALLED = {"robot": "arm"}
"""Names of things to which links lead, by the kind of link, where they are not those of the kinds."""

MOST = 3
"""Largest number of addresses that are named."""

SHORTEST = 3
"""Shortest word that is looked for inside keys and titles, in characters."""


def leads_nowhere(state: State, kind: str, what: str) -> str:
    """Return what is said of a link to something that does not exist; empty where it does, or names nothing.

    Parameters
    ----------
    state : State
    kind : str
        First word of the link, such as ``lesson``.
    what : str
        What follows it.
    """
    name = what if kind == "example" else what.partition("/")[0]
    titles = _titles(kind)
    if titles is None or name in titles or _is_kept(state, kind, name):
        return ""
    says = f"There is no {CALLED.get(kind, kind)} '{name}'."
    close = [f"/{kind}/{key}" for key in _near(name, titles)]
    if not close:
        return says
    return f"{says} Did you mean {close[0]}?" if len(close) == 1 else f"{says} Did you mean one of {', '.join(close)}?"


def _titles(kind: str) -> Mapping[str, str] | None:
    """Return the titles of what a student may open by a kind of link, by their keys; None of a kind without names."""
    match kind:
        case "page":
            return {key: f"{page.title} {page.name}" for key, page in pages().items()}
        case "robot":
            return {key: robot.name for key, robot in catalogue().robots.items()}
        case "lesson":
            return {each.key: each.title for each in lessons().listed}
        case "assignment":
            return {key: each.title for key, each in lessons().assignments.items()}
        case "erratum":
            return {key: each.place for key, each in errata().items()}
        case "example":
            return {f"{bench.key}/{key}": "" for bench in benches().values() for key in bench.examples}
    return None


def _is_kept(state: State, kind: str, name: str) -> bool:
    """Return whether something is in no list and can be opened, or is refused with a reason of its own."""
    found = lessons() if kind in ("lesson", "assignment") else None
    if found is None:
        return False
    if kind == "lesson":
        return is_held(name) or found.has(name) or name in found.gone or name in found.broken
    return is_held(name) or name in state[LessonPart].works


def _near(name: str, titles: Mapping[str, str]) -> list[str]:
    """Return the keys that hold a name, or whose titles do, and then those that are spelt much like it."""
    words = name.replace("_", " ").casefold()
    holding = [key for key, title in titles.items() if name.casefold() in key.casefold() or words in title.casefold()]
    found = dict.fromkeys([*(holding if len(name) >= SHORTEST else ()), *get_close_matches(name, titles, n=MOST)])
    return list(found)[:MOST]
