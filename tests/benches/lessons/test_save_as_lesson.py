"""A lesson written of the lab as it stands: the benches begin in it as they were."""

import json

import numpy as np
import pytest

from armlab.benches.lessons.author.begun import begun_as
from armlab.benches.lessons.author.ui.page import page_beside
from armlab.benches.lessons.author.write_lesson import lesson_text
from armlab.content.bench_words import BenchWord
from armlab.content.lesson_file import parse_lesson
from armlab.content.lessons import lesson
from armlab.content.robots import catalogue
from armlab.session.panel_commands import OpenPanel, OpenWindow, SeeTabs
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.panels import Window
from armlab.session.state import State, apply
from armlab.session.words import command_of
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.play import problems
from support.small_lessons import library_fixture

own = pytest.fixture(library_fixture, name="own")

WORK = [
    ("control.exponential.set_entry", {"name": "a11", "value": -0.5}),
    ("control.follow.add_run", {}),
    ("iterate.newton_1d.type_equation", {"text": "x^3 - 2"}),
    ("iterate.runs.set", {"most": 5}),
    ("motion.curves.add_knot", {"after": 1}),
    ("motion.laws.add_law", {}),
    ("motion.space_curve.choose_curve", {"key": "formula"}),
    ("pose.tool.invert", {}),
    ("robot.normal.place_lines", {"kind": "parallel"}),
    ("velocity.speeds.set_speed", {"joint": 0, "value": 0.1}),
    ("velocity.statics.set_component", {"kind": "force", "axis": 0, "value": 3}),
    ("workspace.what_if.suppose", {"row": 0, "field": "a", "value": 1.25}),
]


def worked(robot="planar_2r"):
    """Return a state in which somebody has worked at many benches."""
    state = apply(State.initial(catalogue()[robot]), MoveJoint(0, 0.7))
    for word, given in WORK:
        state = apply(state, command_of(BenchWord(word, given, "f.md", "", "")))
    return state


def text_of(state):
    return lesson_text("Mine", catalogue()["planar_2r"], state[Joints].q, begin=tuple(begun_as(state)))


def test_the_benches_begin_as_they_were(own):
    state = worked()
    own(mine=text_of(state))
    assert problems("mine") == []
    opened = apply(State.initial(catalogue()["puma560"]), OpenLesson("mine"))
    benches = {word.split(".")[-2] for word, _ in begun_as(state)}
    assert len(benches) >= 10
    for kind in {part.key for part in state if part.saved} - {
        "joints",
        "target",
        "lesson",
        "timeline",
        "shelf",
        "former",
        "display",
    }:
        (one,) = (part.to_json() for part in opened if part.key == kind)
        (other,) = (part.to_json() for part in state if part.key == kind)
        assert json.dumps(one) == json.dumps(other), kind


def test_only_the_fields_that_were_set_are_written():
    set_one = ("sensor.incremental.set", {"pulses": 16})
    state = apply(State.initial(catalogue()["planar_2r"]), command_of(BenchWord(*set_one, "f.md", "", "")))
    assert list(begun_as(state)) == [set_one]
    assert 'command = "sensor.incremental.set"\npulses = 16\n' in text_of(apply(state, MoveJoint(0, 0.7)))


@pytest.mark.parametrize(
    ("panel", "opens"), [("incremental_encoder", "incremental_encoder"), ("share", "joints"), ("help", "joints")]
)
def test_a_lesson_opens_on_the_page_that_was_open_before_that_for_teachers(panel, opens):
    state = apply(State.initial(catalogue()["planar_2r"]), OpenWindow(1, Window.on(panel)))
    state = apply(apply(state, OpenPanel("author", 1)), SeeTabs(1, frozenset({"lessons"})))
    assert page_beside(state, 1) == opens
    assert page_beside(state, 2) == "joints"


def test_a_lab_as_it_opens_writes_no_commands():
    state = apply(State.initial(catalogue()["planar_2r"]), MoveJoint(0, 0.7))
    assert "[[do]]" not in text_of(state)
    parsed = parse_lesson("mine", text_of(state))
    assert parsed.begin == ()
    # Files have eleven decimals of a degree.
    np.testing.assert_allclose(parsed.steps[0].solution[0].q, state[Joints].q, rtol=0, atol=1e-12)


def test_the_lesson_that_is_written_is_read_by_the_library(own):
    own(mine=text_of(worked()))
    assert len(lesson("mine").begin) == len(list(begun_as(worked())))
