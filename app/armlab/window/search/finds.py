"""Finds in a state: nothing that the open lesson hides, and lessons as soon as they have been read."""

from __future__ import annotations

from threading import Event

from armlab.content.index import Entry, search, taught_in
from armlab.content.languages import ENGLISH
from armlab.content.lessons import lessons, lessons_read, read_unhurried
from armlab.session.panel_commands import hidden_panels
from armlab.session.state import State
from armlab.window.search.offers import LESSONS, hidden, things

MOST = 1000
"""Largest number of finds that are counted."""


def find(query: str, state: State, language: str = ENGLISH) -> list[Entry]:
    """Return everything on a query in a language or in English, the best first; nothing for an empty one.

    The lessons are those read last: whoever searches in the first second does not wait for them.
    """
    if not query.strip():
        return []
    known = lessons_read()
    taught = () if known is None or LESSONS in hidden_panels(state) else taught_in(known)
    return search(query, MOST, things=things(), taught=taught, hidden=hidden(state), language=language)


def prepare(given_up: Event) -> None:
    """Make the index of the lab, so that nobody waits for it, unless it is given up.

    It reads all lessons and imports all of kin.
    """
    if not read_unhurried(given_up):
        return
    search("index", things=things(), taught=taught_in(lessons()))
