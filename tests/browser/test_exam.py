"""A student sits an exam in the page: silence, a clock, closed pages, and a file that is marked."""

import re

import pytest

from armlab.teaching.hand_in_assignment import judge_assignment

pytestmark = pytest.mark.browser


def clock(lab):
    """Return the seconds that the page says are left."""
    minutes, seconds = re.fullmatch(r"(\d+):(\d\d)", lab.page.locator(".as-clock").inner_text()).groups()
    return 60 * int(minutes) + int(seconds)


def test_a_student_sits_an_exam(visit):
    student = visit("assignment/solutions/5", own=True)
    page, dock = student.page, student.page.locator("[data-dock-region=left]")
    page.get_by_text("Nothing has begun yet").wait_for()
    page.reload()
    page.get_by_text("Nothing has begun yet").wait_for()
    assert page.locator(".as-clock, .lesson-text").count() == 0
    student.press("confirm-yes")
    page.locator(".as-clock").filter(has_text=":").wait_for()
    at_first = clock(student)
    assert 38 * 60 < at_first <= 40 * 60
    assert page.get_by_role("tab").all_inner_texts() == ["Joints"]  # all others are closed
    assert page.locator('[data-cell="lesson-hint"]').count() == 0
    for column, typed in enumerate(("0.5", "1.7")):
        student.type_into(f"lesson-entry-0-{column}", typed)
    student.press("lesson-check")
    dock.get_by_text("Your answer is noted").wait_for()
    student.press("task-1")
    student.type_into("lesson-answer", "4")
    dock.get_by_text("Your answer is noted").wait_for()
    assert not re.search(r"Right\.|Not yet|folded back", dock.inner_text())
    student.until(lambda: clock(student) < at_first)

    # The work needs a name; then it is judged, and cannot be changed any more.
    student.press("assignment-hand-in")
    page.locator('[data-cell="confirm-yes"]').click()  # without a wait for the lab's rest: what it tells stays 8 s
    page.get_by_text("Write your name at “Name” first").wait_for()
    student.type_into("lesson-name", "Ada Lovelace")
    student.press("assignment-hand-in")
    with page.expect_download() as download:
        student.press("confirm-yes")
    assert download.value.suggested_filename == "solutions_ada_lovelace.json"
    report = judge_assignment(download.value.path().read_text(encoding="utf-8"), "solutions")
    assert (report.student, report.variant, report.handed.attempt) == ("Ada Lovelace", 5, 1)
    assert [step.label for step in report.steps if step.passed] == ["2.1"]
    assert (report.points, report.most) == (2.0, 18.0)
    dock.get_by_text("2 of 18 points on screen").wait_for()
    dock.get_by_text("Right.").wait_for()
    assert page.locator('[data-cell="lesson-answer"]').is_disabled()

    # A reload finds the assignment as it was; another attempt goes on from it.
    page.reload()
    dock.get_by_text("Your teacher has it only when you have given them the file").wait_for()
    student.press("assignment-again")
    page.locator(".as-clock").wait_for()
    student.press("assignment-leave")
    page.locator('[data-cell="lesson-close"], .lesson-text').first.wait_for(state="detached")
    student.open_tab("Motion")
