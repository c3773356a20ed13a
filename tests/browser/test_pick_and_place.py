"""Pick and place from a fresh start in a real page: four waypoints, the box carried, plots and CSV, in few clicks."""

import numpy as np
import pytest

from armlab.benches.motion.pick.state import PickAndPlace, places_at
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.state import planned_now
from armlab.content.robots import catalogue
from armlab.session.state import State, apply

pytestmark = pytest.mark.browser

MOST_CLICKS = 12

COUNT = (
    "() => { window.__clicks = 0; addEventListener('click', event => { window.__clicks += event.isTrusted }, true) }"
)


def box(lab, k=0):
    """Return where the page has the middle of a box, in the world."""
    name = lab.node(f"/pick/box{k}")
    return np.array(lab.page.evaluate("name => window.__viserMutable.nodePoseData[name].position", name))


def saved(lab, cell):
    """Press a button that saves a file, and return its lines."""
    with lab.page.expect_download() as found:
        lab.page.locator(f'.al button[data-cell="{cell}"]').first.click()
    return found.value.path().read_text(encoding="utf-8").splitlines()


def test_pick_and_place_with_plots_and_csv_takes_few_clicks_from_a_fresh_start(visit):
    state = with_planned(apply(State.initial(catalogue()["puma560"]), PickAndPlace()))
    planned = planned_now(state)
    lab = visit()
    lab.page.evaluate(COUNT)
    lab.open_tab("Motion")
    lab.press("motion_pick")
    lab.press("pick-place")
    lab.page.locator(".al .verdict", has_text="1 of 3 boxes at the goal at the end").wait_for()
    assert lab.page.locator('select[data-cell^="at-"]').count() == 4
    np.testing.assert_allclose(box(lab), places_at(state, 0.0)[0], atol=1e-3)
    lab.press("play-motion")
    lab.until(lambda: np.abs(box(lab) - places_at(state, planned.duration)[0]).max() < 1e-3)
    lab.press("motion_plots")
    plotted = saved(lab, "csv")
    lab.press("motion_files")
    table = saved(lab, "csv")
    clicks = lab.page.evaluate("() => window.__clicks")
    assert 6 <= clicks <= MOST_CLICKS, clicks
    assert len(plotted) > 100
    assert table[0].endswith(",gripper_closed")
    rows = np.array([[float(cell) for cell in row.split(",")] for row in table[1:]])
    assert rows[-1, 0] == pytest.approx(planned.duration, abs=1e-6)
    assert set(rows[:, -1]) == {0.0, 1.0}
    assert lab.errors == []


def test_the_box_is_carried_wherever_the_film_is_moved_to(visit):
    state = with_planned(apply(State.initial(catalogue()["scara"]), PickAndPlace()))
    end = planned_now(state).duration
    lab = visit("robot/scara")
    lab.open_tab("motion_pick")
    lab.press("pick-place")
    lab.page.locator(".al .verdict", has_text="at the goal at the end").wait_for()
    lab.press("play-motion")
    lab.page.locator('.al-time button[data-cell="play"][title^="Play"]').wait_for()
    for share in (0.7, 0.45, 0.9, 0.05, 0.6):
        lab.page.locator('.al-time input[data-cell="seek"]').fill(str(share))
        for k, place in enumerate(places_at(state, share * end)):
            lab.until(lambda k=k, place=place: np.abs(box(lab, k) - place).max() < 2e-3)
    lab.page.locator('.al-time button[data-cell="close"]').click()
    lab.until(lambda: np.abs(box(lab) - places_at(state, 0.0)[0]).max() < 1e-3)
    assert lab.errors == []


def test_a_box_is_typed_elsewhere_and_the_words_say_by_how_much_the_hand_misses_it(visit):
    lab = visit("robot/planar_2r")
    lab.open_tab("motion_pick")
    lab.press("pick-place")
    lab.page.locator(".al .verdict", has_text="closes on box 1 and carries it").wait_for()
    before = float(lab.page.locator('input[data-cell="box-0 0"]').input_value().replace("−", "-"))
    lab.type_into("box-0 0", str(before - 90.0))
    said = "The gripper closes on nothing: the middle of box 1 is 90.0 mm away."
    lab.page.locator(".al .verdict", has_text=said[4:]).wait_for()
    lab.page.locator('.al button[data-cell="drag-0"]').click()
    lab.until(lambda: any(name.endswith("/pick/handle") for name in lab.nodes()))
    lab.rest()
    lab.drag_handle(0, 2.0, (60.0, 0.0), node=lab.node("/pick/handle"))
    lab.until(lambda: lab.page.locator('input[data-cell="box-0 0"]').input_value() != f"{before - 90.0:.1f}")
    assert lab.errors == []
