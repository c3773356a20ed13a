"""The pictures of the velocity loop: its block diagram with the present numbers, and its frequency response."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from armlab.benches.control.loop.state import Loop
from armlab.session.amounts import amount
from armlab.ui import svg
from armlab.ui.chart import Chart
from armlab.ui.colours import BLUE, GREEN, ORANGE, PURPLE, VERMILLION, Rgb, css
from armlab.ui.format import trimmed
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.units import Units

Array = NDArray[np.float64]

WISH, REACHED, ERROR, FORCE = BLUE, GREEN, VERMILLION, ORANGE
"""Colours of the wanted velocity, the velocity, their difference, and the force; also in the plots."""

WIDTH = 320
LINE, BACK = 44, 80
"""Width of the pictures, and heights of the forward and of the feedback line of the diagram, pixels."""

LEFT, BOTTOM = 36, 18
"""Room for numbers at the left and at the bottom of each part of the frequency response, pixels."""

GAIN, PHASE, ABOVE = 118, 98, 0.3
"""Heights of the pictures of gain and phase, pixels, and the room above zero, in parts of what lies below."""

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


def frequencies(part: Loop) -> tuple[float, float]:
    """Return the least and the largest frequency that are drawn, rad/s."""
    seen = [math.log10(part.loop.cutoff), math.log10(part.omega if part.kind == "sine" else part.loop.cutoff)]
    low, high = math.floor(min(seen) - AROUND + 1e-9), math.ceil(max(seen) + AROUND - 1e-9)
    return 10.0**low, 10.0**high


def bode(part: Loop, units: Units) -> Markup:
    """Return gain and phase over the frequency, with the cutoff and the frequency of a sine marked."""
    loop, factor, across = part.loop, units.factor(True), frequencies(part)
    fall = 20.0 * math.log10(across[1] / loop.cutoff)
    deepest, step = 20.0 * math.ceil(fall / 20.0 - 1e-9), 0.25 * math.pi / factor

    def chart(key: str, names: tuple[str, str], deep: float, step: float, tall: float) -> Chart:
        up = -deep, ABOVE * deep
        return Chart(key, across, up, WIDTH, tall, LEFT, BOTTOM, names, (0.0, step), log=True)

    gain = chart("loop-gain", ("", "dB"), deepest, 20.0 if deepest <= 80.0 else 40.0, GAIN)
    phase = chart("loop-phase", ("ω, rad/s", units.angle_unit), 2.0 * step, step, PHASE)
    asymptotes = gain.line([(across[0], 0.0), (loop.cutoff, 0.0), (across[1], -fall)], class_="cut")
    return tag(
        "div.loop-bode",
        _response(part, gain, "Gain", BLUE, lambda omega: 20.0 * np.log10(loop.closed_gain(omega)), asymptotes),
        _response(part, phase, "Phase", PURPLE, lambda omega: loop.phase(omega) / factor),
    )


def _response(
    part: Loop, chart: Chart, name: str, colour: Rgb, at: Callable[[Array], Array], more: Inside = None
) -> Markup:
    """Return the chart of one part of the frequency response, with its curve and the marks."""
    cutoff = part.loop.cutoff
    omega = np.geomspace(*chart.x, POINTS)
    x = chart.px(cutoff)
    side, beside = ("end", x - 3) if x > WIDTH - 100 else ("start", x + 3)
    shapes = [
        chart.grid(),
        chart.upright(cutoff, "cut"),
        svg.text("tick", beside, 11, "cutoff K/M", side),
        more,
        chart.line(zip(omega.tolist(), at(omega).tolist(), strict=True), stroke=css(colour), stroke_width="1.8"),
    ]
    if part.kind == "sine":
        y = chart.py(float(at(np.array(part.omega))))
        shapes.append(chart.upright(part.omega, "here", stroke=css(WISH)))
        shapes.append(svg.shape("circle.here", cx=chart.px(part.omega), cy=y, r=4, fill=css(WISH)))
    return chart.picture(f"{name} of W over the frequency; cutoff at {amount(cutoff)} rad/s", shapes)
