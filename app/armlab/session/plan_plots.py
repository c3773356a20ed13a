"""What the plots of a motion say in numbers: peaks, shares of the limits, what is exceeded when, and the comparison."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from armlab.kin.motion import Motion, peaks
from armlab.session.parts.joints import Joints
from armlab.session.parts.plan import Plan
from armlab.session.plan_other import other_way
from armlab.session.plan_question import Limits, Planned, Question
from armlab.session.plan_samples import too_fast
from armlab.session.state import State

Floats = NDArray[np.float64]
Limited = Literal["position", "velocity", "acceleration", "jerk", "tool speed"]
Kind = Literal["joint", "cartesian", "mixed"]

TOOL = 0
"""Stands for the tool where joints are counted from 1."""

AT_LIMIT = 0.995
"""A share from which on a limit is what keeps a motion from being faster; the bounds of the tool are met at samples."""

SAME = 1e-4
"""Part of the duration by which motions that take the same time may differ: one follows its path by samples."""


@dataclass(frozen=True)
class Overrun:
    """A limit that is exceeded, once or several times.

    Attributes
    ----------
    joint : int
        1-based, or `TOOL`.
    quantity : str
    spans : tuple of (float, float)
        From when to when, seconds.
    """

    joint: int
    quantity: Limited
    spans: tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Binding:
    """The limit that keeps a motion from being faster for the longest part of it.

    Attributes
    ----------
    joint : int
        1-based, or `TOOL`.
    quantity : str
    """

    joint: int
    quantity: Limited


@dataclass(frozen=True, eq=False)
class Figures:
    """The largest values of a motion.

    Attributes
    ----------
    velocity, acceleration : ndarray, shape (n,)
        Exact peaks of the absolute values, rad/s or m/s and rad/s² or m/s².
    velocity_at, acceleration_at : ndarray, shape (n,)
        When, seconds.
    velocity_share, acceleration_share : ndarray, shape (n,)
        Parts of the limits.
    way : float
        Metres the tool point goes.
    tool_speed : float
        m/s, the largest.
    binding : Binding or None
        None where no limit is met, as in a motion that is given more time.
    """

    velocity: Floats
    acceleration: Floats
    velocity_at: Floats
    acceleration_at: Floats
    velocity_share: Floats
    acceleration_share: Floats
    way: float
    tool_speed: float
    binding: Binding | None

    @property
    def fastest_joint(self) -> int:
        """The joint, from 1, that comes nearest to its limit of velocity."""
        return int(np.argmax(self.velocity_share)) + 1


def figures(plan: Planned) -> Figures | None:
    """Return the largest values of what can be run of a plan; None when that is nothing."""
    samples, limits = plan.samples, plan.question.limits
    if plan.motion is None or samples is None:
        return None
    running = [(leg.start, leg.motion) for leg in plan.legs if leg.motion is not None]
    first, second = ([peaks(motion, order) for _, motion in running] for order in (1, 2))
    starts = np.array([start for start, _ in running])[:, None]
    velocity, velocity_at = _largest(np.array([e.peak for e in first]), starts + np.array([e.peak_at for e in first]))
    acceleration, acceleration_at = _largest(
        np.array([e.peak for e in second]), starts + np.array([e.peak_at for e in second])
    )
    met = [
        (motion.duration, _met(plan, start, motion, v.peak, a.peak))
        for (start, motion), v, a in zip(running, first, second, strict=True)
    ]
    return Figures(
        velocity,
        acceleration,
        velocity_at,
        acceleration_at,
        velocity / np.array(limits.velocity),
        acceleration / np.array(limits.acceleration),
        float(np.linalg.norm(np.diff(samples.tool, axis=0), axis=1).sum()),
        float(samples.tool_speed.max()),
        _longest(met),
    )


def _largest(values: Floats, times: Floats) -> tuple[Floats, Floats]:
    """Return the largest of each column of legs (k, n), and when it is."""
    leg, joints = np.argmax(values, axis=0), np.arange(values.shape[1])
    return values[leg, joints], times[leg, joints]


def _met(plan: Planned, start: float, motion: Motion, velocity: Floats, acceleration: Floats) -> Binding | None:
    """Return the limit a leg comes nearest to, if it meets it."""
    limits = plan.question.limits
    shares: dict[Binding, float] = {}
    _note(shares, "velocity", velocity / np.array(limits.velocity))
    _note(shares, "acceleration", acceleration / np.array(limits.acceleration))
    if limits.jerk_time is not None:
        _note(shares, "jerk", peaks(motion, 3).peak / limits.jerk())
    if limits.tool_speed is not None and plan.samples is not None:
        on = (plan.samples.t >= start) & (plan.samples.t <= start + motion.duration)
        shares[Binding(TOOL, "tool speed")] = float(plan.samples.tool_speed[on].max(initial=0.0)) / limits.tool_speed
    most = max(shares, key=lambda binding: shares[binding])
    return most if shares[most] >= AT_LIMIT else None


def _note(shares: dict[Binding, float], quantity: Limited, values: Floats) -> None:
    j = int(np.argmax(values))
    shares[Binding(j + 1, quantity)] = float(values[j])


def _longest(met: list[tuple[float, Binding | None]]) -> Binding | None:
    """Return the limit that is met in legs that last longest together."""
    lasting: dict[Binding, float] = {}
    for duration, binding in met:
        if binding is not None:
            lasting[binding] = lasting.get(binding, 0.0) + duration
    return max(lasting, key=lambda binding: lasting[binding]) if lasting else None


def overruns(plan: Planned) -> tuple[Overrun, ...]:
    """Return every limit that is exceeded, each once, in the order of time; that of the tool speed among them."""
    found: dict[tuple[int, Limited], list[tuple[float, float]]] = {}
    for violation in plan.violations:
        found.setdefault((violation.joint, violation.quantity), []).append((violation.start, violation.end))
    fast = [] if plan.samples is None else too_fast(plan.samples, plan.question.limits.tool_speed)
    if fast:
        found[TOOL, "tool speed"] = fast
    every = [Overrun(joint, quantity, tuple(spans)) for (joint, quantity), spans in found.items()]
    return tuple(sorted(every, key=lambda overrun: overrun.spans[0][0]))


def boundaries(plan: Planned) -> tuple[float, ...]:
    """Return the times at which one leg ends and the next begins."""
    return tuple(leg.start for leg in plan.legs if leg.motion is not None and leg.start > 0.0)


def shares(plan: Planned) -> tuple[Floats, Floats] | None:
    """Return |qdot_i| / v_i and |qddot_i| / a_i at the samples of a plan, (k, n) each; None when it cannot be run."""
    if plan.samples is None:
        return None
    limits: Limits = plan.question.limits
    first = np.abs(plan.samples.qdot) / np.array(limits.velocity)
    return first, np.abs(plan.samples.qddot) / np.array(limits.acceleration)


def kind_of(question: Question) -> Kind:
    """Return in which space the moves of a plan are straight: one, or both."""
    spaces = {move.space for move in question.moves}
    return spaces.pop() if len(spaces) == 1 else "mixed"


def can_compare(state: State) -> bool:
    """Return whether there are moves of which another kind can be planned: not of a motion read from a file."""
    part = state[Plan]
    return part.recorded is None and bool(part.moves)


def compared(state: State, plan: Planned) -> Planned | None:
    """Return the plan of the other kind of moves that belongs to a plan; None while it is not wanted or not ready."""
    part = state[Plan]
    if not part.compared or part.other is None or part.other.question.arm is not state[Joints].arm:
        return None
    return part.other if part.other.question == other_way(plan.question) else None


def same_time(one: Planned, other: Planned) -> bool:
    """Return whether two plans are equally fast within the limits."""
    return abs(one.fastest - other.fastest) <= SAME * max(one.fastest, other.fastest)
