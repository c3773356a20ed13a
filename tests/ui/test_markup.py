"""Buttons, choices and fields as markup: nothing that is written into them can get out."""

import logging
from html.parser import HTMLParser
from types import SimpleNamespace

import pytest

from armlab.session.session import Redo, Undo
from armlab.ui import markup
from armlab.ui.overlay import Overlay

BAD = "a\"><b onclick='x'>&lt;"


def tags_of(text):
    """Return tags with their attributes as a page reads them, and the text between."""
    found, words = [], []
    reader = HTMLParser()
    reader.handle_starttag = lambda tag, attributes: found.append((tag, dict(attributes)))
    reader.handle_data = words.append
    reader.feed(text)
    return found, "".join(words)


def test_a_chip_sends_its_cell_and_says_whether_it_is_pressed():
    assert markup.chip("c1", "3", "J3") == '<button class="chip" data-chan="c1" data-cell="3">J3</button>'
    ((_, on),), _ = tags_of(markup.chip("c1", "3", "J3", "hint", pressed=False, off=True))
    assert on["aria-pressed"] == "false"
    assert on["title"] == "hint"
    assert "disabled" in on


@pytest.mark.parametrize(
    ("made", "attributes"),
    [
        (markup.chip("c", BAD, BAD, BAD), ("data-cell", "title")),
        (markup.button("c", BAD, "inside", "kind", BAD, BAD, data_key=BAD), ("data-cell", "title", "aria-label")),
        (markup.copy_button(BAD, BAD), ("data-copy",)),
        (markup.select("c", BAD, BAD, "", BAD), ("data-cell", "aria-label", "title")),
        (markup.options({BAD: BAD}, BAD), ("value",)),
        (markup.field("c", BAD, BAD, BAD, placeholder=BAD), ("data-cell", "value", "aria-label", "placeholder")),
    ],
)
def test_texts_stay_texts(made, attributes):
    found, _ = tags_of(made)
    assert len(found) == 1
    assert all(found[0][1][name] == BAD for name in attributes)


def test_of_several_choices_one_is_chosen():
    assert markup.chips("c", {"a": "A", "b": "B"}, "b", "").count('aria-pressed="true">B') == 1
    assert markup.options({"a": "A", "b": "B"}, "b").endswith('</option><option value="b" selected>B</option>')


def test_only_undo_and_redo_step_back_and_forth(caplog, monkeypatch):
    pressed, posted = [], []
    monkeypatch.setattr("armlab.ui.overlay.Fields", lambda _gui, on_input: pressed.append(on_input))
    Overlay(SimpleNamespace(gui=None), posted.append, posted.append)
    press = pressed[0]
    press("undo", "")
    press("redo", "")
    press("tabs", "Pose")
    assert posted == [Undo(), Redo(), "Pose"]
    with caplog.at_level(logging.WARNING):
        press("anything", "")
    assert len(posted) == 3
    assert "not ours" in caplog.text
