"""A teacher's way in the page: bring the arm to a goal, save it as a lesson, edit the file, see the change."""

import subprocess
import sys

import pytest

from armlab.content.lessons import lessons
from armlab.session.play import problems
from support.lab import running_lab

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A teacher's folder of lessons, empty at first."""
    return tmp_path_factory.mktemp("mine")


@pytest.fixture(scope="module")
def url(tmp_path_factory, folder):
    """A lab with that folder."""
    with running_lab(tmp_path_factory.mktemp("state"), "planar_2r", lessons=folder) as address:
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
