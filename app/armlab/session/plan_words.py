"""What a plan is worth, in words."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from armlab.kin.motion.peaks import QUANTITIES
from armlab.session.plan_question import Leg, Planned

BRIEF = 5e-3
"""Seconds that are told as one moment."""

SLACK = 1.0 + 1e-6
"""By which the tool may be faster than its limit: rounding."""


class Said(NamedTuple):
    """A verdict: ``"ok"``, ``"warn"`` or ``"no"``, a headline, and sentences."""

    kind: str
    head: str
    lines: tuple[str, ...]


def judged(plan: Planned) -> Said:
    """Return what a plan is worth: whether it can be run, within its limits, and what is worth knowing."""
    remarks = tuple(_with_move(leg, remark) for leg in plan.legs for remark in leg.remarks)
    troubles = tuple(leg.trouble for leg in plan.legs if leg.trouble)
    if troubles:
        return Said("no", "cannot be run to its end", (*troubles, *remarks))
    over = exceeded_words(plan)
    if over:
        least = (
            ()
            if np.isnan(plan.fastest) or plan.question.duration is None
            else (f"within the limits it takes {plan.fastest:.2f} s at least",)
        )
        return Said("warn", "exceeds limits", (*over, *least, *remarks))
    return Said("ok", f"runs in {plan.duration:.2f} s within all limits", remarks)


def exceeded_words(plan: Planned) -> tuple[str, ...]:
    """Return a sentence for each quantity that exceeds limits, with the joints, and one for the tool."""
    said = []
    for quantity in QUANTITIES:
        of = [violation for violation in plan.violations if violation.quantity == quantity]
        if of:
            joints = sorted({violation.joint for violation in of})
            many = len(joints) > 1
            names = f"{'joints' if many else 'joint'} {', '.join(map(str, joints))}"
            what = f"{'exceed their limits' if many else 'exceeds its limit'} of {quantity}"
            said.append(f"{names} {what} {_when([(violation.start, violation.end) for violation in of])}")
    speed = plan.question.limits.tool_speed
    if speed is not None and plan.samples is not None and plan.samples.tool_speed.max() > speed * SLACK:
        t = plan.samples.t[plan.samples.tool_speed > speed * SLACK]
        said.append(f"the tool is faster than its limit {_when([(float(t[0]), float(t[-1]))])}")
    return tuple(said)


def _with_move(leg: Leg, remark: str) -> str:
    return remark if leg.stretch is None else f"move {leg.stretch.title}: {remark[:1].lower() + remark[1:].rstrip('.')}"


def _when(times: list[tuple[float, float]]) -> str:
    first, last = min(start for start, _ in times), max(end for _, end in times)
    return f"at {first:.2f} s" if last - first < BRIEF else f"between {first:.2f} and {last:.2f} s"
