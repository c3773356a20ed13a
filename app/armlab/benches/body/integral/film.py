"""Two bodies that turn with the angular velocities of two time laws, each integrated exactly piece by piece."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.integral.state import AXIS, CLIP_KEY, Integral, Law
from armlab.kin.rotations import axis_angle
from armlab.kin.velocity.rigid import turned_by
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State

Floats = NDArray[np.float64]

POINTS = 161
"""Number of times at which the angle of R is drawn."""

EQUAL = 1e-9
"""Difference of a component of two integrals, and angle between two orientations, up to which they are equal, rad."""


@dataclass(frozen=True, eq=False)
class Run:
    """A body that turns by one law.

    Attributes
    ----------
    law : Law
    in_body : bool
        Whether omega is given in the axes of the body.
    """

    law: Law
    in_body: bool

    @cached_property
    def rates(self) -> Floats:
        """Omega of each piece in the axes in which it is given, (k, 3), rad/s."""
        axes = np.array([piece[:AXIS] for piece in self.law])
        units = axes / np.linalg.norm(axes, axis=1, keepdims=True)
        return np.asarray(units * np.array([[piece.rate] for piece in self.law]))

    @cached_property
    def starts(self) -> Floats:
        """Times at which the pieces begin, and the end of the last one, (k + 1,), seconds."""
        return np.concatenate([[0.0], np.cumsum([piece.seconds for piece in self.law])])

    @property
    def duration(self) -> float:
        """Seconds."""
        return float(self.starts[-1])

    def spent(self, times: float | Floats) -> Floats:
        """Return how long each piece has lasted at times (...), (..., k), seconds."""
        return np.clip(np.asarray(times)[..., None] - self.starts[:-1], 0.0, np.diff(self.starts))

    def piece_at(self, time: float) -> int:
        """Return the piece that lasts at a time, the last one afterwards, 0-based."""
        return int(np.clip(np.searchsorted(self.starts, time, side="right") - 1, 0, len(self.law) - 1))

    def at(self, times: float | Floats) -> Floats:
        """Return the orientation at times (...), (..., 3, 3), beginning with I: products of exponentials, no steps."""
        order = slice(None, None, -1 if self.in_body else 1)
        return turned_by(self.rates[order], self.spent(times)[..., order])

    def integral(self, time: float) -> Floats:
        """Return the integral of omega up to a time, (3,), radians."""
        return np.asarray(self.spent(time) @ self.rates)

    def axis(self, time: float) -> Floats:
        """Return the axis of the present piece in the base frame, (3,): that about which a positive rate turns."""
        k = self.piece_at(time)
        axis = np.array(self.law[k][:AXIS])
        axis = axis / np.linalg.norm(axis)
        return np.asarray(self.at(time) @ axis) if self.in_body else axis

    def turned(self, time: float) -> float:
        """Return how far the present piece has turned, radians."""
        k = self.piece_at(time)
        return float(self.spent(time)[k] * self.law[k].rate)

    def omega(self) -> tuple[Floats, Floats]:
        """Return times (2 k,) and omega there (2 k, 3): both ends of each piece, so that its jumps are upright."""
        times = np.repeat(self.starts, 2)[1:-1]
        return times, np.repeat(self.rates, 2, axis=0)


def runs_of(state: State) -> tuple[Run, Run]:
    """Return how both bodies turn."""
    part = state[Integral]
    one, other = (Run(law, part.about == "body") for law in part.laws)
    return one, other


def duration_of(state: State) -> float:
    """Return the time at which both laws have ended, seconds."""
    return max(run.duration for run in runs_of(state))


def stops_of(state: State) -> tuple[float, ...]:
    """Return the times before the end at which an angular velocity jumps."""
    end = duration_of(state)
    return tuple(sorted({float(start) for run in runs_of(state) for start in run.starts if 0.0 < start < end}))


def film_time(state: State) -> float:
    """Return the time of the film in seconds; its end while it is closed."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else duration_of(state)


def apart(state: State, time: float) -> float:
    """Return the angle between the bodies at a time, radians."""
    one, other = (run.at(time) for run in runs_of(state))
    return float(axis_angle(one.T @ other)[1])


def integrals_apart(state: State, time: float) -> float:
    """Return the largest difference of a component of both integrals at a time, radians."""
    one, other = (run.integral(time) for run in runs_of(state))
    return float(np.abs(one - other).max())


def angles_over_time(state: State) -> tuple[Floats, list[Floats]]:
    """Return times (N,), and of each law the angle of R from the start (N,), radians; a law stands still at its end."""
    times = np.unique(np.concatenate([np.linspace(0.0, duration_of(state), POINTS), stops_of(state)]))
    return times, [np.asarray(axis_angle(run.at(times))[1], dtype=np.float64) for run in runs_of(state)]
