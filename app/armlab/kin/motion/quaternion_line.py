"""Orientation along s by a straight line between two quaternions, divided by its length at each place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.motion.orientation import Orientation
from armlab.kin.quaternions import conjugate, product, unit
from armlab.kin.rotations import rotation_from_quaternion

Floats = NDArray[np.float64]

OPPOSITE = 1e-9
"""Length of the middle of the line below which it leads through zero, where there is no direction."""


@dataclass(frozen=True, eq=False)
class QuaternionLine(Orientation):
    """The line from one unit quaternion to another, normalised. Make one with `along_line`.

    It turns about one axis, as `about_one_axis` does, and in the same sense, but slower at its ends and faster in its
    middle.

    Attributes
    ----------
    start, end : ndarray, shape (4,)
        Unit quaternions, scalar first.
    remarks : tuple of str
    """

    start: Floats
    end: Floats
    remarks: tuple[str, ...] = ()

    def quaternion(self, s: ArrayLike) -> Floats:
        """Return the unit quaternions at s, (..., 4)."""
        share = np.asarray(s, dtype=float)[..., None]
        return unit((1.0 - share) * self.start + share * self.end)

    def rotation(self, s: ArrayLike) -> Floats:
        """Return R(s)."""
        return np.asarray(rotation_from_quaternion(self.quaternion(s)))

    def angular(self, s: ArrayLike) -> tuple[Floats, Floats]:
        """Return omega = 2 q' q^-1 and its derivative, (..., 3) each."""
        share = np.asarray(s, dtype=float)[..., None]
        line, step = (1.0 - share) * self.start + share * self.end, self.end - self.start
        square = np.sum(line * line, axis=-1, keepdims=True)
        # The vector part of step line^-1 is that of end start^-1 over the square of the length.
        turned = 2.0 * product(self.end, conjugate(self.start))[1:]
        slope = 2.0 * np.sum(line * step, axis=-1, keepdims=True)
        return np.asarray(turned / square), np.asarray(-turned * slope / square**2)


def along_line(p: ArrayLike, q: ArrayLike, *, shorter: bool = True) -> QuaternionLine:
    """Return the normalised line from one quaternion to another.

    Parameters
    ----------
    p, q : array_like, shape (4,)
        Not zero; they are normalised.
    shorter : bool
        Whether to go to that of q and -q which is nearer to p.

    Raises
    ------
    InputError
        Not quaternions, or p and -p, between which the line leads through zero.
    """
    start, end = unit(p), unit(q)
    if start.shape != (4,) or end.shape != (4,):
        raise InputError(f"p, q: expected one quaternion each, got shapes {start.shape} and {end.shape}")
    along = float(start @ end)
    if shorter and along < 0.0:
        end, along = -end, -along
    if np.linalg.norm(start + end) < OPPOSITE:
        raise InputError("p, q: the line from a quaternion to its opposite leads through zero, which is no rotation")
    half = abs(along) < OPPOSITE
    remarks = ("Half a turn apart: q and -q are as near, and either way is as short.",) if half else ()
    return QuaternionLine(start, end, remarks)
