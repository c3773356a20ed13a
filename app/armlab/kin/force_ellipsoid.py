"""Force ellipsoids: which forces the tool can exert with joint torques of unit length.

``tau = J^T F`` carries forces to torques, so that torques of length 1, as one vector, belong to the forces with
``F^T J J^T F = 1`` (notes, section 5.4.1). It has the axes of the velocity ellipsoid and the inverse half axes: where
the tool is fast it is weak. A direction along which no joint moves the tool needs no torque at all.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.ellipsoid import Ellipsoid, velocity_ellipsoid

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ForceEllipsoid:
    """The forces that torques of unit length give.

    Parameters
    ----------
    velocity : Ellipsoid
        The velocity ellipsoid of the same block and scale.
    """

    velocity: Ellipsoid

    @property
    def axes(self) -> Array:
        """Axes u_i of the velocity ellipsoid as columns, (m, m), in the same order."""
        return self.velocity.axes

    @property
    def half_axes(self) -> Array:
        """1/sigma_i, rising, (m,): N (N m for a block of angular velocities) for scaled torques of length 1.

        Infinite where sigma_i counts as 0 (see `armlab.kin.ellipsoid.RANK_TOLERANCE`): the structure alone carries
        such a force. Never nan.
        """
        rank, sigma = self.velocity.rank, self.velocity.sigma
        half = np.full(len(sigma), math.inf)
        half[:rank] = 1.0 / sigma[:rank]
        half.setflags(write=False)
        return half

    @property
    def free(self) -> tuple[int, ...]:
        """Indices, 0-based, of the axes along which a force needs no torque."""
        return tuple(range(self.velocity.rank, len(self.velocity.sigma)))

    @property
    def w(self) -> float:
        """The product of the half axes, sqrt(det(J J^T)^-1); infinite at singularities. Notes 5.164.

        With fewer joints than rows it is sqrt(det(J^T J)^-1), of the axes along which joints can move the tool, as for
        `Ellipsoid.w`.
        """
        return float(math.prod(self.half_axes[: self.velocity.joint_directions.shape[1]].tolist()))


def force_ellipsoid(J: ArrayLike, scale: ArrayLike | None = None) -> ForceEllipsoid:
    """Return the ellipsoid of forces of one Jacobian block.

    Parameters
    ----------
    J : array_like, shape (m, n)
        One to three rows of one unit: of linear velocities for forces in N, or of angular ones for moments in N m.
        The moments or forces of the other rows are zero.
    scale : array_like, shape (n,), optional
        Speed of each joint, rad/s or m/s, that counts as 1, as in `velocity_ellipsoid`. Torques are then counted as
        powers, ``tau_i scale_i`` in W; without it every joint's own unit counts, N m or N.

    Raises
    ------
    InputError
        As of `velocity_ellipsoid`.

    References
    ----------
    Yoshikawa, *Manipulability of Robotic Mechanisms*, 1985; notes, section 5.4.1 and 5.164.

    Examples
    --------
    >>> found = force_ellipsoid([[0.0, -2.0], [1.0, 0.0]])
    >>> found.axes.tolist(), found.half_axes.tolist(), found.w
    ([[1.0, 0.0], [0.0, 1.0]], [0.5, 1.0], 0.5)
    """
    return ForceEllipsoid(velocity_ellipsoid(J, scale))
