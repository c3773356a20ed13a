"""A teacher's way in the page: a lesson of the arm as it stands, homework of it, and the work of a class judged."""

import subprocess
import sys

import pytest

from armlab.cli import main
from armlab.content.lessons import lessons
from armlab.content.robots import catalogue
from armlab.session.parts.joints import MoveJoint
from armlab.session.state import State, apply
from armlab.teaching.assignment_commands import HandIn, OpenAssignment
from armlab.teaching.hand_in import hand_in
from armlab.teaching.lesson_commands import SignAs, UnlockHint
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.play import problems
from support.lab import running_lab

pytestmark = pytest.mark.browser

KEY = "the key of this teacher"

HOMEWORK = """title = "Homework 1"
last_hint_percent = 50

[[tasks]]
lesson = "evening"
points = 10
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A teacher's folder of lessons, empty at first."""
    return tmp_path_factory.mktemp("mine")


@pytest.fixture(scope="module")
def url(tmp_path_factory, folder):
    """A lab with that folder."""
    with running_lab(tmp_path_factory.mktemp("state"), "planar_2r", lessons=folder, key=KEY) as address:
        yield address


def saved(lab, title):
    """Save the present state as a lesson; return the name of the file and its text."""
    lab.open_tab("Lessons")
    lab.page.locator('button.page[data-cell="author"]').click()
    lab.type_into("title", title)
    with lab.page.expect_download() as download:
        lab.press("save-lesson")
    return download.value.suggested_filename, download.value.path().read_text(encoding="utf-8")


def write(file, text, old="", new=""):
    """Save a file as an editor does."""
    assert old in text
    file.write_text(text.replace(old, new, 1), encoding="utf-8")


def test_a_state_becomes_a_lesson_that_is_edited_checked_and_reloaded(folder, visit):
    teacher, file = visit("robot/planar_2r"), folder / "reach_up.md"
    teacher.page.get_by_role("button", name="Right angle").click()
    teacher.rest()
    name, text = saved(teacher, "Reach <b>up</b>")
    assert name == "reach_b_up_b.md"
    write(file, text)
    teacher.page.locator('button.page[data-cell="lessons"]').click()
    entry = teacher.page.locator('button[data-cell="lesson:reach_up"]')
    entry.wait_for()  # it appears by itself
    assert "Reach <b>up</b>" in entry.inner_text()
    assert problems("reach_up") == []
    command = [sys.executable, "-m", "armlab", "lesson", "check", str(file)]
    told = subprocess.run(command, capture_output=True, text=True)
    assert (told.returncode, told.stderr) == (0, "")

    student = visit("lesson/reach_up")
    write(file, text, "```check", "Live from the editor.\n\n```check")
    student.page.get_by_text("Live from the editor.").wait_for()
    # A slip of the pen takes nothing from those who are in the lesson, and is told with its file.
    write(file, text, "```check", "```chekc")
    teacher.page.get_by_text("chekc").first.wait_for()
    assert student.page.get_by_text("Live from the editor.").is_visible()
    assert any("reach_up.md" in str(problem) for problem in lessons().problems)
    student.page.get_by_role("button", name="Right angle").click()
    student.page.get_by_text("Lesson done").wait_for()


def load(lab, file, says):
    """Load a file from the browser."""
    lab.page.locator('input[data-cell="load-file"]').set_input_files(str(file))
    lab.waits_for(says)


def work_of(number):
    """Return the work of a student on the homework: odd ones are right, every third one has seen the only hint."""
    state = State.initial(catalogue()["planar_2r"])
    for command in (SignAs(f"Student {number}"), OpenAssignment("homework")):
        state = apply(state, command, 1e9)
    if number % 3 == 0:
        state = apply(state, UnlockHint(), 1e9)
    if number % 2:
        (goal,) = state[LessonPart].step.solution
        for joint, value in enumerate(goal.q.tolist()):
            state = apply(state, MoveJoint(joint, value), 1e9 + 10.0 + 0.37 * number)  # no two take the same time
    return hand_in(apply(state, HandIn(), 1e9 + 60.0))


BESIDE = """rows => rows.filter(row => row.checkVisibility()).map(row => {
  const words = document.createRange(), [label, inside] = row.children;
  words.selectNodeContents(label);
  const right = Math.max(...[...inside.children].map(each => each.getBoundingClientRect().right));
  return [inside.getBoundingClientRect().left - words.getBoundingClientRect().right,
          row.getBoundingClientRect().right - right];
})"""
"""The gaps in each row between its label and what is filled in, and from there to its end, in pixels."""


def test_what_is_filled_in_stands_beside_its_label_and_a_text_begins_on_the_left(visit):
    lab = visit("robot/planar_2r")
    lab.open_tab("author")
    lab.type_into("teacher-key", KEY)
    for part in ("Ask for numbers, too", "A lesson of the course as a student sees it"):
        lab.unfold(part)
    lab.page.locator('select[data-cell="preview-set"]').scroll_into_view_if_needed()
    gaps = lab.page.locator(".al .row").evaluate_all(BESIDE)
    assert len(gaps) >= 5
    assert all(between > 3 and behind > -0.5 for between, behind in gaps), gaps
    question = lab.page.locator('textarea[data-cell="ask-text"]')
    assert question.evaluate("field => getComputedStyle(field).textAlign") == "left"


def test_the_evening_of_a_teacher(folder, visit, capsys, tmp_path):
    teacher = visit("robot/planar_2r")
    teacher.page.get_by_role("button", name="Right angle").click()
    teacher.rest()
    name, text = saved(teacher, "Evening")
    write(tmp_path / name, text)
    write(tmp_path / "homework.toml", HOMEWORK)
    load(teacher, tmp_path / name, "evening.md")
    teacher.type_into("teacher-key", KEY)
    teacher.press("give evening.md")
    teacher.waits_for("✓ evening.md is there for everybody.")
    load(teacher, tmp_path / "homework.toml", "Homework 1")
    teacher.press("preview homework.toml")
    teacher.waits_for("As a student sees it")
    teacher.waits_for("Bring the arm there")
    teacher.press("preview-end")
    teacher.until(lambda: "evening" in lessons().lessons)
    teacher.press("give homework.toml")
    teacher.until(lambda: "homework" in lessons().assignments)

    assert main(["lesson", "sheet", str(folder / "homework.toml")]) == 0
    told = capsys.readouterr().out
    assert "The last hint of a step costs 50 % of its points" in told
    assert "| 1.1 | Evening: Bring the arm there | 10 | 1 | 5 |" in told

    hand_ins = tmp_path / "in"
    hand_ins.mkdir()
    for number in range(1, 31):
        write(hand_ins / f"{number:02d}.json", work_of(number))
    assert main(["check", str(folder / "homework.toml"), "--state", str(hand_ins)]) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    scores = [" ".join(line[-3:]) for line in lines[1:31]]
    assert [scores.count(score) for score in ("10 of 10", "5 of 10", "0 of 10")] == [10, 5, 15]
    assert lines[3][3] == "ok+hint"
    assert lines[-1][0] == "+hint:"
