"""Pages in other languages: each student reads their own, English stays as it is, and what is missing is known."""

import json
import re
import urllib.request
from html import unescape

import pytest
from viser import _messages as viser_messages

from armlab.benches.lessons.own_commands import LoadFile
from armlab.commands._translated import compared, of_translations
from armlab.content.held import hold_lesson
from armlab.content.languages import ENGLISH, keys, languages, messages, preferred, words_in
from armlab.content.lessons import lesson, lessons
from armlab.content.po import Message, read_po, write_po
from armlab.content.robots import catalogue
from armlab.content.stand_ins import placeholders
from armlab.content.upload import read_upload
from armlab.content.words import Words
from armlab.errors import ContentError
from armlab.session.fields import Set
from armlab.session.parts.joints import MoveJoint
from armlab.session.parts.language import OF_BROWSER, LanguagePart, ReadIn
from armlab.session.parts.notation import Notation
from armlab.session.share import short
from armlab.session.state import State, apply
from armlab.teaching.lesson_commands import Answer, GoToStep, OpenLesson, UnlockHint
from armlab.teaching.parts.shelf import BackFromShared, OpenShared
from armlab.teaching.preview_commands import PreviewLesson
from armlab.ui.door import Door
from armlab.ui.picks import READING
from armlab.ui.speech import Speech, speech_in
from support.docks import LESSON, BareDock, every_dock
from support.fake_browser import cookie_of
from support.saying import Listener, every_kind_of_arm, every_page, known_before, stale
from support.sources import TOP
from support.student import run, settled, student
from support.verdicts import predictions_refused

MOST_MISSING = 0.002
"""Share of the texts of pages, as they open, that may be English in a language that is complete."""

PUMA = catalogue()["puma560"]
LESSONS = sorted(file.stem for file in (TOP / "lessons/it").glob("*.po"))
OTHERS = keys()[1:]


def asked_for(url, cookie, language):
    """Ask for a language by a link."""
    request = urllib.request.Request(f"{url}?lang={language}", headers={"Cookie": cookie})
    with urllib.request.urlopen(request) as answer:
        assert "lang" not in answer.url


@pytest.mark.parametrize("language", OTHERS)
def test_every_message_has_the_placeholders_of_its_source(language):
    wrong = [each.source for each in messages(language) if placeholders(each.source) != placeholders(each.text)]
    assert not wrong
    assert all(each.text and not each.fuzzy for each in messages(language))


def of_catalogue(language):
    """Return the messages of a language without those of its lessons."""
    return read_po("it.po", (TOP / "app/armlab/languages" / f"{language}.po").read_text(encoding="utf-8"))[1]


@pytest.mark.parametrize("language", OTHERS)
def test_the_translation_of_a_lesson_changes_no_word_of_the_lab(language):
    said: dict[str, set[str]] = {}
    for each in messages(language):
        said.setdefault(each.source, set()).add(each.text)
    assert [source for source, texts in said.items() if len(texts) > 1] == []


@pytest.mark.parametrize("language", OTHERS)
def test_all_that_is_said_of_answers_and_checks_is_translated(language):
    of_docks = of_catalogue(language)
    listener = Listener(of_docks)
    every_dock(listener)
    assert sorted(listener.missing) == []
    said = [message.source for message in of_docks if LESSON in message.places]
    assert not [source for source in said if source not in listener.used]
    assert len(said) > 350


@pytest.mark.parametrize("language", OTHERS)
def test_that_a_prediction_is_still_open_is_translated_whatever_is_said_before_it(language):
    english = [text for text in predictions_refused() if "still open" in words_in(language)(text)]
    assert english == []


@pytest.mark.parametrize("language", OTHERS)
def test_all_pages_are_translated_and_no_message_is_stale(language):
    of_pages = of_catalogue(language)
    listener = Listener(of_pages)
    known_before(listener)
    for _ in every_page(listener):
        pass
    assert not [message.source for message in stale(of_pages, listener) if message.places != (LESSON,)]
    assert len(listener.used) > 2500
    assert len(listener.missing) <= MOST_MISSING * len(listener.used), sorted(listener.missing)


@pytest.mark.parametrize("language", OTHERS)
def test_pages_are_translated_with_arms_of_every_kind(language):
    async def main():  # some pages ask the loop to come back to them
        listener = Listener(of_catalogue(language))
        every_kind_of_arm(listener)
        assert sorted(listener.missing) == []

    run(main())


@pytest.mark.parametrize("language", OTHERS)
def test_pages_are_translated_in_radians_and_metres(language):
    async def main():
        listener = Listener(of_catalogue(language))
        for _ in every_page(listener, ["scara"], Set(Notation, "angle", "rad"), Set(Notation, "length", "m")):
            pass
        assert sorted(listener.missing) == []

    run(main())


def test_the_name_of_a_run_is_no_order_to_open_it():
    assert words_in("it")("Open loop: Transpose αJᵀ") == "Anello aperto: Trasposta αJᵀ"


@pytest.mark.parametrize("language", OTHERS)
def test_the_tasks_of_arms_are_translated(language):
    titles = {robot.arm.task.title for robot in catalogue().robots.values()}
    assert [title for title in titles if words_in(language)(title) == title] == []


@pytest.mark.parametrize("language", OTHERS)
def test_the_arms_of_lessons_have_translated_names(language):
    listener = Listener(of_catalogue(language))
    listener.at(LESSON)
    for key in lessons().found:
        listener.speech.text(lesson(key).robot_used.name)
    assert sorted(listener.missing) == []


@pytest.mark.parametrize("key", LESSONS)
def test_a_translated_lesson_says_all_that_the_lesson_says_also_in_a_variant(key):
    assert [*of_translations(lesson(key)), *of_translations(lesson(key, 17))] == []
    assert Speech(words_in("it")).markup(lesson(key).steps[0].html) != lesson(key).steps[0].html


@pytest.mark.parametrize(
    ("key", "done", "says"),
    [
        ("first_arm", (GoToStep(2), Answer("foo")), "Non riesco a leggere 'foo': scrivi un numero come 0.5, 1/2 o 50"),
        (
            "first_arm",
            (GoToStep(2), Answer("2 rad")),
            "La tua risposta è un angolo; la domanda chiede una lunghezza in m",
        ),
        ("first_arm", (MoveJoint(0, 2.0),), "L'utensile è a 3570.1 mm da (2000.0, 0.0, 0.0) mm: x è −1399.7 mm e"),
        ("ik_2r", (Answer("px +"),), "La formula si interrompe: attesi alla fine un numero, un nome o una parentesi"),
        ("ik_2r", (Answer("0,5 px"),), "Un numero decimale si scrive con il punto: 0.5, non 0,5"),
        ("ik_2r", (Answer("px"),), "La risposta deve dipendere anche da l1, l2, py."),
        ("ik_2r", (GoToStep(1), Answer("0.02")), "Non è ancora la risposta giusta."),
    ],
)
def test_a_student_who_reads_italian_is_told_in_italian_what_is_not_right(key, done, says):
    dock = BareDock(Listener(()))
    dock.do(OpenLesson(key), *done)
    assert says in unescape(speech_in("it").markup("".join(dock.shown)))


OWN = """+++
title = "Turn"
chapter = "Space"
can = ["Turn"]
robot = "planar_2r"
+++
Turn
## Turn

> > Turn
>
> Turn

```question
kind = "choice"
text = "Turn"
options = ["up", "down"]
answer = 1

[[wrong]]
answer = 2
says = "down"
```
```hint
up
```
## Stop
Open
"""
"""A lesson of which the lab knows each word."""


def test_what_a_teacher_has_written_stays_as_it_is_beside_the_words_of_the_lab():
    dock, loaded = BareDock(Listener(())), read_upload(f"turned.md\n{OWN}")
    dock.do(LoadFile(loaded), PreviewLesson(hold_lesson(loaded).lesson.key, "author"), UnlockHint(), Answer("2"))
    shown = "".join(dock.shown)
    said = unescape(speech_in("it").markup(shown))
    assert "Passo 1: \u2068Turn\u2069" in said
    for each, least in (("Turn", 5), ("up", 2), ("down", 2)):
        heard = re.findall(rf">\s*{each}\s*<", unescape(shown))
        assert len(heard) == len(re.findall(rf">\s*{each}\s*<", said)) >= least, each
    assert not re.search(r"(?i)>\s*(gira|giù|in verticale|apri|ferma|spazio)\s*<", said)


def test_elements_whose_texts_stay_end_where_they_end():
    inner = '<div title="Space">space<div>space</div> move joint 1<br><div></div></div>'
    html = f'<p>space <b translate="no">space</b></p><div translate="no">{inner}</div><p>space</p>'
    assert Speech(WORDS).markup(html) == html.replace("<p>space", "<p>spazio")


def test_that_lessons_are_being_read_is_said_in_each_language():
    assert all(words_in(language)(READING) != READING for language in OTHERS)


def test_a_link_to_an_erratum_parts_no_sentence():
    link = '<button class="erratum" title="What is printed">two</button>'
    speech = Speech(Words([Message("The notes have <0>two</0>.", "Le dispense ne hanno <0>due</0>.")]))
    assert (
        speech.markup(f"<p>The notes have {link}.</p>")
        == f"<p>Le dispense ne hanno {link.replace('>two<', '>due<')}.</p>"
    )


def test_a_translation_that_lags_behind_is_told_with_its_line():
    file = TOP / "lessons/it/first_arm.po"
    header, found = read_po(file.name, file.read_text(encoding="utf-8"))
    lagging = write_po(header, [*found[1:], Message("Said long ago.", "Detto tempo fa.")])
    line = lagging[: lagging.index("Said long ago.")].count("\n") + 1
    assert list(compared(lesson("first_arm"), "it/first_arm.po", lagging)) == [
        "it/first_arm.po: no translation of 'Your first arm'",
        f"it/first_arm.po:{line}: the lesson does not say 'Said long ago.' any more",
    ]


def test_two_students_read_two_languages_and_one_changes_it(url):
    async def main():
        english, italian = cookie_of(url), cookie_of(url)
        asked_for(url, italian, "it")
        one, other = await student(url, english), await student(url, italian)
        await settled(one)
        await settled(other)
        for _ in range(2):
            await one.open("statics")
            await other.open("statics")
            await other.open("joints")
            await one.open("joints")
        assert "Joint variables" in one.html()
        assert "Variabili di giunto" not in one.html()
        assert 'id="al-words"' not in one.html()
        assert "Variabili di giunto" in other.html()
        assert "Joint variables" not in other.html()
        await other.press("search", "annulla")
        await other.until(lambda: 'data-cell="hit command:undo"' in other.html())
        await other.open("picture")
        await other.press("en")
        await other.until(lambda: 'id="al-anew"' in other.html())
        again = await student(url, italian)
        await again.open("joints")
        assert "Joint variables" in again.html()
        assert 'id="al-anew"' not in one.html()
        for browser in (one, other, again):
            await browser.close()

    run(main())


@pytest.mark.parametrize("text", ["Open " * 20_000, "Undo: " * 1_000, "Ab. " * 5_000, "{0} " * 5_000])
def test_a_long_text_that_somebody_wrote_is_left_as_it_is(text):
    speech = Speech(words_in("it"))
    assert speech.text(text) == text
    assert speech.markup(f"<p>{text}</p>") == f"<p>{text}</p>"


def test_the_language_of_the_browser_holds_until_one_is_chosen():
    assert preferred("it-IT,it;q=0.9,en;q=0.8") == "it"
    assert preferred("de, it;q=0.4, en;q=0.5") == preferred("") == preferred("x;q=y") == ENGLISH
    assert LanguagePart().read_in("it") == "it"
    assert LanguagePart(ENGLISH).read_in("it") == ENGLISH
    assert set(languages()) == set(keys())


def test_a_language_is_the_students_own_and_travels_in_no_link():
    mine = apply(State.initial(PUMA), ReadIn("it"))
    assert short(mine) == short(State.initial(PUMA))
    shared = apply(mine, OpenShared(short(apply(State.initial(PUMA), ReadIn(ENGLISH)))))
    chosen = apply(shared, ReadIn(ENGLISH))
    assert shared[LanguagePart].chosen == "it"
    assert apply(chosen, BackFromShared())[LanguagePart].chosen == ENGLISH
    assert LanguagePart.from_json("of long ago", PUMA).chosen == OF_BROWSER


WORDS = Words(
    [
        Message("{0} of {1} solutions", "{0} soluzioni su {1}"),
        Message("Drag the <0>handle</0> along <1/>.", "Lungo <1/> trascina la <0>maniglia</0>."),
        Message("Undo: {what}", "Annulla: {what}"),
        Message("move joint {0}", "muovi il giunto {0}"),
        Message("Both text {text}", "Anche {text}"),
        Message("One < two & more", "Uno > due & altri"),
        Message("Space", "Spazio"),
        Message("space", "spazio"),
    ]
)


@pytest.mark.parametrize(
    ("english", "said"),
    [
        ("<p>2 of 8 solutions</p>", "<p>2 soluzioni su 8</p>"),
        (
            '<p>Drag the <b class="x">handle</b>\n along <math><mi>q</mi></math>.</p>',
            '<p>Lungo <math><mi>q</mi></math> trascina la <b class="x">maniglia</b>.</p>',
        ),
        ('<i title="Undo: move joint 3">UR5</i>', '<i title="Annulla: muovi il giunto 3">UR5</i>'),
        ("<p>✓ 1 of 2 solutions, mm</p>", "<p>✓ 1 soluzioni su 2, mm</p>"),
        ("<p>1 of 2 solutions,\u00a0°/s</p>", "<p>1 soluzioni su 2,\u00a0°/s</p>"),
        ("<p>Undo: PUMA</p>", "<p>Annulla: PUMA</p>"),
        ("<p>Both text nobody knows</p>", "<p>Both text nobody knows</p>"),
        ("<p>One &lt; two &amp; more</p>", "<p>Uno &gt; due &amp; altri</p>"),
        ("<textarea>move joint 3</textarea>", "<textarea>move joint 3</textarea>"),
        ("<p><b>move joint 1</p>", "<p><b>muovi il giunto 1</p>"),
        (
            "<p>The points of <strong>space</strong> on <em>Space</em>, of <em>space</em>.</p>",
            "<p>The points of <strong>space</strong> on <em>Spazio</em>, of <em>space</em>.</p>",
        ),
        ("<p>✓ <strong>space</strong> 1.2</p>", "<p>✓ <strong>spazio</strong> 1.2</p>"),
        (
            "<h3><small>2 of 8 solutions</small> Nobody knows <em>a <b>space</b></em><i>x</i> space</h3>",
            "<h3><small>2 soluzioni su 8</small> Nobody knows <em>a <b>space</b></em><i>x</i> space</h3>",
        ),
    ],
)
def test_markup_is_said_in_the_language(english, said):
    assert Speech(WORDS).markup(english) == said


def test_what_a_script_is_told_is_said_too():
    notes = json.dumps({"tab": "move joint 1", "path": "move joint 1", "hidden": ["move joint 2"]})
    said = Speech(WORDS).markup(f'<i data-notes="{notes.replace(chr(34), "&#34;")}"></i>')
    assert said.count("muovi il giunto") == 2
    assert "move joint 1" in said, "an address stays"


def test_an_option_is_chosen_in_one_language_and_heard_in_english():
    from viser import _messages

    door = Door(Speech(WORDS))
    props = _messages.GuiDropdownProps(0.0, "move joint 1", None, True, False, ("move joint 1", "move joint 2"))
    made = door.out(_messages.GuiDropdownMessage("u", "move joint 2", "root", props))
    assert made.props.options == ("muovi il giunto 1", "muovi il giunto 2")
    assert (made.value, props.options[0]) == ("muovi il giunto 2", "move joint 1")
    heard = door.back(_messages.GuiUpdateMessage("u", {"value": "muovi il giunto 1"}))
    assert heard.updates == {"value": "move joint 1"}
    assert door.out(heard).updates == {"value": "muovi il giunto 1"}
    # What no page of ours sends goes on to where it is refused.
    strange = _messages.GuiUpdateMessage(["u"], {"value": "muovi il giunto 1"})
    assert door.back(strange) is strange


@pytest.mark.parametrize("text", ['msgid "a"\nmsgstr "b"\n\nmsgid "a"\nmsgstr "c"\n', 'msgid "a"\nmsgstr b\n'])
def test_a_broken_catalogue_is_refused_with_its_line(text):
    with pytest.raises(ContentError, match=r"^x\.po: line \d"):
        read_po("x.po", text)


def test_a_label_of_the_scene_is_said_and_stays_on_its_page():
    """A node of another owner would be another one, which no later message moves or writes to."""
    door = Door(Speech(Words([Message("target", "obiettivo")])))
    label = viser_messages.LabelMessage(
        "/name", viser_messages.LabelProps("target", "screen", 1.0, 0.1, False, "center-center")
    )
    update = viser_messages.SceneNodeUpdateMessage("/name", {"text": "target"})
    for message in (label, update):
        message.owner = "this page"
        said = door.out(message)
        assert said.owner == "this page"
        assert said.name == "/name"
    assert (label.props.text, update.updates) == ("target", {"text": "target"}), "the lab's own record stays English"
    assert (door.out(label).props.text, door.out(update).updates) == ("obiettivo", {"text": "obiettivo"})
