"""Whose message is next: a flood of one browser leaves most of the time to the others."""

import asyncio
import json
from types import SimpleNamespace

import pytest
from viser import _messages

from armlab.ui import adapter, turns
from armlab.ui.fields import Fields
from armlab.ui.manners import Manners
from armlab.ui.turns import SHARE, SPARE, Turns
from support.bare import Bare
from support.fake_browser import CAMERA
from support.patience import Patience
from support.student import run


@pytest.fixture
def bare():
    started = Bare()
    yield started
    started.stop()


def test_who_uses_more_than_a_share_waits_and_who_was_quiet_has_some_to_spare():
    now = used = 0.0
    one = Turns(lambda: now, lambda: used)

    def message(seconds):
        nonlocal used
        one.begin()
        used += seconds
        one.end()

    message(SPARE)
    assert one.pause == 0.0
    message(0.03)
    assert one.pause == pytest.approx(0.03 / SHARE)
    now += 0.03 / SHARE
    assert one.pause == pytest.approx(0.0)
    now += 1000.0
    message(2.0 * SPARE)
    assert one.pause == pytest.approx(SPARE / SHARE), "no more is saved up than that"


def test_time_is_dearer_for_whoever_has_bad_manners():
    now = used = 0.0
    one = Turns(lambda: now, lambda: used, lambda: 10.0)
    one.begin()
    used += 0.1 * SPARE + 0.003
    one.end()
    assert one.pause == pytest.approx(0.03 / SHARE)


def test_who_has_gone_waits_for_no_turn():
    async def main():
        one, gone = Turns(used=lambda: used[0]), []
        one.begin()
        used[0] += SPARE + 100.0 * SHARE  # a hundred seconds to wait
        one.end()
        loop = asyncio.get_running_loop()
        loop.call_later(0.1, gone.append, True)
        began = loop.time()
        assert await one.next(sent, lambda: bool(gone)) == b"the end"
        assert 0.1 <= loop.time() - began < 50.0

    async def sent():
        return b"the end"

    used = [0.0]
    run(main())


def test_many_messages_sent_together_are_looked_at_one_a_turn_of_the_loop(bare):
    async def work(browser, do):
        fields = await do(lambda: Fields(bare.client.gui, lambda cell, _: heard.append((cell, rounds[0]))))
        await browser.until(lambda: fields.channel_id in browser.controls)

        def count():
            rounds[0] += 1
            if len(heard) < MANY:
                asyncio.get_running_loop().call_soon(count)

        await do(count)
        for k in range(MANY):
            value = json.dumps([str(k), "", k])
            await browser.send({"type": "GuiUpdateMessage", "uuid": fields.channel_id, "updates": {"value": value}})
        patience = Patience()
        while len(heard) < MANY and patience.left():
            await asyncio.sleep(0.01)

    MANY, heard, rounds = 60, [], [0]
    bare.run(work)
    assert [cell for cell, _ in heard] == [str(k) for k in range(MANY)]
    assert len({at for _, at in heard}) == MANY


def test_a_browser_that_has_used_up_its_share_is_heard_again_later_and_in_order(bare, monkeypatch):
    async def work(browser, do):
        fields = await do(lambda: Fields(bare.client.gui, lambda cell, _: heard.append(cell)))
        await browser.until(lambda: fields.channel_id in browser.controls)
        monkeypatch.setattr(Turns, "pause", property(lambda one: waited.append(pause(one)) or waited[-1]))
        for k in range(30):
            await browser.send(CAMERA)
            value = json.dumps([str(k), "9" * 10_000, k])
            await browser.send({"type": "GuiUpdateMessage", "uuid": fields.channel_id, "updates": {"value": value}})
        patience = Patience()
        while len(heard) < 30 and patience.left():
            await asyncio.sleep(0.01)

    pause, waited, heard = Turns.pause.fget, [], []
    monkeypatch.setattr(turns, "SPARE", 1e-5)
    bare.run(work)
    assert heard == [str(k) for k in range(30)]
    assert max(waited) > 0.0


def test_a_socket_that_sent_nonsense_before_much_else_is_let_go_of_soon(bare):
    async def work(browser, do):
        live = bare.server._websock_server._live_connections
        await browser.send_raw(b"\xc1 is no message")
        for _ in range(200):
            await browser.send_raw(b"x" * 10_000)
        patience = Patience()
        while live and patience.left():
            await asyncio.sleep(0.01)
        assert not live

    bare.run(work)


def test_building_a_page_is_not_what_its_browser_has_taken(monkeypatch):
    """The first message of the camera waits until the page is built, in the time of all."""
    now = used = 0.0
    turns_of = {"token": Turns(lambda: now, lambda: used)}

    async def handle(_client, _message):
        nonlocal used
        used += 2.0 * SPARE

    async def receive():
        return b""

    headers = {adapter.TOKEN_HEADER: "token", adapter.ADDRESS_HEADER: "10.0.0.1"}
    socket = SimpleNamespace(request=SimpleNamespace(headers=headers), recv=receive)
    server = SimpleNamespace(_websock_server=SimpleNamespace(_live_connections={7: socket}), _connected_clients={})
    monkeypatch.setattr(adapter, "send_at_once", lambda _buffer: None)
    connection = SimpleNamespace(client_id=7, _handle_incoming_message=handle, get_message_buffer=lambda: None)
    adapter._guard(server, connection, turns_of, Manners())
    camera = {name: value for name, value in CAMERA.items() if name != "type"}
    run(connection._handle_incoming_message(7, _messages.ViewerCameraMessage(**camera)))
    assert turns_of["token"].pause == 0.0
    run(connection._handle_incoming_message(7, _messages.GuiUpdateMessage("none", {"value": 1})))
    assert turns_of["token"].pause > 0.0
