"""Lessons about motions over the wire: examples, pages, and checks of a plan that is worked out beside."""

import json

import pytest

from armlab.session.pages import tabs
from support.lab import running_lab
from support.motion_lesson import MOTION
from support.own_lessons import in_lesson, notes, piece, to_step, write
from support.student import run


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    text = MOTION.replace("## Slowly", "## Slowly\n\nIt takes {{duration}}.")
    folder = write(tmp_path_factory.mktemp("lessons"), corners=text)
    with running_lab(lessons=folder) as address:
        yield address


async def opened(browser):
    """Do what the page's script does: bring the tab to the front that is asked for; return its key."""
    key = next(key for key, pages in tabs().items() if pages[0].title == notes(browser)["tab"])
    value = json.dumps(["tabs", json.dumps([key]), 0])
    await browser.send({"type": "GuiUpdateMessage", "uuid": notes(browser)["chan"], "updates": {"value": value}})
    return key


def test_the_example_is_in_place_and_the_page_of_each_step_is_open(url):
    async def main():
        browser = await in_lesson(url, "corners")
        assert await opened(browser) == "motion"
        await browser.until(lambda: 'value="corner_stop" selected' in browser.html())
        await to_step(browser, 4)
        await browser.until(lambda: 'value="triangle" selected' in browser.html())
        assert await opened(browser) == "motion"
        await to_step(browser, 5)
        await browser.until(lambda: 'value="spline" selected' in browser.html())
        await browser.close()

    run(main())


def test_a_check_is_met_by_the_plan_although_another_tab_is_open(url):
    async def main():
        browser = await in_lesson(url, "corners")
        await to_step(browser, 3)
        await browser.until(lambda: "To do" in piece(browser, "verdict todo"))
        assert "<output" in piece(browser, "lesson-text")
        await browser.until(lambda: ">–</output>" not in piece(browser, "lesson-text"))
        await opened(browser)
        await browser.until(lambda: 'data-cell="time-given"' in browser.html())
        await browser.press("time-given")
        await browser.until(lambda: 'data-cell="duration"' in browser.html())
        await browser.until(lambda: "; at least 10.00 s is required." in piece(browser, "verdict todo"))
        await browser.open("joints")
        await browser.press("duration", "10")
        await browser.until(lambda: "✓ Done" in browser.html())
        await browser.until(lambda: "10.00 s</output>" in piece(browser, "lesson-text"))
        await browser.press("lesson-setup")
        await browser.until(lambda: "10.00 s</output>" not in piece(browser, "lesson-text"))
        await browser.close()

    run(main())
