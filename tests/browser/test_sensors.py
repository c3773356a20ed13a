"""Sensors in a browser: disks that a hand turns, counts that come back, and an arm whose errors are seen."""

import pytest

pytestmark = pytest.mark.browser

LIT = """() => {
  const nodes = Object.entries(window.__viserMutable.nodeRefFromName);
  const lit = nodes.filter(([name, node]) => /\\/absolute\\/sensor\\d+\\/lit$/.test(name) && node?.visible);
  return lit.length;
}"""
"""Number of sensors of the absolute encoder that see light."""


def pulled(lab, picture, by):
    """Drag a picture sideways by pixels."""
    box = lab.page.locator(picture).first.bounding_box()
    x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.4 * box["height"]
    lab.page.mouse.move(x, y)
    lab.page.mouse.down()
    for part in (0.3, 0.6, 1.0):
        lab.page.mouse.move(x + part * by, y)
        lab.frames(2)
    lab.page.mouse.up()
    lab.rest()


def test_disks_are_turned_by_hand_and_counts_come_back(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("absolute_encoder")
    lab.page.locator('select[data-cell="example"]').first.select_option("glitch")
    lab.waits_for("off by up to 8 sectors")
    lab.until(lambda: lab.page.evaluate(LIT) == 4)
    lab.press("code gray")
    lab.waits_for("Gray code: off by 1 sector at most")
    lab.until(lambda: lab.page.evaluate(LIT) == 2)
    pulled(lab, ".ab-strip", -60)
    lab.until(lambda: lab.page.locator('input[data-cell="angle"]').first.input_value() != "176.625")
    lab.page.keyboard.press("Control+z")
    lab.until(lambda: lab.page.locator('input[data-cell="angle"]').first.input_value() == "176.625")
    lab.type_into("tracks", "30")
    lab.waits_for("number of tracks: expected a whole number from 1 to 12, got '30'")
    _moves_add_up_to_nothing(lab)


def _moves_add_up_to_nothing(lab):
    lab.press("incremental_encoder")
    lab.until(lambda: any(name.endswith("/incremental/disk") for name in lab.nodes()))
    lab.press("again")
    lab.waits_for("has not been turned yet")
    pulled(lab, ".ab-strip", -80)
    lab.until(lambda: lab.page.locator(".in-up").count() > 0)
    pulled(lab, ".ab-strip", 80)
    lab.until(lambda: lab.page.locator(".in-down").count() > 0)
    counted = lab.page.locator(".in-rules tr.now td").all_inner_texts()
    assert counted[-2:] == ["0", "0"]
    lab.type_into("moves", "90 -90")
    lab.unfold("Angle over time, direction and zero")
    lab.press("rule same")
    lab.waits_for("Wrong by +16 counts, 180°")
    lab.press("play-moves")
    lab.waits_for("at 2 of 2 s")


def test_throws_are_corrected_a_sensor_is_calibrated_and_an_arm_is_sent_somewhere_again_and_again(visit):
    lab = visit(size=(1100, 800))
    lab.open_tab("encoder_speed")
    lab.type_into("counts", "50")
    lab.until(lambda: lab.page.locator('input[data-cell="speed"]').first.input_value() == "180")
    lab.press("accuracy")
    lab.press("correct")
    lab.waits_for("No bias that chance would not explain")
    lab.press("calibration")
    lab.type_into("degree", "2")
    lab.waits_for("no function of the output takes them away")
    lab.press("pose_accuracy")
    lab.until(lambda: any(name.endswith("/pose_accuracy/points") for name in lab.nodes()))
    lab.until(lambda: any(name.endswith("/pose_accuracy/arrow/arrows") for name in lab.nodes()))
    lab.page.locator('select[data-cell="example"]:visible').select_option("either_side")
    lab.waits_for("Accurate on the mean, not repeatable")
    lab.press("approach same")
    lab.waits_for("More repeatable than accurate")
    lab.type_into("times", "1e9")
    lab.waits_for("times: expected a whole number from 2 to 1000, got '1e9'")
