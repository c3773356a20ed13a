"""What may lag is shown at once while there is time, less often when not, and always once more at the end."""

import asyncio
import time

import pytest

from armlab.ui.pace import MEMORY, SHARE, SLOWEST, Pace, Paced
from support.student import run


class Clock:
    """A clock of our own."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


def idle():
    """The use of a process that does nothing else."""
    return 0.0


def test_the_usual_interval_holds_while_there_is_time(clock):
    pace = Pace(clock, idle)
    pace.timed(lambda: setattr(clock, "now", clock.now + 0.9 * SHARE * MEMORY))
    assert pace.interval(0.0) == 0.0
    assert pace.interval(0.125) == 0.125


def test_more_work_means_longer_intervals_up_to_a_limit_and_rest_forgets(clock):
    pace = Pace(clock, idle)
    intervals = []
    for _ in range(8):
        pace.timed(lambda: setattr(clock, "now", clock.now + 0.3))
        intervals.append(pace.interval(0.125))
    assert intervals == sorted(intervals)
    assert 0.125 < intervals[-1] <= SLOWEST
    clock.now += 5.0 * MEMORY
    assert pace.interval(0.125) == 0.125


@pytest.mark.parametrize(("times", "longer"), [(2.0, 4.0), (3.0, 9.0)])
def test_three_times_the_share_is_shown_a_ninth_as_often(clock, times, longer):
    pace = Pace(clock, idle)
    pace.timed(lambda: setattr(clock, "now", clock.now + times * SHARE * MEMORY))
    assert pace.interval(0.1) == pytest.approx(0.1 * longer, rel=1e-12)


def test_a_busy_process_leaves_less_for_what_may_lag(clock):
    busy = [0.0]
    pace = Pace(clock, lambda: busy[0])
    pace.timed(lambda: setattr(clock, "now", clock.now + 0.9 * SHARE * MEMORY))
    intervals = []
    for busy[0] in (0.5, 0.8, 0.95, 2.0):
        intervals.append(pace.interval(0.0))
    assert intervals[0] == 0.0
    assert 0.0 < intervals[1] < intervals[2] == intervals[3] <= SLOWEST


def test_time_is_counted_also_when_a_call_fails(clock):
    pace = Pace(clock, idle)

    def fail():
        clock.now += 0.8
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        pace.timed(fail)
    assert pace.interval(0.0) > 0.0


def test_a_burst_in_need_is_thinned_out_and_the_last_is_shown():
    class Slow(Pace):
        def interval(self, usual):
            return 0.08

    seen, began = [], time.monotonic()

    async def burst():
        paced = Paced(seen.append, Slow())
        for k in range(50):
            paced(k)
            await asyncio.sleep(0.004)
        await asyncio.sleep(0.2)

    run(burst())
    assert seen[0] == 0
    assert seen[-1] == 49
    assert 2 <= len(seen) <= 2 + (time.monotonic() - began) / 0.08
    assert seen == sorted(seen)


def test_with_time_enough_nothing_is_held_back_and_a_stopped_one_says_nothing_more():
    seen = []

    async def story():
        paced = Paced(seen.append, Pace())
        for k in range(5):
            paced(k)
        paced._pace.interval = lambda usual: 0.05
        paced(5)
        paced.stop()
        await asyncio.sleep(0.1)

    run(story())
    assert seen == [0, 1, 2, 3, 4]
