"""What the lab says of an entry is seen in a window that is too low for the whole panel."""

import pytest

pytestmark = pytest.mark.browser

LOW = (1024, 700)

REFUSAL, VERDICT = "[data-heard] > [role=alert]", ".ask ~ .verdict"

IN_SIGHT = """said => {
  const view = said.closest('.mantine-ScrollArea-viewport').getBoundingClientRect();
  const { top, bottom, height } = said.getBoundingClientRect();
  return height > 0 && top >= view.top && bottom <= Math.min(view.bottom, innerHeight);
}"""
"""Whether all of a sentence is seen."""

SCROLLED = "said => said.closest('.mantine-ScrollArea-viewport').scrollTop"


def refused(lab, key):
    """Type what is no number into the first field of the page, and leave it by a key."""
    field = lab.page.locator('input[data-cell="point 0"]:visible')
    field.fill("foo")
    field.press(key)
    lab.rest()


def test_a_refusal_below_the_edge_is_brought_into_sight_once(visit):
    lab = visit(size=LOW)
    lab.open_tab("atan2")
    refused(lab, "Enter")
    assert lab.page.locator(REFUSAL).evaluate(IN_SIGHT)
    assert lab.page.locator(REFUSAL).evaluate(SCROLLED) > 0
    lab.page.mouse.move(900, 300)
    lab.page.mouse.wheel(0, -2000)
    lab.until(lambda: lab.page.locator(REFUSAL).evaluate(SCROLLED) == 0)
    lab.open_tab("Joints")
    lab.open_tab("atan2")
    lab.still(0.5)
    assert lab.page.locator(REFUSAL).evaluate(SCROLLED) == 0


def test_a_refusal_takes_nobody_away_from_the_next_field(visit):
    lab = visit(size=LOW)
    lab.open_tab("atan2")
    refused(lab, "Tab")
    assert lab.page.evaluate("() => document.activeElement.dataset.cell") == "point 1"
    assert lab.page.locator(REFUSAL).evaluate(SCROLLED) == 0


def test_the_verdict_on_an_answer_is_brought_into_sight(visit):
    lab = visit("lesson/ik_2r", size=(1024, 420))
    lab.type_into("lesson-answer", "px")
    assert lab.page.locator(VERDICT).evaluate(IN_SIGHT)
