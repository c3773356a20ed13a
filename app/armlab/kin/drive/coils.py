"""Forces and torque on coils in a magnetic field, with a commutator or without (notes 2.2-2.3, figures 2.3-2.5).

A coil has two straight sides of length l along the axis of the rotor, at the distance r from it, and some turns of
wire. The field B is uniform and across the axis. The angle theta is that between the lever arm of the first side and
the line along which the forces act, so that the torque of one coil is tau_1 sin theta and is zero at every multiple of
pi.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.checks import as_floats, whole_number, wrong
from armlab.kin.field import positive

Array = NDArray[np.float64]

AXIS = np.array([0.0, 1.0, 0.0])
FIELD = np.array([1.0, 0.0, 0.0])
"""Unit vectors along the axis of the rotor and along the field, from the north to the south pole."""

UP = np.cross(FIELD, AXIS)
"""Unit vector along the lever arm of the first side at theta = 0, and along the forces."""

MOST_COILS = 12


@dataclass(frozen=True)
class Coil:
    """A coil of wire in a uniform field.

    Attributes
    ----------
    B : float
        Flux density, T.
    current : float
        A.
    length : float
        Of one side along the axis, m.
    radius : float
        Distance of the sides from the axis, m.
    turns : int
    """

    B: float
    current: float
    length: float
    radius: float
    turns: int = 1

    @property
    def force(self) -> float:
        """The force on one side with all its turns, N: turns I l B (2.2)."""
        return self.turns * self.current * self.length * self.B

    @property
    def peak(self) -> float:
        """The largest torque of the coil, N m: 2 r F (2.3)."""
        return 2.0 * self.radius * self.force

    def sides(self, theta: float, switched: bool = True) -> tuple[Array, Array, Array]:
        """Return lever arms, currents along the wire and forces of both sides, shape (2, 3) each.

        Parameters
        ----------
        theta : float
            Radians.
        switched : bool
            Whether a commutator reverses the current at every multiple of pi.

        Returns
        -------
        arms : ndarray
            From the axis to each side, m.
        wires : ndarray
            Unit vectors along the current.
        forces : ndarray
            N, of all turns: I (l x B), notes 2.2.
        """
        arm = self.radius * (math.cos(theta) * UP + math.sin(theta) * np.cross(AXIS, UP))
        sign = float(reversal(theta)) if switched else 1.0
        wires = np.array([sign * AXIS, -sign * AXIS])
        forces = self.turns * self.current * np.cross(self.length * wires, self.B * FIELD)
        return np.array([arm, -arm]), wires, forces

    def torque_vector(self, theta: float, switched: bool = True) -> Array:
        """Return T = r_1 x F_1 + r_2 x F_2, N m, shape (3,). Notes 2.3."""
        arms, _, forces = self.sides(theta, switched)
        return np.asarray(np.cross(arms, forces).sum(axis=0))


def reversal(theta: ArrayLike) -> Array:
    """Return the sign that the commutator gives the current: 1 in the first half of a turn, -1 in the second."""
    return np.where(np.mod(theta, 2.0 * math.pi) < math.pi, 1.0, -1.0)


def torque(theta: ArrayLike, coils: int = 1, switched: bool = True) -> Array:
    """Return the torque of coils at equal angles, relative to the largest one of a single coil.

    It is the sum of |sin(theta + k pi / N)| over the coils with a commutator, and of the sines without one. All coils
    carry the same current, as they do in series.

    Parameters
    ----------
    theta : array_like
        Radians.
    coils : int
        N.
    switched : bool

    Returns
    -------
    ndarray
        Of the shape of theta.
    """
    each = single_torques(theta, coils, switched)
    return np.asarray(each.sum(axis=-1))


def single_torques(theta: ArrayLike, coils: int = 1, switched: bool = True) -> Array:
    """Return the torque of every coil, shape (..., N); see `torque`."""
    count = whole_number(coils, "coils", 1)
    at = np.asarray(theta, dtype=np.float64)[..., None] + math.pi / count * np.arange(count)
    return np.abs(np.sin(at)) if switched else np.sin(at)


def extremes(coils: int) -> tuple[float, float, float]:
    """Return least, largest and mean torque of coils with a commutator, relative to the largest of one coil.

    The sum of the sines of N angles pi/N apart is cos(theta - pi/2N) / sin(pi/2N) while theta is between 0 and pi/N.

    >>> extremes(2)
    (1.0000000000000002, 1.4142135623730951, 1.2732395447351628)
    """
    half = 0.5 * math.pi / whole_number(coils, "coils", 1)
    if coils == 1:
        return 0.0, 1.0, 2.0 / math.pi
    return 1.0 / math.tan(half), 1.0 / math.sin(half), 1.0 / half


def ripple(coils: int) -> float:
    """Return the torque ripple of coils with a commutator: largest less least torque, over the mean.

    In closed form pi/(2N) tan(pi/(4N)), which falls as pi²/(8 N²). It is also the ripple of a brushless motor with N
    phases and sinusoidal voltages whose currents are switched in blocks: its torque follows the top of a sine, too.

    >>> f"{ripple(1):.4f}", f"{ripple(3):.4f}"
    ('1.5708', '0.1403')
    """
    half = 0.5 * math.pi / whole_number(coils, "coils", 1)
    return half * math.tan(0.5 * half)


@dataclass(frozen=True)
class Released:
    """The motion of a rotor that is let go.

    Attributes
    ----------
    t : ndarray, shape (N,)
        Seconds.
    theta : ndarray, shape (N,)
        Radians.
    omega : ndarray, shape (N,)
        rad/s.
    """

    t: Array
    theta: Array
    omega: Array


def let_go(
    peak: float,
    inertia: float,
    friction: float,
    start: float,
    duration: float,
    coils: int = 1,
    switched: bool = True,
    points: int = 601,
) -> Released:
    """Return how a rotor turns by the torque of its coils alone: J theta'' = tau(theta) - F theta'.

    Parameters
    ----------
    peak : float
        Largest torque of one coil, N m.
    inertia : float
        kg m², positive.
    friction : float
        Viscous, N m s/rad, not negative.
    start : float
        Radians, at rest.
    duration : float
        Seconds, positive.
    coils : int
    switched : bool
        Whether there is a commutator.
    points : int

    Notes
    -----
    The Runge-Kutta method of order 4, with steps of `STEP` or less of the angle and of the swing. With a commutator the
    torque has a kink at every multiple of pi/N, and a step that would pass one ends there.
    """
    J, end = positive(inertia, "J"), positive(duration, "T")
    F = float(as_floats(friction, "F", "no negative number"))
    if not 0.0 <= F < math.inf:
        raise wrong("F", "no negative number", friction)
    # With a commutator the torque is an even function of the angle: the other sign of the current mirrors the motion.
    mirror = -1.0 if switched and peak < 0.0 else 1.0
    rotor = _Rotor(abs(peak) if switched else peak, J, F, whole_number(coils, "coils", 1), switched)
    t = np.linspace(0.0, end, whole_number(points, "points", 2))
    found = np.array(list(rotor.moved(mirror * float(start), t.tolist())))
    return Released(t, mirror * found[:, 0], mirror * found[:, 1])


STEP = 0.08
"""Largest step of a rotor that is let go, radians of its turn and of its own swing."""


def quickness(peak: float, inertia: float, friction: float, coils: int = 1) -> float:
    """Return a rate that neither the swing of a rotor nor the decay of its speed exceeds: sqrt(|peak| N / J) + F / J.

    `let_go` takes at least duration times quickness over `STEP` steps. See there for the parameters.

    Returns
    -------
    float
        1/s.
    """
    return math.sqrt(abs(peak) * coils / inertia) + friction / inertia


@dataclass(frozen=True)
class _Rotor:
    """A rotor with the torque of its coils and with friction."""

    peak: float
    J: float
    F: float
    coils: int
    switched: bool

    def moved(self, theta: float, times: list[float]) -> Iterator[tuple[float, float]]:
        """Yield angle and speed at rising times, from rest at an angle."""
        omega, part = 0.0, math.pi / self.coils
        branch = math.floor(theta / part) if self.switched else 0
        swing = quickness(self.peak, self.J, self.F, self.coils)
        yield theta, omega
        for start, stop in pairwise(times):
            left = stop - start
            while left > 0.0:
                h = min(left, STEP / max(abs(omega), swing, STEP / left))
                ahead, faster = self._step(theta, omega, h, branch)
                kink = (branch + 1) * part
                if self.switched and ahead >= kink and omega > 0.0:
                    # A few secants end the step at the kink, as exactly as the step itself is.
                    for _ in range(4):
                        h = min(max(h - (ahead - kink) / faster, 0.0), left)
                        ahead, faster = self._step(theta, omega, h, branch)
                    branch, ahead = branch + 1, kink
                theta, omega, left = ahead, faster, left - h
            yield theta, omega

    def _step(self, theta: float, omega: float, h: float, branch: int) -> tuple[float, float]:
        """Return angle and speed after one step, with the torque of one branch between two kinks."""
        half = 0.5 * h
        a1 = self._acceleration(theta, omega, branch)
        w2 = omega + half * a1
        a2 = self._acceleration(theta + half * omega, w2, branch)
        w3 = omega + half * a2
        a3 = self._acceleration(theta + half * w2, w3, branch)
        w4 = omega + h * a3
        a4 = self._acceleration(theta + h * w3, w4, branch)
        sixth = h / 6.0
        return theta + sixth * (omega + 2.0 * (w2 + w3) + w4), omega + sixth * (a1 + 2.0 * (a2 + a3) + a4)

    def _acceleration(self, theta: float, omega: float, branch: int) -> float:
        half = 0.5 * math.pi / self.coils
        if self.switched and self.coils == 1:
            # The cosine below would not be zero at the dead point, only nearly so.
            turning = math.sin(theta - branch * math.pi)
        elif self.switched:
            turning = math.cos(theta - (2 * branch + 1) * half) / math.sin(half)
        else:
            turning = math.sin(theta + (self.coils - 1) * half) / math.sin(half)
        return (self.peak * turning - self.F * omega) / self.J
