"""How surely a pose that can be reached inside the limits is reached, and how long all solutions take at worst."""

import time
from collections.abc import Iterator

import numpy as np
from scipy.optimize import least_squares

from armlab.content.robots import catalogue
from armlab.kin import ik
from armlab.kin.ik.verdict import task_error_of
from rounds import quantile, sized
from support.arms import limited_arm, random_q

TITLE = "Inverse kinematics: reachable poses that are reached, and all solutions with joints to spare"
POSES = sized(2500, 1)
ARMS, POSES_OF_ARM = sized(40, 1), sized(10, 1)
LATTICE = sized(40, 1)
SPARE = ("iiwa7", "canadarm2", "panda", "gen3")
STARTS = 20


def measure() -> Iterator[str]:
    yield f"`solve` without a start, {POSES} poses inside the limits of each robot, its own task:"
    yield ""
    yield "| robot | joints | not reached | median | p99 |"
    yield "| --- | --- | --- | --- | --- |"
    for key in catalogue().found:
        arm, rng = catalogue()[key].arm, np.random.default_rng(11)
        failed, seconds = failures(arm, random_q(arm, rng, POSES))
        median, slow = np.median(seconds) * 1e3, quantile(seconds, 0.99) * 1e3
        yield f"| {key} | {arm.n} | {len(failed)} | {median:.2f} ms | {slow:.1f} ms |"
    yield ""
    yield f"{ARMS} random arms with narrow and wide limits, {POSES_OF_ARM} poses each, SciPy from {STARTS} starts:"
    yield ""
    yield "| joints | poses | not reached | of these by SciPy's bounded least squares |"
    yield "| --- | --- | --- | --- |"
    for n in range(7, 13):
        rng, failed, solved = np.random.default_rng(n), 0, 0
        for _ in range(ARMS):
            arm = limited_arm(rng, n)
            missed, _ = failures(arm, random_q(arm, rng, POSES_OF_ARM))
            failed += len(missed)
            solved += sum(by_scipy(arm, T, rng) for T in missed)
        yield f"| {n} | {ARMS * POSES_OF_ARM} | {failed} | {solved} |"
    yield ""
    yield f"`solve_all`, {LATTICE} poses of multiples of 90, 45 and 30 degrees each, inside the limits or not:"
    yield ""
    yield "| robot | median | slowest | none inside listed, though `solve` finds one |"
    yield "| --- | --- | --- | --- |"
    for key in SPARE:
        yield lattice(key)


def failures(arm, configurations):
    """Return the poses that are not reached, and the seconds of all."""
    missed, seconds = [], []
    for k, q in enumerate(configurations):
        T = arm.fk(q)
        start = time.process_time()
        found = ik.solve(arm, T, seed=k)
        seconds.append(time.process_time() - start)
        if not (found.success and ik.judge(arm, T, found.q).reached):
            missed.append(T)
    return missed, seconds


def by_scipy(arm, T, rng) -> bool:
    task = task_error_of(arm)
    target, (low, high) = task.target(T), arm.limits.T
    for _ in range(STARTS):
        found = least_squares(
            lambda q: task.at(q.tolist(), target)[1], rng.uniform(low, high), bounds=(low, high), xtol=1e-14, gtol=1e-14
        )
        if task.at(found.x.tolist(), target)[2].reached:
            return True
    return False


def lattice(key: str) -> str:
    arm, rng, seconds, wrong = catalogue()[key].arm, np.random.default_rng(5), [], 0
    for step in (90, 45, 30):
        most = 180 // step
        for _ in range(LATTICE):
            T = arm.fk(np.radians(step) * rng.integers(-most, most + 1, arm.n))
            start = time.process_time()
            found = ik.solve_all(arm, T)
            seconds.append(time.process_time() - start)
            wrong += not found.within_limits.any() and ik.solve(arm, T).success
    return f"| {key} | {np.median(seconds) * 1e3:.0f} ms | {max(seconds) * 1e3:.0f} ms | {wrong} |"
