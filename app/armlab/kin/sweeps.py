"""The curve of the tool point when one joint alone moves: a circular arc or a straight line."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats

Floats = NDArray[np.float64]

NO_RADIUS = 1e-9
"""Distance of the tool point from an axis, relative to the reach, below which the joint does not move it."""


@dataclass(frozen=True, eq=False)
class Sweeps:
    """The curves of all joints at one configuration, in closed form.

    Attributes
    ----------
    centre : ndarray, shape (n, 3)
        Centre in the world, metres: for a revolute joint the foot of the tool point on its axis; for a prismatic one
        the tool point at q_i = 0.
    axes : ndarray, shape (n, 3, 3)
        Columns are x, y and z of the curve in the world: z is the joint axis; x of a revolute joint points from the
        axis to where the tool point is at q_i = 0. Where the radius is zero, x is any normal of z.
    radius : ndarray, shape (n,)
        Distance of the tool point from the axis; zero for prismatic joints.
    revolute : ndarray, shape (n,)
    """

    centre: Floats
    axes: Floats
    radius: Floats
    revolute: NDArray[np.bool_]

    def at(self, values: ArrayLike) -> Floats:
        """Return the tool point in the world with joint i alone at its i-th value.

        Parameters
        ----------
        values : array_like, shape (..., n)
            Radians or metres.

        Returns
        -------
        ndarray, shape (..., n, 3)
        """
        value = np.asarray(values, dtype=float)[..., None]
        x, y, z = self.axes[:, :, 0], self.axes[:, :, 1], self.axes[:, :, 2]
        turned = self.radius[:, None] * (np.cos(value) * x + np.sin(value) * y)
        found: Floats = self.centre + np.where(self.revolute[:, None], turned, value * z)
        return found


def sweeps(arm: Arm, q: ArrayLike) -> Sweeps:
    """Return the curve of the tool point for each joint alone, the others as they are.

    Parameters
    ----------
    arm : Arm
    q : array_like, shape (n,)
        Radians or metres.

    Raises
    ------
    InputError
        Not n finite numbers.

    Notes
    -----
    By definition of the screw motions of the joints: turning about the axis through o along z moves a point p on the
    circle about the foot of p on the axis, and its velocity is the column ``z x (p - o)`` of the Jacobian (notes
    5.52-5.65). Axis i is z_{i-1} in a standard and z_i in a modified table.
    """
    values = as_floats(q, "q", f"{arm.n} numbers")
    if values.shape != (arm.n,):
        raise InputError(f"q: expected shape ({arm.n},), got {values.shape}")
    frames = np.asarray(arm.frames(values), dtype=float)
    tool = frames[-1, :3, :3] @ arm.tool[:3, 3] + frames[-1, :3, 3]
    on_axis = frames[:-1] if arm.convention == "standard" else frames[1:]
    z = on_axis[:, :3, 2]
    from_origin = tool - on_axis[:, :3, 3]
    foot = np.sum(from_origin * z, axis=1)[:, None] * z
    radial = from_origin - foot
    radius = np.where(arm.revolute, np.linalg.norm(radial, axis=1), 0.0)
    off = radius > NO_RADIUS * (arm.reach or 1.0)
    radius = np.where(off, radius, 0.0)
    now = np.where(off[:, None], radial / np.where(off, radius, 1.0)[:, None], on_axis[:, :3, 0])
    x = _turned_back(now, z, np.where(arm.revolute, values, 0.0))
    centre = np.where(arm.revolute[:, None], tool - radius[:, None] * now, tool - values[:, None] * z)
    return Sweeps(centre, np.stack([x, np.cross(z, x), z], axis=2), radius, arm.revolute)


def _turned_back(x: Floats, z: Floats, angle: Floats) -> Floats:
    """Return unit normals x of z turned about z by minus the angle, shape (n, 3)."""
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    turned: Floats = c * x - s * np.cross(z, x)
    return turned


def arc(angle: float, radius: float = 1.0, largest_step: float = 0.1) -> Floats:
    """Return points of an arc about z from the x axis through an angle, both ends included.

    Parameters
    ----------
    angle : float
        Radians; negative ones go clockwise seen against z.
    radius : float
        Metres.
    largest_step : float
        Radians between neighbouring points at most.

    Returns
    -------
    ndarray, shape (k, 3)

    Examples
    --------
    >>> arc(np.pi / 2, 2.0).round(6)[[0, -1]].tolist()
    [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0]]
    """
    angles = np.linspace(0.0, angle, 2 + int(abs(angle) / largest_step))
    return radius * np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1)
