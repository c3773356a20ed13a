"""The plots of the motion as a student sees them."""

import pytest

pytestmark = pytest.mark.browser

PLOTS = """() => [...document.querySelectorAll('.u-over')]
  .filter(each => each.getBoundingClientRect().width > 0).length"""
CURSORS = """() => [...document.querySelectorAll('.al-cursor')]
  .filter(line => line.style.display !== 'none').map(line => parseFloat(line.style.left))"""
RED = """() => [...document.querySelectorAll('.uplot canvas')].filter(each => each.width && each.height).map(canvas => {
  const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
  let count = 0;
  for (let k = 0; k < data.length; k += 4)
    if (data[k] === 196 && data[k + 1] === 60 && data[k + 2] === 10 && data[k + 3] === 255) count++;
  return count;
})"""
WIDE = """() => [...document.querySelectorAll('.al')].filter(each => each.scrollWidth > each.clientWidth + 1).length"""


def test_plots_are_chosen_played_through_and_red_where_a_limit_is_exceeded(visit):
    lab = visit()
    lab.open_tab("Motion")
    lab.press("motion_plots")
    lab.until(lambda: lab.page.evaluate(PLOTS) == 3)
    assert "All limits are kept" in lab.page.inner_text("body")
    assert sum(lab.page.evaluate(RED)) == 0
    lab.press("compare")
    lab.until(lambda: "are faster" in lab.page.inner_text("body"))
    lab.press("load")
    lab.until(lambda: lab.page.evaluate(PLOTS) == 5)
    assert lab.page.evaluate(WIDE) == 0
    lab.press("motion")
    lab.press("time-given")
    lab.type_into("duration", "0.6")
    lab.press("play-motion")
    lab.press("motion_plots")
    lab.until(lambda: "limits are exceeded" in lab.page.inner_text("body"))
    lab.until(lambda: sum(lab.page.evaluate(RED)) > 100)
    # At its end the motion is where its curves end, and those of the other kind of moves go on.
    lab.until(lambda: len(lab.page.evaluate(CURSORS)) == 5)
    assert all(5.0 < left < 95.0 for left in lab.page.evaluate(CURSORS))
    lab.press("compare")
    lab.until(lambda: all(left > 99.0 for left in lab.page.evaluate(CURSORS)))
