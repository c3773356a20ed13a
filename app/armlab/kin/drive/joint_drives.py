"""The drives of all joints of an arm: gear, encoder and backlash, and what one count is at the joint."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats, wrong

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

LEAD = 0.01
"""Usual lead of a spindle, metres."""


@dataclass(frozen=True, eq=False)
class JointDrives:
    """Motor, gear and encoder of each joint; make one with `joint_drives`.

    A sliding joint has a lead screw behind its gear, which moves it by the lead in a turn.

    Attributes
    ----------
    turn : ndarray, shape (n,)
        Motion of the joint in one turn behind the gear: 2 pi rad, or the lead of the screw in metres.
    ratio : ndarray, shape (n,)
        Turns of the motor for one turn behind the gear, positive.
    counts : ndarray, shape (n,)
        Of the encoder in one turn of its shaft.
    at_motor : ndarray of bool, shape (n,)
        Whether the encoder is on the shaft of the motor; else it sees the joint itself.
    backlash : ndarray, shape (n,)
        By how much the joint can move while the motor stands still, rad or m.
    """

    turn: Floats
    ratio: Floats
    counts: Floats
    at_motor: Flags
    backlash: Floats

    @property
    def count(self) -> Floats:
        """One count at the joint, rad or m, shape (n,): a turn over the counts and, at the motor, over the ratio."""
        return np.asarray(self.turn / (self.counts * np.where(self.at_motor, self.ratio, 1.0)))

    @property
    def half_width(self) -> Floats:
        """By how much each joint may be to either side of what is read, rad or m, shape (n,).

        One count, and behind an encoder at the motor half the backlash: that encoder does not see it.
        """
        return np.asarray(self.count + np.where(self.at_motor, 0.5 * self.backlash, 0.0))

    def motor_speeds(self, qdot: ArrayLike) -> Floats:
        """Return the speeds of the motors, rad/s, for joint speeds (n,) in rad/s or m/s: ``n q'`` (notes 2.34)."""
        return np.asarray(self.ratio * 2.0 * math.pi / self.turn * np.asarray(qdot, dtype=np.float64))

    def motor_torques(self, tau: ArrayLike) -> Floats:
        """Return the torques of the motors, N m, for torques or forces (n,) of the joints: ``tau/n`` (notes 2.35).

        Without losses; a screw makes ``F lead/(2 pi n)`` of a force.
        """
        return np.asarray(np.asarray(tau, dtype=np.float64) * self.turn / (2.0 * math.pi * self.ratio))


def joint_drives(
    arm: Arm,
    ratio: ArrayLike,
    counts: ArrayLike,
    at_motor: ArrayLike = True,
    backlash: ArrayLike = 0.0,
    lead: ArrayLike = LEAD,
) -> JointDrives:
    """Return checked drives; one value stands for all joints.

    Parameters
    ----------
    arm : Arm
    ratio, counts : array_like, shape (n,)
        Positive.
    at_motor : array_like of bool, shape (n,)
    backlash : array_like, shape (n,)
        Rad or m, not negative.
    lead : array_like, shape (n,)
        Metres in a turn, positive, also of joints that turn, where it has no effect.

    Raises
    ------
    InputError
        A value that is out of range or not finite, or another number of them; the text names the joint.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("P", 0.0, 0.0, 0.0, 0.0)])
    >>> found = joint_drives(arm, 100.0, 4000.0)
    >>> np.degrees(found.count[0]).round(6).item(), found.count[1].round(12).item()
    (0.0009, 2.5e-08)
    """
    leads = _each(lead, "lead of the screw", arm.n, above=True)
    return JointDrives(
        np.where(arm.revolute, 2.0 * math.pi, leads),
        _each(ratio, "ratio", arm.n, above=True),
        _each(counts, "counts of the encoder", arm.n, above=True),
        _flags(at_motor, "encoder at the motor", arm.n),
        _each(backlash, "backlash", arm.n, above=False),
    )


def _flags(values: ArrayLike, where: str, n: int) -> Flags:
    expected = f"{n} values, true or false"
    array = as_floats(values, where, expected)
    if array.shape not in ((), (n,)):
        raise InputError(f"{where}: expected {expected}, got shape {array.shape}")
    if not np.isin(array, (0.0, 1.0)).all():
        # None, which becomes no number, and 2 are not 0, yet no flags either.
        raise wrong(where, expected, values)
    return np.array(np.broadcast_to(array != 0.0, (n,)))


def _each(values: ArrayLike, where: str, n: int, above: bool) -> Floats:
    expected = "a positive number" if above else "no negative number"
    array = as_floats(values, where, f"{n} numbers")
    if array.shape not in ((), (n,)):
        raise InputError(f"{where}: expected {n} numbers, got shape {array.shape}")
    array = np.array(np.broadcast_to(array, (n,)))
    for i, value in enumerate(array.tolist()):
        if not math.isfinite(value) or value < 0.0 or (above and value == 0.0):
            raise InputError(f"{where} of joint {i + 1}: expected {expected}, got {value:g}")
    return array
