"""All and single solutions against a judge, who tries to refute what is claimed of 20,000 arms and poses."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import islice

import numpy as np

from armlab.kin import ik
from judging.arms import at_limits, inside, robots
from judging.cases import CLASSES, Case, limited_arm
from judging.charges import KINDS, Charge, charges
from judging.one import STARTS, by_least_squares, judged
from rounds import sized

TITLE = "Inverse kinematics against a judge: false claims about all solutions, and poses without one"
SEED = 11
FEW, MANY, EVERY = sized((256, 2000, 10), (16, 32, 10))
"""Random starts of the judge's search for what a list does not have, and of every tenth case."""

SAID = ("complete", "none", "at least", "infinite")
POSES, SPECIAL, LIMITED = 2500, 250, 800
"""For single solutions: poses of each robot anywhere inside the limits, those with joints at a limit or at zero, and
random arms of seven to twelve joints with limits."""

LEGEND = """\
From "false none" on, the columns count answers that were refuted so. Only "q not found" is no refutation: a list
that says "at least" and lacks the joint values the pose was made from. What is missing was found by the judge and
verified to rounding; a close one is within 0.01 rad of a listed one."""

SHOWN = 3
"""Refuted claims that are shown of each class."""


@dataclass
class Score:
    """What was said and refuted in a class; ``against`` has each case with what there is against its answer."""

    said: Counter[str] = field(default_factory=Counter)
    kinds: Counter[str] = field(default_factory=Counter)
    seconds: list[float] = field(default_factory=list)
    against: list[tuple[Case, str, list[Charge]]] = field(default_factory=list)


def measure(share: float | None = None, seed: int = SEED) -> Iterator[str]:
    """Yield the tables, from a share of the cases, but at least one of each class and of each robot."""
    share = sized(1.0, 0.0) if share is None else share
    yield LEGEND
    yield ""
    yield from all_solutions(share, seed)
    yield ""
    yield from single_solutions(share, seed)


def all_solutions(share: float, seed: int) -> Iterator[str]:
    """Yield the table of `armlab.kin.ik.solve_all`."""
    head = ["arms and poses", "cases", *SAID, *KINDS, "median", "largest"]
    yield f"| {' | '.join(head)} |"
    yield f"| {' | '.join('---' for _ in head)} |"
    whole, shown = Score(), []
    for title in CLASSES:
        score = judged_class(title, share, seed)
        yield line(title, score)
        whole.said += score.said
        whole.kinds += score.kinds
        whole.seconds += score.seconds
        shown += [told(*one) for one in score.against[:SHOWN]]
    yield line("all", whole)
    yield ""
    yield "| refuted | joint values the pose was made from | said | what is true |"
    yield "| --- | --- | --- | --- |"
    yield from shown or ["| nothing | – | – | – |"]


def cases(title: str, share: float, seed: int = SEED) -> Iterator[Case]:
    """Return a share of the cases of a class, at least one."""
    make, count = CLASSES[title]
    return islice(make(np.random.default_rng([seed, list(CLASSES).index(title), 0])), part_of(count, share))


def judged_class(title: str, share: float, seed: int) -> Score:
    """Solve and judge a share of the cases of a class, at least one."""
    search = np.random.default_rng([seed, list(CLASSES).index(title), 1])
    score = Score()
    for k, case in enumerate(cases(title, share, seed)):
        start = time.process_time()
        found = ik.solve_all(case.arm, case.T)
        score.seconds.append(time.process_time() - start)
        score.said[found.completeness] += 1
        against = charges(case, found, FEW if k % EVERY else MANY, search)
        score.kinds.update({charge.kind for charge in against})
        if any(charge.kind != "q not found" for charge in against):
            score.against.append((case, found.sentence, against))
    return score


def line(title: str, score: Score) -> str:
    """Return a row of the table."""
    count, milliseconds = len(score.seconds), 1e3 * np.array(score.seconds)
    said = [f"{100 * score.said[key] / count:.1f} %" for key in SAID]
    kinds = [str(score.kinds[kind]) for kind in KINDS]
    times = [f"{np.median(milliseconds):.1f} ms", f"{milliseconds.max():.0f} ms"]
    return f"| {' | '.join([title, str(count), *said, *kinds, *times])} |"


def told(case: Case, sentence: str, against: list[Charge]) -> str:
    """Return a row of the table of what was said and what proves that it is wrong."""
    proofs = "; ".join(f"{charge.kind}: {charge.proof}" for charge in against[:2])
    return f"| {case.label} | {case.q.tolist()} | {sentence} | {proofs} |"


def single_solutions(share: float, seed: int) -> Iterator[str]:
    """Yield the table of `armlab.kin.ik.solve`."""
    yield f"| arms | solved | false claims | of the others SciPy solves within {STARTS} starts | median | largest |"
    yield "| --- | --- | --- | --- | --- | --- |"
    for key, arm in robots().items():
        rng = np.random.default_rng([seed, 0])
        yield single(key, ((arm, inside(arm, rng)) for _ in range(part_of(POSES, share))), seed)
    rng = np.random.default_rng([seed, 1])
    special = ((arm, at_limits(arm, rng)) for arm in robots().values() for _ in range(part_of(SPECIAL, share)))
    yield single("all of them, some joints at a limit or zero", special, seed)
    arms = (limited_arm(rng) for _ in range(part_of(LIMITED, share)))
    yield single("7 to 12 joints with limits", ((arm, inside(arm, rng)) for arm in arms), seed)


def part_of(count: int, share: float) -> int:
    """Return a share of a number, at least one."""
    return max(1, round(share * count))


def single(title: str, poses: Iterator[tuple], seed: int) -> str:
    """Solve for the poses of joint values inside the limits and return a row of the table."""
    seconds, solved, wrong, others = [], 0, 0, []
    for k, (arm, q) in enumerate(poses):
        T = np.asarray(arm.fk(q))
        start = time.process_time()
        found = ik.solve(arm, T, seed=k)
        seconds.append(time.process_time() - start)
        one = judged(arm, q, found)
        solved += one.solved
        wrong += bool(one.wrong)
        if not one.solved:
            others.append(by_least_squares(arm, T, np.random.default_rng([seed, k])) is not None)
    milliseconds = 1e3 * np.array(seconds)
    share = f"{solved} of {len(seconds)}, {100 * solved / len(seconds):.2f} %"
    times = f"{np.median(milliseconds):.2f} ms | {milliseconds.max():.0f} ms"
    return f"| {title} | {share} | {wrong} | {sum(others)} of {len(others)} | {times} |"
