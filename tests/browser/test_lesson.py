"""A student does a lesson in the page."""

import numpy as np
import pytest

pytestmark = pytest.mark.browser


def scene(lab):
    """Return left and right end of the scene, and the width of the window."""
    return lab.page.evaluate(
        """() => {
          const box = document.querySelector('canvas[data-engine]').getBoundingClientRect();
          return [box.left, box.right, innerWidth];
        }"""
    )


def shown(lab, text):
    """Return whether a text is seen."""
    return lab.page.get_by_text(text, exact=False).first.is_visible()


def cut(lab, selector):
    """Return whether an element sticks out of the window or of its own box."""
    return lab.page.evaluate(
        """selector => {
          const e = document.querySelector(selector), box = e.getBoundingClientRect();
          return e.scrollWidth > e.clientWidth + 1 || box.bottom > innerHeight || box.right > innerWidth;
        }""",
        selector,
    )


def test_a_lesson_from_its_link_to_its_end_with_a_reload(visit):
    lab = visit("lesson/first_arm", size=(1400, 850))
    assert "/lesson/first_arm" in lab.address()
    left, right, _ = scene(lab)
    assert 270 < left < 300
    assert (right - left) / 1400 > 0.54
    assert shown(lab, "Step 1 of 3")
    assert lab.page.locator(".lesson-text math").count() > 3
    assert "2105.1 mm away" in lab.page.locator(".verdict.todo").inner_text()
    assert lab.page.locator('button[data-cell="lesson-next"]').inner_text() == "Skip ›"
    lab.press("stretched")
    lab.until(lambda: shown(lab, "✓ Done"))
    # The whole arm is in the picture where the lesson has led it.
    at = lab.on_screen("/target")
    assert left < at[0] < right
    lab.press("lesson-next")
    assert shown(lab, "Step 2 of 3")
    lab.press("right angle")
    lab.until(lambda: shown(lab, "✓ Done"))
    lab.press("lesson-next")
    lab.type_into("lesson-answer", "0.5")
    lab.until(lambda: shown(lab, "Both joints turn the second link"))
    lab.page.reload()
    lab.ready()
    lab.until(lambda: shown(lab, "Step 3 of 3"))
    assert lab.page.locator('input[data-cell="lesson-answer"]').input_value() == "0.5"
    np.testing.assert_allclose(lab.slider_values(2), [0.0, 90.0])
    assert lab.page.locator(".strip.done").count() == 2
    lab.page.locator('input[data-cell="lesson-answer"]').fill("0,866")
    lab.page.locator('button[data-cell="lesson-check"]').click()
    lab.until(lambda: shown(lab, "✓ Lesson done"))
    lab.press("lesson-close")
    lab.until(lambda: scene(lab)[0] == 0)
    lab.until(lambda: "/robot/planar_2r" in lab.address())
    assert lab.page.locator(".lesson-text").count() == 0


def test_a_step_begins_at_its_top_and_nothing_is_cut_in_a_small_window(visit):
    lab = visit("lesson/first_arm", size=(1024, 700))
    left, right, width = scene(lab)
    assert left == 0
    assert right / width > 0.63  # one column: the lesson above the bench
    scrolled = "() => document.querySelector('.lesson-text').scrollTop"
    lab.page.evaluate("() => document.querySelector('.lesson-text').scrollTo(0, 1e6)")
    assert lab.page.evaluate(scrolled) > 20
    lab.press("lesson-next")
    assert shown(lab, "Step 2 of 3")
    assert lab.page.evaluate(scrolled) == 0
    for selector in (".lesson-head", ".strips", ".lesson-text", ".verdict.todo", ".lesson-foot"):
        assert not cut(lab, selector), selector
    assert lab.page.locator(f"{lab.slider_track(2)} [role=slider]").first.is_visible()


def test_a_lesson_is_chosen_in_the_bench_and_its_dock_lets_a_typed_answer_be(visit):
    lab = visit(size=(1400, 850))
    lab.open_tab("Lessons")
    lab.press("first_arm")
    lab.ready()
    lab.until(lambda: shown(lab, "Step 1 of 3"))
    assert scene(lab)[0] > 270
    assert lab.page.locator('[role=tab][title="Joints"]').get_attribute("aria-selected") == "true"
    lab.press("lesson-step-2")
    field = lab.page.locator('input[data-cell="lesson-answer"]')
    lab.type_into("lesson-answer", "0.8")
    lab.until(lambda: shown(lab, "not the answer yet"))
    field.fill("0.86")
    lab.drag_slider(1, 0.7)
    assert field.input_value() == "0.86"
    chosen = lab.page.locator('select[data-cell="lesson-key"]').input_value()
    assert chosen == "first_arm"
