"""What is shown to many comes a little each time the loop goes round, and messages are looked at in between."""

import asyncio
import time
from itertools import pairwise

import pytest

from armlab.ui.pace import Pace
from armlab.ui.spread import PIECE, STARVING, Spread
from support.student import run


class Clock:
    """A clock that goes on only where somebody works."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now

    def work(self, seconds):
        self.now += seconds


@pytest.fixture
def clock():
    return Clock()


async def turns_until(done):
    for _ in range(1000):
        if done():
            return
        await asyncio.sleep(0.0)
    raise AssertionError("never")


def test_a_single_call_is_done_at_once(clock):
    async def story():
        done = []
        Spread(clock).put("a", lambda: done.append("a"))
        return list(done)

    assert run(story()) == ["a"]


@pytest.mark.parametrize("each", [0.2 * PIECE, 0.6 * PIECE, 30.0 * PIECE])
def test_ten_calls_are_spread_so_that_each_turn_takes_little_and_a_message_passes_between(clock, each):
    async def story():
        spread, done, of_turn = Spread(clock), [], []

        def call(k):
            clock.work(each)
            done.append(k)

        def message():
            of_turn.append(len(done))
            if len(done) < 10:
                asyncio.get_running_loop().call_soon(message)

        for k in range(10):
            spread.put(k, lambda k=k: call(k))
        message()
        await turns_until(lambda: len(done) == 10)
        assert done == list(range(10))
        return [of_turn[0], *(after - before for before, after in pairwise(of_turn))]

    in_a_turn = run(story())
    # What has begun is done: a turn goes over its time by one call at most.
    assert max(in_a_turn) <= PIECE / each + 1.0
    assert max(in_a_turn) < 10


def test_where_messages_take_long_what_is_shown_gets_as_much_time(clock):
    async def story():
        spread, done, of_turn = Spread(clock), [], []

        def call():
            clock.work(PIECE)
            done.append(len(done))

        def messages():
            of_turn.append(len(done))
            clock.work(10.0 * PIECE)
            if len(done) < 40:
                asyncio.get_running_loop().call_soon(messages)

        for k in range(40):
            spread.put(k, call)
        messages()
        await turns_until(lambda: len(done) == 40)
        return of_turn

    # One at once; then in each turn as many as the messages have taken.
    assert run(story()) == [1, 11, 21, 31, 40]


def test_of_several_with_one_key_the_newest_counts_in_the_place_of_the_first(clock):
    async def story():
        spread, done = Spread(clock), []
        spread.put("long", lambda: clock.work(2.0 * PIECE))
        for key, value in (("a", 1), ("b", 2), ("a", 3)):
            spread.put(key, lambda value=value: done.append(value))
        spread.put("c", lambda: done.append("dropped"))
        spread.drop("c")
        spread.drop("nothing")
        assert done == []
        await turns_until(lambda: len(done) == 2)
        return done

    assert run(story()) == [3, 2]


def test_what_is_put_from_inside_a_call_comes_after_it(clock):
    async def story():
        spread, done = Spread(clock), []

        def outer():
            spread.put("inner", lambda: done.append("inner"))
            done.append("outer")

        spread.put("outer", outer)
        return list(done)

    assert run(story()) == ["outer", "inner"]


class Unforeseen(Exception):
    pass


def test_a_call_that_fails_is_logged_and_keeps_nothing_from_those_behind_it(clock, caplog):
    async def story():
        spread, done = Spread(clock), []

        def fails():
            raise Unforeseen("no")

        spread.put("at once", fails)
        spread.put("long", lambda: clock.work(2.0 * PIECE))
        spread.put("fails", fails)
        spread.put("a", lambda: done.append("a"))
        await turns_until(lambda: done == ["a"])

    run(story())
    assert [(logged.name, str(logged.exc_info[1])) for logged in caplog.records] == 2 * [("armlab.ui.spread", "no")]


def test_whoever_puts_a_call_does_not_do_what_waits_of_others(clock):
    async def story():
        spread, done = Spread(clock), []
        spread.put("long", lambda: clock.work(2.0 * PIECE))
        spread.put("a", lambda: done.append("a"))
        spread._left = PIECE  # the next turn has begun, with another's callback
        spread.put("b", lambda: done.append("b"))
        before = list(done)
        await turns_until(lambda: len(done) == 2)
        return before, done

    assert run(story()) == ([], ["a", "b"])


def test_what_comes_last_waits_for_all_others_and_has_one_call_in_each_turn(clock):
    async def story():
        spread, done, of_turn = Spread(clock), [], []

        def message():
            of_turn.append(list(done))
            if len(done) < 7:
                asyncio.get_running_loop().call_soon(message)

        spread.put("long", lambda: clock.work(2.0 * PIECE))
        for k in range(3):
            spread.put(f"last {k}", lambda k=k: done.append(f"last {k}"), last=True)
        for k in range(3):
            spread.put(f"{k}", lambda k=k: (clock.work(0.6 * PIECE), done.append(k)))
        spread.put("dropped", lambda: done.append("dropped"), last=True)
        spread.drop("dropped")
        spread.put("both", lambda: done.append("never"), last=True)
        spread.put("both", lambda: done.append("both"))
        message()
        await turns_until(lambda: len(done) == 7)
        return done, of_turn

    done, of_turn = run(story())
    assert done == [0, 1, 2, "both", "last 0", "last 1", "last 2"]
    in_turns = [after[len(before) :] for before, after in pairwise(of_turn)]
    assert max(sum(str(one).startswith("last") for one in done) for done in in_turns) == 1


def test_what_comes_last_takes_no_time_of_what_is_put_after_it(clock):
    async def story():
        spread, done = Spread(clock), []
        spread.put("slow", lambda: clock.work(50.0 * PIECE), last=True)
        spread.put("waits", lambda: done.append("waits"), last=True)
        spread.put("a", lambda: done.append("a"))
        before = list(done)
        await turns_until(lambda: len(done) == 2)
        return before, done

    assert run(story()) == (["a"], ["a", "waits"])


def test_what_comes_last_is_called_after_a_while_though_others_never_end(clock):
    async def story():
        spread, done = Spread(clock), []

        def goes_on(k):
            clock.work(0.01)
            spread.put(k + 1, lambda: goes_on(k + 1))

        goes_on(0)
        spread.put("last", lambda: done.append(clock.now), last=True)
        await turns_until(lambda: done)
        spread.drop(next(iter(spread._waiting)))
        return done

    (at,) = run(story())
    assert STARVING < at < STARVING + 0.1


def test_the_pace_puts_whoever_has_bad_manners_last():
    async def story():
        pace, done = Pace(busy=lambda: 0.0), []
        for _ in range(10):
            pace.manners.note("stranger", "10.0.0.1")
        pace.put("student", "long", lambda: time.sleep(2.0 * PIECE))
        pace.put("stranger", 1, lambda: done.append("stranger"))
        pace.put("student", 2, lambda: done.append("student"))
        await turns_until(lambda: len(done) == 2)
        return done

    assert run(story()) == ["student", "stranger"]
