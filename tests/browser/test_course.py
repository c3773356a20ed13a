"""The course, by hand: a newcomer begins, goes on to the next lesson, sees the way on the map, and prints it."""

import re

import numpy as np
import pytest

from armlab.content.lessons import lesson, lessons
from support.axe import findings

pytestmark = pytest.mark.browser

PAGE, PHONE = (1400, 850), {"width": 390, "height": 844}

PAGES = range(3, 9)
"""Numbers of pages that the course may have on paper."""

WIDER = "() => document.documentElement.scrollWidth > innerWidth"

WIDER_FONT = "@media print { body { font-size: 7.8pt !important } }"
"""Takes the room that a font takes on a machine whose fonts are wider than those of this one."""

CUT = """() => [...document.querySelectorAll('.lm-lesson b, .lm summary span, .lm summary small')]
  .filter(e => e.scrollWidth > e.clientWidth + 1 || e.getBoundingClientRect().right > innerWidth)
  .map(e => e.textContent)"""
"""Words of the map that do not fit into their place."""


def row(lab, key):
    return lab.page.locator(f'[data-cell="lesson:{key}"]')


def sign(lab, key):
    return row(lab, key).locator("u").inner_text()


def test_a_newcomer_begins_goes_on_and_sees_the_way(visit):
    lab = visit(size=PAGE)
    first, second = lessons().course().lessons[:2]
    begin = lab.page.locator(f'.al-card [data-cell="start-{first}"]')
    assert begin.inner_text().split("\n")[:2] == [lessons()[first].title, f"{lessons()[first].minutes} min"]
    begin.click()
    lab.ready()
    one_does_the_first_lesson(lab, first)
    the_map_shows_it(lab, first, second)
    lab.press("lesson-onward")
    lab.ready()
    lab.until(lambda: f"/lesson/{second}" in lab.address())
    lab.open_tab("Lessons")
    lab.until(lambda: sign(lab, second) == "●")
    assert sign(lab, first) == "✓"
    assert not lab.page.evaluate(CUT)
    what_needs_others_first_opens_all_the_same(lab)
    the_course_is_printed(lab)


def one_does_the_first_lesson(lab, key):
    """Every student has a variant of their own, which the address tells."""
    first = lesson(key, int(re.search(rf"{key}/(\d+)", lab.address())[1]))
    straight, bent, number, turned = first.steps
    moved_to(lab, straight)
    lab.until(lambda: lab.page.locator(".verdict.ok").count() == 1)
    lab.press("lesson-next")
    moved_to(lab, bent)
    lab.until(lambda: lab.page.locator(".verdict.ok").count() == 1)
    lab.press("lesson-next")
    lab.type_into("lesson-answer", f"{number.question.answer:.3f}")
    lab.until(lambda: lab.page.locator(".verdict.ok").count() == 1)
    lab.press("lesson-next")
    assert lab.page.locator(".lesson-can").count() == 0
    assert lab.page.locator("[data-cell=lesson-onward]").is_visible(), "nothing is locked"
    lab.press("lesson-choice-1")
    moved_to(lab, turned)
    lab.until(lambda: "You can now" in lab.page.inner_text("body"))
    assert not findings(lab, whole=True)


def moved_to(lab, step):
    """Type the joint values of a step's solution."""
    for joint, value in enumerate(np.degrees(step.solution[0].q), start=1):
        lab.type_into(f"value {joint}", f"{value:.0f}")


def the_map_shows_it(lab, first, second):
    lab.open_tab("Lessons")
    lab.until(lambda: f"1 of {len(lessons().course().lessons)} lessons done" in lab.page.inner_text("body"))
    assert sign(lab, first) == "✓"
    assert row(lab, first).get_attribute("aria-current") == "true"
    assert sign(lab, second) == "▸"
    onward = lab.page.locator("[data-cell=lesson-onward]").inner_text()
    assert onward == f"Next lesson: {lessons()[second].title}, {lessons()[second].minutes} min"
    assert not lab.page.evaluate(CUT)


def what_needs_others_first_opens_all_the_same(lab):
    early = row(lab, "ik_2r")
    assert "first: The planar arm" in early.inner_text()
    early.click()
    lab.ready()
    lab.until(lambda: "/lesson/ik_2r" in lab.address())


def the_course_is_printed(lab):
    """The paper is light whatever the look of the lab."""
    lab.open_tab("Lessons")
    with lab.page.context.expect_page() as opened:
        lab.page.get_by_text("To print", exact=True).click()
    paper = opened.value
    paper.emulate_media(color_scheme="dark")
    course = lessons().course()
    assert paper.locator("h1").inner_text() == course.title
    assert paper.locator("li > i").count() == len(course.lessons)
    assert paper.evaluate("() => getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    paper.set_viewport_size(PHONE)
    assert not paper.evaluate(WIDER)
    assert paper.pdf(format="A4").count(b"/Type /Page\n") in PAGES
    paper.locator("a", has_text=lessons()["statics"].title).click()
    paper.wait_for_url("**/lesson/statics")
    paper.close()


def test_the_formulas_fill_exactly_two_pages_and_paper_is_read_on_a_phone(browser, url):
    paper = browser.new_page()
    paper.goto(f"{url}formulas")
    for look in ("@media print {}", WIDER_FONT):
        paper.add_style_tag(content=look)
        printed = paper.pdf(prefer_css_page_size=True).decode("latin-1")
        sizes = [tuple(map(float, size)) for size in re.findall(r"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", printed)]
        assert sizes == [pytest.approx((595.3, 841.9), abs=1.0)] * 2, "two pages A4, in points"
    paper.set_viewport_size(PHONE)
    for address in ("formulas", "guide"):
        paper.goto(f"{url}{address}")
        assert not paper.evaluate(WIDER), address
    paper.close()
