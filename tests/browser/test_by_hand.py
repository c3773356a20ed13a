"""The page "Closed-form IK" in a real browser: no equation lies on another, and the step that is chosen is drawn."""

import pytest

pytestmark = pytest.mark.browser

OVERLAPS = """() => {
  const found = [];
  const boxes = (within, kind) =>
    [...within.querySelectorAll(kind)].map(one => [one.textContent, one.getBoundingClientRect()]);
  const meet = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
  const apart = list => list.forEach(([what, a], i) => list.slice(i + 1).forEach(([other, b]) => {
    if (a.width && b.width && meet(a, b)) found.push([what, other]);
  }));
  for (const step of document.querySelectorAll('.bh-step')) {
    apart(boxes(step, '.eq'));
    for (const given of step.querySelectorAll('.bh-given')) apart(boxes(given, 'span'));
    for (const eq of step.querySelectorAll('.bh-eq')) apart(boxes(eq, ':scope > *'));
  }
  for (const eq of document.querySelectorAll('.eq'))
    for (const math of eq.querySelectorAll('math')) {
      const [inner, outer] = [math.getBoundingClientRect(), eq.getBoundingClientRect()];
      const inside = inner.top > outer.top - 1 && inner.bottom < outer.bottom + 1;
      if (!inside) found.push([math.textContent, "out of its box"]);
    }
  return found;
}"""


def by_hand(visit, robot):
    lab = visit(f"robot/{robot}")
    lab.open_tab("Target")
    lab.page.locator('button.page[data-cell="by_hand"]').click()
    lab.until(lambda: lab.page.locator(".bh-step").count() > 0)
    lab.rest()
    return lab


@pytest.mark.parametrize("robot", ["puma560", "youbot"])
def test_no_equation_lies_on_another(visit, robot):
    _lies_apart(by_hand(visit, robot))


def _lies_apart(lab):
    lab.press("unfold")
    assert lab.page.locator(".bh-eq").count() > 8
    assert lab.page.evaluate(OVERLAPS) == []


def test_a_step_lies_apart_is_chosen_and_drawn_and_its_branch_brings_the_arm_there(visit):
    lab = by_hand(visit, "ur5e")
    assert not any(name.endswith("by_hand/faces") for name in lab.nodes())
    _lies_apart(lab)
    lab.press("step8")
    lab.until(lambda: any(name.endswith("by_hand/faces") for name in lab.nodes()))
    chosen = lab.page.locator('.bh-step.now .chip[aria-pressed="true"]').inner_text()
    lab.page.locator('.bh-step.now .chip[aria-pressed="false"]').first.click()
    lab.until(lambda: lab.page.locator('.bh-step.now .chip[aria-pressed="true"]').inner_text() != chosen)
    lab.rest()
    wanted = lab.page.locator(".bh-step.now .bh-head em").inner_text()
    lab.press("go")
    lab.until(lambda: lab.page.locator('button[data-cell="go"]').inner_text() == "The arm is here")
    lab.open_tab("Joints")
    lab.rest()
    # The arm takes the nearest whole turn.
    gap = lab.slider_value(3) - float(wanted.rstrip("°").replace("−", "-"))
    assert abs((gap + 180.0) % 360.0 - 180.0) < 0.1
