"""Assignments at the command line: the sheet for the teacher, the marks of a class, mistakes."""

import csv
import io
import json

import numpy as np
import pytest

from armlab.commands._scheme import conditions
from armlab.content import lessons as library_module
from armlab.content.assignment import parse_assignment
from armlab.content.robots import catalogue
from armlab.session.parts.joints import MoveJoint
from armlab.session.state import State, apply
from armlab.teaching.assignment_commands import HandIn, OpenAssignment
from armlab.teaching.hand_in import hand_in
from armlab.teaching.lesson_commands import Answer, GoToStep, SignAs
from armlab.teaching.parts.lesson import LessonPart

SHEET = """title = "Sheet 1"
due = 2026-11-30T10:00:00Z
attempts = 2

[[tasks]]
lesson = "v"
points = 6

[[tasks]]
lesson = "t"
"""
BEFORE = 1_795_000_000.0  # November 2026, before it is due


@pytest.fixture
def sheet(place):
    path = place / "mine" / "sheet.toml"
    path.write_text(SHEET, encoding="utf-8")
    library_module.add_folder(place / "mine")
    return path


def handed_in(name, variant, right=True):
    """Return the file of a student who does the first task, and answers its last question rightly or not."""
    state = State.initial(catalogue()["puma560"])
    for command in (SignAs(name), OpenAssignment("sheet", variant)):
        state = apply(state, command, BEFORE)
    goal = state[LessonPart].lesson.values["goal"]
    last = Answer(f"{2 * goal if right else 1:g}")
    steps = (MoveJoint(0, np.radians(goal)), GoToStep(1), Answer(f"{goal / 2:g}"), GoToStep(2), last, HandIn())
    for i, command in enumerate(steps):
        state = apply(state, command, BEFORE + variant + (1.37 + 0.001 * variant) * i)
    return hand_in(state)


def test_the_work_of_a_class_is_one_table(typed, sheet, place):
    folder, names = place / "in", [f"Student {i}" for i in range(1, 41)]
    folder.mkdir()
    (place / "names.txt").write_text("\n".join(names), encoding="utf-8")
    for variant, name in enumerate(names, start=1):
        given = variant if variant != 7 else 8  # one works on the variant of a neighbour
        (folder / f"{variant:03d}.json").write_text(handed_in(name, given, right=variant % 2 == 0), encoding="utf-8")
    marked = ("check", "mine/sheet.toml", "--students", "names.txt", "--state", "in")
    status, out, complaints = typed(*marked, "--format", "csv")
    assert (status, complaints) == (0, "")
    table = list(csv.DictReader(io.StringIO(out)))
    assert [row["student"] for row in table] == names
    assert {row["points"] for row in table[1::2]} == {"6.0"}
    assert {row["points"] for row in table[::2]} == {"4.0", "0.0"}
    assert [row["problem"] for row in table if row["problem"]] == ["This is variant 8; the one given was 7."]
    assert {(row["of"], row["version"], row["attempt"]) for row in table} == {("8.0", "1", "1")}
    lines = typed(*marked)[1].splitlines()
    assert len(lines) == 41
    assert lines[0].split()[2:] == ["1.1", "1.2", "1.3", "2.1", "2.2", "2.3", "attempt", "hints", "score"]
    assert lines[2].split() == ["Student", "2", "2", "ok", "ok", "ok", "-", "no", "no", "1", "0", "6", "of", "8"]
    status, _, _ = typed(*marked, "--format", "gradescope", "--out", "results")
    graded = json.loads((place / "results" / "002.json").read_text(encoding="utf-8"))
    assert (status, graded["score"], graded["tests"][0]) == (
        0,
        6.0,
        {**graded["tests"][0], "name": "1.1 Turn", "score": 2.0, "max_score": 2.0},
    )


def test_the_sheet_has_the_marking_scheme_and_the_answers_of_every_lesson(typed, sheet):
    status, out, _ = typed("lesson", "sheet", "mine/sheet.toml", "--variants", "3-4")
    assert status == 0
    assert out.startswith("# Sheet 1: marking scheme and solutions\n")
    assert "| 1.3 | Turn to 30 degrees: Double | 2 |" in out
    assert "| | all | 8 |" in out
    assert "It can be handed in 2 times." in out
    assert "## Turn to 30 degrees: solutions" in out
    assert "## T: solutions" in out
    goals = [library_module.lesson("v", number).values["goal"] for number in (3, 4)]
    assert all(f"| {2 * goal:g} ± 0.1 |" in out for goal in goals)


@pytest.mark.parametrize(("due", "says"), [("due = 2030-01-01", "Late work is accepted until"), ("", "It closes on")])
def test_the_scheme_speaks_of_late_work_only_where_there_is_a_date_that_it_is_due(due, says):
    text = f'title = "H"\n{due}\ncloses = 2030-01-02\n[[tasks]]\nlesson = "v"\n'
    assert any(line.startswith(says) for line in conditions(parse_assignment("h", text, "h.toml")))
    assert sum(line.startswith("Late") for line in conditions(parse_assignment("h", text, "h.toml"))) == bool(due)


def test_mistakes_and_work_on_something_else_are_told_with_their_file(typed, sheet, work):
    lesson = work("in/lesson.json")
    status, _, complaints = typed("check", "mine/sheet.toml", "--state", lesson)
    assert status == 1
    assert f"{lesson}: this is work on the lesson 'v', not on the assignment 'sheet'" in complaints
    sheet.write_text(SHEET.replace('"t"', '"tt"'), encoding="utf-8")
    said = "mine/sheet.toml, line 10: tasks[2].lesson: unknown lesson 'tt'"
    for command in (("check", "mine/sheet.toml", "--state", "in"), ("lesson", "sheet", "mine/sheet.toml")):
        status, _, complaints = typed(*command)
        assert status == 1
        assert said in complaints
    status, out, _ = typed("lesson", "check", "mine")
    assert status == 1
    assert "mine/sheet.toml:10: tasks[2].lesson: unknown lesson 'tt'" in out
    status, _, complaints = typed("--assignment", "mine/sheet.toml", "--no-browser")
    assert (status, said in complaints) == (1, True)
    sheet.write_text(f'# Pages\npages = ["jionts"]\n{SHEET}', encoding="utf-8")
    status, out, _ = typed("lesson", "check", "mine")
    assert (status, "mine/sheet.toml:2: pages[1]: unknown page 'jionts'; did you mean 'joints'" in out) == (1, True)
    status, _, complaints = typed("check", "mine/gone.toml", "--state", "in")
    assert complaints == "armlab: mine/gone.toml: there is no such file\n"


def test_a_course_is_no_assignment(typed, place):
    (place / "mine" / "course.toml").write_text('title = "C"\n', encoding="utf-8")
    for command in (("--assignment", "mine/course.toml", "--no-browser"), ("lesson", "sheet", "mine/course.toml")):
        said = "armlab: mine/course.toml: this is the file of a course; expected an assignment, NAME.toml\n"
        assert typed(*command) == (1, "", said)


def test_the_key_of_the_teacher_needs_a_folder(typed):
    status, _, complaints = typed("--teacher-key", "long enough", "--no-browser")
    assert (status, complaints.count("\n")) == (1, 1)
    assert "add --lessons DIR" in complaints
