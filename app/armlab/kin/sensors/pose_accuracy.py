"""Pose accuracy and repeatability of an arm: the figures AP and RP of ISO 9283, and an arm that is commanded n times.

Position and orientation each have figures of their own; metres and radians are never added. For a pose that is
commanded and attained n times,

    AP  = |mean - p_c|                            accuracy of position
    RP  = mean of l + 3 S_l,  l_j = |p_j - mean|  repeatability of position
    AP_a = mean of a - a_c,   RP_a = +- 3 S_a     of each angle of the orientation

with the standard deviations S of n - 1. Orientations are compared by their rotation vectors from the commanded one,
about the axes x, y, z of the world, radians; for the small angles between attained poses these are the three angles
of the standard, whatever the order of its axes.

References
----------
Notes, sections 1.7 and 2.3; ISO 9283, pose accuracy and pose repeatability, where n is 30.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats, finite_floats, whole_number, wrong
from armlab.kin.rotations import axis_angle
from armlab.kin.sensors.repeatability import Scatter, scatter_of
from armlab.registry import known_name

Floats = NDArray[np.float64]

MOST_TIMES = 1000

STANDARD = 30
"""Number of times that the standard asks for."""

APPROACHES = {"same": "from the same side", "either": "from either side"}


@dataclass(frozen=True, eq=False)
class JointErrors:
    """Errors of the joints of an arm, rad or m.

    Attributes
    ----------
    count : ndarray, shape (n,)
        Angle or length of one count of the encoder: the joint stops anywhere within it.
    backlash : ndarray, shape (n,)
        Play of the gears that no encoder sees: the joint stops half of it short of where its motor is. With an encoder
        on the link it is 0, whatever play there is.
    zero : ndarray, shape (n,)
        Error of the zero, the same every time.
    """

    count: Floats
    backlash: Floats
    zero: Floats

    def spread(self, approach: str) -> Floats:
        """Return the standard deviation of each joint, (n,): of an even distribution, and of two sides by chance."""
        sides = self.backlash / 2.0 if approach == "either" else 0.0 * self.backlash
        return np.asarray(np.sqrt(self.count**2 / 12.0 + sides**2))


def attained(
    q: ArrayLike, errors: JointErrors, times: int, approach: str = "same", seed: int = 0
) -> tuple[Floats, NDArray[np.bool_]]:
    """Return the joint values at which an arm stops that is sent to the same ones n times.

    Parameters
    ----------
    q : array_like, shape (n,)
        Commanded, rad or m.
    errors : JointErrors
    times : int
        2 to `MOST_TIMES`.
    approach : "same" or "either"
        From below every time, or each joint from above or below by chance.
    seed : int

    Returns
    -------
    q : ndarray, shape (times, n)
    below : ndarray of bool, shape (times, n)
        Whether the joint came from below.

    Raises
    ------
    InputError
        The arguments are not as above.
    """
    wanted = as_floats(q, "q", "joint values")
    if whole_number(times, "times", 2) > MOST_TIMES:
        raise wrong("times", f"at most {MOST_TIMES}", times)
    known_name("approach", approach, APPROACHES)
    random = np.random.default_rng(whole_number(seed, "seed", 0))
    draws = random.random((times, 2, len(wanted)))
    below = (draws[:, 1] < 0.5) if approach == "either" else np.ones((times, len(wanted)), dtype=bool)
    side = np.where(below, -0.5, 0.5)
    stops = wanted + errors.zero + (draws[:, 0] - 0.5) * errors.count + side * errors.backlash
    return np.asarray(stops), below


@dataclass(frozen=True, eq=False)
class PoseFigures:
    """AP and RP of attained poses.

    Parameters
    ----------
    commanded : ndarray, shape (4, 4)
    poses : ndarray, shape (n, 4, 4)
        Attained, at least two.

    Raises
    ------
    InputError
        The shapes do not fit.
    """

    commanded: Floats
    poses: Floats

    def __post_init__(self) -> None:
        finite_floats(self.commanded, "commanded", (4, 4), "a pose (4, 4)")
        if self.poses.ndim != 3 or self.poses.shape[1:] != (4, 4) or len(self.poses) < 2:
            raise InputError(f"attained: expected at least two poses (4, 4), got shape {self.poses.shape}")

    @cached_property
    def position(self) -> Scatter:
        """AP and RP of the position."""
        return scatter_of(self.poses[:, :3, 3], self.commanded[:3, 3])

    @cached_property
    def turns(self) -> Floats:
        """Rotation vectors from the commanded orientation to the attained ones about the world's axes, (n, 3)."""
        axes, angles = axis_angle(self.poses[:, :3, :3] @ self.commanded[:3, :3].T)
        return np.asarray(axes * np.asarray(angles)[..., None])

    @property
    def turn_accuracy(self) -> Floats:
        """AP of the angles about x, y and z, (3,), radians."""
        return np.asarray(self.turns.mean(axis=0))

    @property
    def turn_repeatability(self) -> Floats:
        """RP of the angles about x, y and z, (3,), radians: a band of plus and minus that."""
        return np.asarray(3.0 * self.turns.std(axis=0, ddof=1))


def shares(arm: Arm, q: ArrayLike, errors: JointErrors, approach: str) -> Floats:
    """Return how far each joint alone spreads the tool point: standard deviation to first order, (n,), metres.

    ``|J_i| sigma_i``, with the linear part of the column of the joint.
    """
    J = arm.jacobian(q)[:3]
    return np.asarray(np.linalg.norm(J, axis=0) * errors.spread(approach))


def expected_spread(arm: Arm, q: ArrayLike, errors: JointErrors, approach: str) -> float:
    """Return the root mean square of the distances l to first order, metres: the shares of all joints together."""
    return math.sqrt(float((shares(arm, q, errors, approach) ** 2).sum()))
