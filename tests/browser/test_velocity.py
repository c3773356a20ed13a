"""The pages of velocities and of turning in a real page: numbers, arrows, the drive, nonsense, and nothing cut."""

import re

import numpy as np
import pytest

from armlab.benches.velocity.speeds.examples import EXAMPLES
from armlab.content.robots import catalogue

pytestmark = pytest.mark.browser

CUT = """() => [...document.querySelectorAll('.al .scroll, .al .ve-table, .al .bar, .al .kv, .al .ve-points')]
  .filter(e => e.offsetParent)
  .filter(e => e.getBoundingClientRect().right > innerWidth + 1 || e.scrollWidth > e.clientWidth + 1)
  .map(e => e.className + ': ' + e.innerText)"""


def numbers(text):
    return [float(found.replace("−", "-")) for found in re.findall(r"−?\d+(?:\.\d+)?", text)]


def choose(lab, example):
    lab.page.locator('select[data-cell="example"]').first.select_option(example)
    lab.page.locator(".kit-look", has_text=EXAMPLES[example].says[:20]).wait_for()
    lab.rest()


def test_speeds_are_summed_and_driven_and_turning_says_what_a_singular_angle_loses(visit):
    lab = visit()
    lab.open_tab("Velocity")
    _sums_what_the_positions_say_and_draws_a_column(lab)
    _drives_the_arm_and_keeps_nonsense(lab)
    lab.press("turning")
    _says_what_a_singular_angle_loses(lab)


def _sums_what_the_positions_say_and_draws_a_column(lab):
    choose(lab, "planar")
    arm, example = catalogue()["planar_2r"].arm, EXAMPLES["planar"]
    v = arm.jacobian(example.q)[:3] @ example.qdot
    lab.unfold("Parts and their sum")
    cells = numbers(lab.page.locator(".ve-sum").inner_text().split("\t", 1)[1])
    np.testing.assert_allclose(cells[:3], 1000 * v, rtol=0, atol=0.1)
    (told,) = numbers(lab.page.locator(".ve-size b").first.inner_text())
    assert told == pytest.approx(1000 * np.linalg.norm(v), abs=0.1)
    milliseconds, measured, *_ = numbers(lab.page.locator(".ve-size + p").inner_text())
    assert milliseconds == 0.1
    assert measured == pytest.approx(told, rel=0.01)
    assert any(name.endswith("velocity/parts/arrows") for name in lab.nodes())
    lab.press(",1")
    lab.page.locator(".ve-said", has_text="Column 2").wait_for()
    lab.until(lambda: any(name.endswith("velocity/lit/arrows") for name in lab.nodes()))
    lab.until(lambda: not any(name.endswith("velocity/parts/arrows") for name in lab.nodes()))


def _drives_the_arm_and_keeps_nonsense(lab):
    choose(lab, "two_points")
    matrix = lab.page.locator(".mat.select").first
    before = matrix.inner_text()
    lab.press("play-speeds")
    lab.until(lambda: matrix.inner_text() != before)
    lab.page.locator(".al-time").wait_for()
    lab.page.locator('.kit-unfolds[aria-expanded="true"]').wait_for()
    lab.type_into("point 0 1", "far")
    field = lab.page.locator('input[data-cell="point 0 1"]')
    assert field.input_value() == "far"
    assert field.get_attribute("aria-invalid") == "true"


def _says_what_a_singular_angle_loses(lab):
    lab.page.locator(".verdict", has_text="Well conditioned").wait_for()
    lab.type_into("angles 1", "90")
    lab.page.locator(".verdict", has_text="Singular").wait_for()
    lab.page.locator('button[data-cell="shown laws"]').click()
    lab.page.locator(".verdict", has_text="Same integral, other orientation").wait_for()
    assert "120.0°" in lab.page.locator(".kv").last.inner_text()


def test_nothing_is_cut(visit):
    lab = visit("robot/panda", size=(1400, 850))
    lab.open_tab("Velocity")
    lab.unfold("Parts and their sum")
    lab.page.locator(".ve-sum").wait_for()
    for fold in ("points", "higher"):
        lab.press(f"fold {fold} on")
    lab.finds_none(CUT)
    lab.resize((1024, 700))
    lab.finds_none(CUT)
    lab.page.locator("button.page[data-cell=turning]").click()
    lab.page.locator(".verdict").first.wait_for()
    lab.rest()
    lab.finds_none(CUT)
