"""The tray of large plots as a student uses it: values, curves, zoom, height, the arm under the cursor, and files."""

import io
import json

import numpy as np
import pytest
from PIL import Image

pytestmark = pytest.mark.browser

COMINGS = """() => {
  window.__comings = 0;
  new MutationObserver(changes => {
    for (const { addedNodes } of changes) {
      for (const node of addedNodes) if (node.matches?.('.al-tray')) window.__comings++;
    }
  }).observe(document.body, { childList: true });
}"""
"""Counts how often the tray comes from now on."""

BOX = """box => {
  const r = document.querySelector(box).getBoundingClientRect();
  return [r.left, r.top, r.width, r.height];
}"""
VALUES = "() => [...document.querySelectorAll('.tray-plot:first-child .tray-legend b')].map(each => each.textContent)"
CURVES = "() => document.querySelectorAll('.tray-plot:first-child .curve').length"
DASHES = """() => [...document.querySelectorAll(".tray-plot:first-child .curve")]
  .map(each => each.getAttribute("stroke-dasharray"))"""
ENDS = """() => [...document.querySelectorAll('.tray-plot:first-child .tray-svg text')]
  .map(each => each.textContent).filter(each => /^[−0-9.]+$/.test(each))"""
TIME = "() => Number(document.querySelector('.al-time .now')?.textContent.split(' ')[0] ?? NaN)"
FOLLOWS = """() => {
  const over = document.querySelector('.tray-plot:first-child .tray-over'), before = over.innerHTML;
  window.armlabTray.time(0.2 + Math.random() / 2);
  return over.innerHTML !== before;
}"""
"""Whether the cursor of the first plot follows the time of the page."""

FOCUS = "() => document.activeElement.dataset.curve ?? document.activeElement.className"
SIZE = (1180, 760)


def open_tray(lab):
    """Put two plots of a motion into the tray."""
    lab.page.evaluate("document.activeElement.blur()")
    assert not lab.page.query_selector(".al-tray")
    lab.page.keyboard.press("x")
    lab.page.wait_for_selector(".tray-plot:first-child .curve")


def number(text):
    return float(text.replace("−", "-"))


def test_a_hand_reads_hides_zooms_and_scrubs_saves_files_and_the_tray_closes_with_its_page(visit):
    lab = visit("robot/puma560", size=SIZE)
    lab.open_tab("Motion")
    lab.press("motion_plots")
    open_tray(lab)
    _is_read_hidden_zoomed_scrubbed_and_put_away(lab, lab.page)
    open_tray(lab)
    _lets_the_cursor_go_when_it_is_closed_in_the_hand(lab, lab.page)
    _saves_files_and_closes_with_its_page(lab, lab.page)


def _is_read_hidden_zoomed_scrubbed_and_put_away(lab, page):
    # The scene is smaller, not covered, and nothing covers the tray.
    scene, tray = (page.evaluate(BOX, box) for box in ("canvas", ".al-tray"))
    assert scene[1] + scene[3] <= tray[1] + 1
    assert tray[3] <= 0.4 * SIZE[1] + 1
    assert page.evaluate(CURVES) == 6
    dashes = page.evaluate(DASHES)
    assert len(set(dashes)) == 6
    left, top, wide, tall = page.evaluate(BOX, ".tray-field")
    # All curves are read at the pointer.
    page.mouse.move(left + 0.5 * wide, top + 0.5 * tall)
    lab.until(lambda: all(page.evaluate(VALUES)))
    first = [number(text) for text in page.evaluate(VALUES)]
    page.mouse.move(left + 0.8 * wide, top + 0.5 * tall)
    lab.until(lambda: [number(text) for text in page.evaluate(VALUES)] != first)
    # A drag over time moves the arm and the thumb of the bar.
    page.mouse.move(left + 0.5 * wide, top + 0.5 * tall)
    page.mouse.down()
    lab.until(lambda: page.evaluate(TIME) > 0.2)
    halfway = page.evaluate(TIME)
    page.mouse.move(left + 0.8 * wide, top + 0.5 * tall, steps=4)
    lab.until(lambda: page.evaluate(TIME) > halfway + 0.1)
    page.mouse.up()
    # The wheel zooms, a double click shows the whole again.
    whole = page.evaluate(ENDS)
    page.mouse.wheel(0, -400)
    lab.until(lambda: page.evaluate(ENDS) != whole)
    page.dblclick(".tray-field")
    lab.until(lambda: page.evaluate(ENDS) == whole)
    # A wheel that turns sideways zooms nothing, and however long + is pressed the page answers.
    page.mouse.wheel(60, 0)
    lab.still(0.2)
    assert page.is_disabled("[data-act=reset]")
    for _ in range(120):
        page.dispatch_event(".tray-field", "keydown", {"key": "+"})
    lab.until(lambda: page.evaluate(ENDS) != whole)
    page.dispatch_event(".tray-field", "keydown", {"key": "0"})
    lab.until(lambda: page.evaluate(ENDS) == whole)
    # By the keyboard: hide a curve, show it again.
    page.focus(".tray-legend button")
    page.keyboard.press("Enter")
    lab.until(lambda: page.evaluate(CURVES) == 5)
    assert page.get_attribute(".tray-legend button", "aria-pressed") == "false"
    assert page.evaluate(FOCUS).startswith("q₁")
    page.keyboard.press("Enter")
    lab.until(lambda: page.evaluate(CURVES) == 6)
    page.focus(".tray-field")
    told = page.get_attribute(".tray-field", "aria-valuetext")
    page.keyboard.press("End")
    lab.until(lambda: page.get_attribute(".tray-field", "aria-valuetext") != told)
    lab.until(lambda: all(page.evaluate(VALUES)))
    # The height, by its edge; then all of the scene's place; then away.
    page.focus(".tray-grip")
    page.keyboard.press("Home")
    lab.until(lambda: page.evaluate(BOX, ".al-tray")[3] < tray[3] - 50)
    page.click("[data-tray=full]")
    lab.until(lambda: page.evaluate(BOX, ".al-tray")[3] > 0.7 * SIZE[1])
    assert page.is_visible(".al-time")
    page.keyboard.press("Escape")
    lab.until(lambda: page.evaluate(BOX, ".al-tray")[3] < 0.4 * SIZE[1])
    page.evaluate(COMINGS)
    page.keyboard.press("Escape")
    lab.until(lambda: not page.query_selector(".al-tray") and not page.query_selector("[data-tray-plot]"))
    lab.rest()
    assert page.evaluate("() => window.__comings") == 0, "it came again before the lab had answered"
    assert page.evaluate(BOX, "canvas")[3] == SIZE[1]


def _lets_the_cursor_go_when_it_is_closed_in_the_hand(lab, page):
    """Closed by a key during a drag, the tray follows the time again when it is back."""
    left, top, wide, tall = page.evaluate(BOX, ".tray-field")
    page.mouse.move(left + 0.3 * wide, top + 0.5 * tall)
    page.mouse.down()
    page.keyboard.press("x")
    lab.until(lambda: not page.query_selector(".al-tray") and not page.query_selector("[data-tray-plot]"))
    page.mouse.up()
    lab.rest()
    open_tray(lab)
    page.mouse.move(5, 300)
    lab.until(lambda: page.evaluate(FOLLOWS))


def _saves_files_and_closes_with_its_page(lab, page):
    files = {}
    for kind in ("svg", "png", "csv"):
        with page.expect_download() as waiting:
            page.click(f"[data-act={kind}]")
        files[kind] = waiting.value
    assert [files[kind].suggested_filename for kind in files] == ["q.svg", "q.png", "q.csv"]
    drawn = files["svg"].path().read_text(encoding="utf-8")
    assert drawn.count('class="curve"') == 6
    assert "Position q" in drawn
    assert "limit q₃" in drawn
    pixels = np.asarray(Image.open(io.BytesIO(files["png"].path().read_bytes())).convert("RGB")).astype(int)
    _, _, wide, _ = page.evaluate(BOX, ".tray-field")
    assert pixels.shape[1] == pytest.approx(2 * wide, abs=2)
    assert np.abs(pixels - [0, 114, 178]).max(axis=2).min() <= 3
    assert files["csv"].path().read_text(encoding="utf-8").startswith('"t, s","q₁, °"')
    lab.press("motion")
    lab.until(lambda: not page.query_selector(".al-tray"))
    assert json.loads(page.evaluate("() => JSON.stringify(document.documentElement.dataset.tray ?? null)")) is None
