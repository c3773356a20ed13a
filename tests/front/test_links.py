"""What links bring: arms, lessons, shared states."""

import asyncio
import re
import urllib.request
from urllib.parse import urlsplit

import pytest

from armlab.content.robots import catalogue
from armlab.errors import UnknownName
from armlab.front.wishes import refused
from armlab.session.bench import benches, page_of, robot_of
from armlab.session.example_links import LookAt
from armlab.session.pages import pages
from armlab.session.panel_commands import OpenPanel
from armlab.session.parts.joints import MoveJoint
from armlab.session.parts.panels import Panels
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.session import Session
from armlab.session.share import from_short, short
from armlab.session.state import State, apply
from armlab.teaching.errata_links import LookUp
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.parts.shelf import BackToLesson, OpenShared, ToSandbox
from armlab.ui.speech import speech_in
from armlab.window.wished import panel_of, wished
from support.done import done
from support.fake_browser import cookie_of
from support.lab import running_lab
from support.student import arm_nodes, run, student

PUMA = catalogue()["puma560"]
SHARED = short(apply(State.initial(catalogue()["scara"]), MoveJoint(0, 0.5)))


@pytest.fixture(scope="module")
def url():
    with running_lab() as address:
        yield address


def load(url, cookie, path):
    """Load the page, as a browser does that follows a link or reloads."""
    urllib.request.urlopen(urllib.request.Request(url + path, headers={"Cookie": cookie})).close()


async def follow(url, cookie, path):
    load(url, cookie, path)
    return await student(url, cookie, f"/{path}")


# -- what a link asks of a state ---------------------------------------------------------------------------------


def test_a_wish_that_is_granted_asks_for_nothing():
    fresh = State.initial(PUMA)
    lesson = done(fresh, OpenLesson("first_arm"))
    shared = done(fresh, OpenShared(SHARED), MoveJoint(0, 0.1))
    moved = done(fresh, MoveJoint(0, 0.1))
    for state, wish in (
        (fresh, ""),
        (fresh, "robot/puma560"),
        (lesson, "lesson/first_arm"),
        (shared, f"state/{SHARED}"),
        (moved, f"state/{short(moved)}"),
    ):
        assert wished(state, wish) is None, wish


def test_a_wish_becomes_a_command():
    fresh = State.initial(PUMA)
    assert wished(fresh, "robot/scara") == ChooseRobot("scara")
    assert wished(fresh, "lesson/first_arm") == OpenLesson("first_arm")
    assert wished(fresh, "lesson/first_arm/0012") == OpenLesson("first_arm", variant=12)
    assert wished(fresh, "erratum/5.58") == LookUp("5.58")
    assert wished(fresh, "page/section") == OpenPanel("section")
    assert wished(fresh, "example/laws/triangle") == LookAt("laws/triangle")
    assert wished(fresh, f"state/{SHARED}") == OpenShared(SHARED)
    assert wished(fresh, "nothing/of/ours") is None


def test_a_link_to_an_example_puts_it_in_place_and_opens_its_page():
    state = done(State.initial(PUMA), LookAt("iterations/stretched"))
    assert state[RobotPart].robot.key == robot_of("iterations/stretched") == "planar_2r"
    assert state[Panels].last == "iterations"
    with pytest.raises(UnknownName, match="triangle"):
        done(state, LookAt("laws/triangel"))
    assert {page_of(f"{bench.key}/{next(iter(bench.examples))}") for bench in benches().values()} <= set(pages())
    names = [(bench.key, key) for bench in benches().values() for key in bench.examples]
    assert [name for name in names if refused({"name": name[0], "example": name[1]}) is not None] == []


def test_a_link_to_what_is_not_there_names_no_page():
    assert panel_of("erratum/5.58") == "errata"
    assert panel_of("example/laws/triangle") == "laws"
    assert [panel_of(wish) for wish in ("erratum/9.99", "example/laws/triangel", "nothing/of/ours", "")] == [""] * 4


def test_the_link_of_a_lesson_that_waits_leads_back_to_it():
    state = done(State.initial(PUMA), OpenLesson("first_arm"), MoveJoint(0, 0.3), ToSandbox(), OpenShared(SHARED))
    assert wished(state, "lesson/first_arm") == BackToLesson()


@pytest.mark.parametrize(
    ("wish", "says"),
    [
        ("lesson/nope", "There is no lesson 'nope'."),
        ("lesson/frist_arm/3", "There is no lesson 'frist_arm'. Did you mean /lesson/first_arm?"),
        ("page/incremental", "There is no page 'incremental'. Did you mean /page/incremental_encoder?"),
        ("robot/puma", "There is no arm 'puma'. Did you mean /robot/puma560?"),
        ("assignment/speed", "There is no assignment 'speed'. Did you mean /assignment/speeds?"),
        ("erratum/5.999", "There is no erratum '5.999'."),
        ("erratum/a.ARG", "There is no erratum 'a.ARG'. Did you mean one of /erratum/A.arg, /erratum/2.AR?"),
        ("example/laws/triangel", "There is no example 'laws/triangel'. Did you mean "),
    ],
)
def test_a_link_that_leads_nowhere_names_the_nearest_addresses_alone(wish, says):
    session = Session.fresh("one", PUMA)
    session.apply(wished(session.state, wish), 0.0)
    assert session.notice.text.startswith(says)
    assert len(session.notice.text) < 160
    assert session.notice.heading == "Not found"
    assert "There is no" not in speech_in("it").text(session.notice.text)
    assert "Did you" not in speech_in("it").text(session.notice.text)
    assert all(address in speech_in("it").text(session.notice.text) for address in re.findall("/[^ ,?]+", says))


# -- in the page -------------------------------------------------------------------------------------------------


def test_a_shared_state_opens_beside_ones_own_work_and_a_reload_resets_nothing(url):
    async def main():
        cookie = cookie_of(url)
        browser = await student(url, cookie)
        await browser.set_value(browser.slider(1), 30.0)
        await asyncio.sleep(0.3)
        await browser.close()
        browser = await follow(url, cookie, f"state/{SHARED}")
        await browser.until(lambda: "A shared arm" in browser.html())
        await browser.until(lambda: 0 < len(arm_nodes(browser)) < 6)
        await browser.open("joints")
        await browser.until(lambda: browser.slider(1)["value"] == pytest.approx(28.6, abs=0.1))
        await browser.set_value(browser.slider(1), -45.0)
        await asyncio.sleep(0.3)
        await browser.close()
        browser = await follow(url, cookie, f"state/{SHARED}")
        await browser.open("joints")
        assert browser.slider(1)["value"] == -45.0
        await browser.open("share")
        await browser.press("back-mine")
        await browser.until(lambda: len(arm_nodes(browser)) == 6)
        await browser.until(lambda: "Your own work waits" not in browser.html())
        await browser.open("joints")
        await browser.until(lambda: browser.slider(1)["value"] == 30.0)
        assert browser.notices == []
        await browser.close()

    run(main())


def test_a_link_to_an_erratum_opens_its_page(url):
    async def main():
        browser = await follow(url, cookie_of(url), "erratum/5.58")
        await browser.until(lambda: "<h3>Section 5.1.1, after 5.58" in browser.html())
        await browser.close()

    run(main())


@pytest.mark.parametrize(
    ("path", "says"),
    [
        ("state/1AAAA", "copy the whole link again"),
        ("state/9" + SHARED[1:], "another version of the lab"),
        ("state/" + SHARED[:-3], "copy the whole link again"),
        ("lesson/no_such_lesson/3", "There is no lesson 'no_such_lesson'."),
        ("page/incremental", "There is no page 'incremental'. Did you mean /page/incremental_encoder?"),
    ],
)
def test_what_cannot_be_granted_is_said_on_a_page_that_works(url, path, says):
    async def main():
        browser = await follow(url, cookie_of(url), path)
        await browser.until(lambda: any(says in notice for notice in browser.notices))
        await browser.until(lambda: len(arm_nodes(browser)) == 6)
        await browser.close()

    run(main())


def test_a_link_is_made_of_the_address_people_typed(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("share")
        assert "QR code of the link" not in browser.html()
        await browser.press("make-link")
        await browser.until(lambda: f'data-copy="{url}state/1' in browser.html())
        address = browser.html().split('data-copy="', 1)[1].split('"', 1)[0]
        assert f"{len(address)} characters." in browser.html()
        assert "QR code of the link" in browser.html()
        state = from_short(urlsplit(address).path.removeprefix("/state/"))
        assert state.to_json()["robot"] == "planar_2r"
        await browser.open("joints")
        await browser.set_value(browser.slider(1), 10.0)
        await browser.open("share")
        await browser.until(lambda: "as it was before" in browser.html())
        await browser.close()

    run(main())


@pytest.mark.parametrize(("cell", "ending"), [("markdown", ".md"), ("latex", ".tex")])
def test_a_worksheet_is_downloaded(url, cell, ending):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        names = []
        browser.on_message = lambda message, _: names.append(message.get("filename", ""))
        await browser.open("share")
        await browser.press(cell)
        await browser.until(lambda: any(name.endswith(ending) for name in names))
        await browser.close()

    run(main())


def test_the_sandbox_has_its_way_back_to_the_lesson(url):
    async def main():
        browser = await follow(url, cookie_of(url), "lesson/first_arm")
        await browser.open("share")
        assert "back-lesson" not in browser.html()
        await browser.press("lesson-sandbox")
        await browser.until(lambda: "back-lesson" in browser.html())
        await browser.press("back-lesson")
        await browser.until(lambda: "back-lesson" not in browser.html())
        assert 'data-cell="lesson-sandbox"' in browser.html()
        await browser.close()

    run(main())
