"""A map of basins in the page: it draws in pieces, is cancelled, and a click begins the film there."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.ik import iterate
from armlab.session.run_targets import first_target

pytestmark = pytest.mark.browser
TWO_R = catalogue()["planar_2r"]

PICTURE = """() => {
  const image = document.querySelector('.ba-map img');
  const canvas = document.createElement('canvas');
  canvas.width = image.naturalWidth; canvas.height = image.naturalHeight;
  const context = canvas.getContext('2d');
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, 1, canvas.height);
  return [canvas.width, canvas.height, data.filter((value, k) => k % 4 === 3 && value > 0).length];
}"""
"""Width and height of the picture, and how many pixels of its first column are drawn."""


def drawn_rows(lab):
    """Return the side of the picture, and how many of its rows are there."""
    side, height, rows = lab.page.evaluate(PICTURE)
    assert side == height
    return side, rows


def test_a_map_draws_in_pieces_is_cancelled_and_a_click_starts_the_film_at_that_configuration(visit):
    lab = visit("robot/planar_2r", size=(1100, 900))
    lab.open_tab("Iterate")
    lab.rest()
    lab.press("basins")
    _draws_in_pieces_and_is_cancelled(lab)
    _starts_the_film_at_the_configuration_of_a_click(lab)


def _draws_in_pieces_and_is_cancelled(lab):
    lab.press("points 256")
    lab.page.locator("button[data-cell=draw]").click()
    # The first pieces are a part of the picture, and there are more to come.
    lab.page.wait_for_function("() => document.body.innerText.match(/Drawing: [1-9]/)")
    # The page decodes a picture a moment after it has come.
    lab.until(lambda: drawn_rows(lab)[1] > 0)
    side, rows = drawn_rows(lab)
    assert side == 256
    assert rows < 256
    lab.page.locator("button[data-cell=cancel]").click()
    lab.page.wait_for_selector("button[data-cell=draw]")
    assert "Cancelled at" in lab.page.inner_text("body")
    lab.rest()
    _, rows = drawn_rows(lab)
    assert 0 < rows < 256
    lab.still(1.0)
    assert drawn_rows(lab)[1] == rows


def _starts_the_film_at_the_configuration_of_a_click(lab):
    lab.press("points 64")
    lab.page.locator("select[data-cell=method]").select_option("dls_error")
    lab.rest()
    lab.page.locator("button[data-cell=draw]").click()
    # The link of the map before goes when this one begins, and there is none before it is done.
    lab.page.wait_for_selector("a[download*=dls_error]")
    assert "Elbow up" in lab.page.inner_text(".ba-legend")
    with lab.page.expect_download() as saved:
        lab.page.locator("a[download]").click()
    assert saved.value.suggested_filename == "basins_planar_2r_dls_error.png"
    box = lab.page.locator(".ba-map").bounding_box()
    lab.page.locator(".ba-map").click(position={"x": 0.65 * box["width"], "y": 0.3 * box["height"]})
    lab.until(lambda: lab.page.locator(".al-time").count() == 1)
    lab.rest()
    # The middle of the pixel that was clicked; up is up.
    side = 2 * math.pi / 64
    start = np.array([-math.pi + side * (int(0.65 * 64) + 0.5), -math.pi + side * (int(0.7 * 64) + 0.5)])
    shown = [float(lab.page.locator(f'input[data-cell="start {i}"]').input_value().replace("−", "-")) for i in (0, 1)]
    np.testing.assert_allclose(shown, np.degrees(start), atol=0.06)
    trace = iterate(TWO_R.arm, first_target(TWO_R), start, "dls_error", limits="none")
    assert trace.success
    lab.until(lambda: f"Converged in {trace.iterations} steps" in lab.page.inner_text("body"))
    lab.open_tab("Joints")
    lab.rest()
    np.testing.assert_allclose(lab.slider_values(2), np.degrees(start), atol=0.11)
