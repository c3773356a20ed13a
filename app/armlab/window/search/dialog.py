"""The dialog of the search over the page: what is typed, what is found, and what a pick does.

While it is closed only its field is in the page; nothing is looked for and nothing found can be picked.
"""

from __future__ import annotations

import asyncio
import json
import logging
import secrets
from collections.abc import Collection
from functools import partial

from armlab.content.absent import absent
from armlab.content.index import Entry, Place
from armlab.content.lessons import lessons_read
from armlab.content.rows import known, rows
from armlab.session.pages import tab_of
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.teaching.lesson_commands import OpenLesson
from armlab.ui.commands import Page
from armlab.ui.fields import Fields
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag
from armlab.window.search.finds import find
from armlab.window.search.markup import CLOSED, asked_of, dialog, examples, group, hit, search_field, topic_head
from armlab.window.search.offers import Offer, hidden, is_hidden, offers

log = logging.getLogger(__name__)

SHOWN = 14
"""Largest number of finds in the list."""

KEPT = 5
"""Number of recent finds that are kept."""


class SearchDialog:
    """The search of one browser.

    Parameters
    ----------
    page : Page
        On which picks act.
    """

    def __init__(self, page: Page) -> None:
        self._page = page
        self._form = Form(lambda on_input: Fields(page.client.gui, on_input), page.post, self._again, beside=False)
        self._query: str | None = None  # None while the dialog is closed
        self._looked: tuple[object, ...] = ()  # what was last looked for, and in which state
        self._found: tuple[Entry, ...] | None = None  # None while it is being looked for
        self._recent: tuple[Entry, ...] = ()
        self._wanted: Offer | None = None  # the file whose page is being opened
        self._bring = ""
        self._open: Collection[str] = ()
        self._again()

    def show(self, open_panels: Collection[str]) -> None:
        """Show the finds again where the state has changed them.

        Parameters
        ----------
        open_panels : collection of str
            Keys of the panels that are open now: a file is brought when its page is.
        """
        self._open = open_panels
        self._again()

    # -- what a person does --------------------------------------------------------------------------------------

    def _asked(self, text: str) -> None:
        self._query = text

    def _closed(self, _: str) -> None:
        self._query = None

    def _pick(self, entry: Entry, offer: Offer | None) -> None:
        """Do what a find is for, and close; nothing more where it has been hidden since."""
        self._query = None
        if is_hidden(_place(entry), self._page.session.state):
            return
        others = (each for each in self._recent if _place(each) != _place(entry))
        self._recent = (entry, *others)[:KEPT]
        self._wanted = offer if offer is not None and offer.at else None
        if offer is not None:
            offer.act(self._page)
        else:
            self._page.post(OpenLesson(entry.key))

    # -- what is shown -------------------------------------------------------------------------------------------

    def _again(self) -> None:
        state, query = self._page.session.state, self._query
        if self._wanted is not None and self._wanted.page in self._open:
            self._bring, self._wanted = _bring(self._wanted), None
        open_on: tuple[object, ...] = ()
        if query is not None:
            self._look(query, state)
            if self._found is None:
                return  # the list before stays until then
            open_on = self._looked, self._found, state[Display], state[Notation]
        if self._form.shows(query, self._bring, *open_on):
            return
        self._form.takes(CLOSED, self._closed)
        said, listed = ("", ()) if query is None else self._listed(query, state)
        field = search_field(self._form, query or "", self._asked)
        self._form.show(
            dialog(field, query or "", said, listed),
            tag("i", id="al-bring", hidden=True, data_bring=self._bring) if self._bring else None,
        )

    def _look(self, query: str, state: State) -> None:
        """Look for a query beside the lab's own work: the first time the index has to be made."""
        looked = query, hidden(state), lessons_read()
        if looked == self._looked:
            return
        self._looked, self._found = looked, None
        if not query.strip():
            self._found = ()
            return
        looking = asyncio.get_running_loop().run_in_executor(None, find, query, state, self._page.language)
        looking.add_done_callback(partial(self._came, looked))

    def _came(self, looked: tuple[object, ...], looking: asyncio.Future[list[Entry]]) -> None:
        """Show what has been found, unless something else is looked for by now."""
        if looking.cancelled():
            return
        failure = looking.exception()
        if failure is not None:
            log.error("the search has failed", exc_info=failure)
        if looked != self._looked:
            return
        self._found = () if failure is not None else tuple(looking.result())
        self._again()

    def _listed(self, query: str, state: State) -> tuple[Inside, Inside]:
        """Return the line about the finds of a query, and the list."""
        if not query.strip():
            recent = [entry for entry in self._recent if not is_hidden(_place(entry), state)]
            listed = self._hits(recent, state)
            return "What would you like to find?", (group("Recent", listed, "Recent") if recent else None, examples())
        found, topic = [each for each in self._found or () if asked_of(each) != query.strip()], _topic(query)
        if topic:
            found = [entry for entry in found if entry.kind != "row" and topic in entry.rows]
        listed = self._hits(found[:SHOWN], state)
        shown: Inside = group(topic_head(topic, state), listed, "Topic") if topic else listed
        return _said(query, len(found), bool(topic), self._page.language), shown

    def _hits(self, entries: list[Entry], state: State) -> list[Markup]:
        every = offers()
        made = []
        for i, entry in enumerate(entries):
            offer = every.get(_place(entry))
            made.append(hit(self._form, i, entry, partial(self._pick, entry, offer), offer, state))
        return made


def _place(entry: Entry) -> Place:
    return entry.kind, entry.key


def _topic(query: str) -> str:
    """Return the id of the topic that a query names; empty for any other query."""
    name = query.strip()
    return name if known(name) else ""


def _said(query: str, count: int, is_topic: bool, language: str) -> str:
    """Return a sentence on the number of finds, or on what the lab does not have."""
    if lacking := absent(query, language):
        return f"{lacking} Found all the same: {count}." if count else lacking
    if count > SHOWN:
        return f"The first {SHOWN} of {count}"
    if count:
        return f"{count} found"
    if is_topic:
        return rows()[query.strip()].absent or "No lesson, page or function that you can open now is about it."
    shown = query.strip()[:40]
    return f"Nothing was found for “{shown}”. Try another word, an arm (UR5), a section (4.1) or an equation (3.66)."


def _bring(offer: Offer) -> str:
    """Return the note that lets the page's script lead to the control of a file."""
    name, _, copied = offer.at.partition(" ")
    at = f'[data-copy][title="Copy as {copied}"]' if copied else f'[data-cell="{name}"]'
    # Another word each time: the page may outlive the server that asked before.
    return json.dumps({"tab": tab_of(offer.page), "at": at, "asked": secrets.token_hex(4)})
