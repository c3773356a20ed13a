"""The view of the best ratio: the torque of the motor over the ratio, its minimum, and the derivative there."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
from numpy.typing import NDArray

from armlab.benches.drive.gears.state import Gears, TakeRatio
from armlab.benches.drive.power.ui.typed import typed
from armlab.benches.drive.quantities import prefixed
from armlab.kin.drive.best_ratio import Load, measured_slope, motor_torque, printed_slope, reflected, slope
from armlab.session.amounts import amount
from armlab.session.fields import Set, fields_of
from armlab.ui import svg
from armlab.ui.chart import Chart
from armlab.ui.colours import BLUE, GREEN, ORANGE, css
from armlab.ui.curve import Curve
from armlab.ui.form import Form
from armlab.ui.format import dot, mathml, pairs, scientific
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.large import LargeChart
from armlab.ui.markup import fold, verdict_box
from armlab.ui.symbols import with_symbol
from armlab.ui.tray_picture import Drawn, Picture
from armlab.ui.widgets import Gui

Floats = NDArray[np.float64]

WIDTH, HEIGHT, LEFT, BOTTOM = 320.0, 176.0, 40.0, 20.0
"""Size of the chart, and of the numbers in it, pixels."""

POINTS = 241
DECADE = 20.0
"""Factor by which the chart reaches below and above the best ratio."""

OWN, OTHER, WHOLE = ORANGE, GREEN, BLUE
"""Colours of the motor's own part, of that of the load, and of their sum."""

NAMES = {WHOLE: "τₘ", OWN: "Jₘ n a, the motor itself", OTHER: "(Jᵤ a + τ_L)/n, the load"}
"""Names of the curves by their colours."""


def span(part: Gears) -> tuple[float, float]:
    """Return the ratios of the chart: around the best one, with that which is looked at."""
    best = part.best.ratio if 0.0 < part.best.ratio < math.inf else part.ratio
    return min(best / DECADE, 0.8 * part.ratio), max(best * DECADE, 1.25 * part.ratio)


def terms(load: Load, ratios: Floats) -> tuple[Floats, Floats]:
    """Return what the motor spends on itself and on the load, N m, shape (k,) each."""
    return load.motor_inertia * load.acceleration * ratios, load.resistance / ratios


def heights(part: Gears, whole: Floats) -> tuple[float, float]:
    """Return the torques of the chart, N m: some times that of the best ratio, or of the term there."""
    load, best = part.load, part.best
    unit = abs(best.torque) or 2.0 * math.sqrt(abs(load.motor_inertia * load.acceleration * load.resistance))
    unit = unit or float(np.median(np.abs(whole))) or 1.0
    low, high = float(whole.min()), float(whole.max())
    return (-3.2 * unit if low < 0.0 else 0.0), (3.2 * unit if high > 0.0 else 0.0)


class TorqueChart:
    """The torque of the motor over the ratio, in the panel and large."""

    def __init__(self, gui: Gui) -> None:
        self._large = LargeChart(gui, "Torque of the motor over the ratio", "best_ratio")

    def markup(self, form: Form, part: Gears) -> Inside:
        """Return the chart, in which a click chooses the ratio, with its buttons and names."""
        self._large.show(part, partial(self._picture, part), part.ratio)
        save = form.button("csv", "CSV", self._saved, "copy", "Save the curves as a table")
        head = tag("h3", "Torque over the ratio", tag("span.copies", self._large.button(form), save))
        names = [tag("span", dot(css(colour)), with_symbol(text, "τ_L")) for colour, text in NAMES.items()]
        pick = form.place("chart", partial(_picked, part))
        return head, tag("div.legend", names), tag("div.gr-chart", chart(part), **pick)

    def _saved(self) -> tuple[()]:
        self._large.save()
        return ()

    def _picture(self, part: Gears) -> Picture:
        ratios = np.geomspace(*span(part), POINTS)
        own, other = terms(part.load, ratios)
        curves = (
            Curve("of the motor itself, N m", OWN, dash=(4, 3)),
            Curve("of the load, N m", OTHER, dash=(2, 3)),
            Curve("torque of the motor, N m", WHOLE, 2.0),
        )
        drawn = [Drawn(curve, ratios, y) for curve, y in zip(curves, (own, other, own + other), strict=True)]
        best = part.best.ratio
        marks = [(f"best: {amount(best)}", best)] if 0.0 < best < math.inf else []
        up = heights(part, own + other)
        return Picture(self._large.title, "n", drawn, marks=marks, across=span(part), up=up, log=True)


def _picked(part: Gears, x: float, y: float, drag: int) -> Set:
    """Return the command of a click at a part of the picture's width."""
    low, high = span(part)
    share = min(max((x * WIDTH - LEFT) / (WIDTH - LEFT), 0.0), 1.0)
    field = fields_of(Gears)["ratio"]
    ratio = float(f"{low * (high / low) ** share:.3g}")
    return Set(Gears, "ratio", min(max(ratio, field.low), field.high))


def chart(part: Gears) -> Markup:
    """Return the chart as a picture."""
    across = span(part)
    ratios = np.geomspace(*across, POINTS)
    own, other = terms(part.load, ratios)
    whole, best = own + other, part.best
    at = Chart("gr-torque", across, _seen(heights(part, whole)), WIDTH, HEIGHT, LEFT, BOTTOM, ("n", "N m"), log=True)
    curves = [
        at.line(zip(ratios.tolist(), own.tolist(), strict=True), stroke=css(OWN), stroke_dasharray="5 3"),
        at.line(zip(ratios.tolist(), other.tolist(), strict=True), stroke=css(OTHER), stroke_dasharray="2 3"),
        at.line(zip(ratios.tolist(), whole.tolist(), strict=True), stroke=css(WHOLE), stroke_width="2"),
    ]
    now = float(motor_torque(part.load, part.ratio))
    marks = [at.upright(part.ratio, "gr-now"), _dot(at, "gr-at", part.ratio, now)]
    if 0.0 < best.ratio < math.inf:
        marks.append(_dot(at, "gr-best", best.ratio, best.torque))
    label = f"Torque of the motor over the ratio: {amount(now, 'N m')} at {amount(part.ratio)}"
    return at.picture(label, at.grid(), at.zero(), curves, marks)


def _seen(heights: tuple[float, float]) -> tuple[float, float]:
    low, high = heights
    return (low, high) if high > low else (low - 1.0, high + 1.0)


def _dot(at: Chart, kind: str, x: float, y: float) -> Markup | None:
    low, high = at.y
    return svg.circle(kind, at.px(x), at.py(y), 4.5) if low <= y <= high else None


def best_markup(form: Form, part: Gears, shown: TorqueChart) -> Inside:
    """Return the fields, the chart and the numbers."""
    names = ("motor_inertia", "load_inertia", "acceleration", "load_torque")
    return (
        tag(
            "div.eq.small", mathml(r"\tau_m=J_m\,n\,a+\frac{J_u\,a+\tau_L}{n}"), "⟦ (2.36) and the torque of the load⟧"
        ),
        tag("div.options.gr-load", [typed(form, part, name) for name in names]),
        shown.markup(form, part),
        _looked_at(form, part),
        _verdict(part),
        _derivative(part),
        _why(part),
    )


def _looked_at(form: Form, part: Gears) -> Markup:
    best = part.best.ratio
    field = fields_of(Gears)["ratio"]
    there = field.low <= best <= field.high
    return tag(
        "div.bar.gr-looked",
        typed(form, part, "ratio"),
        tag("b", mathml(r"\tau_m"), f" = {prefixed(float(motor_torque(part.load, part.ratio)), 'N m')}"),
        form.chip("take best", "best", TakeRatio("best"), "Look at the best ratio", off=not there),
        form.chip("take train", "of the train", TakeRatio("train"), "Look at the ratio of the train of wheels"),
    )


def _verdict(part: Gears) -> Markup:
    load, best = part.load, part.best
    if best.ratio == math.inf:
        return verdict_box(
            "warn", "No best ratio", tag("p", "a = 0, at rest or at constant speed: the larger n, the smaller τₘ.")
        )
    if load.acceleration == 0.0:
        return verdict_box("ok", "No torque", tag("p", "Nothing is accelerated and nothing resists."))
    if best.ratio == 0.0:
        alone = "The torque of the load alone gives it this acceleration: the smaller n, the smaller τₘ."
        return verdict_box("warn", "No best ratio", tag("p", alone))
    if best.torque == 0.0:
        return verdict_box(
            "ok",
            f"n* = {amount(best.ratio)}: no torque at all",
            tag("p", "The torque of the load accelerates the load and, at this ratio, the motor as well."),
        )
    return verdict_box(
        "ok",
        f"n* = {amount(best.ratio)} with τₘ = {prefixed(best.torque, 'N m')}",
        tag("p", f"Half of it, {prefixed(0.5 * best.torque, 'N m')}, is for the motor itself, half for the load."),
    )


def _derivative(part: Gears) -> Markup:
    load, n = part.load, part.ratio
    at_motor, at_load = reflected(load, n)
    rows: list[tuple[Inside, Inside]] = [
        ((mathml(r"d\tau_m/dn"), " by differences"), _small(measured_slope(load, n))),
        (mathml(r"J_m a-(J_u a+\tau_L)/n^2"), _small(slope(load, n))),
    ]
    own = load.motor_inertia * load.acceleration
    # Where the load drives the motor, or nothing is accelerated, both terms may cancel with a plus as well.
    nowhere = ", and zero nowhere" if own * load.resistance > 0.0 else ""
    wrong = f"Jₘ a + (Jᵤ a + τ_L)/n² would be {_small(printed_slope(load, n))}{nowhere}"
    printed = with_symbol(f"⟦(2.38) prints a plus: {wrong}. The sign is minus.⟧", "τ_L")
    inertia = (
        f"The motor feels Jₘ + Jᵤ/n² = {prefixed(1e3 * at_motor, 'g m²')}, the load n² Jₘ + Jᵤ = "
        f"{prefixed(1e3 * at_load, 'g m²')}."
    )
    return tag("div.gr-slopes", pairs(rows), tag("p.dim", printed), tag("p.dim", inertia))


def _small(value: float) -> str:
    """Return a derivative; what is rounding is written as a power of ten."""
    return f"{scientific(value) if 0.0 < abs(value) < 1e-6 else amount(value)} N m"


def _why(part: Gears) -> Markup:
    """Return how the best ratio follows, and where the torque of the load moves it."""
    plain = math.sqrt(part.load_inertia / part.motor_inertia)
    return fold(
        "Where the minimum is",
        tag("div.eq.small", mathml(r"\frac{d\tau_m}{dn}=J_m a-\frac{J_u a+\tau_L}{n^2}=0")),
        tag("div.eq.small", mathml(r"n^*=\sqrt{\frac{J_u}{J_m}+\frac{\tau_L}{J_m a}}")),
        tag(
            "p",
            f"Without a torque of the load it is √(Jᵤ/Jₘ) = {amount(plain)}⟦ (2.39)⟧, whatever the acceleration. A "
            "torque that resists moves it up, since it shrinks with n while Jₘ n a does not; the more slowly one "
            "accelerates, the farther. Losses of the gear count like a larger load: divide it by the efficiency.",
        ),
    )
