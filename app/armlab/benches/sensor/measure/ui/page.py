"""The page of accuracy and repeatability: throws at a board, and what n of them tell."""

from __future__ import annotations

from armlab.benches.sensor.absolute.ui.numbers import numbers, typed
from armlab.benches.sensor.measure.commands import AimAsBefore, CorrectAim, ThrowAgain
from armlab.benches.sensor.measure.examples import EXAMPLES, ChooseThrowsExample
from armlab.benches.sensor.measure.state import Throws
from armlab.benches.sensor.measure.ui.board import MOST_DRAWN, board
from armlab.kin.sensors.throws import CONFIDENCE
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import mathml, number
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import row, verdict_box
from armlab.ui.plugin import Panel, Show
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

MOSTLY = 0.7
"""Part of the mean square distance from which on one of its two causes is called the main one."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the example, the fields, the board, and what the throws tell."""
    form, drawn, units = gui.form(post), gui.html(), units_of(state)

    def show(state: State) -> None:
        part = state[Throws]
        if form.shows(part):
            return
        form.show(_head(form, part, units))
        drawn.show(board(part, units), _key(part), _estimates(part, units), _verdict(part, units))

    return show


def _head(form: Form, part: Throws, units: Units) -> Markup:
    hint = "Aim against the centre of these throws, and throw again"
    corrected = bool(part.aim_right or part.aim_up)
    return joined(
        examples(form, EXAMPLES, part.example, ChooseThrowsExample),
        numbers(form, part, ("right", "up", "spread"), units),
        row(
            "Throws",
            tag("div.se-line", typed(form, part, "count", units), "seed", typed(form, part, "seed", units)),
        ),
        row(
            "Hits",
            tag(
                "div.se-line",
                "within",
                typed(form, part, "hit", units),
                tag("i", units.length_unit),
                form.chip("told", "Truth", Set(Throws, "told", not part.told), "Show true bias and spread", part.told),
            ),
        ),
        tag(
            "div.bar",
            form.button("correct", "Correct the aim", CorrectAim(), "main", hint),
            form.button("throw", "Throw again", ThrowAgain(), "", "The same hand, other throws"),
            form.chip("as-before", "Aim as before", AimAsBefore(), off=not corrected),
        ),
    )


def _key(part: Throws) -> Markup:
    sure = number(100.0 * CONFIDENCE, 0)
    few = f" The first {MOST_DRAWN} throws are drawn." if part.count > MOST_DRAWN else ""
    truth = " ✕: the true bias." if part.told else ""
    return tag(
        "p.dim", f"+: centre of the throws, in the circle that holds the bias in {sure} % of all cases.{truth}{few}"
    )


def _estimates(part: Throws, units: Units) -> Markup:
    """Return estimated bias and spread, with their confidence, beside the true ones."""
    found, bias = part.found, part.bias

    def said(value: float) -> str:
        return units.text(value, False)

    def point(x: float, y: float) -> str:
        return f"({said(x)}, {said(y)})"

    rows: list[tuple[str, str, str, str]] = [
        ("centre", point(found.mean[0], found.mean[1]), f"± {said(found.radius)}", point(bias[0], bias[1])),
        ("its distance", said(found.distance), "", said(float((bias @ bias) ** 0.5))),
        ("spread", said(found.spread), f"{said(found.low)} to {said(found.high)}", said(part.spread)),
    ]
    sure = f"{number(100.0 * CONFIDENCE, 0)} %"
    head = head_line(units.length_unit, "estimated", sure, "true" if part.told else "")
    lines = [line(value, range_, true if part.told else "", name=name) for name, value, range_, true in rows]
    return tag("table.kit-points.th-found", head, lines)


def _verdict(part: Throws, units: Units) -> Markup:
    """Return which of bias and spread makes the misses, and what helps against it."""
    found, share = part.found, part.bias_share
    rms, spread = units.length(part.rms), units.length(part.about)
    parts = (
        tag("div.eq.small", mathml(r"\frac{1}{n}\sum|x_i|^2=|\bar x|^2+\frac{1}{n}\sum|x_i-\bar x|^2")),
        f"The root mean square miss is {rms}: bias {units.length(found.distance)}, spread {spread} about the centre. "
        f"{part.hits} of {part.count} are hits.",
    )
    if not found.settled:
        return verdict_box(
            "ok" if part.hits > 0.5 * part.count else "warn",
            "No bias that chance would not explain",
            parts,
            " The middle lies in the circle: a correction would only follow chance.",
        )
    if share > MOSTLY:
        return verdict_box("no", "Mostly bias: not accurate", parts, " Calibration takes it away.")
    if share < 1.0 - MOSTLY:
        return verdict_box("warn", "Mostly spread: not repeatable", parts, " Only better components help.")
    return verdict_box("no", "Both bias and spread", parts, " Calibration takes away the first, and not the second.")


PANEL = Panel((Throws,), build, rebuilds=(Notation,), apart=True)
