"""The plan of a motion in a real page: waypoints, a drag in the scene, play, scrub, and the way before it is run."""

import numpy as np
import pytest

from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.state import planned_now
from armlab.content.robots import catalogue
from armlab.session.state import State

pytestmark = pytest.mark.browser

VERDICT = ".al .verdict"
PLACES = ".mo-at"


def turned(lab):
    """Return how far the page has turned the joints of a planar arm, radians."""
    nodes = sorted(name for name in lab.nodes() if "/arm/" in name and name.rsplit("/", 1)[1].isdigit())
    found = lab.page.evaluate("names => names.map(name => window.__viserMutable.nodePoseData[name].wxyz)", nodes)
    return np.array([2.0 * np.arctan2(wxyz[3], wxyz[0]) for wxyz in found])


def off(lab, q):
    """Return by how many radians the arm on screen is from joint values."""
    return np.abs((turned(lab) - q + np.pi) % (2.0 * np.pi) - np.pi).max()


def at_plan(visit, robot):
    lab = visit(f"robot/{robot}")
    lab.open_tab("Motion")
    lab.page.locator(VERDICT, has_text="within all limits").wait_for()
    return lab


def test_a_waypoint_is_added_where_the_arm_stands_and_dragged(visit):
    lab = at_plan(visit, "ur10e")
    assert lab.page.locator(PLACES).count() == 2
    lab.page.locator('.al button[data-cell="add"]').click()
    lab.until(lambda: lab.page.locator(PLACES).count() == 3)
    lab.page.locator('.al button[data-cell="drag"]').click()
    lab.until(lambda: any(name.endswith("/waypoints/handle") for name in lab.nodes()))
    lab.rest()
    before = lab.page.locator(PLACES).all_inner_texts()
    lab.drag_handle(2, 1.96, (0.0, -60.0), node=lab.node("/waypoints/handle"))
    lab.until(lambda: lab.page.locator(PLACES).all_inner_texts()[2] != before[2])
    after = lab.page.locator(PLACES).all_inner_texts()
    assert after[:2] == before[:2]
    place = [
        np.array([float(number) for number in texts[2].replace("−", "-").split(", ")]) for texts in (before, after)
    ]
    moved = place[1] - place[0]
    assert moved[2] > 20.0
    np.testing.assert_allclose(moved[:2], 0.0, atol=0.2)
    lab.page.locator(VERDICT, has_text="within all limits").wait_for()
    assert lab.errors == []


def test_a_motion_is_played_and_scrubbed_and_one_out_of_reach_is_marked_in_words_before_it_is_run(visit):
    planned = planned_now(with_planned(State.initial(catalogue()["planar_2r"])))
    lab = at_plan(visit, "planar_2r")
    stood = turned(lab)
    lab.page.locator('.al button[data-cell="play-motion"]').click()
    lab.page.locator(".al-time").wait_for()
    lab.until(lambda: off(lab, planned.motion.at(planned.duration)) < 1e-3)
    lab.page.locator('.al-time button[data-cell="play"][title^="Play"]').wait_for()  # it stands at its end
    for share in (0.25, 0.6):
        lab.page.locator('.al-time input[data-cell="seek"]').fill(str(share))
        q = planned.motion.at(share * planned.duration)
        lab.until(lambda q=q: off(lab, q) < 1e-3)
    lab.page.locator('.al-time button[data-cell="close"]').click()
    lab.until(lambda: off(lab, stood) < 1e-3)
    lab.page.locator('select[data-cell="example"]').select_option("out_of_reach")
    lab.page.locator(VERDICT, has_text="Cannot be run to its end").wait_for()
    lab.until(lambda: any(name.endswith("/motion/stop0") for name in lab.nodes()))
    assert lab.page.locator('.al button[data-cell="play-motion"]').is_disabled()
    assert lab.errors == []
