"""Examples and hints of the pages on sensors for a person who has radians."""

import pytest

from armlab.content.languages import keys, messages
from armlab.content.notes import for_reader
from armlab.content.robots import catalogue
from armlab.content.words import Words
from armlab.session.bench import benches, choosing, page_of
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.ui.units import Units
from support.bare_gui import BarePage, content, words

RADIANS = Units(Notation(angle="rad"))


def page_in_radians(key):
    page = BarePage(key, catalogue()["planar_2r"])
    page._post(Set(Notation, "angle", "rad"))
    page.show()
    return page


@pytest.mark.parametrize("bench", ["absolute", "incremental", "encoder_speed", "pose_accuracy"])
def test_what_examples_say_is_in_radians_and_in_every_language(bench):
    found = benches()[bench]
    for name, example in found.examples.items():
        page = page_in_radians(page_of(f"{bench}/{name}"))
        page._post(choosing(f"{bench}/{name}"))
        page.show()
        said = [RADIANS.said(for_reader(text)) for text in (example.title, example.says)]
        assert said[1] in words(page)
        assert "°" not in words(page)
        missing = []
        for language in keys()[1:]:
            for text in said:
                Words(messages(language), missing.append)(text)
        assert missing == []


def test_a_hint_on_moves_has_the_unit_of_the_person():
    (hint,) = [each for each in map(content, page_in_radians("incremental_encoder")._gui.has) if "such as" in each]
    assert "such as 1.57 −0.79 0.17" in hint
