"""What a plan is worth, in words."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from armlab.session.plan_question import Leg, Planned

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
    """Return a sentence for each joint and quantity that exceeds its limit, and for the tool."""
    spans: dict[tuple[int, str], list[tuple[float, float]]] = {}
    for violation in plan.violations:
        spans.setdefault((violation.joint, violation.quantity), []).append((violation.start, violation.end))
    said = [f"joint {joint} exceeds its limit of {what} {_when(times)}" for (joint, what), times in spans.items()]
    speed = plan.question.limits.tool_speed
    if speed is not None and plan.samples is not None and plan.samples.tool_speed.max() > speed * SLACK:
        t = plan.samples.t[plan.samples.tool_speed > speed * SLACK]
        said.append(f"the tool is faster than its limit {_when([(float(t[0]), float(t[-1]))])}")
    return tuple(said)


def _with_move(leg: Leg, remark: str) -> str:
    return remark if leg.stretch is None else f"move {leg.stretch.title}: {remark[:1].lower() + remark[1:].rstrip('.')}"


def _when(times: list[tuple[float, float]]) -> str:
    first, last = times[0][0], times[-1][1]
    if last - first < 5e-3:
        return f"at {first:.2f} s"
    often = f", {len(times)} times" if len(times) > 1 else ""
    return f"from {first:.2f} to {last:.2f} s{often}"
