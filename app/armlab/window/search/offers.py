"""The offers of the search besides lessons and topics of the notes: pages, arms, commands, settings, files.

Each is declared where it belongs: by its page, by its file, beside the keys, with its switch. Here they only meet.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, lru_cache, partial

from armlab.content.index import Place, Thing
from armlab.content.robots import Robot, catalogue
from armlab.page import Export
from armlab.page import Page as PageData
from armlab.session.fields import Set
from armlab.session.pages import pages
from armlab.session.panel_commands import hidden_panels
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import ChooseRobot
from armlab.session.state import State
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui.commands import Page, Shortcut, shortcuts, toggle
from armlab.ui.plugin import layers, switches
from armlab.ui.settings import NOTATION, Setting
from armlab.ui.switches import Switch

CHOICE, VIEW, LESSONS = "robot", "picture", "lessons"
"""Keys of the pages on which arms, settings and lessons are chosen; where one is hidden, these are not found."""


@dataclass(frozen=True, eq=False)
class Offer:
    """One thing that can be found, and what is done with it.

    Attributes
    ----------
    thing : Thing
    act : callable
        Gets the page of the browser.
    page : str
        Key of the page to which it belongs; empty for none.
    key : str
        The key that does the same, in its usual notation; empty for none.
    at : str
        Of a file: where its control is on the page; see `armlab.page.Export`.
    is_on : callable or None
        Of a setting: whether it is on in a state.
    """

    thing: Thing
    act: Callable[[Page], None]
    page: str = ""
    key: str = ""
    at: str = ""
    is_on: Callable[[State], bool] | None = None

    @property
    def place(self) -> Place:
        """Kind and key, under which the index has it."""
        return self.thing.kind, self.thing.key


@cache
def offers() -> dict[Place, Offer]:
    """Return all offers by kind and key."""
    return {offer.place: offer for offer in _all()}


@cache
def things() -> tuple[Thing, ...]:
    """Return what the index is to know of the offers."""
    return tuple(offer.thing for offer in offers().values())


def hidden(state: State) -> frozenset[Place]:
    """Return what is not to be found while the open lesson hides it, or asks for a prediction that it would show."""
    return _hidden(hidden_panels(state), bool(state[LessonPart].hides))


def is_hidden(place: Place, state: State) -> bool:
    """Return whether something is not to be found in a state; see `hidden`."""
    return place in hidden(state) or (place[0] == "lesson" and LESSONS in hidden_panels(state))


@lru_cache(maxsize=32)
def _hidden(panels: frozenset[str], predicting: bool) -> frozenset[Place]:
    gone = panels | {key for key, page in pages().items() if predicting and not page.always}
    tells = {layer.switch.name for layer in layers().values() if layer.switch is not None and not layer.silent}
    told = {("setting", name) for name in tells if predicting}
    return frozenset({place for place, offer in offers().items() if offer.page in gone} | told)


def title_of(page: PageData) -> str:
    """Return the title of a page with that of its tab: ``Velocity › Ellipsoid``."""
    thing = _page(page).thing
    return f"{thing.within} › {thing.title}" if thing.within else thing.title


def _all() -> Iterator[Offer]:
    yield from map(_page, pages().values())
    yield from map(_arm, catalogue().robots.values())
    yield from (_command(shortcut) for shortcut in shortcuts() if shortcut.name)
    yield from map(_switch, switches())
    for name, setting in NOTATION.items():
        yield from (_choice(name, setting, option) for option in setting.options)
    for page in pages().values():
        yield from (_export(page, export) for export in page.exports)


def _page(page: PageData) -> Offer:
    tab = pages()[page.tab or page.key].title
    title = page.page or page.title
    names = (tab,) if tab != title and not page.tab else ()
    thing = Thing("bench", page.key, title, page.about, tab if tab != title else "", names)
    return Offer(thing, lambda view: view.open_tab(page.key), page.key)


def _arm(robot: Robot) -> Offer:
    words = (*robot.words, "".join(row.kind for row in robot.arm.rows), robot.family, "robot", "arm")
    thing = Thing("arm", robot.key, robot.name, words, detail=robot.summary)
    return Offer(thing, lambda view: view.post(ChooseRobot(robot.key)), CHOICE)


def _command(shortcut: Shortcut) -> Offer:
    thing = Thing("command", shortcut.name, shortcut.label, shortcut.about)
    return Offer(thing, shortcut.act, key=shortcut.shown)


def _switch(switch: Switch) -> Offer:
    thing = Thing("setting", switch.name, switch.title, ("show", "hide", *switch.about), detail=switch.hint)
    return Offer(thing, toggle(switch).act, VIEW, switch.key, is_on=switch.on)


def _choice(name: str, setting: Setting, option: str) -> Offer:
    title = f"{setting.title} {setting.options[option]}"
    thing = Thing("setting", f"{name}.{option}", title, setting.about.get(option, ()), detail=setting.hint)
    act = partial(_set, name, option)
    return Offer(thing, act, VIEW, is_on=lambda state: getattr(state[Notation], name) == option)


def _set(name: str, option: str, view: Page) -> None:
    view.post(Set(Notation, name, option))


def _export(page: PageData, export: Export) -> Offer:
    detail = title_of(page) + (f", once {export.after}" if export.after else "")
    about = (*export.about, "export", "download", "save")
    thing = Thing("export", f"{page.key}.{export.at}", export.title, about, detail=detail)
    return Offer(thing, lambda view: view.open_tab(page.key), page.key, at=export.at)
