"""A running lab and students without pictures: who sees what, and what a drag costs in messages."""

import asyncio
import html
import json
import math
import re

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.ui.plugin import layers
from armlab.window.layer_drawing import Drawing
from support.fake_browser import FakeBrowser, cookie_of
from support.lab import running_lab
from support.student import arm_nodes, run, settled, student

PUMA = catalogue()["puma560"]
HAND = np.array(PUMA.arm.position(PUMA.home))


def slider_values(browser):
    return [browser.slider(i + 1)["value"] for i in range(6)]


async def drag_by(browser, shift, steps=10):
    start = HAND if browser.nodes["/target"].get("position") is None else browser.nodes["/target"]["position"]
    await browser.drag("start")
    for k in range(1, steps + 1):
        await browser.drag("update", np.asarray(start) + np.asarray(shift) * k / steps)
        await asyncio.sleep(0.05)
    await browser.drag("end")
    await settled(browser)


def test_a_new_student_sees_the_arm_its_sliders_and_its_handle(url):
    async def main():
        browser = await student(url)
        assert len(arm_nodes(browser)) == 6
        np.testing.assert_allclose(slider_values(browser), np.degrees(PUMA.home), atol=0.05)
        np.testing.assert_allclose(browser.nodes["/target"]["position"], HAND, atol=1e-9)
        assert "Drag the handle" in browser.html()
        await browser.close()

    run(main())


def test_a_drag_asks_only_the_layers_that_are_seen(url, monkeypatch):
    asked, show = set(), Drawing.show

    def noted(drawing, *arguments):
        asked.add(drawing.layer.key)
        show(drawing, *arguments)

    async def main():
        browser = await student(url)
        monkeypatch.setattr(Drawing, "show", noted)
        await drag_by(browser, (0.0, 0.1, 0.05))
        await browser.close()

    run(main())
    assert {"arm", "gizmo"} <= asked
    assert len(asked) < len(layers()) / 4


def test_dragging_the_handle_moves_sliders_numbers_and_verdict(url):
    async def main():
        browser = await student(url)
        await drag_by(browser, (0.0, 0.1, 0.05))
        expected = HAND + np.array([0.0, 0.1, 0.05])
        q = np.radians(slider_values(browser))
        np.testing.assert_allclose(PUMA.arm.position(q), expected, atol=2e-3)
        assert "✓ reached" in browser.html()
        assert f"{1000 * expected[2]:.1f}" in browser.html()
        await browser.close()

    run(main())


def test_two_students_never_touch_each_other(url):
    async def main():
        first, second = await student(url), await student(url)
        await settled(second)
        quiet = second.bytes
        await first.set_value(first.slider(1), 60.0)
        await drag_by(first, (0.05, 0.0, 0.0))
        assert second.bytes == quiet
        np.testing.assert_allclose(slider_values(second), np.degrees(PUMA.home), atol=0.05)
        await first.close()
        await second.close()

    run(main())


def test_a_reload_brings_the_arm_back(url):
    async def main():
        cookie = cookie_of(url)
        browser = await student(url, cookie)
        await browser.set_value(browser.slider(2), 40.0)
        await settled(browser)
        await browser.close()
        again = await student(url, cookie)
        assert slider_values(again)[1] == 40.0
        await again.close()

    run(main())


def test_two_tabs_of_one_browser_show_one_arm(url):
    async def main():
        cookie = cookie_of(url)
        first, second = await student(url, cookie), await student(url, cookie)
        await first.set_value(first.slider(3), -120.0)
        await second.until(lambda: slider_values(second)[2] == -120.0)
        await drag_by(second, (0.0, 0.0, 0.04))
        await settled(first)
        np.testing.assert_allclose(slider_values(first), slider_values(second), atol=1e-9)
        await first.close()
        await second.close()

    run(main())


def test_undo_takes_back_a_whole_drag_in_every_tab(url):
    async def main():
        cookie = cookie_of(url)
        first, second = await student(url, cookie), await student(url, cookie)
        before = slider_values(first)
        await drag_by(first, (0.0, 0.12, 0.0))
        await second.until(lambda: slider_values(second) != before)
        await settled(second)
        dragged = slider_values(second)
        await second.press("undo")
        for browser in (first, second):
            await browser.until(lambda browser=browser: slider_values(browser) == before)
        await second.press("redo")
        await first.until(lambda: slider_values(first) == dragged)
        await first.close()
        await second.close()

    run(main())


def test_a_link_names_an_arm_but_a_reconnect_does_not_repeat_it(url):
    async def main():
        import urllib.request

        cookie = cookie_of(url)
        urllib.request.urlopen(urllib.request.Request(url + "robot/scara", headers={"Cookie": cookie})).close()
        browser = await student(url, cookie, "/robot/scara")
        await browser.open("robot")
        await browser.until(lambda: "SCARA RRPR" in browser.html())
        await browser.press("panda") if 'data-cell="panda"' in browser.html() else await choose(browser, "planar_2r")
        await settled(browser)
        await browser.close()
        again = await student(url, cookie, "/robot/scara")
        await again.open("robot")
        await settled(again)
        assert "Planar 2R" in again.html()
        await again.close()

    async def choose(browser, key):
        family = next(c for c in browser.controls.values() if c["props"].get("label") == "Family")
        await browser.set_value(family, "Planar")
        await browser.until(lambda: f'data-cell="{key}"' in browser.html())
        await browser.press(key)

    run(main())


def test_a_link_to_an_arm_that_is_not_there_says_so(url):
    async def main():
        import urllib.request

        cookie = cookie_of(url)
        urllib.request.urlopen(urllib.request.Request(url + "robot/pumma560", headers={"Cookie": cookie})).close()
        browser = await student(url, cookie)
        await browser.until(lambda: bool(browser.notices))
        assert browser.notices == ["There is no arm 'pumma560'. Did you mean /robot/puma560?"]
        await browser.close()

    run(main())


def test_a_typed_target_that_is_no_number_is_refused_at_the_field(url):
    async def main():
        browser = await student(url)
        before = slider_values(browser)
        await browser.open("joints", "target")
        await browser.press("x", "six hundred")
        refused = "x: expected a number in mm, got &#39;six hundred&#39;"
        await browser.until(lambda: f'role="alert">✕ {refused}' in browser.html())
        assert slider_values(browser) == before
        await browser.close()

    run(main())


@pytest.mark.parametrize("value", [math.nan, math.inf, 1e308, -1e308])
def test_a_hostile_slider_value_is_refused_or_stops_at_the_limit(url, value):
    async def main():
        browser = await student(url)
        await browser.set_value(browser.slider(1), value)
        await settled(browser)
        for node in browser.nodes.values():
            pose = [np.ravel(node[name]) for name in ("position", "wxyz") if name in node]
            assert all(np.isfinite(values).all() for values in pose)
        assert abs(browser.slider(1)["value"]) <= 160.0 or not math.isfinite(value)
        await browser.close()

    run(main())


def test_a_hostile_drag_disturbs_nobody(url):
    """Poses that are no numbers, far away, or no rotations."""

    async def main():
        browser, other = await student(url), await student(url)
        for position, wxyz in (
            ((math.nan, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)),
            ((1e30, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)),
            (HAND, (0.0, 0.0, 0.0, 0.0)),
            (HAND, (math.inf, 0.0, 0.0, 0.0)),
        ):
            await browser.drag("start")
            await browser.drag("update", position, wxyz)
            await browser.drag("end")
            await asyncio.sleep(0.1)
        await settled(browser)
        q = np.radians(slider_values(browser))
        assert np.all(np.isfinite(q))
        before = other.counts["SetOrientationMessage"]
        await other.set_value(other.slider(1), 10.0)
        await other.until(lambda: other.counts["SetOrientationMessage"] > before)
        await browser.close()
        await other.close()

    run(main())


def test_a_drag_costs_one_message_a_moving_joint_and_event(url):
    """Ten events: at most ten orientations a joint, and refreshes of the panels at their own slow pace."""

    async def main():
        browser = await student(url)
        await settled(browser)
        counts = browser.counts.copy()
        await drag_by(browser, (0.02, 0.03, 0.01), steps=10)
        sent = browser.counts - counts
        assert 30 <= sent["SetOrientationMessage"] <= 11 * 6 + 2
        assert sent["SetPositionMessage"] <= 2
        refreshes = math.ceil(1.2 / 0.125) + 2
        assert sent["GuiUpdateMessage"] <= refreshes * (6 + 4)
        assert set(sent) <= {"SetOrientationMessage", "SetPositionMessage", "GuiUpdateMessage"}
        await browser.close()

    run(main())


def test_the_share_tunnel_is_off(url):
    async def main():
        browser = await student(url)
        await browser.send({"type": "ShareUrlRequest"})
        await settled(browser)
        assert not any("Share" in kind for kind in browser.counts)
        await browser.set_value(browser.slider(1), 12.0)
        await browser.until(lambda: "12.0" in browser.html() or slider_values(browser)[0] == 12.0)
        await browser.close()

    run(main())


def test_work_survives_a_restart_of_the_server(open_lab, tmp_path):
    lab = open_lab(tmp_path)
    url = f"http://127.0.0.1:{lab.port}/"

    async def before():
        browser = await student(url, cookie)
        await browser.set_value(browser.slider(1), 77.0)
        await settled(browser)
        await browser.close()

    cookie = cookie_of(url)
    run(before())
    lab.stop()
    open_lab(tmp_path, port=lab.port)

    async def after():
        browser = await student(url, cookie)
        assert slider_values(browser)[0] == 77.0
        await browser.close()

    run(after())


def test_a_class_has_several_labs_behind_one_front(tmp_path):
    with running_lab(tmp_path, labs=2) as url:

        async def main():
            browsers = [await student(url) for _ in range(6)]
            for k, browser in enumerate(browsers):
                await browser.set_value(browser.slider(1), float(10 * k))
            await asyncio.gather(*map(settled, browsers))
            for k, browser in enumerate(browsers):
                assert slider_values(browser)[0] == 10.0 * k
            await asyncio.gather(*(browser.close() for browser in browsers))

        run(main())
    assert len(list((tmp_path / "sessions").glob("*.json"))) == 6


def test_a_clip_is_paused_when_the_last_page_closes(url):
    async def main():
        cookie = cookie_of(url)
        first, second = await student(url, cookie), await student(url, cookie)
        await first.open("film")
        await first.until(lambda: 'data-cell="play"' in first.html())
        await first.press("play")
        await first.until(lambda: clock(first) is not None and clock(first)["rate"] == 1.0)
        await second.close()
        await asyncio.sleep(0.3)
        assert clock(first)["rate"] == 1.0, "it plays on while somebody looks"
        await first.close()
        await asyncio.sleep(0.3)
        again = FakeBrowser(url, cookie)  # it opens on the film, without the handle a student waits for
        await again.connect()
        await again.until(lambda: clock(again) is not None)
        held = clock(again)
        assert held["rate"] == 0.0
        assert 0.0 < held["time"] < held["end"]
        await again.close()

    run(main())


def clock(browser):
    """Return what the lab has told of the timeline."""
    found = re.search(r'data-clock="([^"]*)"', browser.html())
    return json.loads(html.unescape(found[1])) if found else None


def test_a_page_opens_on_the_panel_looked_at_last(url):
    async def main():
        cookie = cookie_of(url)
        browser = await student(url, cookie)
        await browser.open("table")
        await browser.until(lambda: 'class="dh edit"' in browser.html())
        await browser.close()
        again = await student(url, cookie)
        await again.until(lambda: 'class="dh edit"' in again.html())
        found = html.unescape(re.search(r'data-notes="([^"]*)"', again.html())[1])
        assert json.loads(found)["tab"] == "Robot"
        await again.close()

    run(main())


@pytest.mark.parametrize(("panel", "cell"), [("table", "dh-2-a"), ("target", "x")])
def test_half_a_character_is_refused_and_what_follows_is_saved(tmp_path, panel, cell):
    with running_lab(tmp_path) as address:

        async def main():
            cookie = cookie_of(address)
            browser = await student(address, cookie)
            await browser.open(panel)
            await browser.until(lambda: f'data-cell="{cell}"' in browser.html())
            await browser.press(cell, "\ud800")
            await browser.until(lambda: "expected a number" in browser.html())
            await browser.press("undo")
            await browser.open("joints")
            await browser.set_value(browser.slider(1), 33.0)
            await settled(browser)
            await browser.close()
            again = await student(address, cookie)
            assert slider_values(again)[0] == 33.0
            await again.close()

        run(main())
    (saved,) = (tmp_path / "sessions").glob("*.json")
    assert json.loads(saved.read_text(encoding="utf-8"))["parts"]["joints"]["q"][0] == pytest.approx(math.radians(33.0))
