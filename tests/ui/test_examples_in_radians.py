"""Titles and sentences of examples for a person who has radians, on all pages that have examples."""

import re

import pytest

from armlab.content.languages import keys, messages
from armlab.content.robots import catalogue
from armlab.content.rows import rows
from armlab.content.words import Words
from armlab.session.bench import benches, choosing, page_of
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.speech import Speech
from armlab.ui.units import Units
from armlab.window.search.markup import topic_head
from support.bare_gui import BarePage, content
from support.student import run

RADIANS = Units(Notation(angle="rad"))

ABOUT_DEGREES = frozenset[str]()
"""Examples whose subject are degrees themselves, as ``bench/example``: they keep them."""

WITH_DEGREES = [
    f"{bench.key}/{key}"
    for bench in benches().values()
    for key, example in bench.examples.items()
    if "°" in example.title + example.says
]


def example_of(name):
    bench, key = name.split("/")
    return benches()[bench].examples[key]


def shown_in_radians(name):
    """Return the page of an example that was chosen while angles were in degrees."""
    arm = getattr(example_of(name), "robot", "")
    page = BarePage(page_of(name), catalogue()[arm if arm in catalogue().robots else "planar_2r"])
    page._post(choosing(name))
    page.show()
    page._post(Set(Notation, "angle", "rad"))
    page.show()
    return page


def looks_on(page):
    """Return the choices among examples on a page, and the sentences of the chosen ones, as markup."""
    shown = "".join(content(each) for each in page._gui.has)
    return "".join(re.findall(r'<p class="kit-look">.*?</p>|<select[^>]*data-cell="example".*?</select>', shown, re.S))


async def what_is_said(name):
    return looks_on(shown_in_radians(name))


@pytest.mark.parametrize("name", WITH_DEGREES)
def test_what_an_example_says_has_the_unit_of_the_person_in_every_language(name):
    shown = run(what_is_said(name))
    assert "<p" in shown
    assert "<select" in shown
    assert ("°" in shown) == (name in ABOUT_DEGREES)
    missing = []
    for language in keys()[1:]:
        Speech(Words(messages(language), missing.append)).markup(shown)
    assert missing == []


def test_names_that_an_example_gives_to_runs_have_the_unit_of_the_person():
    async def shown():
        page = shown_in_radians("control/line_178")
        return re.findall(r"<span>([^<]*), J⁻¹</span>", "".join(content(each) for each in page._gui.has))

    assert run(shown()) == ["3.11 rad", "2.97 rad"]


def test_a_topic_that_is_found_has_the_unit_of_the_person():
    state = apply(State.initial(catalogue()["planar_2r"]), Set(Notation, "angle", "rad"))
    titles = [topic_head(key, state)[0] for key, row in rows().items() if "°" in row.title]
    assert "Simulation: a 2R along a line at 2.97 rad" in titles


def test_numbers_stay_readable():
    said = RADIANS.said("Line at 178°, up to 300 °/s, phase −45°")
    assert said == "Line at 3.11 rad, up to 5.24 rad/s, phase −0.785 rad"
