"""Sizes of the workspaces of random arms: whether they lie inside their stated errors, and to which side they err.

    python3 benchmarks volume

takes 200 arms. `measured` does any part of them, with as much effort as one likes.
"""

import statistics
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from armlab.kin.workspace.section_size import Size, size
from armlab.kin.workspace.sections import RESOLUTION, section
from judged_volume import Judged, judged
from random_volumes import KINDS, drawn
from rounds import sized

TITLE = "Volume and area of random arms: stated errors against a judge"
ARMS = sized(200, 2)
EFFORT, CELLS = sized((0.3, RESOLUTION), (0.02, 32))

HARDER, ASKED = sized(6.0, 1.0), sized(3, 2)
"""Times as much effort where the answer is not clear, and how often it is asked for at most."""


class Trial(NamedTuple):
    """An arm, what is said of it, and what the judge says."""

    kind: str
    said: Size
    judge: Judged

    @property
    def stated(self) -> float:
        """The stated error, of the size."""
        return self.said.error / self.judge.value

    @property
    def off(self) -> float:
        """By how much the size is too large, of the size."""
        return self.said.value / self.judge.value - 1.0

    @property
    def unclear(self) -> float:
        """What the judge may be off, of the size."""
        return self.judge.error / self.judge.value

    @property
    def verdict(self) -> str:
        """ "inside", "outside", or "unclear" where the judge is not sure enough of it."""
        if abs(self.off) <= self.stated:
            return "inside"
        return "unclear" if abs(self.off) <= self.stated + self.unclear else "outside"


def measure() -> Iterator[str]:
    yield from table(measured(range(ARMS), EFFORT, CELLS))


def measured(arms: Iterable[int], effort: float = 0.3, resolution: int = RESOLUTION) -> Iterator[Trial]:
    """Yield the trial of each arm: they are of all kinds in turn."""
    kinds = list(KINDS)
    for index in arms:
        kind = kinds[index % len(kinds)]
        found = section(drawn(kind, index // len(kinds)), resolution)
        said = size(found)
        for asked in range(ASKED):
            # Asked again, with points enough to tell: of other points, so that nobody is asked until it fits.
            trial = Trial(kind, said, judged(found, HARDER**asked * effort, index + asked * ARMS))
            if trial.verdict == "inside" or (asked and trial.verdict == "outside"):
                break
        yield trial


def table(trials: Iterable[Trial]) -> Iterator[str]:
    """Yield a row for each kind, and one for all."""
    found = list(trials)
    yield "| arms | inside | unclear | outside | mean of off / stated | off: median, most | stated: median, most |"
    yield "| --- | --- | --- | --- | --- | --- | --- |"
    for kind in (*KINDS, "all"):
        some = [trial for trial in found if kind in ("all", trial.kind)]
        if some:
            yield _row(kind, some)


def _row(kind: str, some: list[Trial]) -> str:
    counts = " | ".join(str(sum(t.verdict == verdict for t in some)) for verdict in ("inside", "unclear", "outside"))
    lean = statistics.mean(t.off / t.stated for t in some)
    off, stated = sorted(abs(t.off) for t in some), sorted(t.stated for t in some)
    spread = " | ".join(f"{statistics.median(v):.3%}, {v[-1]:.2%}" for v in (off, stated))
    return f"| {kind} ({len(some)}) | {counts} | {lean:+.2f} | {spread} |"
