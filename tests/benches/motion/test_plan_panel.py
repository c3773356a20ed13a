"""The page Plan of a motion as a browser gets it."""

import re

import numpy as np
import pytest

from armlab.benches.motion.plan.examples import EXAMPLES
from armlab.benches.motion.plan.question import Feasible
from armlab.benches.motion.plan.ui.scene_path import COLOURS, WORDS
from armlab.benches.motion.plan.ui.scene_waypoints import names_of
from support.student import run, settled, student


async def at_plan(url):
    browser = await student(url)
    await browser.open("motion")
    await browser.until(lambda: "within all limits" in browser.html())
    return browser


def places(browser):
    """Return the places in the list of waypoints."""
    return re.findall(r'mo-at">([^<]*)<', browser.html())


def node(browser, ending):
    """Return what is known of the node whose name ends so; None when there is none."""
    return next((known for name, known in browser.nodes.items() if name.endswith(ending)), None)


def marks(browser):
    """Return the words in the scene where a way ends."""
    return [known["text"] for name, known in browser.nodes.items() if name.endswith("/stop0/words")]


def test_waypoints_are_added_typed_exchanged_and_removed(url):
    async def main():
        browser = await at_plan(url)
        assert len(places(browser)) == 2
        assert "Waypoints, mm" in browser.html()
        assert not any("m" in place for place in places(browser))
        await browser.press("go")
        await settled(browser)
        await browser.press("add")
        # Here the arm is at waypoint 2 already: no move would have a length.
        await browser.until(lambda: "waypoint 3: the same configuration as waypoint 2" in browser.html())
        assert len(places(browser)) == 2
        first, second = places(browser)
        await browser.press("down-0")
        await browser.until(lambda: places(browser) == [second, first])
        await browser.press("q 0", "12.5")
        await browser.until(lambda: 'value="12.5"' in browser.html())
        await browser.press("q 0", "much")
        await browser.until(lambda: "joint 1 of waypoint 2: expected a number in degrees" in browser.html())
        await browser.press("add")
        await browser.until(lambda: len(places(browser)) == 3)
        await browser.press("remove-2")
        await browser.until(lambda: len(places(browser)) == 2)
        await browser.close()

    run(main())


def test_a_typed_pose_out_of_reach_is_refused_and_the_old_one_stays(url):
    async def main():
        browser = await at_plan(url)
        before = places(browser)
        await browser.press("pose x", "9000")
        await browser.until(lambda: "waypoint 2: " in browser.html())
        assert places(browser) == before
        await browser.close()

    run(main())


def test_moves_laws_time_and_limits_are_chosen_and_nonsense_is_refused(url):
    async def main():
        browser = await at_plan(url)
        await browser.press("space-cartesian")
        await browser.until(lambda: "Cartesian: straight line" in browser.html())
        await browser.press("path", "circle")
        await browser.until(lambda: "Circle through three points takes 3 waypoints" in browser.html())
        await browser.press("law", "double_s")
        await browser.until(lambda: "law rounding" in browser.html())
        await browser.press("time-given")
        await browser.until(lambda: 'data-cell="duration"' in browser.html())
        await browser.press("law rounding", "0.9")
        await browser.until(lambda: "in a ramp): expected a number greater than 0 and at most 0.5" in browser.html())
        await browser.press("duration", "0.05")
        await browser.until(lambda: "✕ Exceeds limits" in browser.html())
        await browser.until(lambda: "velocity limit" in browser.html())
        await browser.press("duration", "0")
        await browser.until(lambda: "duration: expected a positive number, got 0" in browser.html())
        await browser.press("time-fastest")
        await settled(browser)
        await browser.press("speed", "20")
        await browser.until(lambda: "within all limits" in browser.html())
        await browser.press("vmax 0", "0")
        await browser.until(lambda: "limit of velocity of joint 1: expected a positive number" in browser.html())
        await browser.close()

    run(main())


def test_the_way_is_drawn_before_it_is_run_and_a_dragged_waypoint_bends_it(url):
    async def main():
        browser = await at_plan(url)
        await browser.until(lambda: node(browser, "/motion/way") is not None)
        drawn = browser.counts["LineSegmentsMessage"]
        await browser.press("drag")
        await browser.until(lambda: node(browser, "/waypoints/handle") is not None)
        handle = next(name for name in browser.nodes if name.endswith("/waypoints/handle"))
        at, before = np.array(browser.nodes[handle]["position"]), places(browser)
        await browser.drag("start", at, node=handle)
        for k in range(1, 4):
            await browser.drag("update", at + np.array([0.0, 0.0, 0.02 * k]), node=handle)
        await browser.drag("end", at + np.array([0.0, 0.0, 0.06]), node=handle)
        higher = at[2] + 0.06
        await browser.until(lambda: abs(node(browser, "/waypoints/1")["position"][2] - higher) < 1e-6)
        await browser.until(lambda: places(browser)[1] != before[1])
        await browser.until(lambda: browser.counts["LineSegmentsMessage"] > drawn)
        await browser.press("undo")
        await browser.until(lambda: places(browser) == before)
        await browser.close()

    run(main())


def test_a_dragged_waypoint_stays_in_the_hand_when_another_page_selects_another(url):
    async def main():
        first = await at_plan(url)
        second = await student(url, first.cookie)
        await second.open("motion")
        await first.press("drag")
        await first.until(lambda: node(first, "/waypoints/handle") is not None)
        handle = next(name for name in first.nodes if name.endswith("/waypoints/handle"))
        at, resting = np.array(first.nodes[handle]["position"]), node(first, "/waypoints/0")["position"]
        await first.drag("start", at, node=handle)
        await first.drag("update", at + np.array([0.0, 0.0, 0.02]), node=handle)
        await second.press("select-0")
        await settled(first)
        await first.drag("update", at + np.array([0.0, 0.0, 0.04]), node=handle)
        await first.drag("end", at + np.array([0.0, 0.0, 0.04]), node=handle)
        await first.until(lambda: abs(node(first, "/waypoints/1")["position"][2] - at[2] - 0.04) < 1e-6)
        assert node(first, "/waypoints/0")["position"] == resting
        await first.close()
        await second.close()

    run(main())


@pytest.mark.parametrize("key", ["corner_fly", "out_of_reach", "given_time"])
def test_examples_are_put_in_place_and_judged(url, key):
    async def main():
        browser = await at_plan(url)
        await browser.press("example", key)
        says = EXAMPLES[key].says[:30]
        await browser.until(lambda: says in browser.html())
        kind = {"out_of_reach": "no", "given_time": "no"}.get(key, "ok")
        await browser.until(lambda: f'<div class="verdict {kind}"' in browser.html())
        await browser.until(lambda: marks(browser) == (["✕ out of reach"] if key == "out_of_reach" else []))
        await browser.close()

    run(main())


def test_places_that_are_close_share_a_label():
    spots = np.array([[0.0, 0, 0], [1, 0, 0], [0.01, 0, 0], [1, 0.01, 0], [2, 0, 0]])
    assert names_of(spots, 0.1) == ["1, 3", "2, 4", "", "", "5"]


def test_every_worth_has_a_colour_and_every_stop_has_words():
    assert set(COLOURS) == set(Feasible)
    assert set(WORDS) == {"reach", "limit", "singularity", "branch"}
