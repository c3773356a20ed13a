"""The page of pose accuracy: errors of the joints, AP and RP of the present pose, and what each joint adds."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from armlab.benches.sensor.absolute.ui.numbers import numbers, typed
from armlab.benches.sensor.pose.commands import MoveAgain
from armlab.benches.sensor.pose.examples import EXAMPLES, ChoosePoseExample
from armlab.benches.sensor.pose.state import Attained, Repeats, found
from armlab.benches.sensor.pose.ui.cloud import around
from armlab.kin.control.encoder import SHAFTS
from armlab.kin.sensors.pose_accuracy import APPROACHES, STANDARD, expected_spread, shares
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.state import Post, State
from armlab.ui.colours import css, joint_colour
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import dot, mathml, readable, scientific, trimmed
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import fold, row, verdict_box
from armlab.ui.plugin import Panel, Show
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

Floats = NDArray[np.float64]

MOST_TIMES_BETTER = 1000.0
"""Largest ratio of AP and RP that is written as a number."""

ROUNDING = 1e-14
"""Error of a position, in parts of the largest number of the pose, that is rounding."""

SEES_PLAY = "The encoder on the link sees the play of the gears, and the joint comes to its place in spite of it."

ANGLES = ("a", "b", "c")
"""Names of the angles about x, y and z in the standard."""

POWER_BELOW = 1e-4
"""Size below which a number is written with a power of ten."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the example, the errors of the joints, the figures, and the shares of the joints."""
    form, said, units = gui.form(post), gui.html(), units_of(state)

    def show(state: State) -> None:
        part, attained = state[Repeats], state.derived(found)
        form.show(_head(form, state, part, units))
        said.show(
            _figures(attained, units),
            _verdict(attained),
            fold("Formulas with their numbers", _formulas(attained, units), key="formulas"),
            fold("What each joint adds", _shares(state, attained, units), key="shares"),
        )

    return show


def _head(form: Form, state: State, part: Repeats, units: Units) -> Markup:
    arm = state[Joints].arm
    turning = ("backlash", "zero") if arm.revolute.any() else ()
    sliding = () if arm.revolute.all() else ("play", "zero_slide")
    shafts = form.chips("shaft", SHAFTS, part.shaft, "Encoder on the", partial(Set, Repeats, "shaft"))
    ratio = ("gears 1 :", typed(form, part, "ratio", units)) if part.shaft == "motor" else None
    approaches = form.chips(
        "approach", APPROACHES, part.approach, "From where each joint comes", partial(Set, Repeats, "approach")
    )
    return joined(
        examples(form, EXAMPLES, part.example, ChoosePoseExample, said=units.said),
        row(
            "Encoder", tag("div.se-line.pa-wide", typed(form, part, "counts", units), tag("i", "counts"), shafts, ratio)
        ),
        tag("div.pa-errors", numbers(form, part, (*turning, *sliding, "specimen"), units)),
        tag("p.dim", SEES_PLAY) if part.shaft == "link" else None,
        row("Approach", approaches),
        row(
            "Sent there",
            tag(
                "div.se-line",
                typed(form, part, "times", units),
                "times, seed",
                typed(form, part, "seed", units),
                form.chip("again", "Again", MoveAgain(), "Send the same arm there as often again"),
            ),
            hint=f"The standard asks for {STANDARD} times",
        ),
    )


def _length(value: float, units: Units) -> str:
    """Return a small length with as many decimals as it needs."""
    return (
        f"{readable(float(f'{value:.3g}'), 1)}"
        if value == 0.0
        else f"{_small(value, units, False)} {units.length_unit}"
    )


def _small(value: float, units: Units, revolute: bool) -> str:
    """Return a small length or angle with three significant digits, in the unit of the person."""
    shown = value / units.factor(revolute)
    return scientific(shown, 2) if 0.0 < abs(shown) < POWER_BELOW else readable(float(f"{shown:.3g}"), 0)


def _angle(value: float, units: Units) -> str:
    return f"{_small(value, units, True)}{'°' if units.in_degrees else ' rad'}"


def _figures(attained: Attained, units: Units) -> Markup:
    """Return AP and RP of position and orientation."""
    figures = attained.figures
    rows = [("position", _length(figures.position.accuracy, units), _length(figures.position.repeatability, units))]
    for name, axis, accuracy, repeatability in zip(
        ANGLES, "xyz", figures.turn_accuracy.tolist(), figures.turn_repeatability.tolist(), strict=True
    ):
        rows.append((f"{name}, about {axis}", _angle(accuracy, units), f"±{_angle(repeatability, units)}"))
    head = head_line(None, "accuracy AP", "repeatability RP")
    return tag("table.kit-points", head, [line(ap, rp, name=name) for name, ap, rp in rows])


def _verdict(attained: Attained) -> Markup:
    """Return which of the two figures is larger, and what stands in the scene."""
    scene = "The scene shows the attained positions, magnified as its label says; the arrow is AP and the ball RP."
    ap, rp = attained.figures.position.accuracy, attained.figures.position.repeatability
    if max(ap, rp) <= ROUNDING * float(np.abs(attained.figures.commanded).max()):
        if attained.figures.turns.any():
            turned = "No joint moves the tool point here. The orientation is off all the same, as the table says."
            return verdict_box("ok", "No error of the position", turned)
        return verdict_box("ok", "No error", scene)
    if ap > rp:
        more = trimmed(ap / rp, 1) if rp > ap / MOST_TIMES_BETTER else "far more than a thousand"
        head = "More repeatable than accurate"
        return verdict_box("warn", head, f"AP is {more} times RP: calibration would help. {scene}")
    head = "Accurate on the mean, not repeatable"
    return verdict_box("warn", head, f"RP is larger than AP: better encoders and gears would help. {scene}")


def _formulas(attained: Attained, units: Units) -> Inside:
    """Return the formulas of the standard for the position, with their numbers."""
    figures = attained.figures
    away = [_small(each, units, False) for each in (figures.position.middle - figures.commanded[:3, 3]).tolist()]
    mean, deviation = _length(figures.position.mean_distance, units), _length(figures.position.deviation, units)
    return (
        tag("div.eq.small", mathml(r"AP=\sqrt{(\bar x-x_c)^2+(\bar y-y_c)^2+(\bar z-z_c)^2}")),
        tag("p", f"Barycentre less commanded position: ({', '.join(away)}) {units.length_unit}."),
        tag("div.eq.small", mathml(r"RP=\bar l+3\,S_l,\;S_l=\sqrt{\frac{\sum(l_j-\bar l)^2}{n-1}}")),
        tag(
            "p",
            f"Distances l from the barycentre: mean {mean}, S = {deviation}, so that RP = {mean} + 3 · {deviation} = "
            f"{_length(figures.position.repeatability, units)}, with n = {len(figures.poses)}.",
        ),
        tag("div.eq.small", mathml(r"AP_a=\bar a-a_c,\;\;RP_a=\pm 3\,S_a")),
        tag(
            "p.dim",
            "The angles a, b, c are those of the rotation vector from the commanded orientation, about the axes x, y, "
            "z of the world. Position and orientation have figures of their own: metres and degrees are not added. "
            "ISO 9283.",
        ),
    )


def _shares(state: State, attained: Attained, units: Units) -> Inside:
    """Return how far each joint alone spreads the tool, to first order."""
    part, joints = state[Repeats], state[Joints]
    arm, errors = joints.arm, attained.errors
    each = shares(arm, joints.q, errors, part.approach)
    spread = errors.spread(part.approach)
    largest = float(each.max()) or 1.0
    rows = []
    for k, (own, share) in enumerate(zip(spread.tolist(), each.tolist(), strict=True)):
        revolute = bool(arm.revolute[k])
        deviation = _angle(own, units) if revolute else _length(own, units)
        name = (dot(css(joint_colour(k))), units.variable(k, revolute))
        bar = tag("div.progress", style=f"--part:{100.0 * share / largest:.0f}%")
        rows.append(
            tag("tr", tag("th", name), tag("td", deviation), tag("td", _length(share, units)), tag("td.pa-bar", bar))
        )
    whole = _length(expected_spread(arm, joints.q, errors, part.approach), units)
    rms = _length(float(np.sqrt((attained.figures.position.distances**2).mean())), units)
    return (
        tag("table.kit-points.pa-shares", head_line(None, "σ of the joint", "at the tool", ""), rows),
        tag(
            "p.dim",
            mathml(r"|J_i|\,\sigma_i"),
            f" each; together {whole}, the root of the sum of their squares. The attempts have {rms}.",
        ),
    )


PANEL = Panel((Repeats, Joints), build, around=around)
