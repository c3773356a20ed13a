"""Solve for joint speeds in the page: a singular arm, a velocity that is typed, and the pictures."""

import math

import pytest

from armlab.benches.velocity.solve.ui.pictures import ROWS
from armlab.ui.colours import css
from support.page import LabPage

pytestmark = pytest.mark.browser


def opened(visit, page):
    lab: LabPage = visit("robot/planar_2r", size=(1400, 850))
    lab.open_tab("Velocity")
    lab.rest()
    lab.press(page)
    return lab


def table(lab):
    """Return the numbers of v, what is reached and what is lost."""
    text = lab.page.locator(".so-table").first.inner_text().replace("−", "-")
    rows = [line.split() for line in text.splitlines() if "mm/s" in line]
    return [[float(value) for value in row if value.lstrip("-").replace(".", "").isdigit()] for row in rows]


def test_a_stretched_arm_says_why_it_has_no_answer_and_is_moved_in_the_square(visit):
    lab = opened(visit, "solve")
    lab.page.locator("select[data-cell=example]").select_option("stretched_30")
    lab.page.wait_for_function("() => document.body.innerText.includes('No joint speeds give v')")
    lab.rest()
    (vx, vy) = table(lab)
    assert vx[:3] == [-500.0, -125.0, -375.0]
    assert vy[:3] == [0.0, 216.5, -216.5]
    said = lab.page.inner_text("body")
    assert "Elbow: the arm is stretched" in said
    assert "boundary" in said
    assert lab.page.locator(".so-null").count() == 1
    names = lab.nodes()
    assert any(name.endswith("solve/v/arrows") for name in names)
    # What is inside the range has infinitely many answers: across the arm.
    lab.type_into("v-0", "-100")
    lab.type_into("v-1", f"{100.0 * math.sqrt(3.0):.9f}")
    lab.page.wait_for_function("() => document.body.innerText.includes('Infinitely many answers')")
    lab.press("pictures")
    square = lab.page.locator(".so-map")
    square.scroll_into_view_if_needed()
    lab.rest()
    box = square.bounding_box()
    lab.page.mouse.click(box["x"] + 0.75 * box["width"], box["y"] + 0.5 * box["height"] - 1)

    def place():
        mark = lab.page.locator(".so-map .so-here").bounding_box()
        return math.nan if mark is None else (mark["x"] + mark["width"] / 2 - box["x"]) / box["width"]

    lab.until(lambda: abs(place() - 0.75) < 0.012)
    lab.page.mouse.down()
    for share in (0.7, 0.65, 0.6):
        lab.page.mouse.move(box["x"] + share * box["width"], box["y"] + 0.5 * box["height"] - 1)
    lab.until(lambda: abs(place() - 0.6) < 0.012)
    lab.page.mouse.up()
    assert lab.page.locator(f'.so-lines path[stroke="{css(ROWS[0])}"]').count() == 1
    inside = lab.page.evaluate(
        """() => [...document.querySelectorAll('.so-lines, .so-square, .so-norm')].every(each => {
          const box = each.getBoundingClientRect();
          return box.width > 100 && box.right <= innerWidth;
        })"""
    )
    assert inside


SQUARE_TOP = """() => {
  let top = 0;
  for (let each = document.querySelector('.so-square'); each; each = each.offsetParent) top += each.offsetTop;
  return top;
}"""


@pytest.mark.parametrize("size", [(1400, 850), (1024, 700)])
def test_the_square_stays_in_place_where_the_lines_become_parallel(visit, size):
    """Otherwise it would move under the hand that drags in it, and the arm with it."""
    lab = opened(visit, "solve")
    lab.resize(size)
    tops = set()
    for example in ("one", "stretched_30", "stretched_90"):
        lab.press("solve")
        lab.page.locator("select[data-cell=example]").select_option(example)
        lab.rest()
        lab.press("pictures")
        lab.page.wait_for_selector(".so-square")
        lab.rest()
        tops.add(lab.page.evaluate(SQUARE_TOP))
    assert len(tops) == 1
