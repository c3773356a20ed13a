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
SLOW, AGAIN = 0.06, 3
"""From so many seconds on a case is timed so many times in all, each with an arm not seen before; the best counts."""

SHOWN, OUTLIER = 5, 0.1
"""Of each class the slowest are shown, and all that take longer than this many seconds."""

LEGEND = """\
Processor time of one call, the set-up of an arm not seen before included; the best of 3 where it is above 60 ms."""


class Timed(NamedTuple):
    """The seconds a case takes, and what was said of it."""

    seconds: float
    case: Case
    sentence: str


def measure(share: float | None = None, seed: int = SEED) -> Iterator[str]:
    """Yield the tables, from a share of the cases, but at least one of each class."""
    share = sized(1.0, 0.0) if share is None else share
    yield LEGEND
    yield ""
    yield "| arms and poses | cases | median | p99 | largest | above 100 ms |"
    yield "| --- | --- | --- | --- | --- | --- |"
    every: list[Timed] = []
    slowest: list[Timed] = []
    for title in CLASSES:
        found = sorted((timed(case) for case in cases(title, share, seed)), key=lambda one: -one.seconds)
        yield line(title, found)
        every += found
        slowest += [one for k, one in enumerate(found) if k < SHOWN or one.seconds > OUTLIER]
    yield line("all", every)
    yield ""
    yield "| time | arm and pose | joint values the pose was made from | said |"
    yield "| --- | --- | --- | --- |"
    for seconds, case, sentence in sorted(slowest, key=lambda one: -one.seconds):
        if seconds > SLOW or not every:
            yield f"| {1e3 * seconds:.0f} ms | {case.label} | {case.q.tolist()} | {sentence} |"


def timed(case: Case) -> Timed:
    """Solve a case and return how long it took."""
    seconds, found = once(case)
    if seconds > SLOW:
        seconds = min(seconds, *(once(replace(case, arm=replace(case.arm)))[0] for _ in range(AGAIN - 1)))
    return Timed(seconds, case, found.sentence)


def once(case: Case) -> tuple[float, ik.IkSolutions]:
    """Solve a case and return the processor time and the answer."""
    start = time.process_time()
    found = ik.solve_all(case.arm, case.T)
    return time.process_time() - start, found


def line(title: str, found: list[Timed]) -> str:
    """Return a row of the first table."""
    seconds = [one.seconds for one in found]
    times = [f"{1e3 * value:.1f} ms" for value in (np.median(seconds), quantile(seconds, 0.99), max(seconds))]
    return f"| {' | '.join([title, str(len(found)), *times, str(sum(s > OUTLIER for s in seconds))])} |"
