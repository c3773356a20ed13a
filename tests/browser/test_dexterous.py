"""Orientations in a real browser: rings and arcs of a planar arm, a slice that answers a click, a body cut open."""

import numpy as np
import pytest

pytestmark = pytest.mark.browser

POSE = "name => window.__viserMutable.nodePoseData[name]"


def row(lab, label):
    """Return the figure beside a label of the panel."""
    found = lab.page.locator(f'.kv:visible > span:text-is("{label}") + span').first
    return found.inner_text()


def test_the_tool_goes_into_a_region_and_stands_in_its_singularities(visit):
    lab = visit("robot/planar_3r")
    lab.open_tab("Dexterous")
    lab.page.locator(".dx-region[aria-pressed=true]", has_text="1000.0 – 3000.0").wait_for()
    assert row(lab, "WS₂") == "0.0 – 1000.0 mm"
    lab.until(lambda: any(name.endswith("/dexterous/rings/possible") for name in lab.nodes()))
    lab.press("region 0")
    lab.page.locator(".dx-region[aria-pressed=true]", has_text="dexterous WS₂").wait_for()
    assert row(lab, "Orientations possible here") == "360.0° of 360.0°"
    lab.press("region 1")
    lab.press("way 1 2")
    lab.rest()
    assert row(lab, "Tool") == "r = 1000.0 mm"
    regions = lab.page.locator(".dx-regions").bounding_box()
    wide = lab.page.evaluate(
        "() => [...document.querySelectorAll('.dx-region')].map(b => b.scrollWidth - b.clientWidth)"
    )
    assert regions["width"] <= 345
    assert max(wide) <= 0


def test_a_click_on_the_slice_brings_the_arm_there(visit):
    lab = visit("robot/ur5e")
    lab.open_tab("Dexterous")
    lab.press("count 400000")
    lab.page.locator(".kv", has_text="400\u202f000").first.wait_for()
    lab.page.locator("button[data-cell=stop]").wait_for(state="detached")
    lab.rest()
    before = lab.target()
    frame = lab.node("/dexterous/slice")
    # Above and outward of the middle of the slice, away from arm and handle.
    place = lab.on_screen(frame, (0.15, 0.45, 0.0))
    lab.page.mouse.move(*place)
    lab.page.wait_for_timeout(200)
    lab.page.mouse.down()
    lab.page.wait_for_timeout(120)
    lab.page.mouse.up()
    lab.until(lambda: np.linalg.norm(lab.target() - before) > 0.05)
    lab.rest()
    assert np.linalg.norm(lab.on_screen("/target") - place) < 30


def test_the_slice_stands_where_it_is_put_and_gives_way_to_the_body(visit):
    lab = visit("robot/irb140")
    lab.open_tab("Dexterous")
    lab.page.locator(".kv", has_text="96³").first.wait_for()
    frame = lab.node("/dexterous/slice")
    turned = lab.page.evaluate(POSE, frame)["wxyz"]
    lab.page.locator("input[data-cell=slice]:visible").fill("90")
    lab.page.keyboard.press("Enter")
    lab.until(lambda: not np.allclose(lab.page.evaluate(POSE, frame)["wxyz"], turned))
    # With the limits of its wrist the arm has no WS₂: points with half of the directions are there.
    lab.press("draw body")
    lab.press("share 0.5")
    lab.until(lambda: any(name.endswith("/dexterous/body") for name in lab.nodes()))
    assert row(lab, "Largest share").endswith("%")
