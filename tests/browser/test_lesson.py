"""A student does lessons in the page, and a teacher shows them."""

import numpy as np
import pytest

from armlab.content.lessons import library
from armlab.session import share
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State
from support.lab import running_lab
from support.lesson_player import LessonPlayer
from support.own_lessons import HOSTILE, HOSTILE_ARM, PWN, QUESTIONS, lesson, write

pytestmark = pytest.mark.browser

PLAYED = ("rotation_matrix", "forward_2r")
"""Lessons whose solutions are moves of joints and answers."""

LONG = "\n\n".join(f"Line {i} with joint 1 at {{{{q1}}}}." for i in range(40))

REVEALED = f"""
## One

{LONG}

```question
kind = "choice"
text = "Which?"
options = ["a", "b"]
answer = 1
```

```reveal
It is a, and there is something to say about it.
```
"""


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    """A lab with a teacher's lessons besides its own."""
    folder = write(
        tmp_path_factory.mktemp("lessons"),
        questions=lesson(QUESTIONS),
        hostile=lesson(HOSTILE, HOSTILE_ARM, f"Title {PWN}"),
        long=lesson(f"\nThe introduction.\n\n## One\n\n{LONG}\n\n## Two\n\n{LONG}\n"),
        revealed=lesson(REVEALED),
        table=lesson("\n## A table\n\n| a | `b` |\n|---|---|\n| $c$ | d |\n\n$$ A = B $$\n\n* item\n\n[link](/)\n"),
    )
    with running_lab(tmp_path_factory.mktemp("state"), lessons=folder) as address:
        yield address


def shown(lab, text):
    """Return whether a text is seen."""
    return lab.page.get_by_text(text, exact=False).first.is_visible()


def read(lab):
    return lab.page.locator(".lesson-text").inner_text(), lab.page.locator(".ask .field").all_inner_texts()


def cut(lab, selector):
    """Return whether an element sticks out of the window or of its own box sideways."""
    sticks_out = "e => e.scrollWidth > e.clientWidth + 1 || e.getBoundingClientRect().right > innerWidth"
    return lab.page.locator(selector).first.evaluate(sticks_out)


@pytest.mark.parametrize("key", PLAYED)
def test_a_lesson_is_played_by_clicks_with_a_reload_in_the_middle(visit, key):
    lab = visit(f"lesson/{key}", size=(1400, 850))
    found = library().lesson(key, int(lab.address().partition(key)[2].strip("/").partition("?")[0] or 0))
    player = LessonPlayer(lab, found)
    for i, step in enumerate(found.steps, start=1):
        player.at(i)
        player.hint()
        player.wrong(step)
        if i == len(found.steps) // 2 + 1:
            before = read(lab)
            lab.page.reload()
            lab.page.wait_for_selector(".lesson-foot")
            player.at(i)
            assert read(lab) == before
            assert lab.page.locator(".strip.done").count() == i - 1
        player.solve(step)
        if i < len(found.steps):
            player.click("lesson-next")
    lab.until(lambda: shown(lab, "✓ Lesson done"))
    assert lab.page.locator(".strip.done").count() == len(found.steps)


def test_a_lesson_from_its_link_to_its_end_with_a_reload(visit):
    lab = visit("lesson/first_arm/0", size=(1400, 850))
    player = LessonPlayer(lab, library().lesson("first_arm"))
    assert "/lesson/first_arm/0" in lab.address()
    left, right, _ = lab.scene()
    assert 270 < left < 300
    assert (right - left) / 1400 > 0.5
    assert shown(lab, "1 of 4")
    assert lab.page.locator(".lesson-text math").count() > 3
    assert "To do" in lab.page.locator(".verdict.todo").inner_text()
    assert lab.page.locator('button[data-cell="lesson-next"]').inner_text() == "Skip ›"
    player.hint()
    lab.press("right angle")
    lab.until(lambda: shown(lab, "the second one still bends away"))
    lab.press("stretched")
    lab.until(lambda: shown(lab, "✓ Done"))
    # The whole arm is in the picture where the lesson has led it, from its base to its tool.
    bodies = [name for name in lab.nodes() if "/arm/" in name and name.rsplit("/", 1)[1].isdigit()]
    assert len(bodies) == 2
    for node in (*bodies, "/target"):
        at = lab.on_screen(node)
        assert left < at[0] < right, node
        assert 0 < at[1] < 850, node
    lab.press("lesson-next")
    player.at(2)
    player.hint()
    lab.press("right angle")
    lab.until(lambda: shown(lab, "✓ Done"))
    lab.press("lesson-next")
    player.at(3)
    player.hint()
    lab.type_into("lesson-answer", "0.5")
    lab.until(lambda: shown(lab, "Both joints turn the second link"))
    lab.page.reload()
    lab.ready()
    lab.until(lambda: shown(lab, "3 of 4"))
    assert lab.page.locator('input[data-cell="lesson-answer"]').input_value() == "0.5"
    np.testing.assert_allclose(lab.slider_values(2), [0.0, 90.0])
    assert lab.page.locator(".strip.done").count() == 2
    lab.page.locator('input[data-cell="lesson-answer"]').fill("0,866")
    lab.page.locator('button[data-cell="lesson-check"]').click()
    lab.until(lambda: shown(lab, "✓ Right."))
    lab.press("lesson-next")
    player.at(4)
    player.solve(player.lesson.steps[3])
    lab.until(lambda: shown(lab, "✓ Lesson done"))
    lab.page.locator(".lesson-foot button[data-cell=lesson-close]").click()
    lab.until(lambda: lab.scene()[0] == 0)
    lab.until(lambda: "/robot/planar_2r" in lab.address())
    assert lab.page.locator(".lesson-text").count() == 0


def test_a_lesson_is_chosen_in_the_bench_and_its_dock_lets_a_typed_answer_be(visit):
    lab = visit(size=(1400, 850))
    lab.open_tab("Lessons")
    lab.press("lesson:first_arm")
    lab.ready()
    lab.until(lambda: shown(lab, "1 of 4"))
    assert lab.scene()[0] > 270
    assert lab.tab("Joints").get_attribute("aria-selected") == "true"
    lab.press("lesson-step-2")
    field = lab.page.locator('input[data-cell="lesson-answer"]')
    lab.type_into("lesson-answer", "0.8")
    lab.until(lambda: shown(lab, "not the answer yet"))
    field.fill("0.86")
    lab.drag_slider(1, 0.7)
    assert field.input_value() == "0.86"
    assert lab.page.locator('select[data-cell="lesson-key"]').input_value() == "first_arm"


# -- questions ---------------------------------------------------------------------------------------------------


def at_step(lab, step):
    lab.press(f"lesson-step-{step - 1}")
    lab.until(lambda: shown(lab, f"{step} of 6"))


def saturated(lab):
    """Return how many pixels of the scene have a strong colour, as the arm has and the room has not."""
    left, right, _ = map(int, lab.scene())
    pixels = lab.picture()[80:-80, left + 10 : right - 10]
    return int((pixels.max(axis=2) - pixels.min(axis=2) > 90).sum())


def test_before_a_prediction_the_arm_is_not_there(visit):
    lab = visit("lesson/questions", size=(1400, 850), painted=True)
    lab.dismiss_toasts()
    before = saturated(lab)
    assert before > 300
    at_step(lab, 5)
    lab.until(lambda: saturated(lab) < 0.02 * before)
    assert shown(lab, "Answer the question of the lesson first.")
    assert lab.page.locator("output[data-live=px]").inner_text() == "?"
    lab.page.reload()  # nor after a reload
    lab.until(lambda: shown(lab, "Predict: your first answer counts."))
    lab.page.wait_for_function("() => document.querySelector('canvas[data-engine]')")
    lab.still(2.0)  # what must not come may come late
    lab.dismiss_toasts()
    assert saturated(lab) < 0.02 * before
    lab.type_into("lesson-answer", "1")
    lab.until(lambda: shown(lab, "Both links in a line"))
    lab.until(lambda: saturated(lab) > 0.5 * before)
    assert lab.page.locator("output[data-live=px]").inner_text() == "866.0 mm"
    assert lab.page.locator('input[data-cell="lesson-answer"]').is_disabled()
    assert lab.slider_value(1) == 30.0


def slow_click(lab, cell):
    """Press a button as long as a person does: the lab has answered before it is let go."""
    box = lab.page.locator(f'button[data-cell="{cell}"]').first.bounding_box()
    lab.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    lab.page.mouse.down()
    lab.page.wait_for_timeout(400)
    lab.page.mouse.up()


def test_answers_by_clicking_and_typing_are_saved_for_another_computer(visit, url, tmp_path):
    lab = visit("lesson/questions", size=(1400, 850))
    lab.press("lesson-choice-1")
    lab.until(lambda: shown(lab, "Count again."))
    lab.press("lesson-choice-2")
    lab.until(lambda: shown(lab, "Two it is."))
    lab.press("lesson-next")
    lab.until(lambda: shown(lab, "2 of 6"))
    lab.page.locator(".lesson-more summary").click()
    with lab.page.expect_download() as saved:
        lab.press("lesson-save")
    saved.value.save_as(tmp_path / "work.json")
    at_step(lab, 3)
    a_grid_is_filled(lab)
    become_somebody_else(lab, url)
    lab.open_tab("Lessons")
    assert lab.page.locator(".lesson-text").count() == 0
    lab.page.locator('input[data-cell="lesson-load"]').first.set_input_files(tmp_path / "work.json")
    lab.until(lambda: shown(lab, "2 of 6"))
    assert lab.page.locator(".strip.done").count() == 1


def become_somebody_else(lab, address):
    """Open the lab as a student it does not know."""
    lab.page.context.clear_cookies()
    lab.page.goto(address)
    lab.ready()


def a_grid_is_filled(lab):
    cells = [f'input[data-cell="lesson-entry-{i}-{j}"]' for i in (0, 1) for j in (0, 1)]
    lab.page.locator(cells[0]).click()
    for text in ("0,5", "0", "0"):
        lab.page.keyboard.type(text, delay=60)
        lab.page.keyboard.press("Tab")
        lab.page.wait_for_timeout(300)  # the lab has answered; the cursor is in the next field nevertheless
    lab.page.keyboard.type("1/2", delay=60)
    slow_click(lab, "lesson-check")
    lab.until(lambda: shown(lab, "✓ Right."))
    assert [lab.page.locator(cell).input_value() for cell in cells] == ["0,5", "0", "0", "1/2"]


def test_what_was_opened_and_read_stays_while_the_arm_moves(visit):
    lab = visit("lesson/long", size=(1400, 850))
    lab.page.locator(".lesson-text summary").click()
    lab.page.locator(".lesson-more summary").click()
    top = "() => document.querySelector('.lesson-text').scrollTop"
    lab.page.evaluate("() => document.querySelector('.lesson-text').scrollTo(0, 200)")
    first = lab.page.locator("output[data-live=q1]").first
    assert first.inner_text() == "30.0°"
    lab.drag_slider(1, 0.3)
    lab.until(lambda: first.inner_text() != "30.0°")
    lab.rest()
    assert lab.page.evaluate(top) == 200
    assert lab.page.locator(".lesson-text details").get_attribute("open") is not None
    lab.type_into("lesson-name", "Ada")
    assert lab.page.locator('input[data-cell="lesson-name"]').is_visible()
    lab.press("lesson-next")
    assert lab.page.evaluate(top) == 0
    assert lab.page.locator(".lesson-text details").count() == 1
    assert lab.page.locator(".lesson-text details[open]").count() == 0, "another step begins with its folds closed"


def test_with_the_fold_open_what_is_revealed_is_not_cut(visit):
    lab = visit("lesson/revealed", size=(1280, 800))
    lab.press("lesson-choice-1")
    lab.until(lambda: lab.page.locator(".reveal").count() == 1)
    hidden = "text => text.scrollHeight - text.clientHeight"
    assert lab.page.locator(".lesson-text").evaluate(hidden) > 0
    lab.page.locator(".lesson-more summary").click()
    lab.until(lambda: lab.page.locator(".lesson-text").evaluate(hidden) == 0)
    for selector in (".reveal", 'button[data-cell="lesson-save"]'):
        lab.page.locator(selector).scroll_into_view_if_needed()
        assert lab.page.locator(selector).is_visible()


# -- for a class -------------------------------------------------------------------------------------------------

SIZES = """() => [...document.querySelectorAll(
    '.lesson-text, .lesson-text :is(h2, small, p, li, a, code, td, th, math, b), .lesson-foot *, .ask *, .verdict *')]
  .filter(e => e.getClientRects().length && !e.closest('math') | e.localName === 'math')
  .map(e => [parseFloat(getComputedStyle(e).fontSize), e.localName, e.textContent.slice(0, 20)])
  .filter(([size]) => size < 24)"""


def test_small_windows_and_projectors_show_all_of_a_lesson(visit):
    lab = visit("lesson/first_arm", size=(1024, 700))
    a_step_begins_at_its_top_and_nothing_is_cut(lab)
    for size in ((1024, 700), (1400, 850)):
        lab.resize(size)
        lab.press("lesson-step-0")
        a_projector_shows_large_text_and_no_benches(lab)
    lab.page.locator("select[data-cell=lesson-key]").select_option("table")
    lab.until(lambda: lab.page.locator(".lesson-text table").count() == 1)
    a_table_on_a_projector_is_large_too(lab)


def a_step_begins_at_its_top_and_nothing_is_cut(lab):
    left, right, width = lab.scene()
    assert left == 0
    assert right / width > 0.59  # one column: the lesson above the bench
    scrolled = "() => document.querySelector('.lesson-text').closest('.mantine-ScrollArea-viewport').scrollTop"
    lab.page.locator(".lesson-text summary").click()
    lab.page.mouse.move(right + 100, 200)
    lab.page.mouse.wheel(0, 300)
    lab.until(lambda: lab.page.evaluate(scrolled) > 20)
    lab.press("lesson-next")
    assert shown(lab, "2 of 4")
    lab.until(lambda: lab.page.evaluate(scrolled) == 0)
    for selector in (".lesson-head", ".strips", ".lesson-text", ".verdict.todo", ".lesson-foot"):
        assert not cut(lab, selector), selector
    assert lab.page.locator(f"{lab.slider_track(2)} [role=slider]").first.is_visible()


def a_projector_shows_large_text_and_no_benches(lab):
    bench = lab.page.locator("[data-dock-region=right]")
    assert bench.is_visible()
    before = lab.scene()
    lab.page.mouse.click(before[0] + 60, 300)
    lab.page.keyboard.press("v")
    lab.until(lambda: not bench.is_visible())
    lab.rest()
    assert lab.page.evaluate(SIZES) == []
    left, right, width = lab.scene()
    assert right == width
    assert left == pytest.approx(0.42 * width, abs=2)
    lab.page.keyboard.press("PageDown")
    lab.until(lambda: shown(lab, "2 of 4"))
    lab.page.keyboard.press("PageDown")
    lab.until(lambda: shown(lab, "3 of 4"))
    assert lab.page.evaluate(SIZES) == []
    lab.page.keyboard.press("PageUp")
    lab.until(lambda: shown(lab, "2 of 4"))
    for selector in (".lesson-head", ".strips", ".lesson-text", ".lesson-foot"):
        assert not cut(lab, selector), selector
    lab.page.keyboard.press("Escape")
    lab.until(bench.is_visible)
    lab.until(lambda: lab.scene() == before)
    lab.page.keyboard.press("v")
    lab.until(lambda: not bench.is_visible())
    lab.page.keyboard.press("v")
    lab.until(bench.is_visible)


def a_table_on_a_projector_is_large_too(lab):
    lab.page.evaluate("() => document.activeElement.blur()")
    lab.page.keyboard.press("v")
    lab.until(lambda: not lab.page.locator("[data-dock-region=right]").is_visible())
    lab.rest()
    assert lab.page.evaluate(SIZES) == []


# -- script that others have written -----------------------------------------------------------------------------


def hostile_link():
    """Return a link to an arm with such a name, as somebody with ill will would make it."""
    state = State.initial(library().lesson("hostile").robot_used)
    assert PWN in state[RobotPart].robot.name
    checked, share._check_words = share._check_words, lambda robot: None
    try:
        return share.short(state)
    finally:
        share._check_words = checked


def test_script_of_others_does_not_run(visit, url):
    lab = visit("lesson/hostile", size=(1400, 850))
    lab.press("lesson-hint")
    lab.press("lesson-choice-1")
    lab.until(lambda: shown(lab, "Says <script>"))
    lab.press("lesson-choice-2")
    lab.until(lambda: shown(lab, "Reveal <script>"))
    lab.page.locator(".lesson-more summary").click()
    lab.type_into("lesson-name", PWN)
    assert lab.page.locator('input[data-cell="lesson-name"]').input_value() == " ".join(PWN.split())[:80]
    with lab.page.expect_download() as saved:
        lab.press("lesson-save")
    assert saved.value.suggested_filename.endswith(".json")
    lab.open_tab("Lessons")
    lab.press("lesson-sandbox")
    lab.until(lambda: shown(lab, "Back to Title <script>"))
    assert lab.page.evaluate("() => window.__pwned") is None
    become_somebody_else(lab, f"{url}state/{hostile_link()}")
    assert lab.page.evaluate("() => window.__pwned") is None
    assert "<script" not in lab.page.evaluate("() => document.querySelector('#al-notes').parentElement.innerHTML")
    for path in ("state/%3Cscript%3Ewindow.__pwned=1%3C%2Fscript%3E", "lesson/%3Cscript%3E", "state/" + "A" * 1400):
        lab.page.goto(url + path)
        lab.page.wait_for_timeout(300)
        assert lab.page.evaluate("() => window.__pwned") is None
    lab.errors[:] = [error for error in lab.errors if "Failed to load resource" not in error]  # what is refused
