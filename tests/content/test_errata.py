"""The file of the errata: what it says, how it is searched, the tasks, and where lessons name them."""

import pytest

from armlab.commands._links import leading_nowhere
from armlab.content.errata import errata, erratum, find, linked, parse_errata
from armlab.content.errata_task import SO_PRINTED, read_task, task_of, with_tasks
from armlab.content.markdown import to_html
from armlab.content.question import read_question
from armlab.content.reader import Table
from armlab.content.rows import Reference
from armlab.errors import ContentError, UnknownName

ONE = """
[[errata]]
id = "1.58"
place = "equation 1.58"
section = "1.3"
severity = "A"
title = "The matrix exponential"
printed = '$T^{-1} E T$'
correct = '$T E T^{-1}$'
why = "The series."
rows = ["S1.3-matrix-exp"]
"""

TEXTS = ("printed", "correct", "why", "unrun", "title", "place")


@pytest.mark.parametrize("each", errata().values(), ids=lambda each: each.id)
def test_every_text_is_markdown_with_formulas_that_can_be_set(each):
    for key in TEXTS:
        text = getattr(each, key)
        assert text or key == "unrun"
        assert "<" in to_html(text or "-", "errata.toml", key)
    assert each.rows


@pytest.mark.parametrize("each", errata().values(), ids=lambda each: each.id)
def test_sentences_end_and_titles_do_not(each):
    assert each.why.endswith((".", "!"))
    assert not each.unrun or each.unrun.endswith(".")
    assert not each.title.endswith(".")
    assert each.title[0].isupper()


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (('id = "1.58"', 'id = "ERR-1.58"'), "errata[1].id: expected a chapter, a point, digits and letters"),
        (('severity = "A"', 'severity = "D"'), "errata[1].severity: unknown value 'D'"),
        (('section = "1.3"', 'section = "9.3"'), "errata[1].section: expected a section of the notes"),
        (('rows = ["S1.3-matrix-exp"]', 'rows = ["S1.3-matrix"]'), "unknown row of the inventory 'S1.3-matrix'"),
        (('why = "The series."', ""), "errata[1].why: missing"),
        (('why = "The series."', 'why = "The series."\nhow = 1'), "errata[1].how: unknown key"),
    ],
)
def test_a_mistake_in_the_file_is_said_with_its_place(change, says):
    with pytest.raises(ContentError) as refused:
        parse_errata(ONE.replace(*change))
    assert says in str(refused.value)


def test_an_id_that_comes_twice_is_refused():
    with pytest.raises(ContentError, match=r"'1\.58' comes twice"):
        parse_errata(ONE + ONE)


def test_an_unknown_id_is_refused_with_a_similar_one():
    with pytest.raises(UnknownName, match="did you mean"):
        erratum("1.85")


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("3.66", {"3.66"}),
        ("4.93", {"4.94"}),
        ("4.76", {"4.77", "4.81"}),
        ("5.117", {"5.107"}),
        ("harmonic", {"2.29"}),
        ("§ 1.4", {"1.H4"}),
        ("svd", {"5.125"}),
        ("harmonic quaternion", set()),
    ],
)
def test_errata_are_found_by_number_and_word(text, found):
    assert {each.id for each in find(text)} == found


def test_a_chapter_and_a_severity_narrow_what_is_found():
    assert {each.chapter for each in find(chapter="A")} == {"A"}
    assert {each.severity for each in find(severity="H")} == {"H"}
    assert len(find()) == 118
    assert find("quaternion", "C") == ()


def test_the_equations_of_a_place_are_read():
    assert erratum("4.94").references == (Reference("equation", 4, 85, 85), Reference("equation", 4, 92, 94))
    assert erratum("1.2").references == ()  # a section


# --- tasks


def test_every_erratum_of_severity_a_has_a_task_and_no_other():
    assert set(with_tasks()) == {each.id for each in errata().values() if each.severity == "A"}


@pytest.mark.parametrize("key", with_tasks())
def test_the_right_answer_of_a_task_is_right_and_its_mistakes_are_named(key):
    task = task_of(key)
    assert task.question.judge(task.question.right_answer).right
    for i, wrong in enumerate(task.question.wrong, start=1):
        assert task.question.judge(wrong.typed).name == f"wrong[{i}]"
    assert 0 < len(task.at) < len(task.places) or key in ("4.101", "6.6", "6.145")


def test_what_is_printed_is_a_mistake_of_most_tasks_by_itself():
    """Where it has no value, such as a product whose sizes do not fit, the sentence on that says enough."""
    unnamed = [key for key in with_tasks() if SO_PRINTED not in str([w.says for w in task_of(key).question.wrong])]
    assert unnamed == ["4.116", "5.58", "5.113", "5.141"]


def test_ten_tasks_are_a_choice_of_texts():
    assert sum(task_of(key).of_texts for key in with_tasks()) == 10


@pytest.mark.parametrize(
    ("task", "says"),
    [
        ({}, "has no task"),
        ({"parts": ["$a$"], "at": [2]}, "at: expected some of the parts (1,)"),
        ({"rows": [["$a$", "$b$"]], "at": [2]}, "at: expected some of the parts (1, 1), (1, 2)"),
        ({"rows": ["a"], "at": [1]}, "rows: expected rows of texts"),
    ],
)
def test_a_mistake_in_a_task_is_said(task, says):
    one = parse_errata(ONE)["1.58"]
    question = {"kind": "number", "text": "?", "answer": 1, "tolerance": 0.1} if task else {}
    with pytest.raises(ContentError) as refused:
        read_task(type(one)(**{**one.__dict__, "task": {**task, **question}}))
    assert says in str(refused.value)


def test_a_lesson_can_ask_for_the_correction_of_an_erratum():
    table = Table.parse("f.md", 'kind = "erratum"\ntext = "What is right?"\nerratum = "4.82"\nhide = ["values"]')
    question = read_question(table, lambda markdown, where: markdown)
    assert (question.html, question.hide) == ("What is right?", ("values",))
    assert question.judge("atan2(py/(q3 cos(q2)), px/(q3 cos(q2)))").right
    assert question.judge("atan2(py/cos(q2), px/cos(q2))").says == f"<p>{SO_PRINTED}</p>\n"


def test_a_lesson_cannot_ask_for_one_without_a_task():
    table = Table.parse("f.md", 'kind = "erratum"\ntext = "?"\nerratum = "1.37"')
    with pytest.raises(ContentError, match=r"unknown erratum with a task '1.37'"):
        read_question(table, lambda markdown, where: markdown)


# --- lessons


def test_a_link_of_a_lesson_to_an_erratum_that_is_not_there_is_told():
    html = to_html("See [1.58](/erratum/1.58) and [1.59](/erratum/1.59).", "f.md")
    assert linked(html) == ("1.58", "1.59")
    (problem,) = leading_nowhere(html)
    assert problem.startswith("link: unknown erratum '1.59'")
