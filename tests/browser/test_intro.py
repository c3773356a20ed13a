"""The pages of the first chapter in a browser: history, market and spaces."""

import pytest

from armlab.benches.robot.history.ui.timeline import WIDE, spots

pytestmark = pytest.mark.browser


def arm_name(lab):
    return lab.page.locator(".al-top .arm-name b").inner_text()


def test_history_opens_a_model_judges_answers_and_the_market_computes(visit):
    lab = visit(size=(1024, 850))
    lab.open_tab("history")
    _a_point_leads_to_a_model_and_one_undo_brings_the_arm_back(lab)
    lab.press("shown things")
    lab.press("no gantry")
    lab.waits_for("1 of 13 judged, 1 rightly")
    assert "lacks three or more programmable axes" in lab.page.locator(".hi-why").inner_text()
    lab.open_tab("market")
    lab.press("compute end")
    lab.type_into("years", "3")
    lab.type_into("rate", "100")
    end = lab.page.locator('input[data-cell="end"]')
    lab.until(lambda: end.input_value() == "24000")
    lab.type_into("years", "soon")
    lab.waits_for("years: expected a number")
    assert end.input_value() == "24000"


def _a_point_leads_to_a_model_and_one_undo_brings_the_arm_back(lab):
    places, _, _ = spots()
    spot = next(each for each in places if each.event.key == "irb6")
    box = lab.page.locator("svg.hi-time").bounding_box()
    scale = box["width"] / WIDE
    lab.page.mouse.click(box["x"] + scale * spot.x, box["y"] + scale * spot.y)
    lab.until(lambda: "1973: ASEA IRB-6" in lab.page.locator(".hi-card").inner_text())
    lab.press("event unimate")
    lab.press("model unimate")
    lab.until(lambda: arm_name(lab) == "Unimate type 5R1P")
    lab.page.keyboard.press("Control+z")
    lab.until(lambda: arm_name(lab) == "PUMA 560")


def test_the_end_of_the_stick_is_dragged_off_its_circle_and_the_arm_goes_to_the_other_one(visit):
    lab = visit(size=(1024, 850))
    lab.open_tab("spaces")
    lab.press("shown stick")
    chart = lab.page.locator("svg.sp-picture")
    box, bob = chart.bounding_box(), chart.locator(".sp-bob").bounding_box()
    lab.page.mouse.move(bob["x"] + 0.5 * bob["width"], bob["y"] + 0.5 * bob["height"])
    lab.page.mouse.down()
    for share in (0.75, 0.85, 0.9):
        lab.page.mouse.move(box["x"] + share * box["width"], box["y"] + 0.9 * box["height"])
        lab.frames(2)
    lab.page.mouse.up()
    lab.waits_for("No configuration")
    lab.press("nearest")
    lab.until(lambda: not lab.says("No configuration"))
    lab.page.locator('select[data-cell="example"]:visible').first.select_option("two_arms")
    lab.waits_for("Two arms, two tools")
    lab.until(lambda: any("/spaces/" in name for name in lab.nodes()))
    before = lab.page.locator("table.sp-arms").inner_text()
    lab.press("twin")
    lab.until(lambda: lab.page.locator("table.sp-arms").inner_text() != before)


def test_an_arm_misses_a_computed_goal_and_hits_a_taught_one_and_a_hand_that_yields_finds_every_hole(visit):
    lab = visit(size=(1024, 850))
    lab.open_tab("taught_goal")
    figures = lab.page.locator("table.ac-numbers")
    lab.waits_for("of 30 pegs")
    computed = figures.inner_text()
    assert lab.says("0 of 30 pegs")
    assert lab.says("to another place than the one it was sent to")
    lab.press("goal taught")
    lab.until(lambda: figures.inner_text() != computed)
    assert not lab.says("to another place than the one it was sent to")
    lab.press("goal table")
    lab.until(lambda: figures.inner_text() == computed)
    lab.type_into("yields", "50")
    lab.waits_for("30 of 30 pegs")
    lab.type_into("yields", "soft")
    lab.waits_for("compliance of the hand: expected a number")
    assert lab.says("30 of 30 pegs")
