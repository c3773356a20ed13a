"""Other pages are shown at once, however many a person opens; whoever turns them without end waits for the others."""

import asyncio
import re
import time

from armlab.ui.manners import DEAR
from armlab.ui.pace import TURNING, TURNING_SAVED_UP, Pace
from armlab.ui.spread import Spread
from armlab.window import turning
from armlab.window.pieces import PIECE
from armlab.window.turning import LONGEST, SAVED_UP, SHARE, Turning
from support.lab import running_lab
from support.student import run, student

SELECTED = re.compile(r'data-cell="film"[^>]*aria-selected="true"')

PAGE = 0.01
"""Seconds that a page takes here."""


class Reader:
    """Turns pages, each of which takes the same time of a clock of its own."""

    def __init__(self, browsers, beside=None):
        self.now, self.shown, self.again = 0.0, 0, 0
        self.pace = Pace(busy=lambda: 0.0) if beside is None else beside.pace
        self.pace.browsers = browsers
        self.turning = Turning(self.pace, self.come, "token", lambda: self.now)

    def show(self):
        self.shown += 1
        self.now += PAGE
        yield

    def come(self):
        self.again += 1
        self.turning(self.show, True)

    def turn(self, count, turned=True):
        for _ in range(count):
            self.turning(self.show, turned)

    def turn_at_once(self, count):
        """Turn pages in one turn of the loop, which has time for all of them on a slow machine, too."""
        self.pace.spread = Spread(clock=lambda: 0.0)
        self.turn(count)


def test_many_pages_in_a_row_are_shown_and_then_one_waits_until_its_time():
    async def main():
        reader = Reader(browsers=2)
        many = round(SAVED_UP / PAGE)
        reader.turn_at_once(many)
        assert reader.shown == many
        reader.turn(30)
        shown = reader.shown
        assert many <= shown < many + 30
        began = time.monotonic()
        while not reader.again:
            await asyncio.sleep(0.01)
        assert time.monotonic() - began > 0.5 * PAGE / SHARE
        assert reader.shown == shown + 1
        reader.turning.stop()

    run(main())


def test_who_has_bad_manners_turns_few_pages_and_waits_long_for_the_next():
    async def main():
        reader = Reader(browsers=2)
        for _ in range(10):
            reader.pace.manners.note("token", "10.0.0.1")
        while reader.turning._wait() == 0.0:
            reader.turn(1)
            await asyncio.sleep(0.0)  # what is shown to such a one comes last, and one page each time
        assert reader.shown <= round(SAVED_UP / PAGE / DEAR) + 1
        assert 0.5 * LONGEST < reader.turning._wait() <= LONGEST
        reader.turning.stop()

    run(main())


def test_what_is_shown_on_the_same_page_costs_nothing_and_waits_with_it():
    async def main():
        reader = Reader(browsers=2)
        reader.turn(1000, turned=False)
        reader.turn(1000)
        assert reader.shown < 1000 + 2 * SAVED_UP / PAGE
        before = reader.shown
        reader.turn(1, turned=False)
        assert reader.shown == before
        reader.turning.stop()
        await asyncio.sleep(1.5 * PAGE / SHARE)
        assert reader.again == 0

    run(main())


def test_strangers_who_come_as_somebody_new_again_and_again_get_no_more_together_than_a_class():
    async def main():
        first = Reader(browsers=50)
        readers = [first, *(Reader(browsers=50, beside=first) for _ in range(30))]
        for reader in readers:
            reader.turn_at_once(20)
        together = round(TURNING_SAVED_UP / PAGE)
        assert together <= sum(reader.shown for reader in readers) <= together + 2
        late = readers[-1]
        assert late.shown == 0
        began = time.monotonic()
        while not late.again:
            await asyncio.sleep(0.01)
        assert time.monotonic() - began > 0.5 * PAGE / TURNING
        assert late.shown == 1, "nobody waits more than once for all the others"
        for reader in readers:
            reader.turning.stop()

    run(main())


def test_nobody_waits_where_there_is_nobody_else_and_what_fails_counts(caplog):
    async def main():
        reader = Reader(browsers=1)
        reader.turn(1000)
        reader.pace.browsers = 2
        reader.turn(1)
        assert reader.shown == 1001, "what was shown before is not paid back"

        def fail():
            reader.now += 10.0
            yield
            raise ValueError("it fails")

        reader = Reader(browsers=2)
        reader.turning(fail, True)
        assert [str(record.exc_info[1]) for record in caplog.records] == ["it fails"]
        reader.turn(1)
        assert reader.shown == 0
        began = time.monotonic()
        while not reader.again:
            assert time.monotonic() - began < 30.0 * LONGEST, "nobody waits for as long as a slow page was slow"
            await asyncio.sleep(0.01)
        reader.turning.stop()

    run(main())


def test_a_page_is_shown_in_pieces_and_what_comes_meanwhile_after_it():
    async def main():
        reader, other, said = Reader(browsers=2), [], []

        def steps():
            for k in range(5):
                time.sleep(2.0 * PIECE)
                said.append(k)
                reader.pace.spread.put("other", lambda: other.append(len(said)))
                yield

        reader.turning(steps, True)
        assert said == [0]
        reader.turning(steps, False)
        while not reader.again:
            await asyncio.sleep(0.001)
        assert said == [0, 1, 2, 3, 4]
        assert other == [1, 2, 3, 4, 5]
        assert reader.shown == 1, "the last state once more, since it was another one in between"
        reader.turning.stop()

    run(main())


def test_what_comes_while_a_page_fails_is_shown_after_it(caplog):
    async def main():
        reader = Reader(browsers=2)

        def failing():
            time.sleep(2.0 * PIECE)
            yield
            raise ValueError("it fails")

        reader.turning(failing, True)
        assert reader.turning.busy
        reader.turning(failing, False)
        while not reader.again:
            await asyncio.sleep(0.001)
        assert not reader.turning.busy
        assert [str(record.exc_info[1]) for record in caplog.records] == ["it fails"]
        reader.turning.stop()

    run(main())


def test_a_page_that_goes_leaves_the_rest_of_its_pieces(caplog):
    async def main():
        reader, said = Reader(browsers=2), []

        def steps(closes):
            try:
                for k in range(5):
                    time.sleep(2.0 * PIECE)
                    said.append(k)
                    if k == closes:
                        reader.turning.stop()
                    yield
            finally:
                said.append("end")

        reader.turning(lambda: steps(2), True)
        while "end" not in said:
            await asyncio.sleep(0.001)
        assert said == [0, 1, 2, "end"]
        said.clear()
        reader = Reader(browsers=2)
        reader.turning(lambda: steps(None), True)
        reader.turning.stop()
        await asyncio.sleep(0.02)
        assert said == [0, "end"]
        assert not caplog.records

    run(main())


def test_who_turns_without_end_sees_the_last_page_and_others_notice_nothing(monkeypatch):
    """The loop's time that is saved up is small here; a page takes more than none."""
    monkeypatch.setattr(turning, "SAVED_UP", 0.0)
    waits, wait = [], Turning._wait
    monkeypatch.setattr(Turning, "_wait", lambda self: waits.append(wait(self)) or waits[-1])

    async def main(url):
        greedy, other = await student(url), await student(url)
        await greedy.open("table")
        channel = greedy.channel("film")
        for key in ["film", "table"] * 30 + ["film"]:
            await greedy.press_on(channel, key)
        await other.open("film")
        assert SELECTED.search(other.html())
        assert max(waits) > 0.0
        await greedy.until(lambda: SELECTED.search(greedy.html()) is not None)
        await greedy.close()
        await other.close()

    with running_lab() as url:
        run(main(url))
