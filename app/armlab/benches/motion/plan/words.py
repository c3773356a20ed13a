"""The verdict on a planned motion, in words."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from armlab.benches.motion.plan.figures import TOOL, Overrun
from armlab.benches.motion.plan.question import Leg, Planned

MOST_TOLD = 2
"""Largest number of times at which a limit is exceeded that are listed one by one."""


class Said(NamedTuple):
    """A verdict: ``"ok"``, ``"warn"`` or ``"no"``, a headline, and sentences."""

    kind: str
    head: str
    lines: tuple[str, ...]


def judged(planned: Planned) -> Said:
    """Return the verdict on a planned motion: whether it can be run within its limits, and further remarks."""
    remarks = tuple(_with_move(leg, remark) for leg in planned.legs for remark in leg.remarks)
    if not planned.legs:
        return Said("warn", "no motion yet", ("a motion needs two waypoints: move the arm and add its current pose",))
    troubles = tuple(leg.trouble for leg in planned.legs if leg.trouble)
    if troubles:
        return Said("no", "cannot be run to its end", (*troubles, *remarks))
    over = exceeded_words(planned)
    if over:
        least = (
            ()
            if np.isnan(planned.least) or planned.question.duration is None
            else (f"within the limits it takes at least {rounded_up(planned.least):.2f} s{planned.with_ramps}",)
        )
        return Said("no", "exceeds limits", (*over, *least, *remarks))
    return Said("ok", f"runs in {planned.duration:.2f} s within all limits", remarks)


def exceeded_words(planned: Planned) -> list[str]:
    """Return the limits a planned motion exceeds in words, without full stops."""
    return [*sentences(planned.overruns), *planned.unkept]


def rounded_up(seconds: float) -> float:
    """Return a number of seconds rounded up to hundredths."""
    return math.ceil(100.0 * seconds - 1e-9) / 100.0


def sentences(found: Sequence[Overrun]) -> list[str]:
    """Return in words the limits that are exceeded, without full stops, in one sentence for equal times of joints."""
    together: dict[tuple[str, str], list[int]] = {}
    for overrun in found:
        together.setdefault((overrun.quantity, _when(overrun)), []).append(overrun.joint)
    said = []
    for (quantity, when), joints in together.items():
        if joints == [TOOL]:
            said.append(f"the tool exceeds its speed limit {when}")
            continue
        several = len(joints) > 1
        who = f"joints {listed([str(j) for j in sorted(joints)])}" if several else f"joint {joints[0]}"
        if quantity == "position":
            what = "are outside their limits" if several else "is outside its limits"
        else:
            what = f"exceed their {quantity} limits" if several else f"exceeds its {quantity} limit"
        said.append(f"{who} {what} {when}")
    return said


def listed(words: Sequence[str]) -> str:
    """Return words as a list in a sentence.

    >>> listed(["1", "2", "4"])
    '1, 2 and 4'
    """
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def _when(overrun: Overrun) -> str:
    """Return when a limit is exceeded: the first times, and the number of further ones."""
    spans = [_span(*each) for each in overrun.spans[:MOST_TOLD]]
    more = overrun.count - MOST_TOLD
    if more > 0:
        spans.append("once more" if more == 1 else f"{more} more times")
    return listed(spans)


def _span(start: float, end: float) -> str:
    first, last = f"{start:.2f}", f"{end:.2f}"
    return f"at {first} s" if first == last else f"from {first} to {last} s"


def _with_move(leg: Leg, remark: str) -> str:
    return remark if leg.stretch is None else f"move {leg.stretch.title}: {remark[:1].lower() + remark[1:].rstrip('.')}"
