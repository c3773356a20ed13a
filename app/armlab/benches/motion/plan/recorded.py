"""The planning of a motion read from a file: in its own time or another, judged at its samples."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.laws import slack, tool_share
from armlab.benches.motion.plan.question import Leg, Limits, Planned, Question, Recorded
from armlab.benches.motion.plan.samples import ROUNDING, drawn_leg, exceeded, sampled, spans_of, too_fast
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.motion import Motion, Trajectory, Violation, law_type, path_type, scaled
from armlab.kin.motion.peaks import QUANTITIES

Floats = NDArray[np.float64]

JERK = 3
"""Order of the jerk among the derivatives of the joint values."""

JERK_ROUNDING = 1.0 + 1e-3
"""Multiple of a limit of jerk up to which it counts as kept: the digits of a file are few in a difference."""


def recorded_motion(question: Question) -> Iterator[Planned | None]:
    """Yield None between pieces of the work, and finally a question's recorded motion, planned."""
    recorded = question.recorded
    assert recorded is not None
    own = _motion(recorded)
    k = 1.0 if question.duration is None else question.duration / own.duration
    motion = own if k == 1.0 else scaled(own, k)
    yield None
    try:
        over, within = _judged(question, recorded, motion, own, k)
    except InputError as refusal:
        leg = Leg(None, 0.0, np.zeros((0, 3)), np.zeros(0, dtype=int), None, str(refusal))
        yield Planned(question, (leg,), None, None, (), math.nan)
        return
    yield None
    leg = Leg(None, 0.0, np.zeros((0, 3)), np.zeros(0, dtype=int), None, motion=motion)
    samples = sampled(question.arm, motion, [leg])
    yield None
    fast = too_fast(question.arm, samples, [leg], question.limits.tool_speed)
    leg = drawn_leg(question.arm, leg, (*spans_of(over), *fast))
    yield Planned(question, (leg,), motion, samples, over, within)


def _motion(recorded: Recorded) -> Motion:
    """Return the motion: a natural spline, or cubics with the velocities of the file."""
    t = np.array(recorded.t) - recorded.t[0]
    if recorded.qdot is None:
        path = path_type("spline").path(recorded.q, times=t, ends="natural")
    else:
        path = path_type("hermite").path(recorded.q, times=t, velocities=recorded.qdot)
    return Trajectory(path, law_type("constant").law(float(t[-1])))


def _judged(
    question: Question, recorded: Recorded, motion: Motion, own: Motion, k: float
) -> tuple[tuple[Violation, ...], float]:
    """Return the intervals in which limits are exceeded, and the time inside the limits.

    A file that has rates is believed at its samples: between them nobody knows where an acceleration has jumped, and
    any curve swings over there.
    """
    if recorded.qdot is None or recorded.qddot is None:
        return exceeded(question, motion), own.duration * slack(question, own)
    t, q = np.array(recorded.t) - recorded.t[0], np.array(recorded.q)
    over, factors = _outside(question.arm, k * t, q), [tool_share(question.arm, own, question.limits)]
    for order, share in enumerate(_shares(question.limits, recorded, t), start=1):
        over += _above(k * t, share / k**order, order)
        factors.append(float(share.max()) ** (1.0 / order))
    if not any(factors):
        raise InputError("recorded motion: the arm stands still all the time")
    return tuple(sorted(over, key=lambda each: (each.start, each.joint, each.quantity))), own.duration * max(factors)


def _shares(limits: Limits, recorded: Recorded, t: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the parts of the limits that velocity, acceleration and jerk take, a column for each joint.

    Those of the jerk have one row fewer: from one sample to the next its peak is at least its mean.
    """
    a = np.array(recorded.qddot)
    jerk = np.diff(a, axis=0) / np.diff(t)[:, None]
    held = limits.of_joints().each
    v_share, a_share, j_share = (np.abs(x) / h for x, h in zip((np.array(recorded.qdot), a, jerk), held, strict=True))
    return v_share, a_share, j_share


def _above(t: Floats, shares: Floats, order: int) -> list[Violation]:
    """Return when shares at times, or between them if there is one fewer, are above 1."""
    most = JERK_ROUNDING if order == JERK else ROUNDING
    between = len(t) - len(shares)
    return [
        Violation(joint + 1, QUANTITIES[order], float(t[first]), float(t[last + between]))
        for joint in range(shares.shape[1])
        for first, last in _runs(shares[:, joint] > most)
    ]


def _outside(arm: Arm, t: Floats, q: Floats) -> list[Violation]:
    low, high = arm.limits.T
    room = 1e-6 * np.where(arm.revolute, 1.0, arm.length_scale)
    beyond = (q < low - room) | (q > high + room)
    return [
        Violation(joint + 1, "position", float(t[first]), float(t[last]))
        for joint in range(arm.n)
        for first, last in _runs(beyond[:, joint])
    ]


def _runs(on: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return the first and last index of each run of True."""
    edges = np.diff(np.concatenate([[False], on, [False]]).astype(int))
    return list(zip(np.flatnonzero(edges == 1).tolist(), (np.flatnonzero(edges == -1) - 1).tolist(), strict=True))
