"""Each row of the course's inventory has something that computes it, a page that shows it, and a step that teaches it.

``OPEN`` is what is still missing. Where a row of it has come to have what it lacked, the test asks for its line to be
taken out.
"""

import re

import pytest

from armlab.content.citations import functions
from armlab.content.lessons import lessons
from armlab.content.rows import SECTION, reference, rows
from armlab.session.pages import pages
from support.rows_taught import exists, named, seen, table

ROW = re.compile(r"S[1-7AR][.\d]*-")

OPEN = {
    "S2.3.3-force": "core page lesson",
    "S2.3.4-vision": "core page lesson",
}
"""Rows without all of core, page and step of a lesson, and what they lack."""


def test_the_table_has_each_row_of_the_notes_once():
    assert len(table()) == len(rows()) == 206
    for part, entries in named().items():
        assert set(entries) <= set(rows()), f"[{part}] names rows that the notes do not have"
        assert list(entries) == [row for row in rows() if row in entries], f"[{part}] is not in the order of the notes"


def test_what_is_open_is_in_the_list_and_nothing_else():
    lack = {row: " ".join(each.lacks) for row, each in table().items() if each.lacks}
    assert lack == OPEN, "\n" + "\n".join(amiss(lack, OPEN))
    assert list(OPEN) == [row for row in rows() if row in OPEN]


def test_of_each_row_that_a_page_claims_something_is_seen_on_it():
    unseen = [row for row, each in table().items() if each.pages and not each.shown]
    assert not unseen, f"name what is seen of {', '.join(unseen)}, in [shown]"


def test_a_row_without_anything_says_so_and_no_other_does():
    nothing = [row for row, each in table().items() if not (each.core or each.pages or each.lessons)]
    assert [row.id for row in rows().values() if row.absent] == nothing == list(OPEN)
    assert all(rows()[row].absent.startswith("The lab has no") for row in nothing)


def test_a_row_that_is_no_longer_open_is_to_be_struck_out_of_the_list():
    assert amiss({"SR-R4": "lesson"}, {"SR-R4": "lesson"}) == []
    assert amiss({}, {"SR-R4": "lesson"}) == ["SR-R4: it lacks nothing now; strike it out of OPEN"]
    assert amiss({"SR-R4": "page"}, {"SR-R4": "page lesson"}) == ["SR-R4: it lacks page; OPEN says page lesson"]


def test_a_row_without_a_step_names_the_lessons_that_claim_it():
    (said,) = amiss({"SR-R4": "lesson"}, {})
    assert said == "SR-R4: it lacks lesson; OPEN says nothing; name the step of skeleton that teaches it, in [taught]"


def amiss(lack, listed):
    """Return a line for each row whose lack is not what the list says, and what is to be done."""
    return [_said(row, lack.get(row), listed.get(row)) for row in rows() if lack.get(row) != listed.get(row)]


def _said(row, lacks, listed):
    if lacks is None:
        return f"{row}: it lacks nothing now; strike it out of OPEN"
    claimed = ", ".join(table()[row].lessons) if "lesson" in lacks else ""
    step = f"; name the step of {claimed} that teaches it, in [taught]" if claimed else ""
    return f"{row}: it lacks {lacks}; OPEN says {listed or 'nothing'}{step}"


@pytest.mark.parametrize("row", named()["core"])
def test_a_core_is_named_where_no_function_cites_the_row_and_it_is_there(row):
    assert exists(named()["core"][row])
    assert not [one.name for one in functions() if any(map(rows()[row].cites, one.cites.references))]


def test_a_core_that_is_not_there_is_noticed():
    assert not exists("armlab.kin.growth.shrinking")
    assert not exists("armlab.kin.shrinking")
    assert not exists("armlab.kin.arm.Arm.dance")
    assert not exists("robots/r2d2")


@pytest.mark.parametrize("row", named()["taught"])
def test_a_row_is_taught_in_the_step_that_is_named_by_a_lesson_that_claims_it(row):
    key, step = named()["taught"][row]
    lesson = lessons().lessons[key]
    assert row in lesson.teaches
    assert step in [each.title for each in lesson.steps]


@pytest.mark.parametrize("lesson", lessons().lessons.values(), ids=lambda lesson: lesson.key)
def test_a_lesson_claims_rows_that_there_are(lesson):
    assert set(lesson.teaches) <= set(rows())


@pytest.mark.parametrize("key", pages())
def test_a_page_claims_rows_that_there_are(key):
    claimed = [about for about in pages()[key].about if ROW.match(about)]
    assert set(claimed) <= set(rows())


@pytest.mark.parametrize("key", pages())
def test_a_section_or_an_equation_of_a_page_is_one_of_the_rows_that_it_claims(key):
    """So that whoever looks for a number comes to a page on which something of it is."""
    about = pages()[key].about
    claimed = [rows()[row] for row in about if row in rows()]
    for place in filter(SECTION.fullmatch, about):
        assert any(f"{row.section}.".startswith(f"{place}.") for row in claimed), f"{key}: section {place}"
    for place in (each for each in about if each.startswith("(")):
        cited = reference("equation", place[1:-1])
        assert cited is not None, f"{key}: {place}"
        assert any(row.cites(cited) for row in claimed), f"{key}: equation {place}"


@pytest.mark.parametrize("row", [row.id for row in rows().values() if row.core])
def test_a_row_names_what_computes_it_only_where_nothing_cites_its_numbers(row):
    there = {one.name: one.cites.references for one in functions()}
    assert set(rows()[row].core) <= set(there)
    assert not [name for name, cited in there.items() if any(map(rows()[row].cites, cited))]


@pytest.mark.parametrize("row", named()["shown"])
def test_what_is_said_to_be_seen_of_a_row_is_seen_on_a_page_that_claims_it(row):
    page, example, text, *steps = named()["shown"][row]
    assert row in pages()[page].about
    assert text in seen(page, example, *steps)


def test_what_is_not_on_a_page_is_not_seen_there():
    assert "15.47" not in seen("market", "market/falling")
    assert "Unimate" not in seen("market", "market/whole")
