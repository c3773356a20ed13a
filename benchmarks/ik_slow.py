"""How long all solutions take, over the judge's 20,000 arms and poses, without judging them."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from armlab.kin import ik
from ik_judge import SEED, cases
from judging.cases import CLASSES, Case
from rounds import quantile, sized

TITLE = "Inverse kinematics: the time all solutions take, over the judge's 20,000 arms and poses"
LEGEND = """\
Processor time of one call, for random arms with the set-up of one not seen before; the best of 3 where it is above
60 ms."""

SLOW, AGAIN = 0.06, 2
"""From so many seconds on a case is timed so many times again, each time with an arm not seen before."""

OUTLIER, SHOWN = 0.1, 10
"""Cases above so many seconds are shown, and at least so many."""


class Timed(NamedTuple):
    """The seconds a case takes, what it was, and what was said of it."""

    seconds: float
    label: str
    q: list[float]
    sentence: str


def measure(share: float | None = None, seed: int = SEED) -> Iterator[str]:
    """Yield the tables, from a share of the cases, but at least one of each class."""
    share = sized(1.0, 0.0) if share is None else share
    yield LEGEND
    yield ""
    yield "| arms and poses | cases | median | p99 | largest | above 100 ms |"
    yield "| --- | --- | --- | --- | --- | --- |"
    every: list[Timed] = []
    for title in CLASSES:
        found = [timed(case) for case in cases(title, share, seed)]
        yield line(title, found)
        every += found
    yield line("all", every)
    yield ""
    yield "| the slowest | arm and pose | joint values the pose was made from | said |"
    yield "| --- | --- | --- | --- |"
    for k, one in enumerate(sorted(every, reverse=True)):
        if k < SHOWN or one.seconds > OUTLIER:
            yield f"| {1e3 * one.seconds:.0f} ms | {one.label} | {one.q} | {one.sentence} |"


def timed(case: Case) -> Timed:
    """Solve a case and return how long it takes."""
    seconds, found = once(case)
    if seconds > SLOW:
        seconds = min(seconds, *(once(replace(case, arm=replace(case.arm)))[0] for _ in range(AGAIN)))
    return Timed(seconds, case.label, case.q.tolist(), found.sentence)


def once(case: Case) -> tuple[float, ik.IkSolutions]:
    """Solve a case and return the processor time and the answer."""
    start = time.process_time()
    found = ik.solve_all(case.arm, case.T)
    return time.process_time() - start, found


def line(title: str, found: list[Timed]) -> str:
    """Return a row of the first table."""
    seconds = [one.seconds for one in found]
    times = [f"{1e3 * value:.1f} ms" for value in (np.median(seconds), quantile(seconds, 0.99), max(seconds))]
    return f"| {' | '.join([title, str(len(found)), *times, str(sum(value > OUTLIER for value in seconds))])} |"
