"""Facts of the DC motor that lessons can check: its constants, its run, its powers, and its state."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from armlab.benches.drive.motor.state import SHOWN, Motor, present_time
from armlab.benches.drive.motor.twins import twins_of
from armlab.kin.drive.motor import Balance, DcMotor
from armlab.kin.drive.motor_run import Moment, MotorRun
from armlab.session.facts import Fact, Facts
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State


def _motor(value: Callable[[DcMotor], object]) -> Callable[[State], object]:
    return lambda state: value(state[Motor].motor)


def _run(value: Callable[[MotorRun], object]) -> Callable[[State], object]:
    return lambda state: value(state[Motor].run)


def _now(value: Callable[[Moment], object]) -> Callable[[State], object]:
    return lambda state: value(moment_of(state))


def _power(value: Callable[[Balance], object]) -> Callable[[State], object]:
    return lambda state: value(balance_of(state))


def moment_of(state: State) -> Moment:
    """Return the motor at the present time of its film."""
    return state[Motor].run.at(present_time(state))


def balance_of(state: State) -> Balance:
    """Return the powers at the present time of the film."""
    now = moment_of(state)
    return state[Motor].motor.powers(now.i, now.omega, now.v, now.load)


def _steady(state: State) -> tuple[float, float]:
    """Return steady current and speed at the last voltage and load."""
    part = state[Motor]
    current, speed = part.motor.steady(part.pieces[-1].voltage, part.pieces[-1].load)
    return float(current), float(speed)


def _open_gain(motor: DcMotor) -> float | None:
    return motor.open_gain if math.isfinite(motor.open_gain) else None


def _damping(motor: DcMotor) -> float | None:
    return motor.damping if math.isfinite(motor.damping) else None


def approximation_error(motor: DcMotor) -> float | None:
    """Return by how much -1/tau of the two time constants misses the poles, relative; None where these are complex."""
    if np.any(motor.poles.imag != 0.0):
        return None
    guesses = -1.0 / np.array(motor.time_constants)
    return float(np.abs(guesses / motor.poles.real - 1.0).max())


FACTS = Facts(
    __name__,
    (Motor, Timeline),
    {
        "constant": Fact("the constant k", _motor(lambda m: m.k), "N m/A"),
        "poles_real": Fact("the real parts of the poles", _motor(lambda m: m.poles.real), "1/s", "numbers"),
        "poles_imaginary": Fact("the imaginary parts of the poles", _motor(lambda m: m.poles.imag), "1/s", "numbers"),
        "order": Fact("the number of poles of the speed", _motor(lambda m: len(m.poles)), kind="count"),
        "damping": Fact("the damping ratio", _motor(_damping)),
        "electrical_constant": Fact("the electrical time constant L/R", _motor(lambda m: m.electrical_constant), "s"),
        "mechanical_constant": Fact(
            "the mechanical time constant R I_m/(R F_m + k²)", _motor(lambda m: m.mechanical_constant), "s"
        ),
        "approximation": Fact(
            "the largest relative error of −1/τ as a pole", lambda s: approximation_error(s[Motor].motor)
        ),
        "voltage_gain": Fact("the steady speed for each volt", _motor(lambda m: m.voltage_gain), "rad/(V s)"),
        "open_gain": Fact(
            "the steady speed for each volt of the chain without back-EMF", _motor(_open_gain), "rad/(V s)"
        ),
        "load_gain": Fact("the steady speed for each newton metre", _motor(lambda m: m.load_gain), "rad/(N m s)"),
        "steady_current": Fact("the steady current at the last voltage and load", lambda s: _steady(s)[0], "A"),
        "steady_speed": Fact("the steady speed at the last voltage and load", lambda s: _steady(s)[1], "rad/s"),
        "time": Fact("the time that is looked at", present_time, "s"),
        "current": Fact("the current now", _now(lambda m: m.i), "A"),
        "speed": Fact("the speed now", _now(lambda m: m.omega), "rad/s"),
        "angle": Fact("the angle now", _now(lambda m: m.theta), "rad"),
        "peak_current": Fact("the largest current of the run", _run(lambda r: np.abs(r.i).max()), "A"),
        "peak_speed": Fact("the largest speed of the run", _run(lambda r: np.abs(r.omega).max()), "rad/s"),
        "last_current": Fact("the current at the end of the run", _run(lambda r: r.i[-1]), "A"),
        "last_speed": Fact("the speed at the end of the run", _run(lambda r: r.omega[-1]), "rad/s"),
        "last_angle": Fact("the angle at the end of the run", _run(lambda r: r.theta[-1]), "rad"),
        "supplied": Fact("the power v i of the supply now", _power(lambda p: p.supplied), "W"),
        "copper": Fact("the heat R i² of the winding now", _power(lambda p: p.copper), "W"),
        "converted": Fact("the power k ω i that is converted now", _power(lambda p: p.converted), "W"),
        "to_load": Fact("the power to the load now", _power(lambda p: p.load), "W"),
        "printed_difference": Fact(
            "the difference of the printed vectors of both motors", lambda s: s.derived(twins_of).printed
        ),
        "state_difference": Fact("the difference of (i, ω, θ) of both motors", lambda s: s.derived(twins_of).right),
        "position_difference": Fact(
            "the difference of the angles of both motors", lambda s: s.derived(twins_of).position, "rad"
        ),
        "printed_rest": Fact(
            "the residual of dx/dt = A x + B u with the printed vector", lambda s: s.derived(twins_of).printed_rest
        ),
        "state_rest": Fact(
            "the residual of dx/dt = A x + B u with (i, ω, θ)", lambda s: s.derived(twins_of).right_rest
        ),
        "shown": Fact("what is shown of the motor", lambda s: s[Motor].shown, kind="text", names=SHOWN),
    },
)
