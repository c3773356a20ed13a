"""The page of calibration: the characteristic curve of a sensor, its errors, and what a calibration leaves of them."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from armlab.benches.sensor.absolute.ui.numbers import numbers, typed
from armlab.benches.sensor.calibration.examples import EXAMPLES, ChooseCalibrationExample
from armlab.benches.sensor.calibration.state import PERCENT, Curve
from armlab.kin.sensors.characteristic import MOST_DEGREE, SHAPES, linearity_error
from armlab.session.amounts import amount
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import Post, State
from armlab.ui.colours import BLUE, GREY, ORANGE, VERMILLION
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import number
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import row, verdict_box
from armlab.ui.plot import Curve as Line
from armlab.ui.plot import Plot
from armlab.ui.plugin import Panel, Show
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

Floats = NDArray[np.float64]

DEAD = "Largest change of the input that does not change the output; the play counts where the input turns back"
"""Meaning of the resolution error."""

OVERFITTED = "Between the points it is farther off than at them: too few points for this degree."
OVERFITTED_NOISE = (
    "Between the points it is farther off than at them: too high a degree for so few points and so much noise."
)
"""Sentences on a polynomial that follows its points too closely, without noise and with it."""

TURNS_BACK = (
    "The curve turns back: one output belongs to two inputs, and no polynomial tells them apart, of any degree."
)
"""Sentence on a curve that is not monotonic."""

REMAINS = {
    (True, False, False): "Hysteresis is left: no function of the output takes it away.",
    (False, True, False): "The resolution is left: no function of the output takes it away.",
    (False, False, True): "Noise is left: no function of the output takes it away.",
    (True, True, False): "Hysteresis and resolution are left: no function of the output takes them away.",
    (True, False, True): "Hysteresis and noise are left: no function of the output takes them away.",
    (False, True, True): "Resolution and noise are left: no function of the output takes them away.",
    (True, True, True): "Hysteresis, resolution and noise are left: no function of the output takes them away.",
}
"""Sentences on what a calibration leaves, by whether there is hysteresis, resolution and noise."""

HEIGHT, LOW = 130, 110
"""Heights of the plots of the errors and of the outputs, pixels."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the example, the errors of the sensor, the calibration, its figures, and the plots."""
    units = units_of(state)
    head = gui.form(post)
    errors = _Errors(gui)
    said = gui.html()
    with gui.fold("Outputs and polynomial"):
        outputs, words = _Outputs(gui), gui.html()

    def show(state: State) -> None:
        part = state[Curve]
        if head.shows(part):
            return
        head.show(_head(head, part, units))
        errors.show(part)
        said.show(_figures(part), _verdict(part))
        outputs.show(part)
        words.show(_polynomial(part))

    return show


def _head(form: Form, part: Curve, units: Units) -> Markup:
    shapes = form.chips("shape", SHAPES, part.shape, "Shape of the nonlinearity", partial(Set, Curve, "shape"))
    return joined(
        examples(form, EXAMPLES, part.example, ChooseCalibrationExample),
        tag("h3", "Sensor ", tag("small", "errors in percent of full scale")),
        tag(
            "div.ca-errors",
            numbers(form, part, ("offset", "gain", "bend", "hysteresis", "resolution", "noise"), units),
        ),
        row("Shape", shapes),
        tag("h3", "Calibration"),
        row(
            "Points",
            tag(
                "div.se-line",
                typed(form, part, "points", units),
                "degree",
                typed(form, part, "degree", units),
                "seed",
                typed(form, part, "seed", units),
            ),
        ),
        row(
            "Drift",
            tag(
                "div.se-line",
                typed(form, part, "drift", units),
                tag("i", "% a month, after"),
                typed(form, part, "age", units),
                tag("i", "months"),
            ),
        ),
    )


def _up_and_down(values: Floats, count: int) -> tuple[Floats, Floats]:
    """Return what was found on the way up and on the way down, both by rising inputs."""
    return values[:count], values[: count - 1 : -1]


class _Errors:
    """Errors over the input, before and after the calibration."""

    def __init__(self, gui: Gui) -> None:
        curves = [
            Line("before ↑, %", VERMILLION),
            Line("before ↓, %", ORANGE, dash=(6, 3)),
            Line("after ↑, %", BLUE),
            Line("after ↓, %", GREY, dash=(6, 3)),
        ]
        self._plot = Plot(gui, "Error, % of full scale", "input, %", curves, "calibration", height=HEIGHT)

    def show(self, part: Curve) -> None:
        """Show the errors at the points of the calibration."""
        cycle, count = part.cycle, part.points
        before = _up_and_down((cycle.outputs - cycle.inputs) / PERCENT, count)
        after = _up_and_down(part.calibration.residuals / PERCENT, count)
        self._plot.show(cycle.inputs[:count] / PERCENT, [*before, *after])


class _Outputs:
    """The characteristic curve."""

    def __init__(self, gui: Gui) -> None:
        curves = [
            Line("ideal, %", GREY, 1.2, dash=(3, 3)),
            Line("best line, %", ORANGE, 1.2),
            Line("up, %", BLUE),
            Line("down, %", VERMILLION, dash=(6, 3)),
        ]
        self._plot = Plot(gui, "Output, % of full scale", "input, %", curves, "characteristic", height=LOW)

    def show(self, part: Curve) -> None:
        """Show the outputs of the cycle, and the line that fits them best."""
        cycle, count = part.cycle, part.points
        inputs, (intercept, slope) = cycle.inputs[:count], cycle.line
        up, down = _up_and_down(cycle.outputs, count)
        shown = [inputs, intercept + slope * inputs, up, down]
        self._plot.show(inputs / PERCENT, [each / PERCENT for each in shown])


def _percent(part: float) -> str:
    return f"{number(part / PERCENT, 3)} %"


def _largest(errors: Floats) -> float:
    return float(np.abs(errors).max())


def _figures(part: Curve) -> Markup:
    """Return the figures of the sensor before and after its calibration."""
    cycle, fitted = part.cycle, part.calibration
    corrected = fitted.corrected(cycle.outputs)
    count = part.points
    up, down = _up_and_down(corrected, count)
    rows: list[tuple[Inside, Inside, Inside]] = [
        ("largest error", _percent(cycle.largest_error), _percent(_largest(fitted.residuals))),
        ("at other inputs", "", _percent(_largest(part.checked))),
        ("linearity error", _percent(cycle.linearity), _percent(linearity_error(cycle.inputs, corrected))),
        ("offset error", _percent(cycle.offset), _percent(0.5 * float(corrected[0] + corrected[-1]))),
        ("hysteresis", _percent(cycle.hysteresis), _percent(_largest(up - down))),
        (tag("span", "resolution error", title=DEAD), _percent(part.dead), "the same"),
    ]
    head = head_line(None, "before", "after")
    return tag("table.kit-points", head, [line(before, after, name=name) for name, before, after in rows])


def _verdict(part: Curve) -> Markup:
    """Return what is left, and why."""
    left, between = _largest(part.calibration.residuals), _largest(part.checked)
    sensor = part.sensor
    drifted = abs(part.drift * part.age) * PERCENT
    head = f"{_percent(between)} left of {_percent(part.cycle.largest_error)}"
    if drifted > 0.5 * between:
        return verdict_box("no", head, f"Mostly drift: {_percent(drifted)} since the calibration. Calibrate again.")
    play_and_steps = 0.5 * (sensor.hysteresis + sensor.resolution)
    # Points that lie on steps of the resolution have no error of it, unlike all other inputs.
    if between > 2.0 * max(left, play_and_steps) + 1e-9:
        return verdict_box("no", head, OVERFITTED_NOISE if sensor.noise > 0.0 and part.degree > 1 else OVERFITTED)
    floor = play_and_steps + 3.0 * sensor.noise
    if left > 1.5 * floor + 1e-9:
        return verdict_box("warn", head, _too_coarse(part))
    if floor < 1e-9:
        return verdict_box("ok", head, "The polynomial is the curve.")
    return verdict_box("ok", head, REMAINS[sensor.hysteresis > 0.0, sensor.resolution > 0.0, sensor.noise > 0.0])


def _too_coarse(part: Curve) -> str:
    """Return why the polynomial is not close to the curve, and what helps if anything does."""
    if part.sensor.turns_back:
        return TURNS_BACK
    said = f"A polynomial of degree {part.degree} does not follow the curve closely enough"
    if part.degree < min(MOST_DEGREE, part.points - 1):
        return f"{said}: raise the degree."
    return f"{said}, and no higher one can be chosen."


def _polynomial(part: Curve) -> Inside:
    """Return the polynomial with its numbers, full scale being 1."""
    terms = []
    for power, value in enumerate(part.calibration.coefficients.tolist()):
        factor = "" if power == 0 else " y" if power == 1 else f" y{_raised(power)}"
        plus, minus = (" + ", " − ") if power else ("", "−")
        sign = minus if value < 0.0 else plus
        terms.append(f"{sign}{amount(abs(value))}{factor}")
    return tag("p.dim", f"Input from output, full scale 1: u = {''.join(terms)}")


def _raised(power: int) -> str:
    return str(power).translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹"))


PANEL = Panel((Curve,), build, rebuilds=(Notation,), apart=True)
