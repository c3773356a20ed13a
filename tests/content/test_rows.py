"""The inventory of the course notes."""

import random
from collections import Counter

import pytest

from armlab.content.rows import Reference, chapters, known, parse_rows, reference, rows, suggest, unknown
from armlab.errors import ContentError

HEAD = '[chapters]\n4 = "Kinematics"\n'
ROW = '[[rows]]\nid = "S4.1-dh"\nsection = "4.1"\ntitle = "DH"\nequations = ["4.10-4.14"]\nwords = ["table"]\n'


def test_all_rows_are_there_chapter_by_chapter():
    counts = Counter(row.chapter for row in rows().values())
    assert counts == {"1": 27, "2": 20, "3": 24, "4": 29, "5": 39, "6": 39, "7": 10, "A": 5, "R": 13}
    assert len(rows()) == 206
    assert list(chapters()) == ["1", "2", "3", "4", "5", "6", "7", "A", "R"]


def test_every_row_has_a_title_of_its_own_and_other_words():
    titles = Counter(row.title for row in rows().values())
    assert [title for title, count in titles.items() if count > 1] == []
    assert [row.id for row in rows().values() if not row.words or len(row.title) > 70] == []


def test_ids_begin_with_their_section():
    for row in rows().values():
        place = row.id.partition("-")[0].removeprefix("S")
        assert row.section == place.removesuffix(".0")


def test_equations_lie_in_the_chapter_of_their_row():
    for row in rows().values():
        if row.chapter not in "AR":
            assert {one.chapter for one in row.references if one.kind == "equation"} <= {int(row.chapter)}


def test_equations_of_the_notes_are_covered_without_holes():
    """Robots repeat equations of the text, 6.112 is a case of its own; 5.66 stands alone and empty."""
    last = {1: 58, 2: 45, 3: 133, 4: 129, 5: 164, 6: 186, 7: 28}
    for chapter, highest in last.items():
        spans = [one for row in rows().values() for one in row.references if one[:2] == ("equation", chapter)]
        covered = {number for one in spans for number in range(one.first, one.last + 1)}
        assert set(range(1, highest + 1)) - covered == ({66} if chapter == 5 else set())
        assert max(covered) == highest


@pytest.mark.parametrize(
    ("id_", "section", "cited"),
    [
        ("S3.2.2-inverse", "3.2.2", ("equation", 3, 62, 68)),
        ("S4.3-ur10", "4.3", ("figure", 4, 8, 8)),
        ("S4.1-common-normal", "4.1", ("definition", 0, 6, 7)),
        ("S3.3.2-rpy", "3.3.2", ("theorem", 0, 2, 2)),
        ("SR-2R", "R", ("equation", 4, 44, 44)),
        ("S4.0-2R", "4", ("equation", 4, 5, 7)),
    ],
)
def test_a_row_has_the_numbers_of_the_notes(id_, section, cited):
    assert rows()[id_].section == section
    assert cited in rows()[id_].references


@pytest.mark.parametrize(
    ("kind", "text", "expected"),
    [
        ("equation", "3.66", ("equation", 3, 66, 66)),
        ("equation", "4.91–4.94", ("equation", 4, 91, 94)),
        ("definition", "6", ("definition", 0, 6, 6)),
        ("equation", "4.94-4.91", None),
        ("equation", "4.91-5.2", None),
        ("equation", "66", None),
        ("theorem", "2.1", None),
        ("equation", "4.1.2", None),
        ("equation", "", None),
    ],
)
def test_a_reference_is_a_number_or_a_range(kind, text, expected):
    assert reference(kind, text) == expected


def test_references_meet_where_they_share_a_number():
    rng = random.Random(0)
    for _ in range(300):
        (a, b), (c, d) = (sorted(rng.choices(range(1, 12), k=2)) for _ in range(2))
        together = bool(set(range(a, b + 1)) & set(range(c, d + 1)))
        assert Reference("equation", 4, a, b).meets(Reference("equation", 4, c, d)) == together
        assert not Reference("equation", 4, a, b).meets(Reference("equation", 3, c, d))
        assert not Reference("equation", 4, a, b).meets(Reference("figure", 4, c, d))


def test_known_ids_are_exact():
    assert known("S4.1-dh")
    assert not known("s4.1-DH")
    assert not known("")


@pytest.mark.parametrize(
    ("typed", "meant"),
    [("S4.1-hd", "S4.1-dh"), ("s4.1-DH", "S4.1-dh"), ("S5.2.1-dsl", "S5.2.1-dls"), ("4.2", "S4.2-ws1")],
)
def test_an_unknown_row_gets_suggestions(typed, meant):
    assert meant in suggest(typed)
    assert repr(typed) in unknown(typed)
    assert meant in unknown(typed)
    assert all(known(row) for row in suggest(typed))


def test_at_every_id_one_letter_is_forgiven():
    for row in rows():
        assert row in suggest(row[:-1])


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        (ROW, "chapters"),
        (HEAD + ROW + ROW, "comes twice"),
        (HEAD + ROW.replace("S4.1-dh", "dh"), "expected an id"),
        (HEAD + ROW.replace('section = "4.1"', 'section = "5.1"'), "expected a section"),
        (HEAD + ROW.replace("4.10-4.14", "4.14-4.10"), "expected numbers"),
        (HEAD + ROW + 'numbered = ["picture 3"]\n', "figure 4.8"),
        (HEAD + ROW + 'wrods = ["a"]\n', "wrods"),
        (HEAD + ROW.replace('["table"]', '"table"'), "a list of texts"),
    ],
)
def test_a_mistake_in_the_file_is_named(text, problem):
    with pytest.raises(ContentError, match=problem):
        parse_rows(text)


def test_the_file_as_it_should_be_is_read():
    titles, found = parse_rows(HEAD + ROW)
    assert titles == {"4": "Kinematics"}
    assert found["S4.1-dh"].equations == ("4.10-4.14",)
