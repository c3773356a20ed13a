"""Measures of a planned motion, taken once with the planning, so that panels only read them."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.figures import TOOL, Binding, Figures, Limited, Overrun
from armlab.benches.motion.plan.question import Planned
from armlab.benches.motion.plan.samples import fastest_tool, too_fast, tool_way
from armlab.kin.motion import Motion, peaks

Floats = NDArray[np.float64]

AT_LIMIT = 0.995
"""Share of a limit from which on it slows a motion; the largest speed of the tool is searched, not exact."""


def measuring(work: Iterator[Planned | None]) -> Iterator[Planned | None]:
    """Yield the motions of a planning with their measures, and None between pieces of the work."""
    for planned in work:
        if planned is None:
            yield None
            continue
        yield None
        found = replace(planned, overruns=_overruns(planned))
        yield None
        figures = yield from _figures(found)
        yield replace(found, figures=figures)


def _figures(planned: Planned) -> Generator[None, None, Figures | None]:
    """Return the largest values of what can be run of a planned motion, or None if there is none, with pauses."""
    arm, limits = planned.question.arm, planned.question.limits
    if planned.motion is None:
        return None
    peaks_of: dict[int, list[Floats]] = {1: [], 2: []}
    times_of: dict[int, list[Floats]] = {1: [], 2: []}
    met, tool, way = [], [], 0.0
    for leg in planned.running:
        assert leg.motion is not None
        for order in (1, 2):
            found = peaks(leg.motion, order)
            peaks_of[order].append(found.peak)
            times_of[order].append(leg.start + found.peak_at)
            yield
        tool.append(fastest_tool(arm, leg.motion))
        way += tool_way(arm, leg.motion)
        yield
        met.append((leg.motion.duration, _met(planned, leg.motion, peaks_of[1][-1], peaks_of[2][-1], tool[-1])))
        yield
    velocity, velocity_at = _largest(np.array(peaks_of[1]), np.array(times_of[1]))
    acceleration, acceleration_at = _largest(np.array(peaks_of[2]), np.array(times_of[2]))
    return Figures(
        velocity,
        acceleration,
        velocity_at,
        acceleration_at,
        velocity / np.array(limits.velocity),
        acceleration / np.array(limits.acceleration),
        way,
        max(tool),
        _longest(met),
    )


def _largest(values: Floats, times: Floats) -> tuple[Floats, Floats]:
    """Return the largest value of each column of legs (k, n), and its time."""
    leg, joints = np.argmax(values, axis=0), np.arange(values.shape[1])
    return values[leg, joints], times[leg, joints]


def _met(planned: Planned, motion: Motion, velocity: Floats, acceleration: Floats, tool: float) -> Binding | None:
    """Return the limit that a leg comes nearest to, if the leg meets it."""
    limits = planned.question.limits
    shares: dict[Binding, float] = {}
    _note(shares, "velocity", velocity / np.array(limits.velocity))
    _note(shares, "acceleration", acceleration / np.array(limits.acceleration))
    if limits.jerk_time is not None:
        _note(shares, "jerk", peaks(motion, 3).peak / limits.jerk())
    if limits.tool_speed is not None:
        shares[Binding(TOOL, "tool speed")] = tool / limits.tool_speed
    most = max(shares, key=lambda binding: shares[binding])
    return most if shares[most] >= AT_LIMIT else None


def _note(shares: dict[Binding, float], quantity: Limited, values: Floats) -> None:
    j = int(np.argmax(values))
    shares[Binding(j + 1, quantity)] = float(values[j])


def _longest(met: list[tuple[float, Binding | None]]) -> Binding | None:
    """Return the limit that is met in the legs of the longest total duration."""
    lasting: dict[Binding, float] = {}
    for duration, binding in met:
        if binding is not None:
            lasting[binding] = lasting.get(binding, 0.0) + duration
    return max(lasting, key=lambda binding: lasting[binding]) if lasting else None


def _overruns(planned: Planned) -> tuple[Overrun, ...]:
    """Return the limits that are exceeded, each once, in the order of time, including that of the tool speed."""
    found: dict[tuple[int, Limited], list[tuple[float, float]]] = {}
    for violation in planned.violations:
        found.setdefault((violation.joint, violation.quantity), []).append((violation.start, violation.end))
    question, samples = planned.question, planned.samples
    fast = [] if samples is None else too_fast(question.arm, samples, planned.running, question.limits.tool_speed)
    if fast:
        found[TOOL, "tool speed"] = fast
    every = [Overrun.of(joint, quantity, sorted(spans)) for (joint, quantity), spans in found.items()]
    return tuple(sorted(every, key=lambda overrun: overrun.spans[0][0]))
