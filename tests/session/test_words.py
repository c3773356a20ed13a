"""The words of benches' commands: which there are, and how their arguments are read."""

import importlib
import inspect
import json
import math
import pkgutil
import types
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from armlab.benches.control.loop.state import Loop
from armlab.benches.lessons.author.begun import begun_as
from armlab.benches.lessons.errata.state import Errata
from armlab.content.bench_words import BenchWord
from armlab.content.lesson_lines import LessonError
from armlab.content.robots import catalogue
from armlab.errors import ArmlabError, UnknownName
from armlab.session.arguments import kind_of
from armlab.session.fields import fields_of
from armlab.session.state import Command, State, apply
from armlab.session.words import command_of, pages_with_words, snake_case, word, words_of

ARMS = ("planar_2r", "planar_3r", "puma560")
PAGES = [page for page in pages_with_words() if words_of(page)]

MADE_UP = {
    "a text": ("x", "", "q1 + 1"),
    "a whole number": (0, 1, 99, -1),
    "a number": (0.5, -3.0, 1e9, 0),
    "true or false": (False, True),
    "a text, a number, or true or false": ("x", 0.5, True, 3, [1, 2]),
    "a list of numbers": ([], [0.1, 0.2], [0.1] * 6),
    "a list of whole numbers": ([20, 60], [], [7.0], [0, -1, 99]),
    "a list of lists of numbers": ([[0, 0], [1, 1], [2, 0]], []),
    "a list of 3 numbers": ([0.1, 0.2, 0.3],),
}
"""Values by how a kind of argument is described."""

POSES = (
    {"position": [0.3, 0.2, 0.1], "rpy_deg": [0, 10, 0]},
    [[1, 0, 0, 0.3], [0, 1, 0, 0.2], [0, 0, 1, 0.1], [0, 0, 0, 1]],
)
TASKS = ({"task": "xy", "joints": [[1, 0.5]]}, {"task": "xy", "joints": [[99, 0.1]]})


def written(name, /, **given):
    return BenchWord(name, given, "f.md", "step 1.solution", "do[1]", "\n\n[[do]]\n")


def told(state, command):
    """Return why a command is refused, or the names of the parts it leaves; anything but a refusal is raised."""
    try:
        return " ".join(apply(state, command).to_json())
    except ArmlabError as refusal:
        return str(refusal)


def values_of(says):
    """Return values that a kind of argument takes."""
    if says in MADE_UP:
        return MADE_UP[says]
    if says.startswith("a pose"):
        return POSES
    if says.startswith("a table of task"):
        return TASKS
    return [json.loads(each) if each[0] in "-0123456789" else each for each in says.split(" or ")]


@pytest.mark.parametrize("page", PAGES)
def test_every_command_is_done_or_refused_with_a_sentence(page):
    for robot in ARMS:
        begun = State.initial(catalogue()[robot])
        for known in words_of(page).values():
            for k in range(5):
                choices = [(one.name, values_of(one.kind.says)) for one in known.arguments]
                given = {name: values[(k + i) % len(values)] for i, (name, values) in enumerate(choices)}
                command = command_of(written(known.name, **given))
                assert isinstance(command, Command)
                assert len(told(begun, command)) > 5, known.name


@pytest.mark.parametrize("page", PAGES)
def test_every_argument_of_a_wrong_type_is_named_and_says_what_was_expected(page):
    for known in words_of(page).values():
        for one in known.arguments:
            others = {each.name: values_of(each.kind.says)[0] for each in known.arguments}
            with pytest.raises(LessonError, match=rf"{known.name}: expected .*, got \{{'no': 1\}}") as error:
                command_of(written(known.name, **{**others, one.name: {"no": 1}}))
            assert error.value.key == f"step 1.solution.do[1].{one.name}"


def commands_in(package):
    """Yield the public commands that the modules of a page define."""
    for info in pkgutil.iter_modules(importlib.import_module(package).__path__):
        if not info.ispkg:
            module = importlib.import_module(f"{package}.{info.name}")
            for name, found in inspect.getmembers(module, inspect.isclass):
                if issubclass(found, Command) and found.__module__ == module.__name__ and not name.startswith("_"):
                    yield found


def test_only_events_of_a_drag_and_what_several_are_made_of_have_no_word():
    left_out = {
        f"{page}.{found.__name__}"
        for page, package in pages_with_words().items()
        for found in commands_in(package)
        if f"{page}.{snake_case(found.__name__)}" not in words_of(page)
    }
    assert sum(len(words_of(page)) for page in pages_with_words()) > 180
    for name in left_out:
        known = name in ("motion.plan.PlanCommand", "body.forms.TurnBody")
        assert known or name.rpartition(".")[2].startswith("Drag"), name
    assert {"motion.plan.PlanCommand", "body.forms.TurnBody"} < left_out


def test_a_word_says_what_it_does_and_takes():
    known = word("velocity.statics.set_component")
    assert known.says.startswith("Set one component of the force")
    assert [(one.name, one.kind.says) for one in known.arguments] == [
        ("kind", "a text"),
        ("axis", "a whole number"),
        ("value", "a number"),
    ]


def test_the_fields_that_a_part_declares_are_set_by_one_word():
    known = word("control.loop.set")
    assert {"mass", "gain"} < {one.name for one in known.arguments} == fields_of(Loop).keys() - {"example"}
    begun = State.initial(catalogue()["planar_2r"])
    state = apply(begun, command_of(written("control.loop.set", gain=25, kind="step")))
    assert (state[Loop].gain, state[Loop].kind, state[Loop].mass, state[Loop].example) == (25.0, "step", 1.0, "")
    assert apply(begun, command_of(written("control.loop.set", gain=10))) is begun
    with pytest.raises(LessonError, match=r"control\.loop\.set: expected some of mass, gain"):
        command_of(written("control.loop.set"))
    with pytest.raises(ArmlabError, match="expected"):
        apply(begun, command_of(written("control.loop.set", gain=-1)))


def test_degrees_and_millimetres_are_written_behind_the_name():
    turned = command_of(written("velocity.speeds.set_speed", joint=1.0, value_deg=90))
    assert (turned.joint, turned.value) == (1, math.radians(90))
    put = command_of(written("robot.table.set_point", xyz_mm=[100, 0, -50]))
    np.testing.assert_allclose(put.xyz, (0.1, 0.0, -0.05), rtol=0, atol=1e-15)
    started = command_of(written("iterate.runs.set_start", q_deg=[180, 0]))
    np.testing.assert_allclose(started.q, (math.pi, 0.0), rtol=0, atol=1e-15)


@pytest.mark.parametrize("chapter", [4, "4"])
def test_a_choice_of_digits_is_written_as_a_number_or_a_text(chapter):
    state = State.initial(catalogue()["planar_2r"])
    assert apply(state, command_of(written("lessons.errata.set", chapter=chapter)))[Errata].chapter == "4"


@pytest.mark.parametrize("chapter", [8, True, 4.5])
def test_a_choice_of_digits_is_no_other_number(chapter):
    with pytest.raises(LessonError, match=rf"chapter: .*expected all or 1 or .*, got {chapter}"):
        command_of(written("lessons.errata.set", chapter=chapter))


def test_what_is_left_out_is_as_the_command_has_it():
    assert command_of(written("iterate.runs.add_run")).method == "newton"
    assert command_of(written("motion.plan.last_for")).duration is None


@pytest.mark.parametrize(
    ("name", "given", "says"),
    [
        ("velocity.staticks.set_component", {}, r"do\[1\].command: page of a word: unknown name 'velocity.staticks'"),
        ("velocity.statics.set_componnt", {}, "did you mean 'velocity.statics.set_component'"),
        ("velocity.statics.drag_force", {}, "unknown name 'velocity.statics.drag_force'"),
        ("velocity.statics.set_component", {"knd": "force"}, r"do\[1\].knd: .*unknown argument; did you mean 'kind'"),
        ("velocity.statics.set_component", {"kind": "force", "axis": 0}, r"value: .*missing; expected kind \(a text\)"),
        ("velocity.statics.set_component", {"kind": 1, "axis": 0, "value": 1}, "kind: .*expected a text, got 1"),
        ("velocity.statics.set_component", {"kind": "f", "axis": 0.5, "value": 1}, "expected a whole number, got 0.5"),
        (
            "velocity.statics.set_component",
            {"kind": "f", "axis": True, "value": 1},
            "expected a whole number, got True",
        ),
        ("velocity.speeds.set_speed", {"joint": 0, "value": 1, "value_deg": 1}, "expected one of value and value_deg"),
        ("velocity.speeds.set_speed", {"joint_deg": 0, "value": 1}, "joint_deg: .*unknown argument"),
        ("velocity.speeds.set_speed", {"joint": 0, "value": math.inf}, "expected a finite number, got inf"),
        ("control.follow.set_value", {"key": "speed", "value_deg": "x"}, "expected a number or a list of numbers"),
        ("robot.table.set_point", {"xyz": [1, 2]}, r"expected a list of 3 numbers, got \[1, 2\]"),
        ("motion.curves.set_limit", {"which": "j_max", "value": 1}, "expected v_max or a_max, got 'j_max'"),
        ("motion.plan.set_waypoint_pose", {"k": 1, "pose": [[1]]}, "four rows of four numbers"),
        ("motion.plan.set_waypoint_pose", {"k": 1, "pose": {"positio": [1, 2, 3]}}, "positio: unknown key"),
        ("iterate.runs.choose_task", {"task": {"task": "zz"}}, "the name of a task"),
    ],
)
def test_a_wrong_word_or_argument_is_a_sentence_with_its_place(name, given, says):
    with pytest.raises(LessonError, match=says) as error:
        command_of(written(name, **given))
    assert error.value.line == 3
    assert str(error.value).startswith("f.md, line 3: step 1.solution.do[1]")


def test_the_words_there_are_are_listed():
    with pytest.raises(UnknownName, match=r"velocity\.statics\.release_wrench"):
        word("velocity.statics.nothing")


def test_what_no_file_can_say_has_no_kind():
    assert kind_of(object) is None
    assert kind_of(tuple[object, ...]) is None
    assert kind_of(object | None) is None


def test_an_array_is_known_by_an_alias_of_its_type_as_numpy_has_one_since_2_5():
    class Alias:
        __value__ = np.ndarray[Any, Any]

    alias, plain = kind_of(types.GenericAlias(Alias, (np.float64,))), kind_of(NDArray[np.float64])
    assert alias.says == plain.says == "a pose: four rows, or a table of position and rpy_deg"


def test_a_bench_is_put_as_it_was_saved():
    begun = State.initial(catalogue()["planar_2r"])
    worked = apply(begun, command_of(written("velocity.statics.set_component", kind="moment", axis=2, value=3)))
    ((name, given),) = begun_as(worked)
    assert name == "velocity.statics.set"
    assert apply(begun, command_of(written(name, **given))).to_json() == worked.to_json()
    assert list(begun_as(begun)) == []


@pytest.mark.parametrize("saved", ["", "{", "3", '{"force": "x"}', "null", "[[]]"])
def test_what_was_not_saved_by_the_lab_is_refused(saved):
    for name in ("velocity.statics.put", "control.follow.put", "motion.plan.put"):
        with pytest.raises(ArmlabError, match="what was saved is not usable with this arm"):
            apply(State.initial(catalogue()["planar_2r"]), command_of(written(name, saved=saved)))
