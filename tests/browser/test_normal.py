"""Two lines that are dragged, and the axes of the arm in their place."""

import re

import numpy as np
import pytest

from armlab.benches.robot.normal.ui.scene import HANDLE
from armlab.content.robots import catalogue
from armlab.ui.figure.anatomy import anatomy_of

pytestmark = pytest.mark.browser
SIZE = anatomy_of(catalogue()["puma560"].arm).size


def open_page(lab):
    lab.open_tab("Robot")
    lab.page.locator('button.page[data-cell="normal"]').click()
    lab.until(lambda: any(name.endswith("/handle2_move") for name in lab.nodes()))
    lab.rest()


def drag(lab, node, local, pixels):
    """Grab a handle at a point of its own and drag it."""
    start = lab.on_screen(lab.node(node), local)
    lab.page.mouse.move(*start)
    lab.frames(3)
    lab.page.mouse.down()
    for k in range(1, 13):
        lab.page.mouse.move(*(start + np.asarray(pixels) * k / 12))
        lab.frames(1)
    lab.frames(3)
    lab.page.mouse.up()
    lab.rest()


def measured(lab):
    """Return a in mm and alpha in degrees as the page shows them."""
    text = lab.page.locator(".al .kv").first.inner_text().replace("−", "-")
    return tuple(float(value) for value in re.findall(r"(-?[\d.]+)(?: mm\n|°)", text)[:2])


def test_a_line_is_dragged_and_brought_back_and_cases_and_axes_of_the_arm_take_its_place(visit):
    lab = visit(size=(1100, 800))
    open_page(lab)
    before = measured(lab)
    drag(lab, "/handle2_move", (0.75 * HANDLE * SIZE, 0.0, 0.0), (-60.0, -10.0))
    moved = measured(lab)
    assert moved[0] > before[0] + 20.0
    assert moved[1] == pytest.approx(before[1], abs=0.05)
    lab.press("turn")
    part = 0.7 * HANDLE * SIZE * np.sqrt(0.5)
    drag(lab, "/handle2_turn", (0.0, part, part), (25.0, 25.0))
    assert abs(measured(lab)[1] - moved[1]) > 3.0
    lab.page.keyboard.press("Control+z")
    lab.rest()
    assert measured(lab) == moved
    lab.page.keyboard.press("Control+z")
    lab.rest()
    assert measured(lab) == before
    for kind, words in (("parallel", "Parallel"), ("intersecting", "Intersecting"), ("coincident", "Coincident")):
        lab.press(kind)
        assert words in lab.page.locator(".al .verdict").first.inner_text()
    lab.page.locator("input[role=combobox]").first.click()
    lab.page.get_by_role("option", name="joints 2 and 3").click()
    lab.rest()
    row = catalogue()["puma560"].arm.rows[1]
    assert measured(lab)[0] == pytest.approx(1000.0 * row.a, abs=0.06)
    assert lab.says("They agree with those of the normal")
