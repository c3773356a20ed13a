"""Transfer functions of the motor, its poles in the complex plane, and its time constants."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.drive.motor.state import Motor
from armlab.benches.drive.quantities import prefixed
from armlab.kin.drive.motor import DcMotor
from armlab.session.amounts import amount
from armlab.ui import svg
from armlab.ui.chart import Chart
from armlab.ui.format import mathml, number, pairs
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.tables import head_line, line

WIDTH, TALL, LEFT, BOTTOM = 320.0, 112.0, 34.0, 18.0
"""Size of the plane, and room for its numbers, pixels."""

VOLTAGE = r"\frac{\omega}{v_a}=\frac{k}{(sL_a+R_a)(sI_m+F_m)+k^2}"
LOAD = r"\frac{\omega}{\tau_{load}}=-\frac{sL_a+R_a}{(sL_a+R_a)(sI_m+F_m)+k^2}"

CROSS = 4.5
"""Half size of the cross of a pole, pixels."""


def functions_markup(part: Motor) -> Inside:
    """Return both transfer functions, with their gains and numbers."""
    motor = part.motor
    a, b, c = (amount(value) for value in motor.denominator)
    numbers = f" = {amount(motor.k)} / ({a} s² + {b} s + {c}). The angle has one more pole, 0."
    gains = pairs(
        [
            (("steady ω for 1 V, ", mathml(r"k/(R_aF_m+k^2)")), amount(motor.voltage_gain, "rad/s")),
            (("steady ω for 1 N m, ", mathml(r"-R_a/(R_aF_m+k^2)")), amount(motor.load_gain, "rad/s")),
        ]
    )
    return (
        tag("div.eq.small.mo-eq", mathml(VOLTAGE)),
        tag("div.eq.small.mo-eq", mathml(LOAD)),
        tag("p.dim", "ω/v", tag("sub", "a"), numbers),
        gains,
        tag("p.dim", _open_chain(motor)),
    )


def poles_markup(part: Motor) -> Inside:
    """Return the plane, and the table of poles and time constants."""
    return plane(part.motor), _table(part.motor), _verdict(part.motor)


def _open_chain(motor: DcMotor) -> str:
    ratio = motor.open_gain / motor.voltage_gain
    without = f"{amount(motor.open_gain, 'rad/s')} for each volt, {amount(ratio)} times as fast"
    end = "without end" if motor.F == 0.0 else without
    return (
        f"k ω is a loop inside the motor and no input. Without it, the chain of both parts, k/(R F), would turn {end}."
        "⟦ The text after 2.19 calls the back-EMF an external input; 2.14 mixes s and t on its right side, 2.15 is "
        "right.⟧"
    )


def plane(motor: DcMotor) -> Markup:
    """Return the poles as crosses, that of the angle in grey, and the two approximations as circles."""
    poles, guesses = motor.poles, approximations(motor)
    deepest = min(float(poles.real.min()), *guesses)
    high = max(1.25 * float(np.abs(poles.imag).max()), 0.3 * abs(deepest))
    chart = Chart(
        "mo-plane",
        (1.12 * deepest, 0.1 * abs(deepest)),
        (-high, high),
        WIDTH,
        TALL,
        LEFT,
        BOTTOM,
        ("Re, 1/s", "Im, 1/s"),
    )
    middle = chart.py(0.0)
    circles = [svg.circle("mo-guess", chart.px(value), middle, 4.0) for value in guesses]
    crosses = [_cross("mo-pole", chart.px(pole.real), chart.py(pole.imag)) for pole in poles.tolist()]
    said = ", ".join(pole_text(pole) for pole in poles.tolist())
    return chart.picture(
        f"Poles in the complex plane at {said}",
        chart.grid(),
        chart.zero(),
        chart.upright(0.0, "axis"),
        circles,
        _cross("mo-zero", chart.px(0.0), middle),
        crosses,
    )


def _cross(kind: str, x: float, y: float) -> Markup:
    left, wide = f"M{x - CROSS:.1f}", 2.0 * CROSS
    return svg.path(kind, f"{left} {y - CROSS:.1f}l{wide:g} {wide:g}{left} {y + CROSS:.1f}l{wide:g} {-wide:g}")


def pole_text(pole: complex) -> str:
    """Return a pole as text, in 1/s."""
    if pole.imag == 0.0:
        return amount(pole.real)
    sign = "+" if pole.imag > 0.0 else "−"
    return f"{amount(pole.real)} {sign} {amount(abs(pole.imag))} j"


def approximations(motor: DcMotor) -> list[float]:
    """Return what stands for the poles when both time constants are taken apart, 1/s, the fastest first."""
    return [-1.0 / constant for constant in motor.time_constants]


def _table(motor: DcMotor) -> Markup:
    names = ["mechanical, R J/(R F + k²)"]
    if not motor.reduced:
        names.insert(0 if motor.electrical_constant <= motor.mechanical_constant else 1, "electrical, L/R")
    rows = []
    columns = (names, motor.time_constants, approximations(motor), motor.poles.tolist())
    for name, constant, guess, pole in zip(*columns, strict=True):
        # A complex pair has one decay for both, and no two time constants.
        away = f"{number(100.0 * abs(guess - pole) / abs(pole), 2)} %" if pole.imag == 0.0 else "–"
        rows.append(line(prefixed(constant, "s"), amount(guess), pole_text(pole), away, name=name))
    head = head_line("time constant", "τ", "−1/τ", "pole, 1/s", "off by")
    return joined(
        tag("table.kit-points.mo-poles", head, rows),
        tag(
            "p.dim",
            "× are the poles. ○ are the approximations −1/τ: they are close where the electrical time constant is far "
            "below the mechanical one, or far above it because R F is far above k², and mean nothing where the poles "
            "are complex.",
        ),
    )


def _verdict(motor: DcMotor) -> Markup:
    if motor.reduced:
        return verdict_box("ok", "One pole: the model of first order", "Without inductance the current has no memory.")
    ratio = motor.damping
    stable = "Both poles lie left of the imaginary axis, as they do for all positive constants."
    if ratio >= 1.0:
        head = f"Stable, damping ratio {number(ratio, 2)}: no overshoot"
        return verdict_box("ok", head, stable)
    overshoot = 100.0 * math.exp(-math.pi * ratio / math.sqrt(1.0 - ratio**2))
    head = f"Stable, but oscillating: damping ratio {number(ratio, 3)}"
    says = f"The speed overshoots by {number(overshoot, 1)} % after a step of the voltage. {stable}"
    return verdict_box("warn", head, says)
