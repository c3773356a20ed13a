"""What a lesson holds back and who takes it: locks, hidden panels, variants, saved work, sandboxes, hostile texts."""

import html
import json
import re

import pytest

from armlab.benches.drive.motor.state import Motor
from armlab.content.lessons import lessons, library
from armlab.content.robots import catalogue
from armlab.session.fields import Set
from armlab.session.state import State, apply
from armlab.teaching.lesson_commands import GoToStep, OpenLesson
from armlab.teaching.lesson_progress import Progress
from armlab.teaching.parts.lesson import LessonPart
from armlab.window.lesson import page
from armlab.window.tab import CLOSED
from support.fake_browser import cookie_of
from support.forms import BareForm
from support.lab import running_lab
from support.own_lessons import (
    ARM,
    HOSTILE,
    HOSTILE_ARM,
    PWN,
    in_lesson,
    lesson,
    load,
    notes,
    piece,
    to_step,
    write,
)
from support.student import run, student


def first_arm():
    return lessons()["first_arm"]


LOCKED = ARM + 'locked = ["robot", "table", "joints"]\n'
HIDING = 'robot = "planar_2r"\nhidden = ["joints", "ellipsoid", "orientation"]\n'
VARIED = ARM + "[variants]\nl = { from = 1, to = 500, step = 1 }\n"
STEP = """
## One

It is {{=l}} long.

```question
kind = "number"
text = "How long?"
answer = "= l"
tolerance = 0.1
```
"""


MARKED = """
## Go

```check
kind = "tool_at"
position = [1, 1, 0]
tolerance_m = 0.05
marked = true
```

## Read

Well done.
"""


EXAM = """title = "Exam"
exam = true
[[tasks]]
lesson = "marked"
"""


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    folder = write(
        tmp_path_factory.mktemp("lessons"),
        locked=lesson(front=LOCKED),
        held=lesson(front=ARM + "locked_joints = [2]\n"),
        hiding=lesson(front=HIDING),
        marked=lesson(MARKED),
        varied=lesson(STEP, VARIED),
        hostile=lesson(HOSTILE, HOSTILE_ARM, f"Title {PWN}"),
    )
    (folder / "exam.toml").write_text(EXAM, encoding="utf-8")
    with running_lab(lessons=folder) as address:
        yield address


# -- what a lesson marks in the scene ----------------------------------------------------------------------------


def test_a_marked_goal_is_seen_while_its_step_is_shown(url):
    async def main():
        browser = await in_lesson(url, "marked")
        end = "/goal_0"
        await browser.until(lambda: any(name.endswith(end) for name in browser.nodes))
        (ball,) = (node for name, node in browser.nodes.items() if name.endswith(end))
        assert ball["position"] == pytest.approx((1.0, 1.0, 0.0))
        assert ball["radius"] == 0.05
        before = ball["color"]
        await browser.set_value(browser.slider(1), 0.0)
        await browser.set_value(browser.slider(2), 90.0)
        await browser.until(
            lambda: any(name.endswith(end) and node["color"] != before for name, node in browser.nodes.items())
        )
        await browser.press("lesson-next")
        await browser.until(lambda: not any(name.endswith(end) for name in browser.nodes))
        await browser.close()

    run(main())


# -- what a lesson holds back ------------------------------------------------------------------------------------


def refusal(browser):
    """Return what is said below what was pressed last; empty for nothing."""
    said = re.search('role="alert">([^<]*)', browser.html())
    return said[1] if said else ""


def test_what_is_locked_is_refused_and_shown_as_it_is(url):
    async def main():
        browser = await in_lesson(url, "locked")
        undo = re.search('<button[^>]*data-cell="undo"[^>]*>', browser.html())[0]
        assert re.search('title="Undo ends where this lesson began[.]".* disabled', undo)
        await browser.set_value(browser.slider(1), 80.0)
        await browser.until(lambda: len(browser.notices) == 1)
        assert "keeps the joints as they are; drag the handle" in browser.notices[0]
        await browser.until(lambda: browser.slider(1)["value"] == 30.0)
        await browser.open("robot")
        await browser.until(lambda: 'data-cell="planar_3r"' in browser.html())
        await browser.press("planar_3r")
        await browser.until(lambda: "keeps the Planar 2R" in refusal(browser))
        assert len(browser.notices) == 1
        await browser.press("lesson-close")
        await browser.until(lambda: "lesson-head" not in browser.html())
        await browser.press("planar_3r")
        await browser.until(lambda: notes(browser)["path"] == "/robot/planar_3r")
        await browser.close()

    run(main())


def test_a_held_joint_cannot_be_moved_or_let_go(url):
    async def main():
        browser = await in_lesson(url, "held")
        assert browser.slider(2)["props"]["disabled"]
        await browser.press("1")  # the chip that holds joint 2
        await browser.until(lambda: "keeps joint 2 where" in refusal(browser))
        assert browser.slider(2)["props"]["disabled"]
        await browser.set_value(browser.slider(1), -20.0)
        await browser.press("lesson-close")
        await browser.until(lambda: not browser.slider(2)["props"]["disabled"])
        assert browser.slider(1)["value"] == -20.0
        await browser.close()

    run(main())


def test_panels_a_lesson_hides_are_not_there(url):
    async def main():
        cookie = cookie_of(url)
        await (await student(url, cookie)).close()  # has looked at the joints
        browser = await in_lesson(url, "hiding", cookie)
        shown = notes(browser)
        assert "Joints" in shown["hidden"]
        assert shown["tab"] not in shown["hidden"]
        await browser.open("joints")  # as of a page whose hidden tab was made visible
        await browser.until(lambda: CLOSED in browser.html())
        await browser.open("pose")
        await browser.until(lambda: 'data-cell="pose"' in browser.html() or 'class="pages"' in browser.html())
        assert 'data-cell="orientation"' not in browser.html()
        await browser.open("velocity")
        await browser.until(lambda: 'data-cell="ellipsoid"' not in browser.html())
        await browser.press("lesson-close")
        await browser.until(lambda: notes(browser)["hidden"] == [])
        await browser.close()

    run(main())


# -- variants ----------------------------------------------------------------------------------------------------


def length(variant):
    return library().lesson("varied", variant).values["l"]


def test_a_variant_is_chosen_by_number_and_has_a_progress_of_its_own(url):
    async def main():
        browser = await in_lesson(url, "varied/3")
        assert f"It is {length(3):g} long" in piece(browser, "lesson-text")
        assert 'value="3"' in piece(browser, "lesson-more")
        await browser.press("lesson-answer", f"{length(3)}")
        await browser.until(lambda: "✓ Lesson done" in browser.html())
        await browser.press("lesson-variant", "4")
        await browser.until(lambda: notes(browser)["path"] == "/lesson/varied/4")
        await browser.until(lambda: f"It is {length(4):g} long" in piece(browser, "lesson-text"))
        assert "Lesson done" not in browser.html()
        assert 'value=""' in piece(browser, "lesson-answer")
        await browser.press("lesson-variant", "3")
        await browser.until(lambda: "✓ Lesson done" in browser.html())
        await browser.close()

    run(main())


@pytest.mark.parametrize("text", ["abc", "-1", "10000", "1.5", "", "9" * 5000, "<script>", "²"])
def test_a_variant_that_is_no_number_is_refused_at_its_field(url, text):
    async def main():
        browser = await in_lesson(url, "varied/3")
        await browser.press("lesson-variant", text)
        await browser.until(lambda: "✕ variant: expected" in browser.html())
        assert f'value="{html.escape(text)}"' in piece(browser, "lesson-more")
        assert not browser.notices
        await browser.press("lesson-variant", "3")
        await browser.until(lambda: "✕ variant: expected" not in browser.html())
        assert notes(browser)["path"] == "/lesson/varied/3"
        await browser.close()

    run(main())


# -- name, work, sandbox -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("typed", "kept", "file"),
    [
        ("Ada Lovelace", "Ada Lovelace", "first_arm_0_ada_lovelace.json"),
        (PWN, " ".join(PWN.split())[:80], None),
        ("x" * 500, "x" * 80, "first_arm_0_" + "x" * 40 + ".json"),
        ("half \ud800 line\n two", "half ? line two", "first_arm_0_half_line_two.json"),
        ("../../etc/passwd", "../../etc/passwd", "first_arm_0_etc_passwd.json"),
        ("", "", "first_arm_0.json"),
    ],
)
def test_the_work_is_saved_under_any_name(url, typed, kept, file):
    async def main():
        browser = await in_lesson(url, "first_arm/0")
        await browser.press("stretched")
        await browser.until(lambda: "✓ Done" in browser.html())
        before = piece(browser, "lesson-more")
        await browser.press("lesson-name", typed)
        await browser.until(lambda: piece(browser, "lesson-more") != before)
        assert "<script" not in browser.html()
        assert "<img src=x" not in browser.html()
        await browser.press("lesson-save")
        await browser.until(lambda: any(browser.downloads.values()))
        ((name, content),) = browser.downloads.items()
        assert name.endswith(".json")
        assert set(name) <= set("abcdefghijklmnopqrstuvwxyz0123456789_.")
        if file is not None:
            assert name == file
        data = json.loads(content)
        assert data["student"] == kept
        assert data["lesson"] == "first_arm"
        assert data["digest"] == first_arm().digest
        assert data["progress"]["met"] == ["Stretch the arm along x"]
        await browser.close()

    run(main())


def test_a_hand_in_right_after_the_name_saves_its_file(url):
    """Leaving the field and the press come together, before the dock is shown again."""

    async def main():
        cookie = cookie_of(url)
        load(url, cookie, "assignment/exam")
        browser = await student(url, cookie, "/assignment/exam")
        await browser.until(lambda: "assignment-hand-in" in browser.html())
        await browser.press("lesson-name", "Ada")
        await browser.press("assignment-hand-in")
        await browser.until(lambda: "confirm-yes" in browser.html())
        await browser.press("confirm-yes")
        await browser.until(lambda: any(browser.downloads.values()))
        assert list(browser.downloads) == ["exam_ada.json"]
        await browser.close()

    run(main())


def test_a_sandbox_of_ones_own_leaves_the_lesson_as_it_is(url):
    async def main():
        browser = await in_lesson(url, "first_arm/0")
        await to_step(browser, 3)
        await browser.press("lesson-answer", "0.5")
        await browser.until(lambda: "✕ Not yet" in browser.html())
        await browser.press("lesson-sandbox")
        await browser.until(lambda: "Your sandbox" in browser.html())
        await browser.until(lambda: "lesson-head" not in browser.html())
        assert "‹ Back to Your first arm" in piece(browser, "Your sandbox")
        await browser.press("zero")
        await browser.until(lambda: browser.slider(2)["value"] == 0.0)
        await browser.press("home")
        await browser.until(lambda: "lesson-foot" in browser.html())
        assert "<small>3 of 4</small>" in browser.html()
        assert "✕ Not yet" in browser.html()
        assert 'value="0.5"' in browser.html()
        await browser.until(lambda: browser.slider(2)["value"] == 55.0)
        await browser.press("lesson-sandbox")  # the sandbox is as it was left, too
        await browser.until(lambda: "Your sandbox" in browser.html() and browser.slider(2)["value"] == 0.0)
        await browser.close()

    run(main())


# -- texts of others ---------------------------------------------------------------------------------------------


def test_texts_of_a_lesson_are_never_markup(url):
    async def main():
        browser = await in_lesson(url, "hostile")
        await browser.press("lesson-hint")
        await browser.until(lambda: "<b>Hint 1 of 1</b>" in browser.html())
        await browser.press("lesson-choice-1")
        await browser.until(lambda: "Says " in browser.html())
        await browser.open("robot", "lessons")
        await browser.press("lesson-choice-2")
        await browser.until(lambda: "Reveal " in browser.html())
        await browser.open("robot")
        await browser.press("planar_2r")
        await browser.until(lambda: "lesson-arm" in browser.html())
        shown = browser.html()
        for word in ("Title", "Introduction", "Step", "Text", "Question", "Option", "Hint", "Reveal", "about the Arm"):
            assert f"{word} &lt;script&gt;" in shown, word
        assert "<script" not in shown
        assert "<img" not in shown
        assert not any("<script" in notice for notice in browser.notices)
        await browser.press("lesson-sandbox")
        await browser.until(lambda: "Your sandbox" in browser.html())
        assert "‹ Back to Title &lt;script&gt;" in browser.html()
        assert "<script" not in browser.html()
        await browser.close()

    run(main())


# -- pieces ------------------------------------------------------------------------------------------------------


def part_at(step, met=()):
    """Return a student's way through the first lesson."""
    names = [each.title for each in first_arm().steps]
    progress = Progress(step=names[step], met=frozenset(names[i] for i in met))
    return LessonPart(open="first_arm").with_progress(progress)


def test_strips_tell_what_is_done_and_where_one_is():
    markup = page._strips(BareForm(), first_arm(), part_at(1, (0, 2)))
    assert markup.count('class="strip done"') == 1  # the question of step 3 is not answered
    assert markup.split('aria-current="step"')[0].count('data-cell="lesson-step-') == 2
    assert "Step 1, done: Stretch the arm along x" in markup


def test_the_way_on_is_a_skip_until_the_step_is_done():
    assert "Skip" in page._foot(BareForm(), first_arm(), part_at(0))
    assert "Next" in page._foot(BareForm(), first_arm(), part_at(0, (0,)))
    assert "Not done yet: steps 1, 3, 4" in page._foot(BareForm(), first_arm(), part_at(3, (1, 2)))


def test_a_lesson_that_cannot_be_shown_says_so_and_the_benches_live_on(url, monkeypatch):
    def broken(*arguments):
        raise RuntimeError("made up")

    async def main():
        browser = await in_lesson(url, "held")
        monkeypatch.setattr(page, "step_text", broken)
        await browser.set_value(browser.slider(1), 25.0)
        await browser.until(lambda: "✕ The lesson has failed" in browser.html())
        assert browser.slider(1)["value"] == 25.0
        monkeypatch.undo()
        await browser.set_value(browser.slider(1), 20.0)
        await browser.until(lambda: "The lesson has failed" not in browser.html())
        await browser.close()

    run(main())


def test_the_present_value_stands_in_what_is_said_of_a_mistake():
    state = State.initial(catalogue()["puma560"])
    for command in (OpenLesson("dc_motor"), GoToStep(6), Set(Motor, "load", 0.05)):
        state = apply(state, command)
    markup = str(page._task(BareForm(), state, lessons()["dc_motor"]))
    assert "The motor still turns, at" in markup
    assert re.search(r'data-live="drive.motor.steady_speed">\d+(\.\d+)? rad/s<', markup)
