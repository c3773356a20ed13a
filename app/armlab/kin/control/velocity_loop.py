"""A mass whose velocity is controlled by a force proportional to the error: notes, section 7.1.1.

    M dv/dt = F,    F = K (v_d - v),    W(s) = 1 / (M/K s + 1)

The mass slides without friction; v_d(t) is a step or a sine that begins at t = 0. All answers are exact, none is
integrated numerically.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import finite_floats

Array = NDArray[np.float64]
ReferenceKind = Literal["step", "sine"]


@dataclass(frozen=True)
class SpeedReference:
    """A wanted velocity from t = 0 on: the constant ``amplitude``, or ``amplitude`` sin(``omega`` t).

    Parameters
    ----------
    kind : "step" or "sine"
    amplitude : float
        m/s.
    omega : float
        rad/s, positive; of a sine.

    Raises
    ------
    InputError
        Another kind, or numbers that are not as above.
    """

    kind: ReferenceKind
    amplitude: float
    omega: float = 1.0

    def __post_init__(self) -> None:
        if self.kind not in ("step", "sine"):
            raise InputError(f"reference: expected 'step' or 'sine', got {self.kind!r}")
        finite_floats(self.amplitude, "amplitude", (), "a finite number in m/s")
        _positive(self.omega, "omega", "rad/s")

    def at(self, t: ArrayLike) -> Array:
        """Return the wanted velocity in m/s, shape of t."""
        times = np.asarray(t, dtype=np.float64)
        if self.kind == "step":
            return np.full(times.shape, float(self.amplitude))
        return np.asarray(self.amplitude * np.sin(self.omega * times))


@dataclass(frozen=True)
class VelocityLoop:
    """The loop of one mass and one gain.

    Parameters
    ----------
    mass : float
        M, kg, positive.
    gain : float
        K, N s/m, positive.

    Raises
    ------
    InputError
        Not a positive finite number.

    References
    ----------
    Notes 7.3-7.10.

    Examples
    --------
    >>> loop = VelocityLoop(mass=1.0, gain=10.0)
    >>> round(abs(loop.closed(2j)), 4), round(float(loop.error_gain(2.0)), 4)
    (0.9806, 0.1961)
    """

    mass: float
    gain: float

    def __post_init__(self) -> None:
        _positive(self.mass, "M", "kg")
        _positive(self.gain, "K", "N s/m")
        if not (0.0 < self.cutoff < math.inf and self.time_constant > 0.0):
            raise InputError(f"K/M: expected a number within floating point, got {self.gain:g}/{self.mass:g}")

    @property
    def cutoff(self) -> float:
        """Cut-off frequency K/M in rad/s: there the gain is 1/sqrt(2) and the phase -45 degrees."""
        return self.gain / self.mass

    @property
    def time_constant(self) -> float:
        """Time constant M/K in seconds, after which 1 - 1/e = 63 % of a step is done."""
        return self.mass / self.gain

    def plant(self, s: complex) -> complex:
        """Return H(s) = 1/(M s), from force in N to velocity in m/s; s in rad/s, not 0. Notes 7.9."""
        if s == 0:
            raise InputError("s: expected another number than 0, the pole of 1/(M s)")
        return 1.0 / (self.mass * complex(s))

    def closed(self, s: complex) -> complex:
        """Return W(s) = K H / (1 + K H) = 1/(M/K s + 1), from v_d to v; s in rad/s, not -K/M. Notes 7.10."""
        below = self.time_constant * complex(s) + 1.0
        if below == 0:
            raise InputError(f"s: expected another number than {-self.cutoff:g} rad/s, the pole of W")
        return 1.0 / below

    def closed_gain(self, omega: ArrayLike) -> Array:
        """Return |W(j omega)|, the amplitude of v over that of v_d for a sine in steady state; omega in rad/s."""
        return np.asarray(1.0 / np.hypot(1.0, self._ratio(omega)))

    def phase(self, omega: ArrayLike) -> Array:
        """Return the phase of W(j omega) in radians; v lags behind v_d by -phase/omega seconds."""
        return np.asarray(-np.arctan(self._ratio(omega)))

    def error_gain(self, omega: ArrayLike) -> Array:
        """Return |1 - W(j omega)|: amplitude of v_d - v over amplitude of v_d, of a sine that has lasted.

        The notes call the answer to omega = 2 at K/M = 10 perfect; this is 0.196 there. The gain is 0.981, but the
        velocity lags, and the lag makes most of the error.
        """
        ratio = self._ratio(omega)
        return np.asarray(ratio / np.hypot(1.0, ratio))

    def velocity(self, t: ArrayLike, reference: SpeedReference, v0: float = 0.0) -> Array:
        """Return v(t) in m/s from the velocity v0 at t = 0; seconds, not negative, of any shape. Notes 7.6-7.8."""
        times = self._times(t)
        start = finite_floats(v0, "v0", (), "a finite number in m/s")
        lasting = self._lasting(times, reference)
        return np.asarray(lasting + (start - self._lasting(np.zeros(()), reference)) * np.exp(-self.cutoff * times))

    def error(self, t: ArrayLike, reference: SpeedReference, v0: float = 0.0) -> Array:
        """Return v_d(t) - v(t) in m/s; see `velocity`."""
        return np.asarray(reference.at(t) - self.velocity(t, reference, v0))

    def force(self, t: ArrayLike, reference: SpeedReference, v0: float = 0.0) -> Array:
        """Return F(t) = K (v_d - v) in newtons; see `velocity`. Notes 7.5."""
        return np.asarray(self.gain * self.error(t, reference, v0))

    def position(self, t: ArrayLike, reference: SpeedReference, v0: float = 0.0) -> Array:
        """Return the displacement x(t) - x(0) in metres; see `velocity`.

        Since M (v - v0) is the integral of F, it is that of v_d less M/K (v - v0).
        """
        times = self._times(t)
        if reference.kind == "step":
            wished = reference.amplitude * times
        else:
            # 1 - cos without the loss of digits near 0.
            wished = 2.0 * reference.amplitude / reference.omega * np.sin(0.5 * reference.omega * times) ** 2
        return np.asarray(wished - self.time_constant * (self.velocity(times, reference, v0) - v0))

    def steady_error(self, reference: SpeedReference) -> float:
        """Return the amplitude in m/s of v_d - v in steady state; 0 for a step."""
        if reference.kind == "step":
            return 0.0
        return float(abs(reference.amplitude) * self.error_gain(reference.omega))

    def _lasting(self, times: Array, reference: SpeedReference) -> Array:
        """Return v in steady state: the step itself, or amplitude |W| sin(omega t + phase)."""
        if reference.kind == "step":
            return reference.at(times)
        omega = reference.omega
        wave = np.sin(omega * times + self.phase(omega))
        return np.asarray(reference.amplitude * self.closed_gain(omega) * wave)

    def _ratio(self, omega: ArrayLike) -> Array:
        return np.asarray(omega, dtype=np.float64) / self.cutoff

    @staticmethod
    def _times(t: ArrayLike) -> Array:
        times = np.asarray(t, dtype=np.float64)
        if not (np.isfinite(times).all() and (times >= 0.0).all()):
            raise InputError("t: expected finite seconds, not negative")
        return times


def _positive(value: float, where: str, unit: str) -> None:
    number = finite_floats(value, where, (), f"a positive number in {unit}")
    if not number > 0.0:
        raise InputError(f"{where}: expected a positive number in {unit}, got {float(number):g}")
