"""Buttons, choices and fields as markup: nothing that is written into them can get out."""

from html.parser import HTMLParser
from types import SimpleNamespace

import pytest

from armlab.benches.control.loop.state import Loop
from armlab.content.languages import ENGLISH, keys, words_in
from armlab.content.robots import catalogue
from armlab.session.edits import PASTED
from armlab.session.fields import Set
from armlab.session.session import Redo, Session, Undo
from armlab.teaching.parts.welcome import LeaveWelcome
from armlab.ui import markup
from armlab.ui.figure.drawn import Gallery
from armlab.ui.html import styles, tag
from armlab.ui.plugin import Panel, whole_panel, without_the_arm
from armlab.window.overlay import APART, FIRST_HINT, Overlay
from support.forms import BareFields

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


def test_a_unit_stands_on_the_line_of_the_last_word_of_its_label():
    mass = tags_of(markup.row(("mass of ", tag("b", "A"), ", rpm/s"), ""))[1]
    assert mass == "mass of A,\u00a0rpm/s"
    for label, said in (
        ("Moves, °", "Moves,\u00a0°"),
        ("x y mm, °/s² ", "x y mm,\u00a0°/s² "),
        ("to, from", "to, from"),
    ):
        assert tags_of(markup.row(label, ""))[1] == said


def test_a_page_without_the_arm_says_so_where_no_other_has_to_do_with_it():
    apart, other = Panel((), build=None, apart=True), Panel((), build=None)
    assert [without_the_arm(opened) for opened in ([apart], [apart, other], [other], [])] == [True, False, False, False]
    told = {key for key in ("joints", "motion", "newton_1d", "drive", "target") if whole_panel(key).apart}
    assert told == {"newton_1d", "drive"}


@pytest.mark.parametrize("language", keys()[1:])
@pytest.mark.parametrize("text", [APART, FIRST_HINT, PASTED])
def test_what_stands_over_the_scene_is_translated(language, text):
    assert words_in(language)(text) != text


def test_what_lies_over_the_scene_steps_back_and_forth_where_there_is_something(monkeypatch):
    session, posted, made = Session.fresh("s", catalogue()["planar_2r"]), [], []

    def fields(_gui, on_input):
        made.append(BareFields(on_input))
        return made[0]

    monkeypatch.setattr("armlab.window.overlay.Fields", fields)
    overlay = Overlay(
        SimpleNamespace(gui=None), session, posted.append, Gallery(), posted.append, posted.append, ENGLISH
    )
    overlay.show(handle=True, coming=False)
    assert FIRST_HINT in made[0].content
    overlay.show(handle=True, coming=False, apart=True)
    assert APART in made[0].content
    for cell in ("undo", "redo", "home", "anything"):
        made[0].send(cell, "")
    made[0].send("tabs", "Pose")
    assert posted == ["Pose"]
    session.apply(Set(Loop, "mass", 2.0), 0.0)
    session.apply(Set(Loop, "mass", 3.0), 5.0)
    session.apply(Undo(), 6.0)
    overlay.show(handle=True, coming=False)
    made[0].send("undo", "")
    made[0].send("redo", "")
    assert posted == ["Pose", LeaveWelcome(), Undo(), Redo()]


def test_a_fold_has_a_head_and_is_closed_unless_it_is_said():
    (details, summary), words = tags_of(markup.fold("Peaks", BAD, key="peaks"))
    assert details == ("details", {"class": "kit-fold", "data-fold": "peaks"})
    assert summary == ("summary", {})
    assert words == f"Peaks{BAD}"
    (details, _), _ = tags_of(markup.fold("Peaks", opened=True, kind="kit-holds"))
    assert details == ("details", {"class": "kit-fold kit-holds", "open": None})


def test_a_style_sheet_stands_as_it_is_and_holds_no_element():
    assert styles(["[id='a'] > p { left: 5% }"]) == "<style>[id='a'] > p { left: 5% }</style>"
    with pytest.raises(ValueError, match="expected rules of a style sheet"):
        styles(["p { }", "</style><b>"])
