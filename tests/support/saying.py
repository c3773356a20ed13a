"""What the lab says to people: all texts of its pages, looked up in the words of a language."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Callable, Iterable, Iterator
from copy import copy
from typing import Any

from armlab.content.absent import ABSENT, HAS
from armlab.content.formulas import sheet
from armlab.content.index import told
from armlab.content.index_items import items_of
from armlab.content.languages import keys
from armlab.content.po import Message
from armlab.content.query import NUMBERED, SKIPPED
from armlab.content.robots import catalogue
from armlab.content.synonyms import GROUPS
from armlab.content.words import Words
from armlab.errors import ArmlabError
from armlab.session.bench import benches, choosing, page_of
from armlab.session.facts import facts_of_benches
from armlab.session.job import Deliver, jobs
from armlab.session.pages import pages
from armlab.session.state import Command
from armlab.ui.speech import Speech
from armlab.window import script_words
from armlab.window.formulas_page import formulas_page
from armlab.window.search.offers import things
from support.bare_gui import BarePage, Handle, content
from support.pasted import what_is_said_of_pasted_tables

ARMS = ("puma560", "planar_2r")
"""Arms with which pages are looked at."""

READ_IN = keys()[-1]
"""A language besides English, in which pages tell what is not translated."""


KINDS = [
    "canadarm2",
    "planar_3r",
    "scara",
    "cartesian_3p",
    "cylindrical_rpp",
    "elbow_3r",
    "gen3",
    "iiwa7",
    "manseur_doty",
    "openmanipulator_x",
    "panda",
    "polar_rrp",
    "stanford",
    "trunk9",
    "ur5e",
    "youbot",
]
"""Arms of the other kinds of structure."""

CHANNEL = re.compile(r' data-chan="[^"]*"')

TELL_OF_ARMS = ("robot", "joints", "by_hand", "table")
"""Pages whose sentences are of one arm."""


class Listener:
    """Looks up texts of pages and keeps what is found and what is not.

    Attributes
    ----------
    missing : dict
        Texts that are not in the catalogue, to the places that say them.
    used : dict
        Sources of messages, to the same.
    opened : set of str
        Sources that pages say as they open.

    Parameters
    ----------
    messages : iterable of Message
    """

    def __init__(self, messages: Iterable[Message]) -> None:
        self.missing: dict[str, set[str]] = {}
        self.used: dict[str, set[str]] = {}
        self._at, self._heard = "", set[str]()
        self._names = {robot.name for robot in catalogue().robots.values()}
        self._messages, self.opened = tuple(messages), set[str]()
        self._words = self._words_of()

    def _words_of(self) -> Words:
        return Words(self._messages, self._miss, self._hit)

    def at(self, place: str) -> None:
        """Look at another place from now on."""
        self._at = place
        words = copy(self._words)
        words._known = {}  # keeps nothing of the place before
        self.speech = Speech(words)

    def _miss(self, text: str) -> None:
        if text not in self._names:
            self.missing.setdefault(text, set()).add(self._at)

    def _hit(self, source: str) -> None:
        self.used.setdefault(source, set()).add(self._at)

    def knows(self, texts: Iterable[str]) -> None:
        """Take texts of a lesson as translated, in the form of messages: they belong to a catalogue of their own."""
        have = {message.source for message in self._messages}
        self._messages += tuple(Message(text, text) for text in texts if text not in have)
        self._words = self._words_of()
        self.at(self._at)

    def hear(self, page: BarePage) -> None:
        """Look up what a page shows."""
        self.hear_markup(shown_on(page))

    def hear_markup(self, shown: Iterable[str]) -> None:
        """Look up markup."""
        for markup in shown:
            if markup not in self._heard:
                self._heard.add(markup)
                self.speech.markup(markup)

    def try_out(self, doing: Callable[[], object]) -> None:
        """Do something, and look up why it is refused."""
        try:
            doing()
        except ArmlabError as refusal:
            self.speech.text(str(refusal))

    def hear_controls(self, made: Iterable[dict[str, Any]]) -> None:
        """Look up labels, hints and options of viser's controls."""
        for given in made:
            if given.get("label") == "channel":
                continue
            for name in ("label", "hint", "title"):
                if isinstance(given.get(name), str):
                    self.speech.text(given[name])
            for option in given.get("options") or ():
                self.speech.text(option)
            for each in (*(given.get("axes") or ()), *(given.get("series") or ())):
                if each.get("label"):
                    self.speech.text(each["label"])


def shown_on(page: BarePage) -> list[str]:
    """Return the markup that a page shows, without the numbers of its channels."""
    gui = page._gui
    found = [content(fields) for fields in gui.has] + [each.handle._impl.props.content for each in gui.said]
    return [CHANNEL.sub("", markup) for markup in found]


@contextlib.contextmanager
def controls_made() -> Iterator[list[dict[str, Any]]]:
    """Give the list of what viser's controls are made with from now on."""
    made: list[dict[str, Any]] = []
    begin = Handle.__init__

    def kept(self: Handle, **given: Any) -> None:
        made.append(given)
        begin(self, **given)

    Handle.__init__ = kept  # type: ignore[method-assign]
    try:
        yield made
    finally:
        Handle.__init__ = begin  # type: ignore[method-assign]


def every_page(listener: Listener, arms: Iterable[str] = ARMS, *chosen: Command) -> Iterator[BarePage]:
    """Listen to every page of the lab as it opens and when its long work is done, with each arm; yields it then.

    Parameters
    ----------
    listener : Listener
    arms : iterable of str
    *chosen : Command
        Done on each page first, such as the choice of a unit.
    """
    for key in pages():
        for arm in arms:
            with controls_made() as made:
                page = BarePage(key, catalogue()[arm], READ_IN)
            listener.at(f"page/{key}")
            listener.hear_controls(made)
            for command in chosen:
                page._post(command)
                page.show()
            listener.hear(page)
            _work_done(listener, page)
            yield page


def every_kind_of_arm(listener: Listener) -> None:
    """Listen to every page as it opens with an arm of each kind, and to those that tell of arms with all of them.

    A page that is the same with the first three, which have little in common, is of no arm.
    """
    for key in pages():
        if key in TELL_OF_ARMS:
            _shown_with(listener, key, catalogue().robots)
        elif len(_shown_with(listener, key, KINDS[:3])) > 1:
            _shown_with(listener, key, KINDS[3:])


def _shown_with(listener: Listener, key: str, arms: Iterable[str]) -> set[tuple[str, ...]]:
    """Listen to a page as it opens with these arms; return what it shows with any of them."""
    shown = set()
    for arm in arms:
        with controls_made() as made:
            page = BarePage(key, catalogue()[arm])
        listener.at(f"page/{key}")
        listener.hear_controls(made)
        listener.hear(page)
        shown.add(tuple(shown_on(page)))
    return shown


def _work_done(listener: Listener, page: BarePage) -> None:
    """Carry the long work of a page through, and listen to what it says of it."""
    for job in jobs().values():
        wanted = job.wanted(page.session.state, frozenset({page._gui.page}))
        if wanted is None:
            continue
        for found in job.run(wanted.inputs):
            if found is not None:
                page._post(Deliver(job, wanted.inputs, found))
        page.show()
        listener.hear(page)


def pressed(listener: Listener, page: BarePage) -> None:
    """Press everything on a page, choose every option, and listen to what comes of it."""
    done: set[tuple[str, str]] = set()
    for _ in range(3):  # what comes of it has controls of its own
        wanted = [
            (cell, value)
            for _, cell, inside in page.controls("button", "select")
            for value in (_options(inside) or [""])
            if (cell, value) not in done
        ]
        for cell, value in wanted[:60]:
            done.add((cell, value))
            fields = next((f for f, at, _ in page.controls("button", "select") if at == cell), None)
            if fields is None:
                continue
            with contextlib.suppress(ArmlabError, RuntimeError):
                page.send(fields, cell, value)
            listener.hear(page)


def _options(inside: str) -> list[str]:
    return [each.split('"', 1)[0] for each in inside.split('<option value="')[1:]]


def stale(messages: Iterable[Message], listener: Listener) -> list[Message]:
    """Return the messages that pages said once as they opened, and say no more."""
    return [message for message in messages if message.places and message.source not in listener.used]


def every_example(listener: Listener) -> None:
    """Listen to the page of every example of a bench with the example in place."""
    for bench in benches().values():
        for key, example in bench.examples.items():
            name = f"{bench.key}/{key}"
            arm = getattr(example, "robot", "") or ARMS[0]
            if arm not in catalogue().robots:
                arm = ARMS[0]
            page = BarePage(page_of(name), catalogue()[arm])
            listener.at(f"page/{page_of(name)}")
            with contextlib.suppress(ArmlabError, RuntimeError):  # some wait on a loop before they go on
                page._post(choosing(name))
                page.show()
            listener.hear(page)
            _work_done(listener, page)


def known_before(listener: Listener) -> None:
    """Listen to what is known before a page is opened: titles, facts, what scripts say and is searched, formulas."""
    listener.at("frame")
    for page in pages().values():
        for text in (page.title, page.name, *(export.title for export in page.exports)):
            listener.speech.text(text)
    for text in script_words.SCRIPT_WORDS:
        listener.speech.text(text)
    listener.at("facts")
    for fact in (each for found in facts_of_benches().values() for each in found.facts.values()):
        listener.speech.text(fact.title)
    listener.at("page/lessons")
    listener.speech.text("3 lessons, 2 h")  # of a chapter of whole hours, which the course need not have
    listener.at("search")
    for text in what_the_search_goes_by():
        listener.speech.text(text)
    listener.at("pasted")
    for _, sentence in what_is_said_of_pasted_tables():
        listener.speech.text(sentence)
    listener.at("paper")
    listener.speech.markup(formulas_page(sheet()) or "")


def what_the_search_goes_by() -> Iterator[str]:
    """Yield all texts in whose words the search finds something, besides those of lessons and of code."""
    for item in items_of((), things()):
        if item.entry.kind != "function":
            yield from (text for text, _ in told(item))
    yield from (word for words in (*ABSENT.values(), HAS) for word in words)
    yield from map(", ".join, GROUPS)
    yield from (SKIPPED, *NUMBERED)
