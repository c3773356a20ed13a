"""A page that is shown in pieces: what leaves the scene, and what is refreshed meanwhile."""

import asyncio

import pytest

from armlab.session.parts.robot import ChooseRobot
from armlab.window.turning import Turning
from armlab.window.view import LINGER, View
from support.student import run, student


@pytest.fixture
def lab(open_lab):
    return open_lab()


def on_one_page(lab, work):
    """Do asynchronous work with the view of a student; what it calls on the loop is called by `do`."""

    async def main():
        browser = await student(f"http://127.0.0.1:{lab.port}/")
        (view,) = lab.lab._views.values()

        async def do(call):
            async def called():
                return call()

            return await asyncio.wrap_future(asyncio.run_coroutine_threadsafe(called(), lab.lab.loop))

        await work(browser, view, do)
        await browser.close()

    run(main())


def test_the_bodies_of_the_arm_before_stay_until_the_page_has_those_of_the_new_one(lab, monkeypatch):
    """viser holds all messages back while the counter is above zero."""
    later, held = View._later, []

    def noted(view, seconds, call):
        if seconds == LINGER:
            held.append(view.client._websock_connection.get_message_buffer().atomic_counter)
        later(view, seconds, call)

    monkeypatch.setattr(View, "_later", noted)

    async def work(browser, view, do):
        lab.lab.worker.post(view.session, ChooseRobot("planar_2r"))
        old = [name for name in browser.nodes if name.endswith("/arm/1")]
        assert old
        await browser.until(lambda: not any(name in browser.nodes for name in old))

    on_one_page(lab, work)
    assert held == [0]


def test_what_is_to_be_refreshed_while_a_page_is_shown_in_pieces_is_refreshed_after_it(lab, monkeypatch):
    async def work(_browser, view, do):
        said = []
        monkeypatch.setattr(view, "_refreshing", lambda: iter(said.append("refreshed") or ()))
        monkeypatch.setattr(view, "show", lambda: said.append("shown when that has ended"))
        monkeypatch.setattr(Turning, "busy", True)
        await do(view._refresh_now)
        monkeypatch.setattr(Turning, "busy", False)
        await do(view._refresh_now)
        assert said == ["shown when that has ended", "refreshed"]
        assert view._refresh is None

    on_one_page(lab, work)
