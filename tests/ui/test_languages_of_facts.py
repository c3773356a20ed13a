"""What checks say of facts is said in each language as a whole: the fact, its value and the one that is required."""

import re
from dataclasses import replace
from typing import get_args

import numpy as np
import pytest

from armlab.content.checks.fact import FactIs
from armlab.content.languages import keys, words_in
from armlab.content.observation import Observation
from armlab.content.robots import catalogue
from armlab.content.seen_fact import SeenFact
from armlab.content.stand_ins import without_numbers
from armlab.content.words import has_words
from armlab.kin.ik.iterate.flow import FlowStatus
from armlab.kin.ik.iterate.trace import Status
from armlab.kin.ik.solutions import Completeness
from armlab.kin.screw_motion import Kind
from armlab.kin.velocity.answer import Verdict
from armlab.session.facts import facts_of_benches

FACTS = {f"{key}.{name}": fact for key, found in facts_of_benches().items() for name, fact in found.facts.items()}

CONDITIONS = {
    "number": (
        {"value": 2.0, "tolerance": 0.5},
        {"at_least": 2.0},
        {"at_most": 0.5},
        {"at_least": 2.0, "at_most": 3.0},
    ),
    "count": ({"value": 2},),
    "numbers": ({"value": (2.0, 3.0), "tolerance": 0.5}, {"component": 2, "value": 2}, {"component": 3, "value": 2}),
    "text": ({"value": "2"},),
    "truth": ({"value": True},),
}
"""Conditions by the kind of a fact, none of which is met."""

VALUES = {"number": 1.0, "count": 1, "numbers": (1.0, 1.5), "text": "1", "truth": False}

ENGLISH = re.compile(
    r"\b(?:the|of|is|are|with|whether|how|at (?:least|most)|required|component|not|yet|only|yes)\b", re.I
)
"""Words of the sentences in English; none of these is without one."""


PROPER_NAMES = ("robot.history.event", "robot.history.definition")
"""Facts whose keys stand for names of robots and of standards."""


AS_THEY_ARE = {
    *("body.meanings.axis", "body.products.axes", "body.products.formula", "body.products.typed"),
    *("frames.chain.reference", "frames.chain.frame", "frames.chain.way", "frames.chain.given", "frames.two.name"),
    *("help.identities.left", "help.identities.right", "help.identities.names"),
    *("help.identities.left_functions", "help.identities.right_functions", "lessons.errata.chosen"),
    *("lessons.errata.severity", "pose.tool.reference", "pose.tool.frame", "robot.table.kinds"),
    *("robot.table.structure", "sensor.absolute.word", "target.solutions.at"),
}
"""Facts whose value is no key: a name, a formula, or words."""


def said_of(word, fact):
    """Yield what is said of a fact that is not known yet, not there, or has another value than the required one."""
    bare = Observation.of(catalogue()["planar_2r"].arm, np.zeros(2))
    for given in CONDITIONS[fact.kind]:
        for value, slow in ((VALUES[fact.kind], False), (None, False), (None, True)):
            seen = SeenFact(fact.title, fact.unit, value, slow, fact.names)
            yield FactIs(word, **given).says(replace(bare, facts={word: seen}))


def test_a_fact_that_is_a_text_has_words_for_its_keys_or_is_a_name_or_a_formula():
    assert {word for word, fact in FACTS.items() if fact.kind == "text" and not fact.names} == AS_THEY_ARE


@pytest.mark.parametrize(
    ("word", "every"),
    [
        ("iterate.runs.status", {*get_args(Status), *get_args(FlowStatus), "refused"}),
        ("velocity.solve.solutions", set(get_args(Verdict))),
        ("target.solutions.known", set(get_args(Completeness))),
        ("frames.screw.kind", set(get_args(Kind))),
    ],
)
def test_each_key_has_its_words(word, every):
    assert set(FACTS[word].names) == every


@pytest.mark.parametrize("language", keys()[1:])
def test_the_words_for_keys_are_known_in_the_language(language):
    words = words_in(language)
    told = [fact for word, fact in FACTS.items() if word not in PROPER_NAMES]
    names = {without_numbers(name).text for fact in told for name in fact.names.values()}
    assert [name for name in names if words.find(name) is None and has_words(name)] == []


@pytest.mark.parametrize("language", keys()[1:])
def test_what_is_said_of_every_fact_is_in_the_language_as_a_whole(language):
    words = words_in(language)
    titles = {fact.title: words(fact.title) for fact in FACTS.values()}
    assert [title for title, said in titles.items() if said == title and has_words(title)] == []
    wrong = []
    for word, fact in FACTS.items():
        begin = titles[fact.title][1:]  # the first letter is a capital
        wrong += [
            (text, said)
            for text in said_of(word, fact)
            if not (said := words(text))[1:].startswith(begin) or ENGLISH.search(said)
        ]
    assert wrong == []
