"""One registry: a key never comes twice, and an unknown one is refused with a list of those there are."""

from types import SimpleNamespace

import pytest

from armlab.commands import command_types
from armlab.content.check import check_types
from armlab.content.question import question_types
from armlab.content.robots import catalogue
from armlab.content.vocabulary import vocabularies, with_added
from armlab.errors import PluginError, UnknownName
from armlab.kin.control.control_law import control_laws
from armlab.kin.control.rate_inverse import rate_inverses
from armlab.kin.ik.closed_form import closed_forms
from armlab.kin.ik.iterate.method import iteration_methods
from armlab.kin.ik.method import methods
from armlab.kin.motion.law_types import law_types
from armlab.kin.motion.path_types import path_types
from armlab.kin.task import NAMED
from armlab.kin.workspace.measures import MEASURES
from armlab.registry import Registry, known_name
from armlab.session.bench import benches
from armlab.session.facts import facts_of_benches
from armlab.session.job import jobs
from armlab.session.pages import pages
from armlab.session.parts.timeline import clips
from armlab.session.state import State
from armlab.ui.plugin import layers

FOUND = {
    "check": check_types,
    "clip": clips,
    "closed": closed_forms,
    "command": command_types,
    "bench": benches,
    "control law": control_laws,
    "facts": facts_of_benches,
    "inverse": rate_inverses,
    "job": jobs,
    "law": law_types,
    "layer": layers,
    "page": pages,
    "path": path_types,
    "question": question_types,
    "measure": lambda: MEASURES,
    "task": lambda: NAMED,
    "vocabulary": vocabularies,
}


def things(*keys):
    return [SimpleNamespace(key=key) for key in keys]


@pytest.mark.parametrize("word", FOUND)
def test_an_unknown_name_is_refused_with_what_there_is(word):
    there = FOUND[word]()
    key = next(iter(there))
    with pytest.raises(UnknownName, match=f"^{word}: unknown name '{key}x'.*{key}"):
        there[f"{key}x"]
    assert there[key].key == key


@pytest.mark.parametrize("known", [methods, iteration_methods])
def test_methods_of_both_kinds_are_called_so(known):
    with pytest.raises(UnknownName, match=r"^method: unknown name 'newtom'"):
        known()["newtom"]


@pytest.mark.parametrize("name", [None, 3, ["cubic"], {"cubic": 1}, b"cubic", float("nan")])
def test_what_can_be_no_name_is_refused_in_the_same_words(name):
    with pytest.raises(UnknownName, match="law: unknown name"):
        law_types()[name]
    with pytest.raises(UnknownName, match="axes: unknown name"):
        known_name("axes", name, ("zyx", "zxz"))
    assert law_types().get("no law") is None


def test_a_key_that_comes_twice_is_refused_with_both_places():
    with pytest.raises(PluginError, match=r"^b: the key 'one' is already used by a$"):
        Registry("law", things("one", "one"), ("a", "b"))
    with pytest.raises(PluginError, match=r"^example: the key 'one' is already used by example$"):
        Registry("example", things("one", "two", "one"))


def test_a_word_of_lesson_files_that_comes_twice_is_refused():
    assert with_added("live value", {"r": 1}, ({"s": 2}, {})) == {"r": 1, "s": 2}
    with pytest.raises(PluginError, match="live value: 'r' comes twice"):
        with_added("live value", {"r": 1}, ({"s": 2}, {"r": 3}))
    with pytest.raises(PluginError, match="live value: 's' comes twice"):
        with_added("live value", {"r": 1}, ({"s": 2}, {"s": 3}))


def test_things_stay_in_their_order():
    assert list(Registry("law", things("b", "a", "c"))) == ["b", "a", "c"]


@pytest.mark.parametrize("bench", benches().values(), ids=lambda bench: bench.key)
def test_examples_of_a_bench_are_looked_up_by_key_alone(bench):
    assert list(bench.examples) == [example.key for example in bench.examples.values()]
    with pytest.raises(UnknownName, match=r"^example: unknown name 'no such'"):
        bench.choose("no such").apply(State.initial(catalogue()["planar_2r"]))
