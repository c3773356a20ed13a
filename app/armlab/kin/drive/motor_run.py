"""A DC motor over time, exactly, for voltage and load that are constant piece by piece."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.drive.motor import DcMotor, checked_start

Array = NDArray[np.float64]

EVEN, EARLY, FEWER = 480, 240, (8, 24)
"""Points of a run over its whole duration, those while the fastest transient of each piece lasts, of all pieces
together, and the least and largest number of these for one piece."""

FEWEST = 6
"""Least number of even points of a piece."""

LASTING = 6.0
"""Duration of a transient in time constants, after which 0.25 % of it are left."""

MOST_PIECES = 200
MOST_RATE = 1e8
"""Largest duration in time constants of the fastest pole: beyond it the exponential has lost half of its digits."""


@dataclass(frozen=True)
class Piece:
    """A while in which voltage and load are constant.

    Attributes
    ----------
    duration : float
        Seconds, positive.
    voltage : float
        V.
    load : float
        N m, against the torque of the motor.
    """

    duration: float
    voltage: float
    load: float


def transition(motor: DcMotor, h: float) -> tuple[Array, Array]:
    """Return Phi and Gamma of x(t + h) = Phi x(t) + Gamma u, exact for a constant input u.

    Both are blocks of the exponential of the augmented matrix [[A, B], [0, 0]] h. It is formed of current and speed
    times the roots of L and J, whose squares are energies: scaled so, no entry of Phi for them exceeds 1.

    Parameters
    ----------
    motor : DcMotor
    h : float
        Seconds.

    Returns
    -------
    Phi : ndarray, shape (n, n)
    Gamma : ndarray, shape (n, 2)
        n is 3, or 2 without inductance.
    """
    return _transition(motor, h)


@lru_cache(maxsize=512)
def _transition(motor: DcMotor, h: float) -> tuple[Array, Array]:
    from scipy.linalg import expm  # type: ignore[import-untyped]

    roots = [math.sqrt(motor.J)] * 2 if motor.reduced else [math.sqrt(motor.L), *[math.sqrt(motor.J)] * 2]
    n, scale = len(roots), np.array(roots)
    augmented = np.zeros((n + 2, n + 2))
    augmented[:n, :n] = scale[:, None] * motor.A / scale
    augmented[:n, n:] = scale[:, None] * motor.B
    found = np.asarray(expm(augmented * h), dtype=np.float64)
    phi, gamma = found[:n, :n] * scale / scale[:, None], found[:n, n:] / scale[:, None]
    phi.flags.writeable = gamma.flags.writeable = False
    return phi, gamma


@dataclass(frozen=True, eq=False)
class MotorRun:
    """A motor over time. At a jump of voltage or load there are two samples of one time, before it and after it.

    Attributes
    ----------
    motor : DcMotor
    pieces : tuple of Piece
    starts : ndarray, shape (P, n)
        The state at the start of every piece.
    t : ndarray, shape (N,)
        Seconds, never falling.
    v, load, i, omega, theta : ndarray, shape (N,)
        V, N m, A, rad/s, rad.
    """

    motor: DcMotor
    pieces: tuple[Piece, ...]
    starts: Array
    t: Array
    v: Array
    load: Array
    i: Array
    omega: Array
    theta: Array

    @cached_property
    def edges(self) -> Array:
        """The times at which pieces begin, and the end, shape (P + 1,)."""
        return np.concatenate([[0.0], np.cumsum([piece.duration for piece in self.pieces])])

    @property
    def end(self) -> float:
        """The duration, seconds."""
        return float(self.edges[-1])

    def at(self, time: float) -> Moment:
        """Return the motor at a time in seconds, exactly; after a jump where there is one."""
        clipped = min(max(time, 0.0), self.end)
        k = min(int(np.searchsorted(self.edges, clipped, side="right")) - 1, len(self.pieces) - 1)
        piece = self.pieces[k]
        phi, gamma = transition(self.motor, clipped - float(self.edges[k]))
        x = phi @ self.starts[k] + gamma @ np.array([piece.voltage, piece.load])
        i, omega, theta = _full(self.motor, x, piece.voltage).tolist()
        return Moment(clipped, piece.voltage, piece.load, i, omega, theta)

    @property
    def rates(self) -> Array:
        """The derivatives (di/dt, domega/dt, dtheta/dt) at all samples, shape (N, 3)."""
        return self.motor.rates(self.i, self.omega, self.v, self.load)

    @property
    def states(self) -> Array:
        """The states (i, omega, theta) at all samples, shape (N, 3)."""
        return np.stack([self.i, self.omega, self.theta], axis=-1)


@dataclass(frozen=True)
class Moment:
    """A motor at one time: seconds, V, N m, A, rad/s, rad."""

    t: float
    v: float
    load: float
    i: float
    omega: float
    theta: float


def run(motor: DcMotor, pieces: Sequence[Piece], start: ArrayLike = (0.0, 0.0, 0.0)) -> MotorRun:
    """Return a motor over time, exact at every sample whatever the distance of samples is.

    Parameters
    ----------
    motor : DcMotor
    pieces : sequence of Piece
    start : array_like, shape (3,)
        i, omega, theta at the start; without inductance the current follows from the voltage and is not looked at.

    Returns
    -------
    MotorRun

    Raises
    ------
    InputError
        No pieces or too many, one that is not positive, or a duration of more than `MOST_RATE` fast time constants.

    Examples
    --------
    >>> motor = DcMotor(R=1.2, L=0.002, k=0.05, J=1e-4, F=2e-5)
    >>> found = run(motor, [Piece(0.2, 12.0, 0.1)])
    >>> round(float(found.omega[-1]), 6), round(float(found.theta[-1]), 6)
    (187.635918, 29.02738)
    """
    checked = check_pieces(motor, pieces)
    x = checked_start(start)[3 - len(motor.A) :]
    total = sum(piece.duration for piece in checked)
    fastest = 1.0 / float(np.abs(motor.poles).max())
    fine = min(max(EARLY // len(checked), FEWER[0]), FEWER[1])
    begun, starts, columns = 0.0, list[Array](), list[Array]()
    for piece in checked:
        u = np.array([piece.voltage, piece.load])
        count = max(FEWEST, round(EVEN * piece.duration / total))
        even = _stepped(motor, x, u, piece.duration, count)
        early = _stepped(motor, x, u, min(piece.duration, LASTING * fastest), fine)
        offsets, picked = np.unique(np.concatenate([even[0], early[0][1:-1]]), return_index=True)
        states = np.concatenate([even[1], early[1][1:-1]])[picked]
        full = _full(motor, states, piece.voltage)
        inputs = np.broadcast_to(u, (len(offsets), 2))
        columns.append(np.column_stack([begun + offsets, inputs, full]))
        starts.append(x)
        x, begun = even[1][-1], begun + piece.duration
    t, v, load, i, omega, theta = np.vstack(columns).T
    return MotorRun(motor, checked, np.array(starts), t, v, load, i, omega, theta)


def check_pieces(motor: DcMotor, pieces: Sequence[Piece]) -> tuple[Piece, ...]:
    """Return pieces that a run can be made of; `InputError` for others, see `run`."""
    if not 1 <= len(pieces) <= MOST_PIECES:
        raise InputError(f"pieces: expected 1 to {MOST_PIECES}, got {len(pieces)}")
    for k, piece in enumerate(pieces):
        numbers = (piece.duration, piece.voltage, piece.load)
        if not (all(map(math.isfinite, numbers)) and piece.duration > 0.0):
            raise InputError(f"piece {k + 1}: expected a positive duration, a voltage and a load, got {numbers}")
    total = sum(piece.duration for piece in pieces)
    rate = float(np.abs(motor.poles).max())
    if total * rate > MOST_RATE:
        raise InputError(
            f"duration: {total:g} s are {total * rate:.2g} times the fastest time constant of the motor, expected at "
            f"most {MOST_RATE:g} times; take L = 0, the model without inductance, or a shorter time"
        )
    return tuple(pieces)


def _stepped(motor: DcMotor, x: Array, u: Array, duration: float, count: int) -> tuple[Array, Array]:
    """Return equal steps of a piece: offsets (count + 1,) in seconds, and states (count + 1, n)."""
    phi, gamma = transition(motor, duration / count)
    pushed, states = gamma @ u, [x]
    for _ in range(count):
        states.append(phi @ states[-1] + pushed)
    return np.linspace(0.0, duration, count + 1), np.array(states)


def _full(motor: DcMotor, states: Array, voltage: float) -> Array:
    """Return states with the current in front, which without inductance follows from the voltage, shape (..., 3)."""
    if not motor.reduced:
        return states
    current = motor.current(states[..., 0], voltage)
    return np.concatenate([current[..., None], states], axis=-1)
