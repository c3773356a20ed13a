"""The order in which the tests themselves are run, with the scheduler of pytest-xdist as judge."""

from types import SimpleNamespace

import pytest
from xdist.scheduler import WorkStealingScheduling

from support.order import ordered


class Worker:
    """A worker that keeps what it is given."""

    shutting_down = False

    def __init__(self, name):
        self.gateway = SimpleNamespace(id=name)
        self.given = []

    def send_runtest_some(self, indices):
        self.given += indices

    def send_steal(self, indices):
        """Give nothing back."""

    def shutdown(self):
        self.shutting_down = True


def blocks(items, count):
    """Return the items that xdist gives to each of so many workers at the start."""
    config = SimpleNamespace(getvalue=lambda _: ["popen"] * count)
    scheduling, workers = WorkStealingScheduling(config), [Worker(f"gw{k}") for k in range(count)]
    for worker in workers:
        scheduling.add_node(worker)
        scheduling.add_node_collection(worker, items)
    scheduling.schedule()
    return [[items[k] for k in worker.given] for worker in workers]


def collected(modules, others):
    """Return names as pytest collects them: modules of browser tests, of so many each, in the midst of others."""
    browsers = [f"browser/{m}::{k}" for m, size in enumerate(modules) for k in range(size)]
    plain = [f"plain/{k // 7}::{k}" for k in range(others)]
    return [*plain[: others // 3], *browsers, *plain[others // 3 :]]


def is_first(name):
    return name.startswith("browser/")


def module_of(name):
    return name.partition("::")[0]


@pytest.mark.parametrize("count", [1, 2, 3, 4, 7])
def test_every_worker_begins_with_its_share_of_browsers(count):
    items = collected([3, 9, 1, 4, 12, 2, 2, 6, 1, 5, 3, 8], 1003)
    found = blocks(ordered(items, is_first, module_of, count), count)
    shares = [[name for name in block if is_first(name)] for block in found]
    assert [block[: len(share)] for block, share in zip(found, shares, strict=True)] == shares
    # One module at most lies between the largest share and the least.
    assert max(map(len, shares)) - min(map(len, shares)) <= 12
    homes = [{module_of(name) for name in share} for share in shares]
    assert sum(map(len, homes)) == 12, "no module is opened by two workers"


@pytest.mark.parametrize(("modules", "others"), [([], 50), ([5, 4], 0), ([30, 1], 3), ([], 0), ([1], 1)])
@pytest.mark.parametrize("count", [1, 4])
def test_no_test_is_lost_or_done_twice(modules, others, count):
    items = collected(modules, others)
    found = ordered(items, is_first, module_of, count)
    assert sorted(found) == sorted(items)
    assert [name for name in found if not is_first(name)] == [name for name in items if not is_first(name)]


def test_one_worker_does_all_browsers_first_in_their_order():
    items = collected([2, 3], 10)
    found = ordered(items, is_first, module_of, 1)
    assert found == [name for name in items if is_first(name)] + [name for name in items if not is_first(name)]
