"""Two equal motors that differ by an angle, and the two vectors of which only one is a state (2.12)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.drive.motor.state import Motor
from armlab.kin.drive.motor_run import MotorRun, transition
from armlab.session.state import State

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Twins:
    """Differences of two runs, and how far both vectors are from fulfilling dx/dt = A x + B u.

    Attributes
    ----------
    printed : float
        Largest difference of (di/dt, d²theta/dt², dtheta/dt) of both motors, in its own units.
    right : float
        Largest difference of (i, omega, theta).
    position : float
        Largest difference of theta, rad.
    printed_rest, right_rest : float
        Largest |dx/dt - A x - B u| with either vector for x, in units of its first component, 1/s.
    """

    printed: float
    right: float
    position: float
    printed_rest: float
    right_rest: float


def twins_of(state: State) -> Twins:
    """Return how the motor and its twin differ."""
    part = state[Motor]
    one, other = part.run, part.second
    return Twins(
        float(np.abs(other.rates - one.rates).max()),
        float(np.abs(other.states - one.states).max()),
        float(np.abs(other.theta - one.theta).max()),
        rest(one, True),
        rest(one, False),
    )


STENCIL = {-2: 1.0 / 12.0, -1: -2.0 / 3.0, 1: 2.0 / 3.0, 2: -1.0 / 12.0}
"""Weights of the values some steps away in a derivative that is right to the fourth power of the step."""

FINE = 0.01
"""The step, in time constants of the fastest pole: the derivative is then right to about 1e-10 of itself."""


def rest(run: MotorRun, printed: bool) -> float:
    """Return the largest |dx/dt - A x - B u| along a run, for the printed vector or for (i, omega, theta) as x.

    dx/dt is a difference of values before and after, which the run itself has there; A and B are those of the motor.
    """
    motor, n = run.motor, len(run.motor.A)
    step = FINE / float(np.abs(motor.poles).max())
    u = np.stack([run.v, run.load], axis=-1)
    slope: Floats = np.zeros((len(run.t), n))
    for steps, weight in STENCIL.items():
        phi, gamma = transition(motor, steps * step)
        slope = slope + weight / step * _vectors(run, run.states[:, 3 - n :] @ phi.T + u @ gamma.T, printed)
    x = _vectors(run, run.states[:, 3 - n :], printed)
    return float(np.abs(slope - x @ motor.A.T - u @ motor.B.T).max())


def _vectors(run: MotorRun, states: Floats, printed: bool) -> Floats:
    """Return what stands for x at some states (N, n): they themselves, or the printed vector."""
    if not printed:
        return states
    motor, n = run.motor, states.shape[1]
    current = states[:, 0] if n == 3 else motor.current(states[:, 0], run.v)
    return motor.rates(current, states[:, n - 2], run.v, run.load)[:, 3 - n :]
