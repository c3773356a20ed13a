"""The permanent-magnet DC motor as a linear system (notes 2.4-2.28).

    L_a di/dt = v_a - R_a i - k omega
    I_m domega/dt = k i - F_m omega - tau_load
    dtheta/dt = omega

with one constant k = k_v = k_t, in V s/rad and in N m/A, which is the same in SI units (2.22-2.28).
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, finite_floats, wrong
from armlab.kin.field import positive

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class DcMotor:
    """A DC motor.

    Its state is x = (i, omega, theta) in A, rad/s and rad; its input u = (v_a, tau_load) in V and N m. The notes print
    (di/dt, d²theta/dt², dtheta/dt) as the state (2.12), which is the derivative of it: it does not hold the position.

    With L = 0 the current follows the voltage at once, and the motor is of first order: the states are (omega, theta).

    Parameters
    ----------
    R : float
        R_a, resistance of the winding, ohm, positive.
    L : float
        L_a, inductance, H, not negative.
    k : float
        k_v = k_t, V s/rad = N m/A, positive.
    J : float
        I_m, moment of inertia of all that turns with the shaft, kg m², positive.
    F : float
        F_m, viscous friction, N m s/rad, not negative.

    Raises
    ------
    InputError
        A constant is out of its range or not finite.

    Examples
    --------
    >>> motor = DcMotor(R=1.2, L=0.002, k=0.05, J=1e-4, F=2e-5)
    >>> motor.poles.real.round(3).tolist()
    [-578.38, -21.82]
    """

    R: float
    L: float
    k: float
    J: float
    F: float = 0.0

    def __post_init__(self) -> None:
        for name, title in (("R", "resistance"), ("k", "constant"), ("J", "moment of inertia")):
            positive(getattr(self, name), f"{name} ({title})")
        for name, title in (("L", "inductance"), ("F", "friction")):
            value = as_floats(getattr(self, name), f"{name} ({title})", "no negative number")
            if value.shape != () or not (np.isfinite(value) and value >= 0.0):
                raise wrong(f"{name} ({title})", "no negative number", getattr(self, name))

    @property
    def reduced(self) -> bool:
        """Whether the inductance is left out."""
        return self.L == 0.0

    @cached_property
    def A(self) -> Array:
        """The matrix of dx/dt = A x + B u, shape (3, 3); (2, 2) without inductance. Notes 2.10."""
        if self.reduced:
            return np.array([[-(self.F + self.k**2 / self.R) / self.J, 0.0], [1.0, 0.0]])
        return np.array(
            [
                [-self.R / self.L, -self.k / self.L, 0.0],
                [self.k / self.J, -self.F / self.J, 0.0],
                [0.0, 1.0, 0.0],
            ]
        )

    @cached_property
    def B(self) -> Array:
        """The matrix of the input (v_a, tau_load), shape (3, 2); (2, 2) without inductance."""
        if self.reduced:
            return np.array([[self.k / (self.R * self.J), -1.0 / self.J], [0.0, 0.0]])
        return np.array([[1.0 / self.L, 0.0], [0.0, -1.0 / self.J], [0.0, 0.0]])

    @property
    def stiffness(self) -> float:
        """R F + k², the constant term of the denominator, by which all gains are divided."""
        return self.R * self.F + self.k**2

    @property
    def denominator(self) -> tuple[float, float, float]:
        """Coefficients of (L s + R)(J s + F) + k², the highest power first; the first is 0 without inductance."""
        return self.L * self.J, self.L * self.F + self.R * self.J, self.stiffness

    @cached_property
    def poles(self) -> Complex:
        """Poles of omega(s)/v_a(s) and of omega(s)/tau_load(s), 1/s, the fastest first; one without inductance.

        The integrator from omega to theta adds the pole 0.
        """
        a, b, c = self.denominator
        if self.reduced:
            return np.array([-c / b], dtype=np.complex128)
        # The sum is of two numbers of one sign where the poles are real, so that no digit of the slow one is lost.
        q = -0.5 * (b + cmath.sqrt(b * b - 4.0 * a * c))
        return np.array([q / a, c / q], dtype=np.complex128)

    @property
    def damping(self) -> float:
        """Damping ratio of the poles: below 1 they are complex; infinite without inductance."""
        a, b, c = self.denominator
        return math.inf if self.reduced else b / (2.0 * math.sqrt(a * c))

    @property
    def natural(self) -> float:
        """Natural angular frequency, rad/s; infinite without inductance."""
        a, _, c = self.denominator
        return math.inf if self.reduced else math.sqrt(c / a)

    @property
    def electrical_constant(self) -> float:
        """L/R, s: time constant of the current while the rotor stands."""
        return self.L / self.R

    @property
    def mechanical_constant(self) -> float:
        """R J/(R F + k²), s: time constant of the speed without inductance. With it, an approximation."""
        return self.R * self.J / self.stiffness

    @property
    def time_constants(self) -> tuple[float, ...]:
        """Both time constants, s, the shorter first, as the poles are; without inductance only the mechanical one."""
        both = sorted((self.electrical_constant, self.mechanical_constant))
        return (self.mechanical_constant,) if self.reduced else tuple(both)

    @property
    def voltage_gain(self) -> float:
        """Steady speed for each volt, rad/(V s): k/(R F + k²), with the back-EMF inside (notes after 2.19)."""
        return self.k / self.stiffness

    @property
    def open_gain(self) -> float:
        """Steady speed for each volt that the chain without back-EMF would have, k/(R F); infinite without friction."""
        return math.inf if self.F == 0.0 else self.k / (self.R * self.F)

    @property
    def load_gain(self) -> float:
        """Steady change of the speed for each newton metre of load, rad/(N m s): -R/(R F + k²)."""
        return -self.R / self.stiffness

    def transfer(self, s: complex) -> tuple[complex, complex]:
        """Return omega/v_a and omega/tau_load at a complex frequency s, rad/s, which is no pole.

        k / ((L s + R)(J s + F) + k²) and -(L s + R) / ((L s + R)(J s + F) + k²).
        """
        electrical = self.L * s + self.R
        below = electrical * (self.J * s + self.F) + self.k**2
        if below == 0:
            raise InputError(f"s: expected no pole of the motor, got {s:.6g} rad/s")
        return self.k / below, -electrical / below

    def steady(self, voltage: ArrayLike, load: ArrayLike = 0.0) -> tuple[Array, Array]:
        """Return current (A) and speed (rad/s) at which a constant voltage (V) and load (N m) leave the motor."""
        v, tau = np.asarray(voltage, dtype=np.float64), np.asarray(load, dtype=np.float64)
        return (self.F * v + self.k * tau) / self.stiffness, (self.k * v - self.R * tau) / self.stiffness

    def stalled(self, voltage: float) -> tuple[float, float]:
        """Return current (A) and torque (N m) of the rotor that is held at this voltage, once the current is there."""
        return voltage / self.R, self.k * voltage / self.R

    def current(self, omega: ArrayLike, voltage: ArrayLike) -> Array:
        """Return the current (A) of a motor without inductance: (v_a - k omega)/R."""
        return np.asarray((np.asarray(voltage) - self.k * np.asarray(omega)) / self.R, dtype=np.float64)

    def rates(self, i: ArrayLike, omega: ArrayLike, voltage: ArrayLike, load: ArrayLike) -> Array:
        """Return (di/dt, domega/dt, dtheta/dt), shape (..., 3): what the notes print as the state (2.12).

        Without inductance di/dt is that between jumps of the voltage.
        """
        i, omega, voltage, load = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in (i, omega, voltage, load)))
        faster = (self.k * i - self.F * omega - load) / self.J
        rise = -self.k * faster / self.R if self.reduced else (voltage - self.R * i - self.k * omega) / self.L
        return np.stack([rise, faster, omega], axis=-1)

    def powers(self, i: float, omega: float, voltage: float, load: float) -> Balance:
        """Return where the power of the supply goes at a moment."""
        rise, faster, _ = self.rates(i, omega, voltage, load).tolist()
        return Balance(
            voltage * i,
            self.R * i**2,
            self.L * i * rise,
            self.k * omega * i,
            self.J * omega * faster,
            self.F * omega**2,
            load * omega,
        )


@dataclass(frozen=True)
class Balance:
    """Powers of a motor at a moment, watts.

    v i = R i² + d/dt(L i²/2) + k omega i, and k i omega = d/dt(J omega²/2) + F omega² + tau_load omega.

    Attributes
    ----------
    supplied : float
        v i, from the supply.
    copper : float
        R i², heat of the winding.
    magnetic : float
        L i di/dt, into the field of the winding.
    converted : float
        k omega i: v_emf i on the electrical side, tau_m omega on the mechanical one (2.25).
    kinetic : float
        J omega domega/dt, into the motion.
    friction : float
        F omega², heat of the bearings.
    load : float
        tau_load omega, to the load.
    """

    supplied: float
    copper: float
    magnetic: float
    converted: float
    kinetic: float
    friction: float
    load: float

    @property
    def electrical_rest(self) -> float:
        """Rest of the electrical equation, W, which is rounding."""
        return self.supplied - self.copper - self.magnetic - self.converted

    @property
    def mechanical_rest(self) -> float:
        """Rest of the mechanical equation, W, which is rounding."""
        return self.converted - self.kinetic - self.friction - self.load


def checked_start(values: ArrayLike) -> Array:
    """Return a start (i, omega, theta), shape (3,); `InputError` when it is none."""
    return finite_floats(values, "start", (3,), "current in A, speed in rad/s and angle in rad")
