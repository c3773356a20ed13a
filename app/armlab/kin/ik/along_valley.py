"""The search along a valley, from a configuration where descents creep to a solution.

An arm with joints to spare that is stretched lies in a valley: the joints move far, as two turns about one line against
each other, and the error hardly changes. A descent goes down into the valley and creeps along its bottom, in steps that
shrink with the error, and may never see that there is an exact solution a radian away. So descents start all along it.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.many_at_once import damped_steps, many_at_once
from armlab.kin.ik.rest import AT
from armlab.kin.ik.samples import samples_of
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.ik.verified import distinct, solution
from armlab.kin.transforms import inverse

Vector = NDArray[np.float64]

WEAK = 3e-2
"""Singular value, relative to the largest, below which the tool hardly moves along a direction."""

FAR, POINTS = 3.0, 24
"""Distance, radians or length scales, to which starts go either way, and number of starts in each direction."""

SAMPLES, OTHERS, CREPT, APART = 64, 4, 1e-2, 0.5
"""Samples from which other valleys are looked for, and the most of these that are used; the scaled error of a descent
that ended in one, and their least distance, radians or length scales."""

BEST = 8
"""Number of descents that are continued."""

STEPS = (15, 60)
"""Steps of all descents, and of the best."""

DAMPING, FLOOR, LONGEST = 1e-3, 1e-14, 1.0
"""Damping of least squares as a factor of the squared error, its smallest value, and the largest change of a joint."""

NEAR = 1e-5
"""Scaled error below which a descent is worth polishing."""


def solutions_along(arm: Arm, q: Vector, T: Vector) -> Iterator[Vector]:
    """Yield solutions (n,) inside the limits along the valley in which a descent crept, the most exact first.

    Parameters
    ----------
    arm : Arm
    q : ndarray, shape (n,)
        Configuration in which it crept, near a target T (4, 4) in the world.
    T : ndarray, shape (4, 4)
    """
    G, target = np.asarray(inverse(arm.base) @ T, dtype=np.float64), task_error_of(arm).target(T)
    for start in (q, *_others(arm, q, G, target)):
        yield from _along(arm, start, G, target)


def _others(arm: Arm, q: Vector, G: Vector, target: list[float]) -> Iterator[Vector]:
    """Yield end points of descents in other valleys, begun at samples near the target."""
    some, sizes = _descended(arm, samples_of(arm, 0).near(target, SAMPLES), G, STEPS[0])
    known = [q]
    for k in np.argsort(sizes, kind="stable"):
        if len(known) <= OTHERS and sizes[k] < CREPT and len(distinct(arm, [*known, some[k]], APART)) > len(known):
            known.append(some[k])
            yield some[k]


def _along(arm: Arm, q: Vector, G: Vector, target: list[float]) -> Iterator[Vector]:
    """Yield the ends of descents begun along the valley through a configuration."""
    scales = np.where(arm.revolute, 1.0, arm.length_scale)
    J = many_at_once(arm).linearised(q[None], G)[0][0]
    _, values, ways = np.linalg.svd(J)
    weak = ways[np.count_nonzero(values > WEAK * values.max(initial=0.0)) :]
    far = np.linspace(-FAR, FAR, POINTS)[:, None]
    starts = np.concatenate([q + far * way * scales for way in weak])
    some, sizes = _descended(arm, starts, G, STEPS[0])
    some, sizes = _descended(arm, some[np.argsort(sizes, kind="stable")[:BEST]], G, STEPS[1])
    low, high = arm.limits.T
    for k in np.argsort(sizes, kind="stable"):
        # The last steps would lead over a limit by the root of the rounding.
        held = (some[k] <= low + AT) | (some[k] >= high - AT)
        found = solution(arm, some[k], target, held) if sizes[k] < NEAR else None
        if found is not None and arm.within_limits(found):
            yield found


def _descended(arm: Arm, q: Vector, G: Vector, steps: int) -> tuple[Vector, Vector]:
    """Return the ends of damped steps inside the limits from (k, n), and the scaled errors there, shape (k,)."""
    many, scales, (low, high) = many_at_once(arm), np.where(arm.revolute, 1.0, arm.length_scale), arm.limits.T
    q = np.clip(q, low, high)
    for _ in range(steps):
        J, e = many.linearised(q, G)
        damping = DAMPING * np.einsum("ki,ki->k", e, e) + FLOOR
        step = damped_steps(J, e, damping)
        stopped = ((q <= low) & (step < 0.0)) | ((q >= high) & (step > 0.0))
        if stopped.any():
            # Joints that push against a limit stay there, and the others compensate.
            step = damped_steps(np.where(stopped[:, None], 0.0, J), e, damping)
        q = np.clip(q + np.clip(step, -LONGEST, LONGEST) * scales, low, high)
    e = many.linearised(q, G)[1]
    return q, np.sqrt(np.einsum("ki,ki->k", e, e))
