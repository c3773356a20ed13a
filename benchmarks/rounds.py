"""Time things side by side: rounds in turn, medians, and the ratio to ours in the same run."""

import os
import statistics
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TypeVar

Work = Callable[[], object]
Size = TypeVar("Size")

TINY = "--tiny" in sys.argv
"""Whether the tables are only to be filled, with figures that mean nothing, to see that every benchmark still runs."""

if TINY:  # the labs that are started read no lessons, which would be most of their work
    os.environ["PYTHONPATH"] = str(Path(__file__).resolve().parents[1] / "tests" / "support" / "no_lessons")


def sized(full: Size, tiny: Size) -> Size:
    """Return how much a benchmark does: as much as its figures need, or as little as fills its table."""
    return tiny if TINY else full


def medians(entries: Mapping[str, Work], count: int = 1, rounds: int = 15, least: float = 0.02) -> dict[str, float]:
    """Return seconds for one item of each entry, a call of which does ``count`` items.

    Every round runs each entry once, for at least so many seconds, so that a slow moment of the machine meets all.
    """
    rounds = sized(rounds, 1)
    calls = {name: _calls(work, least) for name, work in entries.items()}
    seconds: dict[str, list[float]] = {name: [] for name in entries}
    for _ in range(rounds):
        for name, work in entries.items():
            start = time.perf_counter()
            for _ in range(calls[name]):
                work()
            seconds[name].append((time.perf_counter() - start) / calls[name] / count)
    return {name: statistics.median(values) for name, values in seconds.items()}


def _calls(work: Work, least: float) -> int:
    if TINY:
        return 1
    work()
    start = time.perf_counter()
    work()
    return max(1, round(least / max(time.perf_counter() - start, 1e-7)))


def row(title: str, found: Mapping[str, float], unit: str, scale: float, digits: int = 1) -> str:
    """Return a table row; the first entry is ours, the others get their ratio to it."""
    (_, ours), *others = found.items()
    peers = [f"{name} {value * scale:.{digits}f} ({value / ours:.1f}×)" for name, value in others]
    return f"| {title} | {ours * scale:.{digits}f} {unit} | {', '.join(peers) or '–'} |"


def header() -> Iterator[str]:
    """Yield the head of the table that `row` fills."""
    yield "| work | Armlab | peers (× Armlab) |"
    yield "| --- | --- | --- |"


def quantile(values: list[float], part: float) -> float:
    """Return the value below which this part of the values lies."""
    return sorted(values)[min(len(values) - 1, int(part * len(values)))]
