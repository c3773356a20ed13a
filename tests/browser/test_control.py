"""Runs of kinematic control in a real page: the notes' experiments, their numbers read from the panel, and a push."""

import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.control.follow import runs
from armlab.benches.control.follow.examples import EXAMPLES
from armlab.content.robots import catalogue

pytestmark = pytest.mark.browser
ARM = catalogue()["planar_2r"].arm


@pytest.fixture(autouse=True)
def coarse(monkeypatch):
    """Let runs take steps five times as long; in `tests/benches/control` they have those of the notes."""
    exact = runs.settings_of
    monkeypatch.setattr(runs, "settings_of", lambda arm, setup: exact(arm, replace(setup, step=5.0 * setup.step)))


def choose(lab, key):
    """Put an experiment in place and wait until its runs are made."""
    lab.page.locator('select[data-cell="example"]').select_option(key)
    lab.page.locator(".kit-look", has_text=EXAMPLES[key].says[:20]).wait_for()
    lab.page.locator(".ct-card").first.wait_for()
    lab.until(lambda: "…" not in (lab.page.locator(".ct-card").first.text_content() or ""))


def row(lab, name):
    """Return the numbers in a row of the results, folded or not, without their times."""
    cells = lab.page.locator(".ct-card tr", has_text=name).locator("td").all_text_contents()[1:]
    return [float(cell.split()[0].replace("−", "-").split("·")[0]) for cell in cells]


def bodies(lab):
    """Return how far the page has turned the arm's joints, in degrees."""
    nodes = sorted(name for name in lab.nodes() if "/arm/" in name and name.rsplit("/", 1)[1].isdigit())
    found = lab.page.evaluate("names => names.map(name => window.__viserMutable.nodePoseData[name].wxyz)", nodes)
    return [2.0 * math.degrees(math.atan2(wxyz[3], wxyz[0])) for wxyz in found]


def test_the_presets_of_the_notes_are_read_and_played_and_a_push_is_made_good(visit):
    lab = visit()
    lab.open_tab("Control")
    choose(lab, "line_178")
    assert row(lab, "peak q̇1") == [518.5, 104.9]  # 518.6 in the steps of the notes
    choose(lab, "saturated")
    assert row(lab, "error at the end")[0] == pytest.approx(48.0, abs=0.2)
    assert row(lab, "peak q̇1")[0] == 300.0
    choose(lab, "dls")
    assert row(lab, "largest error")[0] == pytest.approx(25.1, abs=0.2)
    assert row(lab, "peak q̇1")[0] < 120.0
    lab.page.locator('.al-time button[data-cell="forward"]').click()
    lab.until(lambda: "t = 0.00 s" not in lab.page.locator(".ct-clock").inner_text())
    lab.rest()
    before = np.array(bodies(lab))
    lab.page.locator('.al-time button[data-cell="play"]').click()
    lab.until(lambda: np.abs(np.array(bodies(lab)) - before).max() > 5.0)
    lab.page.locator('.al-time button[data-cell="close"]').click()
    choose(lab, "cartesian_tracking")
    lab.page.locator('button[data-cell="push"]').click()
    lab.page.locator('button[data-cell="drop"]').wait_for()
    lab.until(lambda: "…" not in (lab.page.locator(".ct-card").first.text_content() or ""))
    assert row(lab, "error at the end")[0] < 1.0
    assert lab.page.locator(".ct-run").count() == 3
    lab.page.locator('button[data-cell="remove 2"]').click()
    lab.until(lambda: lab.page.locator(".ct-run").count() == 2)
    lab.page.locator('button[data-cell="sigma"]').click()
    lab.page.locator("h3", has_text="Smallest singular value").wait_for()
