"""The pictures of the velocity loop: its block diagram with the present numbers, and its frequency response."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from armlab.benches.control.loop.state import Loop
from armlab.session.amounts import amount
from armlab.ui.colours import BLUE, GREEN, ORANGE, PURPLE, VERMILLION, css
from armlab.ui.format import number, trimmed
from armlab.ui.units import Units

WISH, REACHED, ERROR, FORCE = BLUE, GREEN, VERMILLION, ORANGE
"""Of the wanted velocity, the velocity, their difference, and the force; also in the plots."""

WIDTH = 320
LINE, BACK = 44, 80
"""Heights of the forward and of the feedback line of the diagram, pixels."""

LEFT, RIGHT = 36, 8
"""Of what numbers take beside the frequency response, pixels."""

GAIN_TOP, GAIN_HIGH, PHASE_TOP, PHASE_HIGH = 8, 84, 112, 62
BODE_HIGH = 192

DECIMALS = 3
"""Of the numbers in the diagram."""

POINTS = 81
AROUND = 1.0
"""Decades shown below the lower and above the higher of cutoff and frequency, at least."""


def diagram(part: Loop, t: float) -> str:
    """Return the block diagram, with wish, error, force and velocity at a time."""
    loop, wish = part.loop, part.reference
    v_d, v = float(wish.at(t)), float(loop.velocity(t, wish, part.v0))
    signals = (
        (2, "start", "v<tspan class='sub' dy='3'>d</tspan>", v_d, "m/s", WISH),
        (97, "middle", "e", v_d - v, "m/s", ERROR),
        (164, "middle", "F", loop.gain * (v_d - v), "N", FORCE),
        (WIDTH - 2, "end", "v", v, "m/s", REACHED),
    )
    names = "".join(
        f'<text x="{x}" y="11" text-anchor="{anchor}" fill="{css(colour)}" class="name">{name}</text>'
        f'<text x="{x}" y="25" text-anchor="{anchor}">{trimmed(value, DECIMALS)} {unit}</text>'
        for x, anchor, name, value, unit, colour in signals
    )
    boxes = "".join(_box(x, wide, text) for x, wide, text in ((116, 28, "K"), (186, 34, "1/M"), (238, 26, "∫")))
    arrows = "".join(_arrow(a, b) for a, b in ((2, 60), (80, 116), (144, 186), (220, 238), (264, WIDTH - 2)))
    back = f'<path class="wire" d="M292 {LINE}V{BACK}H70V{LINE + 11}"/><path class="tip" d="M70 {LINE + 9}l-3.5 7h7z"/>'
    circle = f'<circle class="sum" cx="70" cy="{LINE}" r="9"/>'
    signs = f'<text x="52" y="{LINE - 4}">+</text><text x="77" y="{LINE + 20}">−</text>'
    joint = f'<circle cx="292" cy="{LINE}" r="2.2" class="tip"/>'
    label = "Block diagram: the error times K is the force, which the mass integrates to the velocity"
    return (
        f'<svg class="loop-diagram" viewBox="0 0 {WIDTH} {BACK + 4}" role="img" aria-label="{label}">'
        f"{arrows}{back}{joint}{circle}{signs}{boxes}{names}</svg>"
    )


def _box(x: int, wide: int, text: str) -> str:
    return (
        f'<rect class="box" x="{x}" y="{LINE - 13}" width="{wide}" height="26" rx="3"/>'
        f'<text x="{x + wide / 2:g}" y="{LINE + 4.5}" text-anchor="middle" class="name">{text}</text>'
    )


def _arrow(start: int, end: int) -> str:
    return f'<path class="wire" d="M{start} {LINE}H{end - 4}"/><path class="tip" d="M{end} {LINE}l-7 -3.5v7z"/>'


def bode(part: Loop, units: Units) -> str:
    """Return gain and phase over the frequency, with cutoff and, of a sine, its frequency marked."""
    scale = _Scale(part)
    omega = np.logspace(scale.low, scale.high, POINTS)
    gains = 20.0 * np.log10(part.loop.closed_gain(omega))
    phases = np.degrees(part.loop.phase(omega))
    parts = [_grid(scale, units), _asymptotes(scale)]
    parts.append(_curve(omega, gains, scale.x, scale.gain_y, css(BLUE)))
    parts.append(_curve(omega, phases, scale.x, scale.phase_y, css(PURPLE)))
    if part.kind == "sine":
        parts.append(_mark(part, scale))
    label = f"Gain and phase of W over the frequency; cutoff at {amount(part.loop.cutoff)} rad/s"
    return (
        f'<svg class="loop-bode" viewBox="0 0 {WIDTH} {BODE_HIGH}" role="img" aria-label="{label}">'
        f"{''.join(parts)}</svg>"
    )


class _Scale:
    """Where frequencies, decibels and degrees are drawn."""

    def __init__(self, part: Loop) -> None:
        cutoff = math.log10(part.loop.cutoff)
        here = math.log10(part.omega) if part.kind == "sine" else cutoff
        self.cutoff = cutoff
        self.low = math.floor(min(cutoff, here) - AROUND + 1e-9)
        self.high = math.ceil(max(cutoff, here) + AROUND - 1e-9)
        self.deepest = 20.0 * math.ceil(max(self.high - cutoff, 1.0))

    def x(self, omega: float) -> float:
        """Return the pixel of a frequency in rad/s."""
        return LEFT + (WIDTH - LEFT - RIGHT) * (math.log10(omega) - self.low) / (self.high - self.low)

    def gain_y(self, decibels: float) -> float:
        """Return the pixel of a gain in dB."""
        return GAIN_TOP - GAIN_HIGH * decibels / self.deepest

    def phase_y(self, degrees: float) -> float:
        """Return the pixel of a phase in degrees."""
        return PHASE_TOP - PHASE_HIGH * degrees / 90.0


def _grid(scale: _Scale, units: Units) -> str:
    lines = []
    every = max(1, math.ceil((scale.high - scale.low) / 6))
    for power in range(scale.low, scale.high + 1):
        x = scale.x(10.0**power)
        for top, high in ((GAIN_TOP, GAIN_HIGH), (PHASE_TOP, PHASE_HIGH)):
            lines.append(f'<path class="grid" d="M{x:.1f} {top}v{high}"/>')
        if (power - scale.low) % every == 0:
            text = number(10.0**power, max(0, -power)) if -3 <= power <= 4 else f"10^{power}".replace("-", "−")
            anchor = "end" if x > WIDTH - 20 else "middle"
            lines.append(f'<text class="tick" x="{x:.1f}" y="{PHASE_TOP + PHASE_HIGH + 13}" text-anchor="{anchor}">')
            lines.append(f"{text}</text>")
    step = 20 if scale.deepest <= 80 else 40
    lines += [_level(scale.gain_y(-db), number(-float(db), 0)) for db in range(0, round(scale.deepest) + 1, step)]
    lines += [
        _level(scale.phase_y(degrees), units.text(math.radians(degrees), True).removesuffix(".0"))
        for degrees in (0.0, -45.0, -90.0)
    ]
    x = scale.x(10.0**scale.cutoff)
    lines.append(f'<path class="cut" d="M{x:.1f} {GAIN_TOP}V{PHASE_TOP + PHASE_HIGH}"/>')
    side, at = ("end", x - 3) if x > WIDTH - 60 else ("start", x + 3)
    lines.append(f'<text class="tick" x="{at:.1f}" y="{PHASE_TOP - 8}" text-anchor="{side}">K/M</text>')
    lines.append(f'<text class="tick" x="2" y="{PHASE_TOP - 8}">dB</text>')
    lines.append(f'<text class="tick" x="2" y="{BODE_HIGH - 5}">{units.angle_unit}</text>')
    lines.append(f'<text class="tick" x="{LEFT}" y="{PHASE_TOP - 8}">ω, rad/s</text>')
    return "".join(lines)


def _level(y: float, text: str) -> str:
    return (
        f'<path class="grid" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}"/>'
        f'<text class="tick" x="{LEFT - 4}" y="{y + 3.5:.1f}" text-anchor="end">{text}</text>'
    )


def _asymptotes(scale: _Scale) -> str:
    """Return 0 dB up to the cutoff, and 20 dB a decade down from there."""
    x, end = scale.x(10.0**scale.cutoff), scale.x(10.0**scale.high)
    down = scale.gain_y(-20.0 * (scale.high - scale.cutoff))
    return f'<path class="cut" d="M{LEFT} {GAIN_TOP}H{x:.1f}L{end:.1f} {down:.1f}"/>'


def _curve(
    omega: np.ndarray[tuple[int], np.dtype[np.float64]],
    values: np.ndarray[tuple[int], np.dtype[np.float64]],
    x: Callable[[float], float],
    y: Callable[[float], float],
    colour: str,
) -> str:
    points = " ".join(f"{x(at):.1f},{y(value):.1f}" for at, value in zip(omega.tolist(), values.tolist(), strict=True))
    return f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.8"/>'


def _mark(part: Loop, scale: _Scale) -> str:
    """Return the frequency of the sine on both curves."""
    x = scale.x(part.omega)
    gain = scale.gain_y(20.0 * math.log10(float(part.loop.closed_gain(part.omega))))
    phase = scale.phase_y(math.degrees(float(part.loop.phase(part.omega))))
    dots = "".join(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{css(WISH)}" class="here"/>' for y in (gain, phase))
    return f'<path class="here" d="M{x:.1f} {GAIN_TOP}V{PHASE_TOP + PHASE_HIGH}" stroke="{css(WISH)}"/>{dots}'
