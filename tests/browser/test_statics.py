"""Statics and the ellipsoid of forces in a real browser: numbers on the pages, the force pulled, nothing cut off."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.two_link import two_link

pytestmark = pytest.mark.browser

CUT = """() => [...document.querySelectorAll('.st-wrench, .st-bars, .st-dual, .el-map')]
  .filter(each => each.scrollWidth > each.clientWidth + 1 || each.getBoundingClientRect().right > innerWidth).length"""
SHOWN = "name => window.__viserMutable.nodeRefFromName[name].visible"


def torques(lab):
    """Return the torques as the page has them."""
    texts = lab.page.locator(".st-bars > b").all_inner_texts()
    return np.array([float(text.replace("−", "-")) for text in texts])


def choose(lab, key):
    lab.page.locator('select[data-cell="example"]').select_option(key)


def become(lab, expected):
    """Wait until the page has these torques."""
    lab.until(lambda: len(torques(lab)) == len(expected) and np.allclose(torques(lab), expected, atol=0.006))


def test_a_force_is_pulled_both_ellipsoids_compared_and_torques_of_a_typed_wrench_read(visit):
    lab = visit("robot/planar_2r", size=(1024, 700))
    lab.open_tab("Statics")
    lab.rest()
    _pulls_the_force_at_its_tip(lab)
    lab.open_tab("Ellipsoid")
    _shows_both_ellipsoids_with_inverse_half_axes(lab)
    lab.open_tab("Statics")
    _reads_torques_and_types_a_wrench(lab)


def _reads_torques_and_types_a_wrench(lab):
    choose(lab, "torques_2r")
    become(lab, [-4.723, -1.713])
    choose(lab, "along")
    become(lab, [0.0, 0.0])
    assert lab.page.locator(".al .verdict", has_text="No torque needed").count() == 1
    lab.type_into("force 0", "0")
    # 10 N upwards, 2 cos 30° m and cos 30° m from the axes.
    become(lab, [17.32, 8.66])
    assert lab.page.evaluate(SHOWN, lab.node("/torque1/arc"))
    assert lab.page.evaluate(CUT) == 0
    lab.page.keyboard.press("Control+z")
    become(lab, [0.0, 0.0])


def _pulls_the_force_at_its_tip(lab):
    tip = lab.node("/force_tip")
    before = float(lab.page.locator('input[data-cell="force 0"]').input_value())
    size = 2.0
    # Its arrows are 0.09 / 0.14 as long as those of the arm's handle.
    lab.drag_handle(0, size * 0.09 / 0.14, (60, 0), node=tip)
    field = lab.page.locator('input[data-cell="force 0"]')
    lab.until(lambda: float(field.input_value().replace("−", "-")) > before + 1.0)
    assert float(lab.page.locator('input[data-cell="force 1"]').input_value()) == pytest.approx(16.0, abs=0.01)


def _shows_both_ellipsoids_with_inverse_half_axes(lab):
    lab.press("both")
    lab.page.locator(".half.force").wait_for()
    speeds, forces = (
        [float(text.split()[0]) for text in lab.page.locator(f"{where} > b").all_inner_texts()]
        for where in (".half:not(.force)", ".half.force")
    )
    np.testing.assert_allclose(np.array(speeds) * forces, 1.0, atol=0.03)
    assert lab.page.evaluate(SHOWN, lab.node("_force/body"))
    assert lab.page.locator(".el-map svg").count() == 2
    assert lab.page.evaluate(CUT) == 0
    best = two_link(catalogue()["planar_2r"].arm).best
    assert f"= {1000.0 * best:.1f} mm" in lab.page.locator(".al", has_text="roundest at").last.inner_text()
    lab.page.keyboard.press("0")
    lab.until(lambda: lab.page.locator(".half.force > b").last.inner_text() == "∞")
    lab.rest()
    assert [lab.page.evaluate(SHOWN, lab.node(f"_force/through{i}")) for i in range(3)] == [False, True, False]
