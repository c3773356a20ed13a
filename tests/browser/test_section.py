"""The section of a workspace in the page: filled, clicked, sliced."""

import re

import numpy as np
import pytest

from armlab.content.robots import catalogue

pytestmark = pytest.mark.browser
KNOWN = "() => document.body.innerText.includes('To the boundary')"


def test_a_click_in_the_side_view_moves_the_tool_and_a_slice_is_drawn(visit):
    lab = visit("robot/elbow_3r", size=(1024, 700))
    lab.open_tab("Section")
    lab.page.wait_for_function(KNOWN)
    lab.rest()
    assert re.search(r"9\.0[89]\d* ± 0\.0\d+ m³", lab.page.inner_text("body"))
    box = lab.page.locator(".sc-pick").bounding_box()
    before = lab.target()
    # From the axis to 1.3 m, and from 0.7 m below frame 0 to 1.9 m above.
    lab.page.mouse.click(box["x"] + 0.7 * box["width"], box["y"] + 0.5 * box["height"])
    lab.until(lambda: not np.allclose(lab.target(), before, atol=1e-3))
    lab.rest()
    x, y, z = lab.target()
    np.testing.assert_allclose([np.hypot(x, y), z], [0.7 * 1.3, 0.6], atol=0.02)
    assert any(name.endswith("section/slice") for name in lab.nodes())
    lab.press("slice z")
    lab.type_into("at", "400")
    position = "name => window.__viserMutable.nodePoseData[name].position"
    lab.until(lambda: abs(lab.page.evaluate(position, lab.node("section/slice"))[2] - 0.4) < 1e-6)
    # Up by its handle, from where its arrow is not seen end on.
    lab.page.keyboard.press("c")
    lab.rest()
    lab.drag_handle(2, catalogue()["elbow_3r"].arm.reach, (0, -60), node=lab.node("section/handle/z"))
    lab.until(lambda: lab.page.evaluate(position, lab.node("section/slice"))[2] > 0.45)
    assert float(lab.page.locator("input[data-cell=at]").input_value()) > 450
    wide = lab.page.evaluate(
        """() => [...document.querySelectorAll('.sc-view, .al .kv, .al .row')]
          .filter(each => each.scrollWidth > each.clientWidth + 1 || each.getBoundingClientRect().width > 345).length"""
    )
    assert wide == 0
