"""How much of a core the process uses, averaged over a window."""

import threading
import time

import pytest

from armlab.session.load import WINDOW, Load, of_others


class Meter:
    """A number that is read by calling it."""

    def __init__(self):
        self.value = 10.0

    def __call__(self):
        return self.value


def test_the_use_is_that_of_the_last_window():
    used, clock = Meter(), Meter()
    load = Load(used, clock)
    assert load() == 0.0
    clock.value += 0.5 * WINDOW
    used.value += 0.4 * WINDOW
    assert load() == 0.0  # not yet a window
    clock.value += 0.5 * WINDOW
    assert load() == pytest.approx(0.4)
    clock.value += 2.0 * WINDOW
    used.value += 2.0 * WINDOW
    assert load() == pytest.approx(1.0)
    assert load() == pytest.approx(1.0)


def test_the_work_of_the_asking_thread_is_not_of_others():
    seen = []

    def work():
        before, own = of_others(), time.thread_time()
        while time.thread_time() - own < 0.2:
            pass
        seen.append(of_others() - before)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert seen[0] < 0.15
