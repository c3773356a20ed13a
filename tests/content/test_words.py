"""Texts of the lab in the words of another language."""

import pytest

from armlab.content.po import Message
from armlab.content.stand_ins import UNIT_SIGNS
from armlab.content.words import Words


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("2 m away, turned by 1.5 rad at 3 rad/s", "a 2 m, ruotato di 1.5 rad a 3 rad/s"),
        ("2 mm away, turned by 1.5 rad at 3 rad/s", "a 2 mm, ruotato di 1.5 rad a 3 rad/s"),
        ("2 mm away, turned by 5° at 3 °/s", "a 2 mm, ruotato di 5° a 3 °/s"),
        ("moves in rad", "mosse in rad"),
        ("1.5 rad after 2 m", "1.5 rad after 2 m"),  # the translation has them in another order
    ],
)
def test_a_message_is_found_in_the_units_of_the_reader(text, says):
    known = [("{0} mm away, turned by {1}° at {2} °/s", "a {0} mm, ruotato di {1}° a {2} °/s")]
    known += [("moves in °", "mosse in °"), ("{0}° after {1} mm", "dopo {1} mm, {0}°")]
    assert Words([Message(*each) for each in known])(text) == says


def test_a_text_that_is_known_in_part_is_no_name():
    given = {"{text} is wrong.": "{text} è sbagliato.", "x": "x", "row": "riga", "It is right.": "È giusto."}
    known = Words([Message(source, text) for source, text in given.items()])
    assert known("row is wrong.") == "riga è sbagliato."
    assert known("It is right. Nobody knows is wrong.") == "È giusto. Nobody knows is wrong."


def test_a_message_that_begins_small_is_known_at_the_beginning_of_a_sentence_before_any_with_names():
    given = {"speed of the load": "velocità del carico", "Speed of {q}": "Velocità di {q}"}
    known = Words([Message(source, text) for source, text in given.items()])
    assert known("Speed of the load") == "Velocità del carico"
    assert known("Speed of q₁") == "Velocità di q₁"


def test_a_conjunction_is_said_only_with_the_words_around_it():
    known = Words([Message("and", "e"), Message("Two rules hold:", "Valgono due regole:")])
    assert known.find("Nobody knows this: <0/>, <1/>, and") is None
    assert known.find("Two rules hold: <0/>, <1/>, and") == "Valgono due regole: <0/>, <1/>, e"


def test_what_a_person_typed_comes_back_as_it_was_typed():
    given = {"{text}: got {typed}": "{text}: ricevuto {typed}", "speed": "velocità", "arm": "braccio"}
    known = Words([Message(source, text) for source, text in given.items()])
    assert known("speed: got 'arm'") == "velocità: ricevuto 'arm'"
    assert known("v: got arm") == "v: ricevuto arm", "a name without words fits as well"
    assert known("colour: got arm") == "colour: got arm", "one with unknown words does not"


def test_a_power_of_ten_is_part_of_its_number():
    words = Words([Message("largest error {0} of {1}", "errore massimo {0} su {1}")])
    assert words("largest error 1.2·10⁻¹⁶ of 3²") == "errore massimo 1.2·10⁻¹⁶ su 3²"
    assert words("largest error 10⁻¹⁶ of 5") == "errore massimo 10⁻¹⁶ su 5"


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("joint 2 at 30°: near by 5 mm", "giunto 2 a 30°: vicino di 5 mm"),
        ("joint 2 at 0.5 rad: near by 5 m", "giunto 2 a 0.5 rad: vicino di 5 m"),
        ("row 3 m of 1 rad at 0.5 rad: far by 2 m", "row 3 m of 1 rad a 0.5 rad: lontano di 2 m"),
        ("0.5 rad of the arm", "0.5 rad del braccio"),
        ("2 m, then 0.5 rad of near", "2 m, then 0.5 rad of near"),  # the translation has them in another order
    ],
)
def test_a_message_with_names_is_found_in_the_units_of_the_reader(text, says):
    given = {
        "{what} at {0}°: {how} by {1} mm": "{what} a {0}°: {how} di {1} mm",
        "{0}° of the {what}": "{0}° del {what}",
        "{0} mm, then {1}° of {what}": "{1}° di {what}, poi {0} mm",
        "joint {0}": "giunto {0}",
        "near": "vicino",
        "far": "lontano",
        "arm": "braccio",
    }
    assert Words([Message(source, text) for source, text in given.items()])(text) == says


@pytest.mark.parametrize("sign", ["∡", "↔", *UNIT_SIGNS])
def test_a_text_may_have_any_sign_that_stands_for_a_unit(sign):
    given = {"{what}: expected {0} mm, got {typed}": "{what}: atteso {0} mm, ricevuto {typed}", "{0} mm": "{0} mm"}
    known = Words([Message(source, text) for source, text in given.items()])
    got = f"Radius: expected 5 mm, got '1 {sign} 2'"
    assert known(got) == f"Radius: atteso 5 mm, ricevuto '1 {sign} 2'"
    for text in (got.replace("mm", "m"), f"1 {sign}", f"expected 5 m, got 1 {sign} 2{sign}"):
        known(text)  # in whatever language


def test_what_is_typed_ends_with_its_sentence_where_the_next_one_is_known():
    given = {"In {typed}.": "In {typed}.", "{text_why}. Go on.": "{text_why}. Avanti.", "No {text}": "Nessun {text}"}
    given |= {"Go on.": "Avanti.", "Old {typed}": "Vecchio {typed}", "arm": "braccio"}
    known = Words([Message(source, text) for source, text in given.items()])
    assert known("In rad/s. Go on.") == "In rad/s. Avanti."
    assert known("Old arm. Go on.") == "Vecchio arm. Avanti."
    assert known("Old arm. Ada") == "Vecchio arm. Ada", "a person may write a full stop"
