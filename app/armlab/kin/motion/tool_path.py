"""The motion of a tool: a path of its tool point and an orientation over one parameter."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import finite_floats
from armlab.kin.motion.breaks import merged
from armlab.kin.motion.orientation import Orientation
from armlab.kin.motion.path import Path
from armlab.kin.transforms import transform

Floats = NDArray[np.float64]


class ToolPath:
    """Poses along s in [0, 1].

    With ``point`` at the centre of a spherical wrist the planning is decoupled (notes, end of section 6.3.2): the path
    is planned for the wrist, which the first joints move, the orientation for the last three, and both share s and so
    one timing law. The tool itself then moves on another curve.

    Parameters
    ----------
    position : Path
        Path of the point, in the world, metres, three coordinates.
    orientation : Orientation
        Orientation of the tool in the world.
    point : array_like, shape (3,), optional
        The point of the tool that follows the path, in tool axes, metres; the tool point itself when left out.

    Attributes
    ----------
    pieces : ndarray, shape (k,)
        Interior s between which everything is smooth.
    corners : ndarray, shape (c,)
        Those of them at which the twist jumps.
    remarks : tuple of str

    Raises
    ------
    InputError
        A path that is not in space, or a point that is not three numbers.
    """

    def __init__(self, position: Path, orientation: Orientation, point: ArrayLike | None = None) -> None:
        if position.m != 3:
            raise InputError(f"position: expected a path with 3 coordinates, got {position.m}")
        self.position, self.orientation = position, orientation
        self.point = finite_floats(np.zeros(3) if point is None else point, "point", (3,), "three finite numbers")
        self.pieces = merged([position.pieces, orientation.pieces], 0.0, 1.0)
        self.corners = merged([position.corners, orientation.corners], 0.0, 1.0)
        self.remarks = (*position.remarks, *orientation.remarks)

    def pose(self, s: ArrayLike) -> Floats:
        """Return poses of the tool in the world, (..., 4, 4) from s of shape (...)."""
        R = self.orientation.rotation(s)
        return np.asarray(transform(R, self.position.at(s) - R @ self.point))

    def twist(self, s: ArrayLike) -> Floats:
        """Return (dp/ds; omega) of the tool point per unit of s, world axes, (..., 6)."""
        omega, _ = self.orientation.angular(s)
        arm = self.orientation.rotation(s) @ self.point
        return np.concatenate([self.position.at(s, 1) - np.cross(omega, arm), omega], axis=-1)

    def twist_rate(self, s: ArrayLike) -> Floats:
        """Return the derivative of `twist` with respect to s, (..., 6)."""
        omega, change = self.orientation.angular(s)
        arm = self.orientation.rotation(s) @ self.point
        bend = np.cross(change, arm) + np.cross(omega, np.cross(omega, arm))
        return np.concatenate([self.position.at(s, 2) - bend, change], axis=-1)
