"""What the other browser tests rest on: a page's rest ends when the answer is there, however late, and not before."""

import asyncio
import threading
import time

import pytest

from armlab.session.session import Session
from armlab.ui.pace import Pace
from armlab.ui.spread import Spread
from armlab.window.pieces import Pieces
from support import at_rest

pytestmark = pytest.mark.browser

LATE = 2.0
"""Seconds; longer than a page that says nothing was ever waited for."""

ON_THE_WAY = 0.2
"""Seconds; less than a page has to be the same before it counts as answered."""


@pytest.fixture
def slow(monkeypatch):
    """Let every command take its time, while this is set."""
    apply, is_slow = Session.apply, threading.Event()

    def slowly(session, command, *more):
        if is_slow.is_set():
            time.sleep(LATE)
        apply(session, command, *more)

    monkeypatch.setattr(Session, "apply", slowly)
    return is_slow


@pytest.fixture
def held_up(monkeypatch):
    """Let every message to a page be long on its way, as where the machine is busy."""
    send = at_rest._send

    async def send_late(*arguments, **options):
        await asyncio.sleep(ON_THE_WAY)
        await send(*arguments, **options)

    monkeypatch.setattr(at_rest, "_send", send_late)


@pytest.fixture
def put_off(monkeypatch):
    """Let the pieces of a page wait for their turn until this time, as where others have much to be shown."""
    go_on, until = Spread._go_on, [0.0]

    def late(spread, with_last):
        for key in [each for each in spread._waiting if not isinstance(each, Pieces)]:
            spread._waiting.pop(key)()
        if time.monotonic() > until[0]:
            go_on(spread, with_last)

    monkeypatch.setattr(Spread, "_go_on", late)
    monkeypatch.setattr(Pace, "browsers", property(lambda _: 2, lambda *_: None), raising=False)
    return until


def test_what_has_its_turn_late_is_waited_for(visit, put_off):
    lab = visit("robot/panda")
    lab.open_tab("Robot")
    put_off[0] = time.monotonic() + LATE
    lab.press("trainer")
    assert lab.says("Not for this arm")
    assert time.monotonic() > put_off[0]


@pytest.mark.usefixtures("held_up")
def test_an_answer_that_is_on_its_way_is_waited_for(visit, slow):
    test_an_answer_that_comes_late_is_waited_for(visit, slow)


def test_an_answer_that_comes_late_is_waited_for(visit, slow):
    lab = visit("robot/planar_2r")
    _waits_for_what_the_page_itself_does_later(lab)
    before = lab.slider_value(1)
    slow.set()
    lab.page.get_by_role("button", name="Right angle").click()
    lab.rest()
    slow.clear()
    assert lab.slider_value(1) != before


def _waits_for_what_the_page_itself_does_later(lab):
    lab.page.evaluate("() => { setTimeout(() => { window.done = true; }, 450); }")
    lab.rest()
    assert lab.page.evaluate("() => window.done")
