"""The torque at the present angle, from the forces, and over a turn, sampled: the second way to all numbers."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.drive.torque.state import Torque, present_angle
from armlab.kin.drive.coils import AXIS, single_torques, torque
from armlab.session.state import State

Floats = NDArray[np.float64]

SAMPLES = 7200
"""Number of angles of a turn that are looked at: half a tenth of a degree from one to the next."""

NOTHING = 1e-9
"""Torque, relative to the largest of one coil, that is none."""


@dataclass(frozen=True, eq=False)
class Sampled:
    """The torque now and over a turn.

    Attributes
    ----------
    angle : float
        Radians.
    arms, wires, forces : ndarray, shape (2, 3)
        Of both sides of the first coil now: m, directions of the current, N.
    vector : ndarray, shape (3,)
        r_1 x F_1 + r_2 x F_2 of the first coil now, N m.
    single : ndarray, shape (N,)
        Of every coil now, about the axis, N m.
    least, largest, mean : float
        Of the sampled turn, N m.
    zeros : int
        Angles of a turn at which there is no torque though there is a current.
    """

    angle: float
    arms: Floats
    wires: Floats
    forces: Floats
    vector: Floats
    single: Floats
    least: float
    largest: float
    mean: float
    zeros: int

    @property
    def now(self) -> float:
        """The torque of all coils now, N m."""
        return float(self.single.sum())

    @property
    def along(self) -> float:
        """The component of the vector along the axis, N m."""
        return float(self.vector @ AXIS)

    @property
    def between(self) -> float:
        """The angle between lever arm and force of the first side, radians; 0 without a force."""
        product = float(np.linalg.norm(self.arms[0]) * np.linalg.norm(self.forces[0]))
        return math.acos(min(max(float(self.arms[0] @ self.forces[0]) / product, -1.0), 1.0)) if product else 0.0


def sampled_of(state: State) -> Sampled:
    """Return the torque at the present angle and over a turn."""
    part, angle = state[Torque], present_angle(state)
    coil = part.coil
    arms, wires, forces = coil.sides(angle, part.switched)
    over = coil.peak * torque(np.linspace(0.0, 2.0 * math.pi, SAMPLES, endpoint=False), part.coils, part.switched)
    return Sampled(
        angle,
        arms,
        wires,
        forces,
        coil.torque_vector(angle, part.switched),
        coil.peak * single_torques(angle, part.coils, part.switched),
        float(over.min()),
        float(over.max()),
        float(over.mean()),
        _zeros(over / coil.peak) if coil.peak else 0,
    )


def _zeros(torques: Floats) -> int:
    """Return how often torques over a turn, in torques of one coil, are zero or change their sign."""
    signs = np.where(np.abs(torques) <= NOTHING, 0.0, np.sign(torques))
    return int((signs == 0.0).sum() + (signs * np.roll(signs, -1) < 0.0).sum())


def curve(part: Torque, points: int) -> tuple[Floats, Floats, Floats]:
    """Return angles of a turn, and there the torque of all coils and of the first one, N m, shape (points,) each."""
    theta = np.linspace(0.0, 2.0 * math.pi, points)
    single = part.coil.peak * single_torques(theta, part.coils, part.switched)
    return theta, np.asarray(single.sum(axis=-1)), np.asarray(single[..., 0])
