"""Gears, a harmonic drive and the drives of the joints, in a browser."""

import pytest

pytestmark = pytest.mark.browser


def test_wheels_are_typed_and_turn_and_a_click_finds_the_best_ratio(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("gears")
    lab.until(lambda: any(name.endswith("/wheel1/solid") for name in lab.nodes()))
    lab.type_into("teeth 1", "54")
    lab.waits_for("n = −3")
    lab.type_into("teeth 1", "0")
    lab.waits_for("(teeth of wheel 2): expected a whole number from 6 to 200")
    assert lab.says("n = −3")
    lab.press("layout compound")
    lab.until(lambda: any(name.endswith("/wheel3/solid") for name in lab.nodes()))
    lab.type_into("time", "1")
    lab.until(lambda: lab.page.locator('[data-cell="time"]').first.input_value() == "1")
    # A tooth that stood on the line of centres has turned a quarter of the way round.
    node = lab.node("/wheel0")
    middle, tooth = lab.on_screen(node), lab.on_screen(node, (0.2, 0.0, 0.0))
    assert abs(tooth - middle)[1] > 3.0 * abs(tooth - middle)[0]
    lab.page.locator('select[data-cell="example"]').first.select_option("best")
    lab.until(lambda: lab.page.locator(".gr-chart svg").count() == 1)
    box = lab.page.locator(".gr-chart").bounding_box()
    # 20 is in the middle of the logarithmic axis, to the right of the numbers.
    lab.page.mouse.click(box["x"] + (0.5 + 20.0 / 320.0) * box["width"], box["y"] + 0.5 * box["height"])
    lab.until(lambda: 18.0 < float(lab.page.locator('[data-cell="ratio"]').first.input_value()) < 22.0)
    lab.press("take best")
    lab.until(lambda: lab.page.locator('[data-cell="ratio"]').first.input_value() == "20")


def test_the_flexspline_falls_back_by_two_teeth_in_a_turn(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("harmonic")
    lab.until(lambda: any(name.endswith("/teeth") for name in lab.nodes()))
    counted = lab.page.locator(".hd-counted")
    flag = lab.node("/flag")
    before = lab.on_screen(flag)
    lab.press("turn 1")
    lab.until(lambda: "−2.00" in counted.inner_text())
    assert "62.0" in counted.inner_text()
    after = lab.on_screen(flag)
    # Two of sixty teeth, clockwise: downwards on the right-hand side.
    assert after[1] > before[1] + 2.0
    lab.press("fixed flexible")
    lab.waits_for("n = 31")
    lab.type_into("circular", "61")
    lab.waits_for("expected 2, 3 or 4 more than the 60 of the flexspline")


def test_counts_of_the_joints_are_seen_at_the_tool(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("joint_drive")
    lab.until(lambda: any(name.endswith("/joint_drive/body") for name in lab.nodes()))
    assert lab.says("within 0.0279 mm and 0.0035°")
    lab.type_into("backlash 0", "0.05")
    lab.until(lambda: "0.0259°" in lab.page.locator(".jd-table").inner_text())
    lab.press("side 0")
    lab.until(lambda: "± 0.09°" in lab.page.locator(".jd-table").inner_text())
    lab.type_into("ratio 1", "0")
    lab.waits_for("(ratio of the gear of joint 2): expected a number greater than 0")
    lab.unfold("Motors")
    assert "rpm" in lab.page.locator(".jd-both").last.inner_text()
