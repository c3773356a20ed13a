"""A lesson and the benches: facts in its text as they are at the moment, and what a question leaves in the scene."""

import re

import pytest

from armlab.benches.velocity.statics.state import SetComponent
from armlab.content.robots import catalogue
from armlab.session.state import State, apply
from armlab.teaching.lesson_commands import GoToStep, OpenLesson
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui.html import Markup
from armlab.ui.plugin import OF_THE_ARM, hidden_layers, panel
from armlab.ui.speech import speech_in
from armlab.window.lesson.text import step_text, with_values
from support.bench_lesson import BENCHES
from support.small_lessons import library_fixture

own = pytest.fixture(library_fixture, name="own")


def shown(state):
    """Return the live values in the text of the shown step, by name."""
    part = state[LessonPart]
    return dict(re.findall(r'data-live="([^"]*)">([^<]*)<', step_text(state, part.lesson, part.index)))


def test_a_fact_in_a_text_follows_the_bench(own):
    own(benches=BENCHES)
    state = apply(State.initial(catalogue()["planar_2r"]), OpenLesson("benches", variant=0))
    assert shown(state) == {"velocity.statics.torques": "(17.32, 0)"}
    state = apply(state, SetComponent("force", 1, 10.0))
    assert shown(state) == {"velocity.statics.torques": "(8.66, 0)"}
    assert shown(apply(state, GoToStep(1)))["velocity.speeds.turning_speed"] == "0.5236 rad/s"


def test_a_fact_that_nobody_publishes_is_a_dash(own):
    own(benches=BENCHES.replace("speeds.turning_speed", "speeds.turning"))
    state = apply(State.initial(catalogue()["planar_2r"]), OpenLesson("benches", variant=0))
    assert shown(apply(state, GoToStep(1)))["velocity.speeds.turning"] == "–"


def test_a_fact_that_is_a_choice_is_in_words_which_are_said_in_the_language_of_the_reader():
    state = apply(State.initial(catalogue()["planar_2r"]), OpenLesson("what_is_a_robot"))
    i = next(i for i, step in enumerate(state[LessonPart].lesson.steps) if "robot.history.decision" in _checked(step))
    live = Markup('<p>So <output class="live" data-live="robot.history.decision">…</output>.</p>')
    text = with_values(apply(state, GoToStep(i)), live)
    assert ">it has to do it</output>" in text
    assert ">deve farla</output>" in speech_in("it").markup(text)
    number = '<output class="live" data-live="q1">30.0°</output>'
    assert speech_in("it").markup(number) == number


def _checked(step):
    return () if step.check is None else step.check.facts


def test_a_prediction_hides_facts(own):
    asked = 'kind = "number"\ntext = "x?"\nanswer = 1\ntolerance = 0.1\nhide = ["values"]'
    own(benches=BENCHES.replace("```check", f"```question\n{asked}\n```\n\n```check", 1))
    state = apply(State.initial(catalogue()["planar_2r"]), OpenLesson("benches", variant=0))
    assert shown(state) == {"velocity.statics.torques": "?"}


def test_a_prediction_on_a_page_without_the_arm_brings_no_arm(own):
    asked = 'kind = "number"\ntext = "x?"\nanswer = 1\ntolerance = 0.1\nhide = ["values"]'
    own(benches=BENCHES.replace("```check", f"```question\n{asked}\n```\n\n```check", 1))
    state = apply(State.initial(catalogue()["planar_2r"]), OpenLesson("benches", variant=0))
    assert {*OF_THE_ARM, "gizmo"} <= hidden_layers(state, [panel("motor")])
    assert not {"arm", "gizmo"} & hidden_layers(state, [panel("velocity")])
