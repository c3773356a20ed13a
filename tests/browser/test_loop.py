"""The velocity loop and the matrix exponential in a real browser: their numbers, the film, and nothing that is cut."""

import pytest

pytestmark = pytest.mark.browser


def test_the_loop_and_its_film_tell_the_error_and_the_exponential_refuses_in_words(visit):
    lab = visit()
    lab.open_tab("loop")
    lab.unfold("Frequency response")
    lab.page.locator(".loop-bode").wait_for()
    assert "0.1961 m/s, 19.6 % of v" in lab.page.locator(".al .verdict").first.inner_text()
    lab.page.locator('select[data-cell="example"]:visible').select_option("omega_20")
    lab.page.locator(".al .verdict", has_text="89.4 % of v").wait_for()
    lab.type_into("time", "0.5")
    lab.until(lambda: "−0.544 m/s" in lab.page.locator(".loop-diagram").inner_html())
    lab.page.locator('.al-time button[data-cell="forward"]').click()
    lab.until(lambda: "−0.544 m/s" not in lab.page.locator(".loop-diagram").inner_html())
    wide = lab.page.evaluate(
        """() => [...document.querySelectorAll('.loop-diagram, .loop-bode, .loop-form')]
          .filter(each => each.scrollWidth > each.clientWidth + 1 || each.getBoundingClientRect().width > 345).length"""
    )
    assert wide == 0
    lab.press("exponential")
    lab.page.locator(".exp-plane").wait_for()
    assert lab.page.locator(".exp-result").count() == 3
    lab.page.locator('select[data-cell="example"]:visible').select_option("defective")
    lab.page.locator(".al .verdict", has_text="A is not diagonalisable").wait_for()
    lab.type_into("a11", "1000000")
    lab.page.locator("p.no[role=alert]").wait_for()
    assert lab.page.locator('input[data-cell="a11"]').get_attribute("aria-invalid") == "true"
