"""The points that the centre of a spherical wrist reaches: the workspace of the joints before it, as a test.

Exact, limits included, where joints 1 to 3 are an elbow (axis 1 at a right angle to the parallel axes 2 and 3);
otherwise sampled: a table of what was met over the coordinates of joint 1, which then turns as far as it may.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.transforms import inverse, transform
from armlab.kin.workspace.elbow_points import ElbowPoints, elbow_of
from armlab.kin.workspace.sampled_points import SampledPoints, sampling
from armlab.kin.wrist import wrist_centre

WristPoints = ElbowPoints | SampledPoints
"""A set of points: ``holds(points)``, whether it is ``exact``, and ``centre`` and ``radius`` of a ball around it."""


def front_of(arm: Arm) -> Arm:
    """Return the joints in front of the spherical wrist as an arm whose tool point is the wrist centre.

    Raises
    ------
    InputError
        The arm has no spherical wrist, or no joint in front of it.
    """
    centre = wrist_centre(arm)
    n = arm.n - 3
    if centre is None or n < 1:
        raise InputError("arm: expected joints in front of a spherical wrist")
    q = arm.limits.mean(axis=1)
    T = np.asarray(inverse(arm.frames(q)[n]) @ arm.fk(q))
    fixed = transform(position=T[:3, :3] @ centre + T[:3, 3])
    return Arm.from_dh(
        arm.rows[:n], arm.convention, arm.base, fixed, arm.limits[:n], task="xyz", name=f"{arm.name}, wrist centre"
    )


def wrist_points(arm: Arm) -> WristPoints:
    """Return where the wrist centre of an arm can be, joint limits respected.

    Raises
    ------
    InputError
        The arm has no spherical wrist, or no joint in front of it.

    References
    ----------
    Pieper 1968; Gupta and Roth 1982, on the workspaces of arms with spherical wrists.
    """
    *_, found = finding_wrist_points(arm)
    assert found is not None
    return found


def finding_wrist_points(arm: Arm) -> Iterator[WristPoints | None]:
    """Yield None after each piece of work of some 20 ms, and at last what `wrist_points` returns."""
    front = front_of(arm)
    elbow = elbow_of(front)
    if elbow is not None:
        yield elbow
        return
    yield from sampling(front)
