"""Each row of the course's inventory has something that computes it, a page that shows it, and a step that teaches it.

Whatever claims a row is opened, and the row's symbol, number or name is read there.

``OPEN`` is what is still missing. Where a row of it has come to have what it lacked, the test asks for its line to be
taken out.
"""

import re

import pytest

from armlab.content.citations import functions
from armlab.content.lessons import lessons
from armlab.content.rows import SECTION, reference, rows
from armlab.session.pages import pages
from support.claims import Proof, amiss
from support.rows_taught import exists, named, seen, steps_of, table

ROW = re.compile(r"S[1-7AR][.\d]*-")

OPEN = {
    "S2.3.3-force": "core page lesson",
    "S2.3.4-vision": "core page lesson",
}
"""Rows without all of core, page and lesson, and what they lack."""

MOST_STRANGERS = 1
"""Number of pages, as they are opened here, or of lessons that may have the text of a row without claiming the row."""


def test_the_table_has_each_row_of_the_notes_once():
    assert len(table()) == len(rows()) == 206
    for part, entries in named().items():
        assert set(entries) <= set(rows()), f"[{part}] names rows that the notes do not have"
        assert list(entries) == [row for row in rows() if row in entries], f"[{part}] is not in the order of the notes"


def test_what_is_open_is_in_the_list_and_nothing_else():
    lack = {row: " ".join(each.lacks) for row, each in table().items() if each.lacks}
    assert lack == OPEN, "\n" + "\n".join(changed(lack, OPEN))
    assert list(OPEN) == [row for row in rows() if row in OPEN]


def test_a_row_without_anything_says_so_and_no_other_does():
    nothing = [row for row, each in table().items() if not (each.core or each.pages or each.lessons)]
    assert [row.id for row in rows().values() if row.absent] == nothing == list(OPEN)
    assert all(rows()[row].absent.startswith("The lab has no") for row in nothing)


def test_a_row_that_is_no_longer_open_is_to_be_struck_out_of_the_list():
    assert changed({"SR-R4": "lesson"}, {"SR-R4": "lesson"}) == []
    assert changed({}, {"SR-R4": "lesson"}) == ["SR-R4: it lacks nothing now; strike it out of OPEN"]
    assert changed({"SR-R4": "page"}, {"SR-R4": "page lesson"}) == ["SR-R4: it lacks page; OPEN says page lesson"]


def changed(lack, listed):
    """Return a line for each row whose lack is not what the list says, and what is to be done."""
    return [_said(row, lack.get(row), listed.get(row)) for row in rows() if lack.get(row) != listed.get(row)]


def _said(row, lacks, listed):
    if lacks is None:
        return f"{row}: it lacks nothing now; strike it out of OPEN"
    return f"{row}: it lacks {lacks}; OPEN says {listed or 'nothing'}"


@pytest.mark.parametrize("row", named()["core"])
def test_a_core_is_named_where_no_function_cites_the_row_and_it_is_there(row):
    assert exists(named()["core"][row])
    assert not [one.name for one in functions() if any(map(rows()[row].cites, one.cites.references))]


def test_a_core_that_is_not_there_is_noticed():
    assert not exists("armlab.kin.growth.shrinking")
    assert not exists("armlab.kin.shrinking")
    assert not exists("armlab.kin.arm.Arm.dance")
    assert not exists("robots/r2d2")


def test_each_lesson_that_is_listed_claims_rows_and_all_such_that_there_are():
    claimed = {(lesson.key, row) for lesson in lessons().lessons.values() for row in lesson.teaches}
    assert [each for each in claimed if each[1] not in rows()] == []
    assert [lesson.key for lesson in lessons().listed if not lesson.teaches] == []


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


def test_of_each_row_that_a_page_claims_something_is_seen_on_that_page():
    claims = {row: each.pages for row, each in table().items()}
    proofs = {
        row: [Proof(one.page, one.text, seen(one.page, one.example, *one.steps)) for one in each.shown]
        for row, each in table().items()
    }
    opened = {(one.page, one.example, *one.steps) for each in table().values() for one in each.shown}
    everything: dict[str, str] = {}
    for page, *how in sorted(opened):
        everything[page] = f"{everything.get(page, '')} | {seen(page, *how)}"
    wrong = [*amiss(claims, proofs, everything, MOST_STRANGERS)]
    assert not wrong, "in [shown]:\n" + "\n".join(wrong)


def test_of_each_row_that_a_lesson_claims_a_step_speaks():
    claims = {row: each.lessons for row, each in table().items()}
    proofs = {
        row: [Proof(one.lesson, one.text, steps_of(one.lesson).get(one.step, "")) for one in each.said]
        for row, each in table().items()
    }
    everything = {key: " | ".join(steps_of(key).values()) for key in lessons().lessons}
    wrong = [*amiss(claims, proofs, everything, MOST_STRANGERS)]
    assert not wrong, "in [taught]:\n" + "\n".join(wrong)


def test_a_claim_is_true_only_if_a_text_of_its_own_is_read_there():
    def said(claims, *proofs, elsewhere=()):
        everything = {proof.place: proof.read for proof in proofs} | dict.fromkeys(elsewhere, "det J")
        return [*amiss({"a": claims, "b": ("p",)}, {"a": proofs, "b": [Proof("p", "b", "b")]}, everything, 1)]

    assert said(["p"], Proof("p", "det J", "det J = 0")) == []
    assert said(["p", "q"], Proof("p", "det J", "det J = 0")) == ["a: q claims it; name what is read of it there"]
    assert said([], Proof("p", "det J", "det J = 0")) == ["a: p does not claim it"]
    assert said(["p"], Proof("p", "det J", "rank J")) == ["a: 'det J' is not read at p"]
    assert said(["p"], *[Proof("p", "det J", "det J")] * 2) == ["a: p is named more than once"]
    assert said(["p"], Proof("p", "b", "b")) == ["b: 'b' of p is named for a already"]
    assert said(["p"], Proof("p", "det J", "det J = 0"), elsewhere="q") == []
    assert said(["p"], Proof("p", "det J", "det J = 0"), elsewhere="qr") == [
        "a: 'det J' is read as well at q, r, which do not claim it"
    ]


def test_what_is_not_on_a_page_is_not_seen_there():
    assert "15.47" not in seen("market", "market/falling")
    assert "Unimate" not in seen("market", "market/whole")
