"""The page of the files of a motion as a browser gets it, and recordings."""

import asyncio
import base64
import csv
import io
import json
import math
import re
import threading
from dataclasses import replace

import msgspec
import numpy as np
import pytest
import zstandard

from armlab.benches.motion.files.read import column_names, motion_csv, plan_json
from armlab.benches.motion.files.ui.page import MotionFiles, size_text
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.points import SelectWaypoint
from armlab.benches.motion.plan.state import planned_now
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.motion import Trajectory, law_type, path_type
from armlab.session.parts.joints import Joints, LockJoint
from armlab.session.parts.timeline import OpenClip
from armlab.session.state import State, apply
from armlab.teaching.lesson_commands import OpenLesson
from armlab.ui.figure.anatomy import anatomy_of
from armlab.ui.plugin import layers, panel
from armlab.ui.recording import LONGEST, POSES_PER_SECOND, Scenario, maker, record
from support.bare_gui import BareGui
from support.patience import Patience
from support.student import run, student


def opened(key="puma560"):
    return with_planned(State.initial(catalogue()[key]))


def scenario(state):
    return Scenario(state, planned_now(state).motion, 0.4, 0.3)


def messages_of(recorded):
    """Return duration and timed messages of a recording, arrays in them as placeholders."""
    length = int.from_bytes(recorded[:8], "little")
    plain = zstandard.ZstdDecompressor().decompress(recorded[8:], max_output_size=length)
    packed = int.from_bytes(plain[:8], "little")
    data = msgspec.msgpack.decode(plain[8 : 8 + packed])
    return data["durationSeconds"], data["messages"]


# -- recordings ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", ["puma560", "scara"])
def test_a_recording_moves_the_bodies_as_the_motion_does_in_real_time(key):
    state = opened(key)
    arm, motion = state[Joints].arm, planned_now(state).motion
    duration, messages = messages_of(record(scenario(state), "viser"))
    assert duration == pytest.approx(motion.duration, abs=1e-9)
    bodies = anatomy_of(arm).bodies
    times, shown = {0.0}, np.full(arm.n, np.nan)
    for i, body in enumerate(bodies):
        kind = "SetOrientationMessage" if body.revolute else "SetPositionMessage"
        name = "/0/arm/" + "/".join(str(k + 1) for k in range(i + 1))
        found = [(at, m) for at, m in messages if m["type"] == kind and m["name"] == name]
        for at, message in found[1:]:
            q = float(arm.clip(motion.at(at))[i])
            wanted = body.node_wxyz(q) if body.revolute else body.node_position(q)
            np.testing.assert_allclose(message["wxyz" if body.revolute else "position"], wanted, rtol=0, atol=1e-6)
        if found[-1][0] > 0.0:
            shown[i] = found[-1][0]
        times |= {at for at, _ in found}
    np.testing.assert_allclose(shown[np.isfinite(shown)], motion.duration, atol=1e-9)
    assert len(times) == math.ceil(motion.duration * POSES_PER_SECOND) + 1
    kinds = [message["type"] for _, message in messages]
    assert kinds.count("GlbMessage") == arm.n + 1
    assert "GridMessage" in kinds
    assert any(message.get("name") == "/0/way" for _, message in messages)
    assert not any(kind.startswith("Gui") or "Javascript" in kind for kind in kinds)


def test_a_page_holds_its_recording_and_needs_nothing_else():
    state = opened("planar_2r")
    text = record(scenario(state), "html").decode()
    embedded = re.search(r'window\.__VISER_EMBED_DATA__="([^"]+)"', text)[1]
    duration, _ = messages_of(base64.b64decode(embedded))
    assert duration == pytest.approx(planned_now(state).duration, abs=1e-9)
    assert f"<title>{catalogue()['planar_2r'].name}: motion</title>" in text
    assert len(text) < 2e6
    # Nothing is fetched from elsewhere: every source is in the page.
    assert not re.search(r'<(script|link|img)[^>]+(src|href)="(?!data:)', text)


def test_a_motion_that_is_too_long_is_refused_and_no_server_is_left():
    state = opened("planar_2r")
    before = {thread.ident for thread in threading.enumerate()}
    path = path_type("line").path([[0.0, 0.0], [0.5, 0.5]])
    slow = Trajectory(path, law_type("quintic").law(LONGEST + 1.0))
    with pytest.raises(InputError, match="lasts 121 s; at most 120 s can be recorded"):
        record(Scenario(state, slow, 0.0, 0.3), "viser")
    record(scenario(state), "viser")
    left = [thread for thread in threading.enumerate() if thread.ident not in before]
    for thread in left:
        thread.join(5.0)
    assert not any(thread.is_alive() for thread in left)


def test_a_joint_that_is_held_moves_in_a_recording():
    state = opened()
    joints = state[Joints].moved_to(state[Joints].q + np.array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0]))
    held = apply(state.replace(joints), LockJoint(0, True))
    wanted, found = (messages_of(record(replace(scenario(state), state=each), "viser")) for each in (state, held))
    turned = [[m for _, m in messages if m["type"] == "SetOrientationMessage"] for _, messages in (wanted, found)]
    assert turned[0] == turned[1] != []


def test_a_recording_says_nothing_on_standard_output(capsys):
    record(scenario(opened("planar_2r")), "viser")
    assert capsys.readouterr() == ("", "")


# -- the page --------------------------------------------------------------------------------------------------------


def test_sizes_are_told_in_kilobytes_or_megabytes():
    sizes = [size_text(size) for size in (3, 1_640, 9_960, 312_400, 999_600, 1_234_567)]
    assert sizes == ["0.1 kB", "1.6 kB", "10 kB", "312 kB", "1.00 MB", "1.23 MB"]


@pytest.mark.parametrize("key", ["motion", "motion_plots", "motion_files"])
def test_the_handle_of_the_arm_is_hidden_while_the_motion_is_on(key):
    state = opened()
    assert panel(key).hides_then(state) == ()
    on = apply(state, OpenClip("motion"))
    assert set(panel(key).hides_then(on)) == {"gizmo", "gap"} <= set(layers())
    # A waypoint takes the handle only where it has one itself.
    held = panel(key).hides_then(apply(state, SelectWaypoint(1, handled=True)))
    assert bool(held) == (key in layers()["motion_waypoints"].panels)


async def at_files(url, path="/"):
    browser = await student(url, path=path)
    await browser.open("motion_files")
    await browser.until(lambda: "Plan of 2 waypoints" in browser.html())
    return browser


async def saved(browser, cell, name):
    await browser.press(cell)
    await browser.until(lambda: f"✓ Saved {name}" in browser.html())
    return browser.downloads[name]


def test_each_file_is_saved_with_what_it_should_hold(url):
    async def main():
        browser = await at_files(url)
        state = opened()
        await browser.press("rate", "50")
        await browser.until(lambda: 'value="50"' in browser.html())
        table = await saved(browser, "csv", "puma_560_motion.csv")
        assert table.decode() == motion_csv(state[Joints].arm, planned_now(state).motion, 50.0)
        plan = json.loads(await saved(browser, "json", "puma_560_motion.json"))
        assert plan == json.loads(plan_json(state))
        script = await saved(browser, "python", "puma_560_motion.py")
        assert b"RATE = 50.0" in script
        assert b"puma_560_motion.csv" in script
        duration, _ = messages_of(await saved(browser, "viser", "puma_560_motion.viser"))
        assert duration == pytest.approx(planned_now(state).duration, abs=1e-9)
        page = await saved(browser, "html", "puma_560_motion.html")
        assert b"__VISER_EMBED_DATA__" in page
        await browser.close()

    run(main())


def test_a_table_is_read_made_waypoints_of_and_taken_back(url):
    async def main():
        browser = await at_files(url)
        text = (await saved(browser, "csv", "puma_560_motion.csv")).decode()
        rows = list(csv.reader(io.StringIO(text)))
        assert tuple(rows[0]) == column_names(opened()[Joints].arm)
        await browser.press("read-motion", text)
        await browser.until(lambda: f"From a file: {len(rows) - 1} samples" in browser.html())
        await browser.press("motion-back")
        await browser.until(lambda: "Plan of 2 waypoints" in browser.html())
        await browser.press("read-motion", text)
        await browser.until(lambda: 'data-cell="by-shape"' in browser.html())
        await browser.press("count", "1")
        refusal = "waypoints: expected a whole number from 2 to 20, got &#39;1&#39;"
        await browser.until(lambda: refusal in browser.html())
        await browser.press("count", "5")
        await browser.until(lambda: 'value="5"' in browser.html())
        await browser.press("by-time")
        await browser.until(lambda: "Plan of 5 waypoints" in browser.html())
        assert 'data-cell="motion-back"' not in browser.html()
        assert browser.notices == []
        await browser.close()

    run(main())


def test_what_cannot_be_read_is_told_on_the_page_and_the_plan_stays(url):
    async def main():
        browser = await at_files(url)
        for text, says in (
            ("time,q1,q2,q3,q4,q5,q6\n0,0,0,0,0,0,0\n1,nan,0,0,0,0,0", "row 3, column q1: expected a finite number"),
            ("time,<b>q1</b>", "there are: time, &lt;b&gt;q1&lt;/b&gt;"),
            ("\0", "got a binary file"),
            ("", "the file is empty"),
            ("{", "plan, row 1, column 2"),
            ('{"format": "armlab plan", "version": 1}', "plan: &#39;robot&#39; is missing in the file"),
        ):
            await browser.press("read-motion", text)
            await browser.until(lambda says=says: says in browser.html())
            assert "Plan of 2 waypoints" in browser.html()
        await browser.press("rate", "fast")
        await browser.until(lambda: "expected a number, got &#39;fast&#39;" in browser.html())
        await browser.press("rate", "0")
        await browser.until(lambda: "expected more than 0 and at most 10000, got 0" in browser.html())
        await browser.press("rate", "10000")
        await browser.until(lambda: 'value="10000"' in browser.html())
        await browser.close()

    run(main())


def test_of_files_chosen_while_one_is_read_the_last_is_told(url):
    async def main():
        browser = await at_files(url)
        release = threading.Event()
        maker().submit(release.wait)
        for text in ("\0", '{"format": "armlab plan", "version": 1}', ""):
            await browser.press("read-motion", text)
        await browser.press("rate", "50")  # what stands before it in the queue has been heard when this has
        await browser.until(lambda: 'value="50"' in browser.html())
        release.set()
        await browser.until(lambda: "the file is empty" in browser.html())
        assert "Plan of 2 waypoints" in browser.html()
        assert browser.notices == []
        await browser.close()

    run(main())


def test_a_plan_of_another_arm_brings_its_arm_along(url):
    async def main():
        browser = await at_files(url)
        await browser.press("read-motion", plan_json(opened("ur10e")))
        await browser.until(lambda: "/robot/ur10e" in browser.html())
        await browser.until(lambda: "Plan of 2 waypoints" in browser.html())
        data = json.loads(await saved(browser, "json", "ur10e_motion.json"))
        assert data["robot"] == "ur10e"
        await browser.close()

    run(main())


def test_an_arm_that_the_lesson_keeps_is_told_at_the_field():
    async def main():
        posted = []
        page = MotionFiles(BareGui(), apply(opened(), OpenLesson("how_many_numbers")), posted.append)
        page.read(plan_json(opened("ur10e")))
        patience = Patience()
        while page._shown.busy and patience.left():
            await asyncio.sleep(0.01)
        return page._shown.refused_at, page._shown.refused, posted

    where, said, posted = run(main())
    assert (where, posted) == ("import", [])
    assert said.startswith("This lesson keeps the ")
