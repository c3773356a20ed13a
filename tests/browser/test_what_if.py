"""Compare designs, in a real browser: a slider, both workspaces in the scene, what is said, and taking it over."""

import pytest

pytestmark = pytest.mark.browser

CUT = """() => [...document.querySelectorAll('.wi-figures, .wi-changes, .wi-section, .wi-legend')]
  .filter(each => each.scrollWidth > each.clientWidth + 1 || each.getBoundingClientRect().right > innerWidth).length"""
COUNT = """suffix => {
  const found = Object.entries(window.__viserMutable.nodeRefFromName)
    .find(([name, node]) => name.endsWith(suffix) && node?.visible);
  let points = 0;
  found?.[1].traverse(each => { points = Math.max(points, each.geometry?.attributes.position?.count ?? 0); });
  return points;
}"""


def points(lab, name):
    return lab.page.evaluate(COUNT, f"/what_if/{name}")


def drag_value(lab, fraction):
    """Drag the thumb of the page's slider to a fraction of its track."""
    label = lab.page.locator("label", has_text="a₂ mm").first.get_attribute("for")
    track = lab.page.locator(f'[id="{label}"]').first.bounding_box()
    thumb = lab.page.locator(f'[id="{label}"] [role=slider]').first.bounding_box()
    y = thumb["y"] + thumb["height"] / 2
    lab.page.mouse.move(thumb["x"] + thumb["width"] / 2, y)
    lab.page.mouse.down()
    for k in range(1, 7):
        goal = track["x"] + fraction * track["width"]
        lab.page.mouse.move(thumb["x"] + (goal - thumb["x"]) * k / 6, y)
        lab.frames(1)
    lab.page.mouse.up()


def test_a_longer_link_is_previewed_compared_and_taken_over(visit):
    lab = visit("robot/elbow_3r")
    lab.open_tab("Compare designs")
    lab.page.locator(".wi-section").wait_for()
    lab.until(lambda: points(lab, "kept") > 1000)
    drag_value(lab, 0.75)
    lab.page.locator(".al .verdict", has_text="The volume is larger").wait_for()
    assert lab.page.locator(".wi-changes b").count() == 1
    lab.until(lambda: points(lab, "gained") > 100)
    assert lab.page.locator(".wi-section :is(.was, .then)").count() == 2
    assert lab.page.evaluate(CUT) == 0
    lab.type_into("value", "900")
    lab.page.locator(".wi-changes b", has_text="900.0 mm").wait_for()
    lab.press("take")
    now = lab.page.locator(".al .row", has_text="now 900.0 mm")
    now.wait_for()
    assert lab.page.locator(".wi-changes").count() == 0
    lab.page.keyboard.press("Control+z")
    now.wait_for(state="detached")
