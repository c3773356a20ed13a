"""What a page tells of its screen: dark pages until the person chooses, large labels on a projector; and two triads."""

import json

import numpy as np
import pytest

from armlab.content.lessons import lesson
from armlab.content.robots import catalogue
from armlab.session.parts.display import SYSTEM_DARK, Display, Show
from armlab.session.state import State, apply
from armlab.teaching.lesson_start import set_up
from armlab.ui.camera import HANDLE
from armlab.ui.figure.marks import FRAME_LENGTH
from armlab.ui.switches import DARK
from armlab.window.view import PROJECTED
from support.own_lessons import notes
from support.student import is_on, run, settled, student

START = State.initial(catalogue()["planar_2r"])


def test_the_system_is_followed_until_the_person_chooses():
    asked = apply(START, Show(SYSTEM_DARK, True))
    assert not DARK.on(START)
    assert DARK.on(asked)
    assert not DARK.on(apply(asked, Show("dark", False)))
    chosen = apply(START, Show("dark", True))
    assert DARK.on(apply(chosen, Show(SYSTEM_DARK, False)))


def test_what_the_system_asks_for_is_kept_and_is_no_part_of_a_lesson():
    asked = apply(START, Show(SYSTEM_DARK, True))
    assert DARK.on(set_up(asked, lesson("forward_2r"), 0))
    robot = catalogue()["planar_2r"]
    assert Display.from_json(asked[Display].to_json(), robot).switches[SYSTEM_DARK]
    assert asked[Display].of_screen() == {SYSTEM_DARK: True}


async def tells(browser, text):
    await browser.press_on(notes(browser)["chan"], "screen", text)


def screen(dark=False, still=False, large=False):
    return json.dumps({"dark": dark, "still": still, "large": large})


def themes(browser):
    """Listen to the theme from now on."""
    found = []
    before = browser.on_message

    def note(message, at):
        before(message, at)
        if message["type"] == "ThemeConfigurationMessage":
            found.append(message["dark_mode"])

    browser.on_message = note
    return found


def test_a_page_of_a_dark_system_is_dark_and_a_switch_is_a_choice(url):
    async def main():
        browser = await student(url)
        found = themes(browser)
        await tells(browser, screen(dark=True))
        await browser.until(lambda: found == [True])
        await browser.open("picture")
        await browser.press("dark")
        await browser.until(lambda: found == [True, False])
        await tells(browser, screen(dark=False))
        await tells(browser, screen(dark=True))
        await settled(browser)
        assert found == [True, False]
        await browser.close()

    run(main())


def test_what_a_stranger_tells_of_a_screen_changes_nothing(url):
    async def main():
        browser = await student(url)
        found = themes(browser)
        for text in ("", "dark", "[1, 1, 1]", "{}", '{"dark": true}', "null", "7"):
            await tells(browser, text)
        await settled(browser)
        assert found == []
        await tells(browser, screen(dark=True))
        await browser.until(lambda: found == [True])
        await browser.close()

    run(main())


def node(browser, ending):
    return next((each for name, each in browser.nodes.items() if name.endswith(ending)), None)


def test_labels_grow_on_a_projector_also_those_that_come_later_and_with_another_arm(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await tells(browser, screen(large=True))
        await browser.open("picture")
        await browser.press("frames")
        await browser.until(lambda: node(browser, "/label0") is not None)
        assert node(browser, "/label0")["font_screen_scale"] == pytest.approx(0.85 * PROJECTED)
        await tells(browser, screen())
        await browser.until(lambda: node(browser, "/label0")["font_screen_scale"] == 0.85)
        await tells(browser, screen(large=True))
        await browser.until(lambda: node(browser, "/label0")["font_screen_scale"] > 0.85)
        await browser.open("workspace")
        await browser.press("example", "elbow")  # another arm, with labels of its own
        await browser.until(lambda: node(browser, "/label3") is not None)
        await settled(browser)
        sizes = [each["font_screen_scale"] for each in browser.nodes.values() if "font_screen_scale" in each]
        assert sizes
        assert min(sizes) >= 0.8 * PROJECTED
        await browser.close()

    run(main())


def test_the_frame_of_the_tool_is_smaller_than_the_others_and_the_handle_beside_it_has_a_name(url):
    async def main():
        browser = await student(url, path="/robot/puma560")
        await browser.open("picture")
        assert node(browser, "/target_name") is None
        await browser.press("frames")
        await browser.until(lambda: node(browser, "/target_name") is not None and node(browser, "/frameE") is not None)
        await settled(browser)
        name, target = node(browser, "/target_name"), browser.nodes["/target"]
        assert name["text"] == "target"
        assert node(browser, "/labelE")["text"] == "{E}"
        assert node(browser, "/frameE")["scale"] < 0.7 * node(browser, "/frame1")["scale"]
        away = np.array(name["position"]) - target["position"]
        tip = node(browser, "/frame1")["scale"] / FRAME_LENGTH * HANDLE
        np.testing.assert_allclose(away, [tip, 0.0, 0.0], atol=1e-6)
        await browser.until(lambda: is_on(browser, "frames"))
        await browser.press("frames")
        await browser.until(lambda: not node(browser, "/target_name").get("visible", True))
        await browser.close()

    run(main())
