"""The page Errata in a real browser: one is looked up and run again, drawn on the arm, spotted and put right."""

import re

import pytest

pytestmark = pytest.mark.browser

CUT = """() => [...document.querySelectorAll('.er-form, .er-entry, .er-parts, .er-why, .er-where')]
  .filter(each => each.getBoundingClientRect().right > innerWidth).length"""
SHOWN = """() => Object.entries(__viserMutable.nodeRefFromName)
  .filter(([name, node]) => /errata.*arrows/.test(name) && node?.visible).length"""


def residuals(lab):
    """Return the largest residuals of both forms, as the page has them."""
    return lab.page.locator(".er-form .er-head span b").all_inner_texts()


def test_an_erratum_is_looked_up_run_drawn_and_put_right(visit):
    lab = visit("robot/planar_2r", size=(1024, 700))
    lab.open_tab("errata")
    lab.type_into("query", "5.58")
    lab.press("erratum 5.58")
    _runs_both_forms_again(lab)
    _draws_the_wrong_result_beside_the_right_one(lab)
    _finds_others_in_the_list(lab)
    _spots_the_error_and_puts_it_right(lab)


def test_a_lesson_opens_it_beside_itself(visit):
    lab = visit("lesson/damped", size=(1024, 700))
    mark = lab.page.locator(".lesson-text button.erratum").first
    key = mark.get_attribute("data-cell").removeprefix("erratum ")
    mark.click()
    lab.page.locator('.er-entry[aria-current="true"]', has_text=key).wait_for()
    lab.page.locator(".er-form.er-right").wait_for()
    assert lab.page.locator(".lesson-text").is_visible()


def _runs_both_forms_again(lab):
    lab.page.locator("h3", has_text="after 5.58").wait_for()
    lab.until(lambda: len(residuals(lab)) == 2)
    before = residuals(lab)
    lab.press("again")
    lab.until(lambda: len(residuals(lab)) == 2 and residuals(lab) != before)
    assert "10⁻" in residuals(lab)[1]
    assert lab.page.locator(".verdict, .no", has_text="wrong at 20 of 20").count() >= 1
    assert lab.page.evaluate(CUT) == 0


def _draws_the_wrong_result_beside_the_right_one(lab):
    lab.until(lambda: lab.page.evaluate(SHOWN) > 0)
    assert lab.page.locator(".al .verdict", has_text=re.compile(r"On the .*: .* off")).count() == 1


def _finds_others_in_the_list(lab):
    lab.type_into("query", "no such words")
    lab.page.get_by_text("Nothing is found.").wait_for()
    lab.type_into("query", "1.58")
    lab.page.locator(".er-count", has_text="1 of 118").wait_for()
    lab.press("erratum 1.58")
    lab.page.locator("h3", has_text="1.58").wait_for()
    lab.until(lambda: lab.page.evaluate(SHOWN) == 0)
    lab.type_into("query", "")
    lab.page.locator(".er-count", has_text="118 of 118").wait_for()


def _spots_the_error_and_puts_it_right(lab):
    lab.press("view practise")
    lab.page.locator('select[data-cell="task"]').select_option("4.110")
    lab.press("part 1")
    lab.page.get_by_text("This part is right as it stands.").wait_for()
    assert lab.page.locator('[data-cell="lesson-answer"]').count() == 0
    lab.press("part 2")
    lab.page.get_by_text("Here it is wrong.").wait_for()
    lab.type_into("lesson-answer", "f/d")
    lab.page.locator(".verdict.no").wait_for()
    lab.type_into("lesson-answer", "x - f/d")
    lab.page.get_by_text("1 of 45 spotted and put right").wait_for()
