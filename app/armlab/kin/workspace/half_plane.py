"""The half plane at one angle of joint 1: random configurations that bring the tool point into it.

Joint 1 carries whatever the other joints reach into this half plane, where its limits let it. So all samples fall on
one surface, and a few hundred thousand of them fill a picture that would take a hundred times as many in space. For an
arm with a prismatic first joint it is the plane perpendicular to it, at one place along it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.workspace.sheet import Met, Sheet, Singles, within

Floats = NDArray[np.float64]

ON_AXIS = 1e-6
"""Distance from axis 1, relative to the reach, below which joint 1 does not move the tool point."""


@dataclass(frozen=True, eq=False)
class HalfPlane(Sheet):
    """The half plane at s, the third coordinate of the arm's `FirstJoint`: rad, or metres where joint 1 slides.

    Its coordinates are (u, v). For an arm whose tool turns about one line only, orientations are counted from the
    direction outward where this line is that of joint 1; else from a direction that stays.
    """

    def met(self, q: Singles) -> Met:
        """Return positions and directions of the tool of configurations when joint 1 turns it into the half plane."""
        joint, drawn = self.joint, q[:, 0].astype(np.float64)
        q[:, 0] = 0.0
        T = np.asarray(self.arm.fk(q), dtype=np.float64)
        coordinates = joint.split(T[:, :3, 3])
        q1 = self.s - coordinates[:, 2]
        if joint.revolute:
            q1 = joint.low + np.mod(q1 - joint.low, math.tau)
            # On the axis the point is in every half plane, however joint 1 turns the tool.
            q1 = np.where(coordinates[:, 0] <= ON_AXIS * self.arm.reach, drawn, q1)
        # With all of a turn every value fits, but for rounding at its end.
        kept = np.ones(len(q), dtype=bool) if joint.full else (q1 >= joint.low) & (q1 <= joint.high)
        low, high = within(self.arm)
        q[:, 0] = np.clip(q1, low[0], high[0])
        axis = T[:, :3, 0 if self.bins.circle else 2] @ self.counted_axes(T, joint.axes)
        if joint.revolute:
            # Joint 1 turns the tool by q1, and the half plane stands at s: what is left is the turn from s at q1 = 0.
            turned = (axis[:, 0] + 1j * axis[:, 1]) * np.exp(1j * (q1 - self.s))
            axis = np.stack([turned.real, turned.imag, axis[:, 2]], axis=-1)
        return Met(q[kept], coordinates[kept, :2], axis[kept])

    def places(self, points: ArrayLike) -> Floats:
        """Return (u, v), (..., 2), of points (..., 3) in the world, for any value of joint 1."""
        return self.joint.split(points)[..., :2]

    def points(self, places: ArrayLike) -> Floats:
        """Return the points (..., 3) of the half plane, in the world, with coordinates (u, v), (..., 2)."""
        given = np.asarray(places, dtype=np.float64)
        return self.joint.join(np.concatenate([given, np.full((*given.shape[:-1], 1), self.s)], axis=-1))

    def lowest(self, low: Floats) -> Floats:
        """Return the corner of a picture, which does not begin before the axis."""
        return np.array([max(low[0], 0.0), low[1]]) if self.joint.revolute else low
