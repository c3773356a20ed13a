"""The arms as pictures, by family, and which of them a typed text means."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial

from armlab.content.languages import ENGLISH, words_in
from armlab.content.query import plain
from armlab.content.robots import FAMILIES, Robot, catalogue
from armlab.ui.form import Form, Wish
from armlab.ui.format import so_many
from armlab.ui.html import Inside, Markup, styles, tag
from armlab.ui.picks import broken_files
from armlab.ui.png import as_address

YOUR_OWN = "your own"
"""Family of the arms that are the student's own."""


def groups(own: Iterable[Robot]) -> dict[str, list[Robot]]:
    """Return the arms by family, the student's own ones first; families without an arm are left out."""
    found = {YOUR_OWN: list(own)}
    for family in FAMILIES:
        found[family] = [robot for robot in catalogue().robots.values() if robot.family == family]
    return {family: robots for family, robots in found.items() if robots}


def choice_markup(
    form: Form,
    own: Iterable[Robot],
    present: Robot,
    asked: tuple[str, str],
    choose: Callable[[Robot], Wish],
    begin: Callable[[], Wish],
) -> Inside:
    """Return the arms that a text means, by family; without a text all of them, after the button for a new one.

    ``asked`` is the text, and the language of who types it. ``choose`` gets the arm that is pressed; ``begin`` is
    called for a new one.
    """
    sections: list[Inside] = []
    for family, robots in groups(own).items():
        entries = [
            _entry(form, family, robot, present, partial(choose, robot)) for robot in robots if fits(robot, *asked)
        ]
        if not sections and not asked[0].strip():
            entries.insert(0, _new(form, begin))
        if entries:
            sections.append(tag("section", tag("h3", _capital(family)), tag("div.arms", entries)))
    if not sections:
        sections.append(tag("p.dim", "No arm was found. Try a name, a maker, a family, RRP or 7 joints."))
    return sections, broken_files("robot", catalogue().problems)


def fits(robot: Robot, asked: str, language: str = ENGLISH) -> bool:
    """Return whether every word of a text stands in what is said of an arm, in English or in a language.

    >>> fits(catalogue()["puma560"], "spherical 6R"), fits(catalogue()["scara"], "puma")
    (True, False)
    """
    kinds = kinds_of(robot)
    only = f"{len(kinds)}{kinds[0]}" if len(set(kinds)) == 1 else ""
    told = (robot.family, _joints(robot), robot.summary, *robot.words)
    also = map(words_in(language), (_capital(robot.family), *told[1:]))
    said = plain(" ".join((robot.name, robot.key, kinds, only, *told, *also)))
    return all(word in said for word in plain(asked).split())


def _capital(family: str) -> str:
    return family[0].upper() + family[1:]


def name_of(family: str, robot: Robot) -> str:
    """Return the name of an arm in cells and classes; own arms, which have no key, are told apart by their tables."""
    return f"own{id(robot.arm):x}" if family == YOUR_OWN else robot.key


def picture_rules(family: str, pictures: dict[Robot, bytes]) -> Markup:
    """Return style rules that put pictures, PNG files, into the places that `choice_markup` has for them.

    They may come later than the arms, which then stay as they are, with the focus in them.
    """
    return styles(
        f".al-pic-{name_of(family, robot)}{{--pic:url({as_address(picture)})}}\n" for robot, picture in pictures.items()
    )


def kinds_of(robot: Robot) -> str:
    """Return the joints as letters, R for one that turns and P for one that slides."""
    return "".join(row.kind for row in robot.arm.rows)


def _joints(robot: Robot) -> str:
    return so_many(robot.arm.n, "joint")


def _new(form: Form, begin: Callable[[], Wish]) -> Markup:
    about = "Fill in a table, or paste one."
    inside = tag("span.pic", "+", aria_hidden="true"), tag("b", "New arm"), tag("span", about)
    return form.button("arms-new", inside, begin, "arm")


def _entry(form: Form, family: str, robot: Robot, present: Robot, choose: Callable[[], Wish]) -> Markup:
    name = name_of(family, robot)
    inside = (
        tag(f"span.pic.al-pic-{name}", aria_hidden="true"),
        tag("b", robot.name),
        tag("i", f"{_joints(robot)} · {kinds_of(robot)}", title="R: revolute, P: prismatic"),
        tag("span", robot.summary),
    )
    return form.button(f"arm-{name}", inside, choose, "arm", aria_current="true" if robot is present else "")
