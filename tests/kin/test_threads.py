"""Several threads ask the same arm, which keeps what it has computed: the workers of the lab do so all the time."""

import pickle
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.ik import solve, solve_all
from armlab.kin.velocity import determinant

THREADS = 4
OFTEN = 1e-6
"""Seconds after which another thread goes on: a thousand times as often as usual."""


@pytest.fixture(autouse=True)
def threads_take_turns_often() -> Iterator[None]:
    usual = sys.getswitchinterval()
    sys.setswitchinterval(OFTEN)
    yield
    sys.setswitchinterval(usual)


def all_answers(arm: Arm) -> bytes:
    """Return, to the last bit, what students ask of an arm, of one configuration and of many at once."""
    seeded = np.random.default_rng(5)
    low, high = arm.limits.T
    many = seeded.uniform(low, high, (5000, arm.n))
    q, start = many[0], many[1]
    found = solve(arm, arm.fk(q), start)
    said = [arm.fk(many), arm.frames(many), arm.position(many.astype(np.float32)), arm.jacobian(many)]
    said += [arm.manipulability(many), arm.fk(q), arm.jacobian(q), found.q]
    said += list(solve_all(arm, arm.fk(q)))
    return b"".join(np.asarray(each).tobytes() for each in said) + repr(determinant(arm)).encode()


@pytest.mark.parametrize("key", ["planar_3r", "stanford", "ur5e", "manseur_doty", "panda"])
def test_threads_that_ask_one_arm_together_get_the_answers_of_one_alone(key):
    arm = catalogue()[key].arm
    alone = all_answers(pickle.loads(pickle.dumps(arm)))
    shared, together = pickle.loads(pickle.dumps(arm)), Barrier(THREADS)

    def asked(_: int) -> bytes:
        together.wait()
        return all_answers(shared)

    with ThreadPoolExecutor(THREADS) as pool:
        assert set(pool.map(asked, range(THREADS))) == {alone}
