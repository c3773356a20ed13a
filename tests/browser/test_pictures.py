"""Pictures in lessons, shown large."""

import pytest

pytestmark = pytest.mark.browser


def test_a_picture_is_shown_large_by_a_press_or_a_key_and_gives_the_focus_back(visit):
    lab = visit("lesson/two_robots")
    picture = lab.page.locator(".lesson-text").get_by_role("button", name="Robot A on the left")
    large = lab.page.locator("dialog[open] img")
    picture.focus()
    lab.page.keyboard.press("Enter")
    box = large.bounding_box()
    assert box["width"] > 800, "the window has 900"
    lab.page.keyboard.press("v")
    assert not lab.page.locator("html[data-projector]").count(), "the keys of the page rest"
    lab.page.keyboard.press("Escape")
    large.wait_for(state="detached")
    assert picture.evaluate("picture => picture === document.activeElement")
    picture.click()
    large.click()
    large.wait_for(state="detached")
