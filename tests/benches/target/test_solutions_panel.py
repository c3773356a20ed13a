"""The page Solutions, and the ghosts, through the protocol a page speaks."""

import asyncio
import math
import re

import numpy as np
import pytest

from armlab.benches.target.solutions.ui.names import bends, ranges
from armlab.content.robots import catalogue
from armlab.kin.rotations import rotation_from_quaternion
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.target import Said, Target, verdict
from armlab.session.state import State
from armlab.ui.scene._sticks import corners_of, drawn_sticks, turns_to
from armlab.ui.units import Units
from armlab.ui.verdicts import verdict_card, verdict_line
from support.student import run, student

ROW = re.compile(r'<div class="sol-row([^"]*)" data-place="(\d+)"[^>]*>(.*?)</div>')
SPAN = re.compile(r"<span>([^<]*)</span>")


def rows_of(html):
    """Return place, slot, class and values of every row on screen."""
    found = []
    for kind, place, inside in ROW.findall(html):
        slot = re.search(r'data-cell="go(\d+)"', inside).group(1)
        values = [float(text.replace("−", "-")) for text in SPAN.findall(inside.split('class="values"', 1)[1])]
        found.append((int(place), int(slot), kind.strip(), values))
    return found


async def listed(browser, count):
    await browser.until(lambda: len(rows_of(browser.html())) == count)
    return rows_of(browser.html())


def angles(browser, n):
    return [browser.slider(i + 1)["value"] for i in range(n)]


def test_a_row_is_pressed_and_the_arm_goes_there(url):
    async def main():
        browser = await student(url, path="/robot/ur10_notes")
        await browser.press("eight")
        await browser.open("joints", "solutions")
        rows = await listed(browser, 8)
        assert "8 solutions, and no others" in browser.html()
        assert [place for place, *_ in rows] == list(range(1, 9))
        assert [kind for _, _, kind, _ in rows].count("now") == 1
        for _, slot, kind, values in rows:
            if kind == "now":
                continue
            await browser.press(f"go{slot}")
            await browser.until(lambda values=values: np.allclose(angles(browser, 6), values, atol=0.06))
        await browser.until(lambda: rows_of(browser.html())[-1][2] == "now")
        await browser.close()

    run(main())


def test_the_list_follows_a_drag_and_rows_out_of_limits_say_why(url):
    async def main():
        browser = await student(url)
        await browser.open("solutions")
        before = await listed(browser, 8)
        off = [row for row in before if row[2] == "off"]
        assert off
        assert re.search(r"✕ joint \d by [\d.]+° (above|below)", browser.html())
        start = np.array(browser.nodes["/target"]["position"])
        await browser.drag("start")
        for k in range(12):
            await browser.drag("update", start - np.array([0.0, 0.0, 0.004 * k]))
            await asyncio.sleep(0.05)
        await browser.drag("end")
        await browser.until(lambda: rows_of(browser.html()) and rows_of(browser.html())[0][3] != before[0][3])
        now = rows_of(browser.html())
        assert [row[1] for row in now] == [row[1] for row in before]
        assert np.abs(np.array(now[0][3]) - before[0][3]).max() < 20.0
        await browser.press(f"go{off[0][1]}")
        await browser.until(lambda: re.search('role="alert">[^<]*out of limits', browser.html()) is not None)
        await browser.close()

    run(main())


def test_ghosts_come_with_the_page_or_the_switch_and_stand_at_the_target(url):
    async def main():
        browser = await student(url, path="/robot/elbow_3r")
        messages = []
        browser.on_message = lambda message, at: messages.append(message)

        def made(layer):
            return [
                m for m in messages if m["type"] == "BatchedMeshesMessage" and m["name"].endswith(f"/{layer}/sticks")
            ]

        await browser.open("solutions")
        await browser.until(lambda: bool(made("solutions_page")))
        await browser.until(lambda: any(m["type"] == "MeshMessage" and m["name"].endswith("ghost") for m in messages))
        await browser.open("joints", "picture")
        assert not made("solutions")
        await browser.press("ghosts")
        await browser.until(lambda: bool(made("solutions")))
        await browser.close()

    run(main())


def test_the_self_motion_has_a_slider_and_the_proof_is_shown(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("solutions")
        await listed(browser, 2)
        await browser.press("prove")
        await browser.until(lambda: "the same 2 solutions, no other." in browser.html())
        await browser.press("2R, centre")
        await browser.until(lambda: "Infinitely many" in browser.html())
        await browser.until(lambda: browser.control("along %")["props"]["visible"])
        await browser.open("joints", "solutions")
        before = browser.slider(1)["value"]
        await browser.set_value(browser.control("along %"), 75.0)
        await browser.until(lambda: abs(browser.slider(1)["value"] - before) > 5.0)
        assert browser.slider(2)["value"] == pytest.approx(180.0, abs=0.06)
        await browser.close()

    run(main())


@pytest.mark.parametrize("key", ["ur10e", "puma560", "panda", "scara", "polar_rrp", "planar_2r"])
def test_the_sticks_go_along_the_table_to_the_tool(key, rng):
    arm = catalogue()[key].arm
    q = rng.uniform(arm.limits[:, 0], arm.limits[:, 1], (5, arm.n))
    corners = corners_of(arm, q)
    np.testing.assert_allclose(corners[:, -1], arm.position(q), atol=1e-12)
    np.testing.assert_allclose(corners[:, 0:-1:2], arm.frames(q)[:, :, :3, 3], atol=1e-12)
    way = np.diff(corners, axis=1)
    lengths = np.linalg.norm(way, axis=2)
    drawn = drawn_sticks(arm, 1e-9)
    assert np.all(lengths[:, ~drawn] < 1e-12)
    fixed = [abs(row.a) for row in arm.rows]
    along_x = lengths[:, 1:-1:2] if arm.convention == "standard" else lengths[:, 0:-1:2]
    np.testing.assert_allclose(along_x, np.tile(fixed, (5, 1)), atol=1e-12)


def test_sticks_are_turned_from_z_to_where_they_go(rng):
    directions = rng.normal(size=(50, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    directions = np.vstack([directions, [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1e-7, 0.0, -1.0]]])
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    for wxyz, direction in zip(turns_to(directions), directions, strict=True):
        np.testing.assert_allclose(rotation_from_quaternion(wxyz)[:, 2], direction, atol=1e-6)


def test_numbers_of_ghosts_are_short_and_stand_where_they_differ():
    assert ranges([1, 2, 3, 5, 8, 9]) == "1–3, 5, 8, 9"
    assert ranges([4]) == "4"
    arm = catalogue()["planar_2r"].arm
    corners = corners_of(arm, np.radians([[0.0, 90.0], [90.0, -90.0]]))
    np.testing.assert_allclose(bends(corners[:1], corners[1]), [[1.0, 0.0, 0.0]], atol=1e-12)


def test_words_about_a_drag_are_in_both_verdicts():
    state = State.initial(catalogue()["planar_2r"])
    target = state[Target]
    said = Said("the elbow has changed from up to down", 0.0)
    state = state.replace(type(target)(state[Joints].tool_pose, crossing=said, near=Said("near <b>", 0.0)))
    units = Units(Notation())
    for text in (verdict_card(verdict(state), units), verdict_line(verdict(state), units)):
        assert "he elbow has changed from up to down" in text
        assert "ear &lt;b&gt;" in text
    assert math.isfinite(verdict(state).position_error)


def test_the_list_is_one_stop_of_the_tab_key_at_the_present_solution(url):
    async def main():
        browser = await student(url, path="/robot/ur10_notes")
        await browser.press("eight")
        await browser.open("solutions")
        rows = await listed(browser, 8)
        for slot in (rows[2][1], rows[5][1]):
            await browser.press(f"go{slot}")
            await browser.until(lambda slot=slot: stops(browser.html()) == [slot])
            selected = re.findall(r'data-place="(\d+)" role="row" aria-selected="true"', browser.html())
            assert [rows[int(place) - 1][1] for place in selected] == [slot]
        await browser.close()

    run(main())


def stops(html):
    """Return the slots of the rows that the tab key reaches."""
    return [int(slot) for slot in re.findall(r'data-cell="go(\d+)"[^>]*tabindex="0"', html)]
