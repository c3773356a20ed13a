"""The view over the wire: what a page does to it is undone when the page is left, and each window has its own."""

import asyncio

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.workspace.cloud import samples
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.eye import TALL, Eye, Z
from support.fake_browser import CAMERA, cookie_of
from support.lab import running_lab
from support.own_lessons import in_lesson, lesson, write
from support.student import run, settled, student

FRONT = 'robot = "elbow_3r"\nq_deg = [10, 60, -60]\npanel = "section"\n'
VIEW = "\n[camera]\nazimuth_deg = 30\nelevation_deg = 40\n"
FROM_THE_SIDE = np.array([0.2, -0.97, 0.1])


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    own = {"plain": lesson(front=FRONT), "viewed": lesson(front=FRONT + VIEW)}
    with running_lab(lessons=write(tmp_path_factory.mktemp("lessons"), **own)) as address:
        yield address


def eye_of(browser):
    """Return where the lab has put the camera of a page."""
    place, look_at = (browser.camera.get(key, CAMERA[key]) for key in ("position", "look_at"))
    return Eye(np.array(place), np.array(look_at), np.array(browser.camera.get("up_direction", Z)))


def is_square(browser):
    """Return whether the eye looks across the vertical axis of the arm, upright."""
    eye = eye_of(browser)
    return abs(eye.back[2]) < 1e-3


async def tells(browser, eye):
    """Tell the lab where a hand has put the camera."""
    place = {"position": eye.position.tolist(), "look_at": eye.look_at.tolist()}
    await browser.send({**CAMERA, **place})


async def at_section(browser):
    await browser.open("section")
    await browser.until(lambda: "To the boundary" in browser.html() and is_square(browser))
    await settled(browser)


def test_after_a_section_the_view_is_what_it_was(url):
    async def main():
        browser = await student(url, path="/robot/elbow_3r")
        await settled(browser)
        hand = Eye(3.0 * FROM_THE_SIDE, np.array([0.1, 0.0, 0.4]), Z)
        await tells(browser, hand)
        await settled(browser)
        await at_section(browser)
        assert not eye_of(browser).near(hand)
        await browser.open("joints")
        await browser.until(lambda: np.abs(eye_of(browser).position - hand.position).max() < 1e-6)
        assert np.abs(eye_of(browser).look_at - hand.look_at).max() < 1e-6
        await browser.close()

    run(main())


def test_a_hand_in_between_keeps_its_view_and_an_undo_moves_no_eye(url):
    async def main():
        browser = await student(url, path="/robot/elbow_3r")
        await at_section(browser)
        before = browser.counts["SetCameraPositionMessage"]
        await tells(browser, Eye(9.0 * FROM_THE_SIDE, np.zeros(3), Z))  # far enough for every pose
        await browser.open("joints")
        await browser.set_value(browser.slider(1), 50.0)
        await settled(browser)
        await browser.press("undo")
        await settled(browser)
        assert browser.counts["SetCameraPositionMessage"] == before
        await browser.close()

    run(main())


def test_two_windows_have_views_of_their_own(url):
    async def main():
        cookie = cookie_of(url)
        one, other = await student(url, cookie, "/robot/elbow_3r"), await student(url, cookie, "/robot/elbow_3r")
        await asyncio.gather(settled(one), settled(other))
        before = other.counts["SetCameraPositionMessage"]
        await at_section(one)
        assert other.counts["SetCameraPositionMessage"] == before
        await one.close()
        await other.close()

    run(main())


@pytest.mark.parametrize(("name", "square"), [("viewed", False), ("plain", True)])
def test_the_view_of_a_lesson_comes_before_what_its_page_wants(url, name, square):
    async def main():
        browser = await in_lesson(url, name)
        await browser.open("section")
        await browser.until(lambda: "To the boundary" in browser.html())
        await settled(browser)
        assert is_square(browser) == square
        if not square:
            x, y, z = eye_of(browser).back
            np.testing.assert_allclose(np.degrees([np.arctan2(y, x), np.arcsin(z)]), [30.0, 40.0], atol=1e-4)
        await browser.close()

    run(main())


def test_the_points_that_a_page_samples_come_into_the_picture(url):
    async def main():
        browser = await student(url, path="/robot/scara")
        await browser.open("workspace")
        await browser.press("count", "26000")
        await browser.press("sample")
        await browser.until(lambda: "26\u202f000</span>" in browser.html())
        await settled(browser)
        assert "26\u202f000 of the first 26\u202f000" in browser.html(), "of a SCARA nothing is cut away"
        points = np.vstack([piece.points for piece in samples(catalogue()["scara"].arm, 26_000, seed=0)])
        aspect = CAMERA["image_width"] / CAMERA["image_height"]
        assert eye_of(browser).sees(points.astype(float), TALL, aspect)
        await browser.close()

    run(main())


def test_the_camera_looks_at_the_arm_that_is_shown_while_the_worker_has_put_another_one_there(open_lab):
    lab = open_lab(opening="puma560")

    async def main():
        browser = await student(f"http://127.0.0.1:{lab.port}/")
        (views,) = lab.lab._of_session.values()
        (view,) = views
        there = view.session.state
        view.session.state = State.initial(catalogue()["scara"])  # as the worker does at any moment
        try:
            assert view.camera._pose() is there[Joints].q
            assert view.camera._arm_is_here
        finally:
            view.session.state = there
        await browser.close()

    run(main())
