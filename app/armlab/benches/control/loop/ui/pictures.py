"""The pictures of the velocity loop: its block diagram with the present numbers, and its frequency response."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from armlab.benches.control.loop.state import Loop
from armlab.session.amounts import amount
from armlab.ui import svg
from armlab.ui.colours import BLUE, GREEN, ORANGE, PURPLE, VERMILLION, Rgb, css
from armlab.ui.format import number, trimmed
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.units import Units

WISH, REACHED, ERROR, FORCE = BLUE, GREEN, VERMILLION, ORANGE
"""Colours of the wanted velocity, the velocity, their difference, and the force; also in the plots."""

WIDTH = 320
LINE, BACK = 44, 80
"""Width of the pictures, and heights of the forward and of the feedback line of the diagram, pixels."""

LEFT, RIGHT = 36, 8
"""Room for numbers on both sides of the frequency response, pixels."""

GAIN_TOP, GAIN_HIGH, PHASE_TOP, PHASE_HIGH = 8, 84, 112, 62
BODE_HIGH = 192

DECIMALS = 3
"""Number of decimals in the diagram."""

POINTS = 81
AROUND = 1.0
"""Number of points of the curves, and least range in decades below the lower and above the higher of cutoff and
frequency."""


def diagram(part: Loop, t: float) -> Markup:
    """Return the block diagram, with wish, error, force and velocity at a time."""
    loop, wish = part.loop, part.reference
    v_d, v = float(wish.at(t)), float(loop.velocity(t, wish, part.v0))
    signals: tuple[tuple[int, str, Inside, float, str, Rgb], ...] = (
        (2, "start", ("v", tag("tspan.sub", "d", dy=3)), v_d, "m/s", WISH),
        (97, "middle", "e", v_d - v, "m/s", ERROR),
        (164, "middle", "F", loop.gain * (v_d - v), "N", FORCE),
        (WIDTH - 2, "end", "v", v, "m/s", REACHED),
    )
    names = [
        (
            tag("text.name", name, x=x, y=11, text_anchor=anchor, fill=css(colour)),
            svg.text("", x, 25, f"{trimmed(value, DECIMALS)} {unit}", anchor),
        )
        for x, anchor, name, value, unit, colour in signals
    ]
    return svg.drawing(
        "chart.loop-diagram",
        WIDTH,
        BACK + 4,
        "Block diagram: the error times K is the force, which the mass integrates to the velocity",
        [_arrow(a, b) for a, b in ((2, 60), (80, 116), (144, 186), (220, 238), (264, WIDTH - 2))],
        svg.path("wire", f"M292 {LINE}V{BACK}H70V{LINE + 11}"),
        svg.path("tip", f"M70 {LINE + 9}l-3.5 7h7z"),
        svg.circle("tip", 292, LINE, 2.2),
        svg.circle("sum", 70, LINE, 9),
        svg.text("", 52, LINE - 4, "+"),
        svg.text("", 77, LINE + 20, "−"),
        [_box(x, wide, text) for x, wide, text in ((116, 28, "K"), (186, 34, "1/M"), (238, 26, "∫"))],
        names,
    )


def _box(x: int, wide: int, text: str) -> Inside:
    around = tag("rect.box", x=x, y=LINE - 13, width=wide, height=26, rx=3)
    return around, svg.text("name", x + wide / 2, LINE + 4.5, text, "middle")


def _arrow(start: int, end: int) -> Inside:
    return svg.path("wire", f"M{start} {LINE}H{end - 4}"), svg.path("tip", f"M{end} {LINE}l-7 -3.5v7z")


def bode(part: Loop, units: Units) -> Markup:
    """Return gain and phase over the frequency, with the cutoff and the frequency of a sine marked."""
    scale = _Scale(part)
    omega = np.logspace(scale.low, scale.high, POINTS)
    gains = 20.0 * np.log10(part.loop.closed_gain(omega))
    phases = np.degrees(part.loop.phase(omega))
    return svg.drawing(
        "chart.loop-bode",
        WIDTH,
        BODE_HIGH,
        f"Gain and phase of W over the frequency; cutoff at {amount(part.loop.cutoff)} rad/s",
        _grid(scale, units),
        _asymptotes(scale),
        _curve(omega, gains, scale.x, scale.gain_y, css(BLUE)),
        _curve(omega, phases, scale.x, scale.phase_y, css(PURPLE)),
        _mark(part, scale) if part.kind == "sine" else None,
    )


class _Scale:
    """The scales for frequencies, decibels and degrees."""

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


def _grid(scale: _Scale, units: Units) -> Inside:
    lines: list[Inside] = []
    every = max(1, math.ceil((scale.high - scale.low) / 6))
    for power in range(scale.low, scale.high + 1):
        x = scale.x(10.0**power)
        for top, high in ((GAIN_TOP, GAIN_HIGH), (PHASE_TOP, PHASE_HIGH)):
            lines.append(svg.path("grid", f"M{x:.1f} {top}v{high}"))
        if (power - scale.low) % every == 0:
            text = number(10.0**power, max(0, -power)) if -3 <= power <= 4 else f"10^{power}".replace("-", "−")
            anchor = "end" if x > WIDTH - 20 else "middle"
            lines.append(svg.text("tick", x, PHASE_TOP + PHASE_HIGH + 13, text, anchor))
    step = 20 if scale.deepest <= 80 else 40
    lines += [_level(scale.gain_y(-db), number(-float(db), 0)) for db in range(0, round(scale.deepest) + 1, step)]
    lines += [
        _level(scale.phase_y(degrees), units.text(math.radians(degrees), True).removesuffix(".0"))
        for degrees in (0.0, -45.0, -90.0)
    ]
    x = scale.x(10.0**scale.cutoff)
    lines.append(svg.path("cut", f"M{x:.1f} {GAIN_TOP}V{PHASE_TOP + PHASE_HIGH}"))
    side, at = ("end", x - 3) if x > WIDTH - 60 else ("start", x + 3)
    lines.append(svg.text("tick", at, PHASE_TOP - 8, "K/M", side))
    lines.append(svg.text("tick", 2, PHASE_TOP - 8, "dB"))
    lines.append(svg.text("tick", 2, BODE_HIGH - 5, units.angle_unit))
    lines.append(svg.text("tick", LEFT, PHASE_TOP - 8, "ω, rad/s"))
    return lines


def _level(y: float, text: str) -> Inside:
    return svg.path("grid", f"M{LEFT} {y:.1f}H{WIDTH - RIGHT}"), svg.text("tick", LEFT - 4, y + 3.5, text, "end")


def _asymptotes(scale: _Scale) -> Markup:
    """Return 0 dB up to the cutoff, and 20 dB a decade down from there."""
    x, end = scale.x(10.0**scale.cutoff), scale.x(10.0**scale.high)
    down = scale.gain_y(-20.0 * (scale.high - scale.cutoff))
    return svg.path("cut", f"M{LEFT} {GAIN_TOP}H{x:.1f}L{end:.1f} {down:.1f}")


def _curve(
    omega: np.ndarray[tuple[int], np.dtype[np.float64]],
    values: np.ndarray[tuple[int], np.dtype[np.float64]],
    x: Callable[[float], float],
    y: Callable[[float], float],
    colour: str,
) -> Markup:
    points = " ".join(f"{x(at):.1f},{y(value):.1f}" for at, value in zip(omega.tolist(), values.tolist(), strict=True))
    return svg.shape("polyline", points=points, fill="none", stroke=colour, stroke_width=1.8)


def _mark(part: Loop, scale: _Scale) -> Markup:
    """Return the mark of the sine's frequency on both curves."""
    x = scale.x(part.omega)
    gain = scale.gain_y(20.0 * math.log10(float(part.loop.closed_gain(part.omega))))
    phase = scale.phase_y(math.degrees(float(part.loop.phase(part.omega))))
    line = tag("path.here", d=f"M{x:.1f} {GAIN_TOP}V{PHASE_TOP + PHASE_HIGH}", stroke=css(WISH))
    return joined(line, [svg.shape("circle.here", cx=x, cy=y, r=4, fill=css(WISH)) for y in (gain, phase)])
