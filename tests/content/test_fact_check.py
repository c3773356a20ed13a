"""The check of a fact: what it takes from a file, when it is met, and what it says."""

import math
import re

import numpy as np
import pytest

from armlab.content.check import Words, read_check
from armlab.content.checks.fact import FactIs
from armlab.content.fact_words import said
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import catalogue
from armlab.content.seen_fact import SeenFact, read_value
from armlab.errors import ContentError, InputError
from armlab.session.facts import facts_of_benches, seen_facts
from armlab.session.state import State

ROBOT = catalogue()["planar_2r"]
WORD = "tab.page.fact"


def check(text):
    table = Table.parse("f.md", f'kind = "fact"\nfact = "{WORD}"\n{text}')
    table.where = "step 1.check"
    return read_check(table, ROBOT)


def seen(value, unit="", slow=False):
    return Observation.of(ROBOT.arm, [0, 0], facts={WORD: SeenFact("the thing", unit, value, slow)})


@pytest.mark.parametrize(
    ("text", "met", "not_met"),
    [
        ("value = 2\ntolerance = 0.5", [1.5, 2.0, 2.5], [1.49, 2.51, math.inf, "2", True, (2.0,), None]),
        ("value = 3", [3.0], [2.0, 3.0001, None]),
        ("at_least = 1", [1.0, 5.0, math.inf], [0.99, None, True, "1"]),
        ("at_most = 1", [1.0, -5.0], [1.01, None]),
        ("at_least = 1\nat_most = 2", [1.0, 2.0], [0.9, 2.1]),
        ("value = [1, 2]\ntolerance = 0.1", [(1.05, 1.95)], [(1.2, 2.0), (1.0,), (1.0, 2.0, 3.0), 1.0, None]),
        ("component = 2\nvalue = 5\ntolerance = 0.1", [(0.0, 5.0)], [(5.0, 0.0), (5.0,), 5.0]),
        ('value = "up"', ["up"], ["down", 1.0, None]),
        ("value = true", [True], [False, 1.0, None]),
        ("value = false", [False], [True, 0.0, None]),
        ("value_deg = 90\ntolerance_deg = 1", [math.radians(89.5)], [math.radians(88), 90.0]),
        ("at_least_deg = 10", [math.radians(11)], [math.radians(9)]),
        ("value = 1\ntolerance = 0.1", [1.1, 0.9], [1.1001, 0.8999]),
        ("value = [1, 2]\ntolerance = 0.1", [(1.1, 1.9)], [(1.1001, 1.9)]),
        ("at_most = 0.7", [700 * 1e-3], [0.70001]),
        ("at_least = -0.7", [-700 * 1e-3], [-0.70001]),
        ("at_least = 0", [0.0], [-1e-12]),
    ],
)
def test_a_check_is_met_by_what_it_asks_for(text, met, not_met):
    asked = check(text)
    for value in met:
        assert asked.is_met(seen(value)), value
    for value in not_met:
        assert not asked.is_met(seen(value)), value
    assert not asked.is_met(Observation.of(ROBOT.arm, [0, 0]))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "value: expected either value, or at_least and at_most or one of them"),
        ("value = 1\nat_least = 0", "value: expected either value, or at_least"),
        ("at_least = 2\nat_most = 1", "at_most: expected at least 2, got 1"),
        ("value = 1\ntolerance = -1", "tolerance: expected a number not below zero"),
        ('value = "x"\ntolerance = 1', "tolerance: expected a number not below zero, with a value that is a number"),
        ("value = 1\ntolerance_deg = 1", "value: expected all numbers in degrees, or none"),
        ('value_deg = "x"', "value_deg: expected a number or a list of numbers, got 'x'"),
        ("value = []", r"value: expected a number or a list of numbers, got \[\]"),
        ("value = [1, 'x']", r"value\[2\]: expected a number"),
        ("component = 0\nat_least = 1", "component: expected a whole number from 1 to 100"),
        ("at_lest = 1\nvalue = 1", "at_lest: unknown key; did you mean 'at_least'"),
        ('value = 1\nfact = "x"', "not valid TOML"),
    ],
)
def test_a_broken_check_is_a_sentence(text, says):
    with pytest.raises(ContentError, match=says):
        check(text)


def test_the_sentence_says_what_is_and_what_is_asked():
    asked = check("value = [1, 2]\ntolerance = 0.1")
    assert asked.says(seen((1.0, 3.0), "N")) == "The thing: (1, 3) N. Required: (1, 2) N ± 0.1 N."
    assert asked.says(seen((1.0, 2.0), "N")) == "The thing: (1, 2) N."
    assert asked.says(seen(None)) == "The thing: not there yet, or this arm does not have it."
    assert asked.says(seen(None, slow=True)) == "The thing: not known yet."
    assert asked.says(Observation.of(ROBOT.arm, [0, 0])) == "Tab.page.fact: not known yet."
    both = check("component = 1\nat_least = 1\nat_most = 2")
    assert both.says(seen((0.0,))) == "The thing, component 1: 0. Required: at least 1 and at most 2."


@pytest.mark.parametrize(
    ("body", "value", "unit", "says"),
    [
        ("at_least_deg = 60", math.radians(59.96), "rad", "a little less than 60.0°. Required: at least 60.0°."),
        ("at_most = 0.25", 0.2501, "m", "a little more than 0.250 m. Required: at most 0.250 m."),
        ("value = 2\ntolerance = 0.5", 1.49999, "N", "a little less than 1.5 N. Required: 2 N ± 0.5 N."),
        ("value = 2", 2.00001, "", "a little more than 2. Required: 2."),
        ("at_least_deg = 60", math.radians(59.94), "rad", "59.9°. Required: at least 60.0°."),
        ("at_least_deg = 60", math.radians(60), "rad", "60.0°."),
    ],
)
def test_a_number_that_misses_its_end_by_less_than_is_shown_says_so(body, value, unit, says):
    assert check(body).says(seen(value, unit)) == f"The thing: {says}"


def test_a_key_is_told_in_words():
    fact = SeenFact("the thing", "", "one", names={"one": "the first", "two": "the second"})
    now = Observation.of(ROBOT.arm, [0, 0], facts={WORD: fact})
    assert check('value = "two"').says(now) == "The thing: the first. Required: the second."
    assert check('value = "one"').says(now) == "The thing: the first."
    assert check('value = "six"').says(now) == "The thing: the first. Required: six."


def test_a_component_that_will_never_be_is_told():
    third = check("component = 3\nat_least = 1")
    assert third.says(seen((1.0, 2.0))) == "The thing, component 3: there are only 2 components."
    assert third.says(seen((1.0,))) == "The thing, component 3: there is only one component."
    assert third.says(seen(None, slow=True)) == "The thing, component 3: not known yet."


@pytest.mark.parametrize(
    ("title", "begun"),
    [("the rank of J", "The rank of J"), ("r of the planar 3R", "r of the planar 3R"), ("x(t)", "x(t)")],
)
def test_a_sentence_begins_with_a_capital_unless_a_formula_does(title, begun):
    now = Observation.of(ROBOT.arm, [0, 0], facts={WORD: SeenFact(title, "", 1.0)})
    assert check("at_most = 2").says(now) == f"{begun}: 1."


def test_the_torque_of_an_arm_with_a_slide_is_not_promised_for_later():
    word = "velocity.statics.largest_torque"
    facts = seen_facts(State.initial(catalogue()["scara"]), (word,))
    says = FactIs(word, at_most=1.0).says(Observation.of(catalogue()["scara"].arm, [0] * 4, facts=facts))
    assert says.startswith("The largest torque of a joint: not there yet, or this arm does not have it")


def test_lengths_and_angles_are_in_the_units_of_the_screen():
    words = Words(lambda x: f"{1000 * x:.0f} mm", lambda x: f"{x:.2f} rad")
    assert check("at_most = 1").says(seen(0.25, "m"), words) == "The thing: 250 mm."
    assert said((0.5, 1.0), "rad", words) == "(0.50 rad, 1.00 rad)"


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (100_000.0, "", "100000"),
        (-3.0, "N", "−3 N"),
        (1e-15, "N m", "0 N m"),
        (0.00012345, "", "0.0001234"),
        (math.inf, "", "∞"),
        (-math.inf, "", "−∞"),
        (False, "", "no"),
        ("elbow up", "", "elbow up"),
        (None, "m", "–"),
    ],
)
def test_values_in_words(value, unit, text):
    assert said(value, unit) == text


def begun(title):
    """Return how a check's sentence on a fact begins."""
    seen = Observation.of(ROBOT.arm, [0, 0], facts={WORD: SeenFact(title, "", 1.0)})
    return FactIs(WORD, at_least=0.0).says(seen)[0]


def test_a_sentence_on_a_fact_begins_with_a_capital_where_its_title_begins_with_a_word():
    titles = {fact.title for found in facts_of_benches().values() for fact in found.facts.values()}
    words = [title for title in titles if re.match(r"(?:[a-z]{2,}|a)(?: |$)", title)]
    assert len(words) > 300
    assert [title for title in words if begun(title) != title[0].upper()] == []


def test_a_title_leaves_the_keys_of_values_that_have_words_to_the_guide_for_authors():
    named = [fact for found in facts_of_benches().values() for fact in found.facts.values() if fact.names]
    keys = [key for fact in named for key in fact.names if re.search(rf"[(,] ?{re.escape(key)}\b", fact.title)]
    assert keys == []
    assert [fact.title for fact in named if re.search(r"\bkey\b", fact.title)] == []


def test_a_value_that_is_a_question_needs_no_full_stop():
    seen = SeenFact("what is shown", "", "things", names={"things": "2 Robot or not?", "laws": "3 Three laws"})
    says = FactIs(WORD, value="laws").says(Observation.of(ROBOT.arm, [0, 0], facts={WORD: seen}))
    assert says == "What is shown: 2 Robot or not? Required: 3 Three laws."


def test_a_check_names_its_fact_for_the_lab():
    assert FactIs(WORD, at_least=1.0).facts == (WORD,)


@pytest.mark.parametrize("value", [None, True, "x", 1.5, [1, 2.5]])
def test_values_are_read_back(value):
    assert read_value(value, "told") == (tuple(map(float, value)) if isinstance(value, list) else value)


@pytest.mark.parametrize("value", [math.nan, 1e7, ["x"], [[1]], {}, "x" * 65, [0.0] * 101])
def test_other_values_are_refused(value):
    with pytest.raises(InputError, match="told"):
        read_value(value, "told")


def test_numbers_of_degrees_are_kept_in_radians():
    np.testing.assert_allclose(check("value_deg = [90, 180]\ntolerance_deg = 1").value, [math.pi / 2, math.pi])
