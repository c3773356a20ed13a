"""Who sends what the lab's page never sends, and who comes from where such a one is."""

import asyncio
import time

import pytest

from armlab.session.saved_up import SavedUpEach
from armlab.ui import adapter
from armlab.ui.adapter import NotAMessage
from armlab.ui.gate import Gate
from armlab.ui.manners import DEAR, FORGIVEN, MOST, SENSELESS, SENSELESS_AT_ADDRESS, Manners
from armlab.ui.pace import BUILDING, SLOWEST, Pace
from support.bare import Bare
from support.fake_browser import cookie_of
from support.patience import Patience
from support.student import run, student

HERE, THERE = "10.0.0.1", "10.0.0.2"


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


def test_a_few_senseless_messages_change_nothing_and_more_are_forgiven_after_a_while(clock):
    manners = Manners(clock)
    for _ in range(int(SENSELESS)):
        manners.note("one", HERE)
    assert manners.price("one") == 1.0
    manners.note("one", HERE)
    assert (manners.price("one"), manners.price("another")) == (DEAR, 1.0)
    clock.now += FORGIVEN
    assert manners.price("one") == 1.0
    for _ in range(100_000):
        manners.note("one", HERE)
    clock.now += 0.99 * SENSELESS * FORGIVEN
    assert manners.price("one") == DEAR
    clock.now += 0.02 * SENSELESS * FORGIVEN
    assert manners.price("one") == 1.0, "after a minute all is forgiven"


def test_who_comes_back_as_somebody_new_has_to_show_manners_and_who_was_there_has_not(clock):
    manners = Manners(clock)
    manners.meet("classmate", HERE)
    for k in range(int(SENSELESS_AT_ADDRESS) + 1):
        manners.note(f"stranger {k}", HERE)
    for name, address in (("classmate", HERE), ("newcomer", HERE), ("far away", THERE)):
        manners.meet(name, address)
    assert [manners.price(name) for name in ("classmate", "newcomer", "far away")] == [1.0, DEAR, 1.0]
    clock.now += 1.01 * FORGIVEN
    assert manners.price("newcomer") == 1.0
    manners.note("newcomer", HERE)
    assert manners.price("newcomer") == DEAR, "nothing is saved up yet"
    clock.now += 1.01 * SENSELESS * FORGIVEN
    manners.meet("much later", HERE)
    assert manners.price("much later") == 1.0


def test_so_many_are_known_and_no_more(clock):
    manners = Manners(clock)
    for k in range(10 * MOST):
        manners.meet(f"{k}", HERE)
        manners.note(f"{k}", f"address {k}")
    assert len(manners._known) == MOST
    assert len(manners._of_browsers._left) == len(manners._of_addresses._left) == SavedUpEach.MOST


def test_pictures_come_less_often_to_a_browser_with_bad_manners():
    pace = Pace(busy=lambda: 0.0)
    for _ in range(10):
        pace.manners.note("stranger", HERE)
    assert pace.interval(0.125, "stranger") == DEAR * pace.interval(0.125, "honest") == DEAR * 0.125
    pace.timed(time.sleep, 0.3)
    assert pace.interval(0.125, "honest") <= SLOWEST < DEAR * 0.125 <= pace.interval(0.125, "stranger")


def test_a_page_is_built_slowly_for_a_browser_with_bad_manners():
    pace = Pace(busy=lambda: 0.0)
    for _ in range(10):
        pace.manners.note("stranger", HERE)
    took = 0.01
    assert took / (took + pace.rest("honest", took)) == pytest.approx(BUILDING)
    assert took / (took + pace.rest("stranger", took)) == pytest.approx(BUILDING / DEAR)


def test_the_panels_of_a_page_come_at_the_pace_of_its_browser(url, monkeypatch):
    asked, interval = set(), Pace.interval

    def noted(pace, usual, browser=""):
        asked.add(browser)
        return interval(pace, usual, browser)

    async def main():
        browser = await student(url)
        monkeypatch.setattr(Pace, "interval", noted)
        await browser.set_value(browser.slider(1), 10.0)
        patience = Patience()
        while not any(asked):
            assert patience.left()
            await asyncio.sleep(0.01)
        await browser.close()

    run(main())


@pytest.mark.parametrize(
    "message", [{"type": "ShareUrlRequest"}, {"type": "GuiUpdateMessage", "uuid": 5, "updates": 7}]
)
def test_nonsense_is_noted(message):
    bare = Bare()

    async def work(browser, _do):
        for _ in range(10):
            await browser.send(message)
        patience = Patience()
        while bare.manners.price("token") == 1.0:
            assert patience.left()
            await asyncio.sleep(0.01)

    try:
        bare.run(work)
    finally:
        bare.stop()


def test_what_cannot_be_read_is_nonsense():
    noted = []
    with pytest.raises(NotAMessage):
        adapter._read(b"\xc1", Gate(lambda: noted.append("nonsense")))
    assert noted == ["nonsense"]


def test_a_hand_that_drags_to_the_horizon_has_no_bad_manners():
    bare = Bare()

    async def work(browser, _do):
        await browser.drag("start")
        for k in range(20):
            await browser.drag("update", (1e8 + k, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
        await browser.drag("update", (0.5, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
        await browser.drag("end")
        patience = Patience()
        while bare.heard != ["start", "update", "end"]:
            assert patience.left()
            await asyncio.sleep(0.01)
        assert bare.manners.price("token") == 1.0

    try:
        bare.run(work)
    finally:
        bare.stop()


def test_the_lab_knows_strangers_by_their_address_and_students_by_themselves(open_lab, tmp_path):
    lab = open_lab(tmp_path)
    url = f"http://127.0.0.1:{lab.port}/"
    price = lab.lab.pace.manners.price

    async def main():
        honest = await student(url, cookie_of(url))
        (token,) = lab.lab._of_session
        stranger = await student(url, cookie_of(url))
        (other,) = lab.lab._of_session.keys() - {token}

        async def rude():
            """Go on for as long as others need to open their pages: it is forgiven after some seconds."""
            while True:
                for _ in range(5):
                    await stranger.send({"type": "ShareUrlRequest"})
                await asyncio.sleep(0.1)

        sending = asyncio.create_task(rude())
        patience = Patience()
        while price(other) == 1.0:
            assert patience.left()
            await asyncio.sleep(0.01)
        await asyncio.sleep(SENSELESS_AT_ADDRESS / 5.0 * 0.1 + 0.2)
        await honest.close()
        again = await student(url, honest.cookie)
        newcomer = asyncio.create_task(student(url, cookie_of(url)))
        patience = Patience()
        # Not once its page is open: a newcomer is forgiven after seconds, in which a slow machine does not open it.
        while {price(new) for new in tuple(lab.lab.pace.manners._known) if new not in (token, other)} != {DEAR}:
            assert patience.left()
            await asyncio.sleep(0.01)
        assert price(token) == 1.0
        newcomer = await newcomer
        sending.cancel()
        await stranger.close()
        assert again.controls.keys()
        assert newcomer.controls.keys()
        await again.close()
        await newcomer.close()

    run(main())


@pytest.mark.parametrize("prices", [[], [DEAR]], ids=["behind strangers", "forgiven meanwhile"])
def test_nobody_waits_for_a_page_that_is_built_slowly_for_its_browsers_manners(open_lab, tmp_path, monkeypatch, prices):
    lab, left = open_lab(tmp_path), list(prices)
    building = lab.lab._building[DEAR]
    monkeypatch.setattr(Manners, "price", lambda self, browser: left.pop() if left else 1.0)

    async def main():
        asyncio.run_coroutine_threadsafe(building.acquire(), lab.lab.loop).result()
        browser = await student(f"http://127.0.0.1:{lab.port}/")
        await browser.close()
        assert building.locked()

    run(main())
