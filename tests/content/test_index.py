"""The index: words, sections and equations of the notes to rows, lessons, benches and functions."""

import pkgutil
import random
import string

import pytest

from armlab.content.citations import citations, functions
from armlab.content.index import Taught, Thing, search
from armlab.content.lessons import lessons
from armlab.content.query import one_slip, plain, terms_of
from armlab.content.rows import chapters, known, rows
from armlab.content.synonyms import GROUPS, synonyms

THINGS = (
    Thing("bench", "table", "Table", ("4.1", "S4.1-dh", "DH table"), "Robot"),
    Thing("bench", "ellipsoid", "Ellipsoid", ("5.3", "velocity ellipsoid")),
    Thing("bench", "target", "Target", ("S4.3-multiplicity", "(4.115-4.116)", "inverse kinematics")),
    Thing("arm", "kr6r900", "KUKA KR 6 R900", ("cobot",), detail="A spherical wrist."),
    Thing("command", "undo", "Undo", ("take back",)),
    Thing("export", "table.csv", "The table as CSV", ("save",)),
)
TAUGHT = (
    Taught("stretch", "Stretch the arm", "5 Singularities", ("S5.1.4-2R", "S5.3-manipulability")),
    Taught("table_of_2r", "A first table", "4 Tables", ("S4.1-dh",)),
)


def find(text, limit=20):
    return search(text, limit, things=THINGS, taught=TAUGHT)


def keys(text, kind=None, limit=1000):
    return [entry.key for entry in find(text, limit) if kind in (None, entry.kind)]


# --- Numbers


@pytest.mark.parametrize(
    "text", ["3.66", "(3.66)", "eq 3.66", "eq. (3.66)", "Equation 3.66", "eqn 3.66", "3.66-3.67", "equations 3.63–3.66"]
)
def test_an_equation_is_found_however_it_is_written(text):
    assert keys(text, "row") == ["S3.2.2-inverse"]
    assert "armlab.kin.rotations.axis_angle" in keys(text, "function")


def test_every_equation_of_the_inventory_is_found_by_its_number():
    for row in rows().values():
        for number in row.equations:
            assert row.id in keys(f"({number.partition('-')[0]})", "row")


def test_a_number_alone_is_a_section_before_an_equation():
    found = keys("4.1", "row")
    assert found[:4] == ["S4.1-common-normal", "S4.1-dh", "S4.1-dh-chain", "S4.1-dh-caveats"]
    assert "S4.0-spaces" in found
    assert keys("(4.1)", "row") == ["S4.0-spaces"]
    assert "S4.0-spaces" not in keys("section 4.1", "row")


def test_subsections_come_after_their_section():
    found = keys("section 4.3", "row")
    assert found[0] == "S4.3-multiplicity"
    assert set(found) == {row.id for row in rows().values() if row.section.startswith("4.3")}
    assert keys("§ 4.3.3", "row") == ["S4.3.3-ik-2R"]


def test_a_section_without_rows_leads_to_the_one_it_is_in():
    assert keys("section 1.4.1", "row") == ["S1.4-definitions"]


@pytest.mark.parametrize("text", ["4", "chapter 4", "ch. 4"])
def test_a_chapter_is_found_with_all_its_rows(text):
    assert find(text)[0].kind == "chapter"
    assert keys(text, "row") == [row.id for row in rows().values() if row.chapter == "4"]


@pytest.mark.parametrize(
    ("text", "row", "function"),
    [
        ("theorem 2", "S3.3.2-rpy", "armlab.kin.rotations.rotation_from_sequence"),
        ("definition 3", "S3.2.1-skew", "armlab.kin.rotations.skew"),
        ("def. 7", "S4.1-common-normal", "armlab.kin.lines.common_normal"),
        ("fig 4.8", "S4.3-ur10", "armlab.kin.structure"),
    ],
)
def test_figures_definitions_and_theorems_are_found(text, row, function):
    assert row in keys(text, "row")
    assert function in keys(text, "function")


def test_ids_are_found_in_any_letters_and_by_their_beginning():
    assert keys("s4.1-DH", "row") == ["S4.1-dh", "S4.1-dh-chain", "S4.1-dh-caveats"]
    assert set(keys("S4.1", "row")) == {row.id for row in rows().values() if row.id.startswith("S4.1-")}
    assert set(keys("SR-", "row")) == {row.id for row in rows().values() if row.chapter == "R"}


def test_each_row_is_the_first_for_its_own_id_and_for_its_title():
    for row in rows().values():
        assert find(row.id)[0].key == row.id
        assert find(row.title)[0].key == row.id


# --- Words


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("forward kinematics", "S4.0-2R"),
        ("rodriges", "S3.2.1-rodrigues"),
        ("Rodrigues' formula", "S3.2.1-rodrigues"),
        ("jacobain", "S5.1.1-analytic"),
        ("manipul", "S5.3-manipulability"),
        ("pseudo-inverse", "S5.2.2-pinv"),
        ("DLS", "S5.2.1-dls"),
        ("denavit-hartenburg", "S4.1-dh"),
        ("gimbal lock", "S3.3.1-zxz"),
        ("what is a harmonic drive", "S2.2.1-harmonic"),
        ("Capek", "S1.5-robota"),
        ("SLERP", "S6.3.3-axis-angle"),
        ("LSPB", "S6.2.1-linear-parabolic"),
        ("fk 2r", "S4.0-2R"),
    ],
)
def test_words_and_their_synonyms_are_found(text, expected):
    assert keys(text, "row")[0] == expected


def test_a_word_of_the_title_comes_before_a_synonym():
    found = keys("pseudoinverse", "row")
    assert found.index("S5.2.2-pinv") < found.index("S1.2.1-min-norm")


def test_every_word_has_to_be_there_if_anything_has_them_all():
    every = set(keys("inverse kinematics", "row"))
    assert {"S4.3.3-ik-2R", "S4.3.5-ik-elbow"} <= every
    assert set(keys("inverse kinematics elbow", "row")) < every
    assert keys("quaternion zzzzz", "row") == keys("quaternion", "row")


def test_a_number_and_a_word_narrow_each_other():
    assert keys("4.3 tangent", "row") == ["S4.3-tan-half"]


def test_one_slip_anywhere_is_forgiven():
    rng = random.Random(1)
    for word, row in (("quaternion", "S3.2.3-quaternion"), ("manipulability", "S5.3-manipulability")):
        for _ in range(40):
            i, letter = rng.randrange(len(word)), rng.choice(string.ascii_lowercase)
            left_out, mistaken, added = (
                word[:i] + word[i + 1 :],
                word[:i] + letter + word[i + 1 :],
                word[:i] + letter + word[i:],
            )
            exchanged = word[:i] + word[i : i + 2][::-1] + word[i + 2 :]
            for typed in (left_out, mistaken, added, exchanged):
                assert row in keys(typed, "row"), typed


@pytest.mark.parametrize(("a", "b"), [("axis", "axsi2"), ("torque", "torque"), ("abcd", "badc"), ("spline", "line")])
def test_more_than_one_slip_is_another_word(a, b):
    assert not one_slip(a, b)
    assert not one_slip(b, a)


# --- What belongs together


def test_a_row_leads_to_lessons_benches_and_functions():
    (row,) = (entry for entry in find("S4.1-dh") if entry.key == "S4.1-dh")
    assert row.lessons == ("table_of_2r",)
    assert row.benches == ("table",)
    assert {"armlab.kin.dh", "armlab.kin.dh.link_transform", "armlab.kin.moves.moves_of"} <= set(row.functions)
    assert row.detail == "Section 4.1; equations 4.10-4.14"


def test_a_row_without_cited_equations_has_the_functions_that_it_names_and_none_of_its_section():
    (row,) = find("S4.1-dh-caveats", 1)
    assert row.functions == ("armlab.kin.relations.axis_relations",)
    (row,) = find("S1.7-history", 1)
    assert row.functions == ()
    assert "armlab.kin.assignment" in keys("section 4.1", "function"), "found by its section, which is no claim"


def test_a_topic_that_the_lab_does_not_have_says_so():
    (row,) = find("force sensors")
    assert (row.key, row.absent) == ("S2.3.3-force", rows()["S2.3.3-force"].absent)
    assert row.absent.startswith("The lab has nothing on force sensors")
    assert all(not entry.absent or entry.kind == "row" for entry in find("sensors", 1000))


def test_lessons_are_found_by_what_they_teach_and_by_their_title():
    assert "stretch" in keys("5.144", "lesson")
    assert "stretch" in keys("manipulability", "lesson")
    assert keys("strech", "lesson") == ["stretch"]
    (lesson,) = (entry for entry in find("stretch the arm") if entry.kind == "lesson")
    assert (lesson.title, lesson.detail, lesson.rows) == ("Stretch the arm", *TAUGHT[0][2:3], TAUGHT[0].teaches)


def test_benches_are_found_by_section_row_equation_and_word():
    assert keys("4.13", "bench") == ["table"]
    assert keys("4.8", "bench") == []
    assert keys("5.3", "bench") == ["ellipsoid"]
    assert keys("4.116", "bench") == ["target"]
    assert keys("velocity ellipsoid", "bench") == ["ellipsoid"]
    (bench,) = (entry for entry in find("target") if entry.kind == "bench")
    assert bench.rows == ("S4.3-multiplicity",)


def test_a_section_or_an_equation_of_a_bench_claims_no_row():
    """They say where it is found; the rows that are there it names itself."""
    assert find("S5.3-manipulability")[0].benches == ()
    assert find("S4.4.1-newton-redundant")[0].benches == ()
    assert "ellipsoid" not in keys("5.144", "bench")


def test_functions_have_their_first_line():
    (found,) = (entry for entry in find("3.16") if entry.kind == "function")
    assert found.key == "armlab.kin.rotations.rotation_about"
    assert found.detail.startswith("Return")
    assert found.rows == ("S3.1-elementary",)


def test_the_lessons_and_benches_of_one_query_are_not_in_the_next():
    assert keys("4.13", "bench") == ["table"]
    assert [entry for entry in search("4.13", taught=()) if entry.kind in ("bench", "lesson")] == []


def test_the_lessons_of_the_lab_are_in_the_index():
    for lesson in lessons().listed:
        row = next(row for row in lesson.teaches if known(row))
        assert lesson.key in [entry.key for entry in search(row, 1000) if entry.kind == "lesson"]


# --- Other things of the lab


@pytest.mark.parametrize(
    ("text", "first"),
    [
        ("undo", "undo"),
        ("take back", "undo"),
        ("kuka", "kr6r900"),
        ("kr 6", "kr6r900"),
        ("cobot", "kr6r900"),
        ("csv", "table.csv"),
        ("excel", "table.csv"),
        ("download", "table.csv"),
        ("robot table", "table"),
    ],
)
def test_arms_commands_and_files_are_found_by_title_words_synonyms_and_what_they_are_a_part_of(text, first):
    assert find(text)[0].key == first


def test_an_arm_is_found_by_its_line_after_what_has_the_words_as_a_name():
    assert keys("spherical wrist", "arm") == ["kr6r900"]
    assert keys("spherical wrist")[0] != "kr6r900"


def test_what_is_to_be_used_comes_before_what_is_only_to_be_read():
    found = [entry.kind for entry in find("ellipsoid", 1000)]
    assert found[0] == "bench"
    assert found.index("bench") < found.index("row") < found.index("function")


def test_the_other_number_of_a_word_is_no_slip():
    assert keys("ellipsoids")[0] == "ellipsoid"
    assert keys("tables")[0] == "table"
    assert "S5.1.4-singularity" in keys("singularities", "row")


@pytest.mark.parametrize(
    ("text", "place"),
    [("ellipsoid", ("bench", "ellipsoid")), ("5.3", ("bench", "ellipsoid")), ("kuka", ("arm", "kr6r900"))],
)
def test_what_is_hidden_is_not_found_and_no_topic_leads_to_it(text, place):
    def everything(hidden):
        return search(text, 1000, things=THINGS, taught=TAUGHT, hidden=hidden)

    assert place in [(entry.kind, entry.key) for entry in everything(frozenset())]
    found = everything({place})
    assert place not in [(entry.kind, entry.key) for entry in found]
    assert all(place[1] not in entry.benches for entry in found)


def test_every_synonym_stands_in_one_form_and_leads_to_the_others():
    for group in GROUPS:
        assert len(set(group)) == len(group)
        for word in group:
            assert word == word.casefold()
            if word == plain(word) and " " not in word:
                assert set(synonyms([word])) >= {other for other in group if other != word}


# --- The list


@pytest.mark.parametrize("text", ["", "   ", "?!", "\n"])
def test_an_empty_query_gives_the_chapters_with_counts(text):
    found = find(text)
    assert [entry.key for entry in found] == list(chapters())
    assert found[0].detail.startswith("27 topics, ")
    assert found[3].detail.startswith("29 topics, 1 lesson, ")
    assert sum(len(entry.rows) for entry in found) == 206


def test_the_order_is_stable_and_the_limit_cuts_its_end():
    for text in ("kinematics", "4.3", "velocity", "rotation matrix"):
        everything = find(text, 1000)
        assert len({(entry.kind, entry.key) for entry in everything}) == len(everything)
        assert everything == find(text, 1000)
        for limit in (0, 1, 5):
            assert find(text, limit) == everything[:limit]


def test_nothing_is_found_for_nonsense():
    assert find("zzzzqqq xxyyy") == []
    assert find("9.9") == []


def test_any_text_can_be_asked():
    rng = random.Random(2)
    letters = "".join(chr(c) for c in range(32, 127)) + "°§–−’éčΘσ½²\n\t\u202e中😀"
    pieces = ["eq", "section", "4.1", "(", ")", "S4.1-", "3.66-3.6", "s-", "-", "'", "4.999999999999999999", "§"]
    for _ in range(400):
        text = "".join(
            rng.choice(letters) if rng.random() < 0.7 else rng.choice(pieces) for _ in range(rng.randrange(40))
        )
        assert all(entry.title for entry in find(text))
    assert find("a " * 10_000) == find("a " * 100)


# --- What functions cite


def test_what_is_named_exists_and_cites():
    assert len(functions()) > 30
    for one in functions():
        assert one.cites.references or one.cites.sections or any(one.name in row.core for row in rows().values())
        assert one.says
        assert one.says in pkgutil.resolve_name(one.name).__doc__


@pytest.mark.parametrize(
    ("text", "numbers", "sections"),
    [
        ("Return it. Notes 3.62-3.68.", ["3.62-68"], []),
        ("where the trace (3.63) loses digits. Equation 3.66 prints a half.", ["3.63", "3.66"], []),
        ("See eqs. 4.91-4.94 and (4.5), section 3.2 of the notes.", ["4.91-94", "4.5"], ["3.2"]),
        ("Notes 4.13-4.14 (standard); Craig, *Introduction to Robotics*, 3.6 (modified).", ["4.13-14"], []),
        ("Pieper 1968; notes, section 4.3.2; Siciliano et al., *Robotics*, 2.12.", [], ["4.3.2"]),
        ("Horn and Johnson, *Topics*, 1991, theorem 3.3.16.", [], []),
        ("Named in the notes before section 6.1; Biagiotti and Melchiorri 2008, section 2.2.2.", [], ["6"]),
        ("Notes, section 1.7; ISO 9283:1998, sections 7.2.1 and 7.2.2, for positions.", [], ["1.7"]),
        ("Chiaverini, Siciliano and Egeland, 1994, section 3.2 and (4.5). Notes 5.107.", ["5.107"], []),
        ("Sugihara 2011 (section 5.1.4), as in section 4.1 of the notes.", [], ["4.1"]),
        ("Lengths of 1.5 m and 3.5 rad, notes say; a tolerance of 1.2 mm.", [], []),
        ("Return 2.0 times 3.5.", [], []),
        ("Notes, definitions 6 and 7 and equations 4.8-4.9.", ["4.8-9", "definition 6-7"], []),
        ("Notes, definition 3.", ["definition 3"], []),
        ("*   Two circles (notes 4.44-4.65).\n*   Figure 4.8 too.", ["4.44-65", "figure 4.8"], []),
        ("Notes 3.16.\n\nExamples\n--------\n>>> f((3.5, 4.6), of=3.66)\n3.77", ["3.16"], []),
        ("Notes 9.1 and 0.5.", [], []),
    ],
)
def test_citations_are_those_of_the_notes(text, numbers, sections):
    def written(one):
        place = f"{one.chapter}.{one.first}" if one.chapter else str(one.first)
        kind = "" if one.kind == "equation" else f"{one.kind} "
        return f"{kind}{place}" + (f"-{one.last}" if one.last != one.first else "")

    found = citations(text)
    assert [written(one) for one in found.references] == numbers
    assert list(found.sections) == sections


def test_a_query_is_split_into_what_it_asks_for():
    found = terms_of("How do I use eq. (3.66), §4.1 and the pseudo-inverse?")
    assert [(term.kind, term.text) for term in found] == [
        ("word", "use"),
        ("equation", "3.66"),
        ("section", "4.1"),
        ("word", "pseudo-inverse"),
    ]
    assert [term.text for term in terms_of("what is it")] == ["what", "is", "it"]
