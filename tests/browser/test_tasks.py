"""Tasks that many come with, from a fresh start, in no more clicks than a person would put up with."""

import re

import numpy as np
import pytest

from armlab.content.robots import catalogue
from support.hand import Hand

pytestmark = pytest.mark.browser

SIZE = (1400, 850)


FASTEST = """name => {
  const rows = [...document.querySelectorAll('.ms-table tr')].filter(row => row.innerText.includes(name));
  return rows.map(row => Number(row.cells[1].innerText.replace('−', '-')));
}"""
"""Largest joint speeds of the methods whose name holds a text, as the table has them."""


def fastest(lab, name):
    found = lab.page.evaluate(FASTEST, name)
    assert found
    assert np.isfinite(found).all()
    return max(map(abs, found))


def arm_is(lab, key):
    name = catalogue()[key].name
    lab.until(lambda: lab.page.locator(".al-top .arm-name b").inner_text() == name)
    lab.ready()


def test_all_solutions_of_a_ur5e_in_three(visit):
    lab = visit(size=SIZE)
    hand = Hand(lab)
    hand.find("UR5e")
    arm_is(lab, "ur5e")
    hand.find("all solutions")
    lab.until(lambda: lab.page.locator(".sol-row").count() == 8)
    assert "8 solutions, and no others" in lab.page.locator(".count").inner_text()
    assert hand.clicks <= 3


def test_singularities_of_the_puma_and_damped_least_squares_in_four(visit):
    lab = visit(size=SIZE)
    hand = Hand(lab)
    hand.find("singular")
    lab.page.locator(".ms-bars").wait_for()
    places = lab.page.locator('button[data-cell^="place "]:visible')
    assert places.count() >= 3
    wrist = places.filter(has_text=re.compile("wrist", re.IGNORECASE)).first.get_attribute("data-cell")
    hand.on(wrist)
    lab.until(lambda: fastest(lab, "J⁻¹") > 2.0 * fastest(lab, "DLS"))
    assert hand.clicks <= 4


def test_the_workspace_of_a_scara_sampled_cut_clicked_and_its_volume_in_six(visit):
    lab = visit(size=SIZE)
    hand = Hand(lab)
    hand.find("SCARA")
    arm_is(lab, "scara")
    hand.find("workspace")
    hand.on("sample")
    lab.page.locator(".kv", has_text="Points drawn").first.wait_for()
    hand.on("cut z")
    before = lab.target()
    hand.at(*lab.on_screen(lab.node("/workspace/points"), (0.4, 0.2, 0.1)))
    lab.page.locator(".verdict", has_text="The arm is there").wait_for()
    assert not np.allclose(lab.target(), before)
    hand.on("section")
    lab.until(lambda: re.search(r"\d ± [\d.]+ m³", lab.page.inner_text("body")))
    assert hand.clicks <= 6
