"""Where in the course errata are met."""

from armlab.benches.lessons.errata.places import named_in, taught_in
from armlab.content.errata import errata, erratum
from armlab.content.lessons import lessons


def test_lessons_that_name_an_erratum_are_found_with_the_step():
    places = named_in(lessons())
    (place,) = places["1.58"]
    assert (place.lesson, lessons()["error_dynamics"].title) == ("error_dynamics", place.title)
    assert "/erratum/1.58" in lessons()["error_dynamics"].steps[place.step].texts
    assert places.keys() <= errata().keys()


def test_every_erratum_is_named_by_a_lesson():
    named = named_in(lessons())
    assert [key for key in errata() if key not in named] == []


def test_no_lesson_names_an_erratum_by_its_bare_mark():
    assert not [each.key for each in lessons().lessons.values() if any("ERR-" in step.texts for step in each.steps)]


def test_a_lesson_that_names_it_twice_is_listed_once():
    assert [place.lesson for place in named_in(lessons())["6.145"]] == ["path_geometry"]


def test_other_lessons_on_its_topic_are_listed_besides():
    found = dict(taught_in(erratum("1.18"), lessons()))
    named = {place.lesson for place in named_in(lessons())["1.18"]}
    assert named
    assert not named & found.keys()
    assert all(set(lessons()[key].teaches) & set(erratum("1.18").rows) for key in found)
