"""The page of accuracy: what is wrong with the arm, where it comes to, and what accuracy and repeatability follow."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

from armlab.benches.robot.taught.examples import EXAMPLES, ChooseGoalExample
from armlab.benches.robot.taught.state import ABOUT, PLANES, TaughtGoal, VisitAgain
from armlab.benches.robot.taught.ui.board import board
from armlab.benches.robot.taught.ui.scene import around
from armlab.benches.robot.taught.visits import Visits, visits_of
from armlab.session.fields import Set, fields_of
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import mathml, readable, trimmed
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold
from armlab.ui.option_text import Scale, option_value
from armlab.ui.plugin import Panel, Show
from armlab.ui.small_numbers import with_unit
from armlab.ui.tables import line
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

GOALS = {"table": "from the table", "taught": "taught"}

FORMULAS = r"AP=|\bar p-p_c|,\quad l_j=|p_j-\bar p|,\quad RP=\bar l+3\,S_l"

FINDS = "A peg does if it misses by no more than clearance and compliance together."

MANY = 3.0
"""Ratio of accuracy and repeatability from which one is told to be many times the other."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the goal, the picture, the numbers, the peg and the errors."""
    form, units = gui.form(post), units_of(state)

    def show(state: State) -> None:
        part, visits = state[TaughtGoal], visits_of(state)
        form.show(
            examples(form, EXAMPLES, part.example, ChooseGoalExample),
            _goal(form, part),
            _seen(form, part),
            board(part, visits, units),
            numbers_markup(visits, units),
            peg_markup(form, part, visits, units),
            fold("What is wrong with the arm", errors_markup(form, state, units)),
            fold("How they are computed", words_markup(part)),
        )

    return show


def _goal(form: Form, part: TaughtGoal) -> Markup:
    chosen = "taught" if part.taught else "table"
    hint = "Whether the goal is computed, or is where the arm stood once"
    chips = form.chips("goal", GOALS, chosen, hint, lambda key: Set(TaughtGoal, "taught", key == "taught"))
    again = form.chip("again", f"{part.visits} more visits", VisitAgain(), "With other errors by chance")
    return tag("div.bar", tag("span.dim", "goal"), chips, again)


def _seen(form: Form, part: TaughtGoal) -> Markup:
    plane = form.chips("plane", PLANES, part.plane, "Plane that is seen", partial(Set, TaughtGoal, "plane"))
    about = form.chips("about", ABOUT, part.about, "Middle of the picture", partial(Set, TaughtGoal, "about"))
    return tag("div.bar", plane, tag("span.dim", "about"), about)


def numbers_markup(visits: Visits, units: Units) -> Inside:
    """Return accuracy and repeatability, and which of both is the larger."""
    found = visits.scatter
    return (
        tag(
            "table.kit-points.ac-numbers",
            line(with_unit(found.accuracy, False, units), "from goal × to mean +", name="accuracy AP"),
            line(with_unit(found.repeatability, False, units), "radius of the circle", name="repeatability RP"),
        ),
        tag("p", said_of(visits)),
    )


def said_of(visits: Visits) -> str:
    """Return in words which error is the larger."""
    found = visits.scatter
    if found.repeatability == 0.0:
        return "Every visit ends at the same point: no scatter at all."
    ratio = found.accuracy / found.repeatability
    if ratio >= MANY:
        return f"AP is {trimmed(ratio, 1)} times RP: it comes back, but to another place than the one it was sent to."
    if ratio <= 1.0 / MANY:
        return "AP is small beside RP: on the average it is right, and each visit misses by chance."
    return "Both errors are of the same size."


def peg_markup(form: Form, part: TaughtGoal, visits: Visits, units: Units) -> Inside:
    """Return clearance and compliance, and how many pegs find their hole."""
    entered = visits.entered(part.clearance, part.yields)
    return (
        tag("h3", "A peg along z of the tool"),
        tag("div.ac-fields", [_field(form, part, name, units) for name in ("clearance", "yields")]),
        tag("p", tag("b", f"{entered} of {part.visits} pegs"), f" find their hole. {FINDS}"),
    )


def errors_markup(form: Form, state: State, units: Units) -> Inside:
    """Return the fields of the errors; those of sliding joints for an arm that has some."""
    part, arm = state[TaughtGoal], state[Joints].arm
    names = ["longer"]
    names += ["offset", "scatter"] if arm.revolute.any() else []
    names += [] if arm.revolute.all() else ["slide_offset", "slide_scatter"]
    names += ["visits", "seed"]
    return tag("div.ac-fields", [_field(form, part, name, units) for name in names])


def _field(form: Form, part: TaughtGoal, name: str, units: Units) -> Markup:
    spec = fields_of(TaughtGoal)[name]
    value: Any = getattr(part, name)
    unit, factor = _unit(name, spec.unit, units)

    def typed(text: str) -> Command:
        if unit in ("°", "rad", "mm", "m"):
            return Set(TaughtGoal, name, units.read(text, spec.unit == "rad", spec.title, within=(spec.low, spec.high)))
        shown = replace(spec, unit="q") if unit else spec
        return Set(TaughtGoal, name, option_value(shown, text.removesuffix(unit), value, (Scale(unit, factor),), True))

    field = form.field(name, readable(value / factor, 3), spec.title, typed)
    return tag("label", tag("span", spec.title), field, tag("i", unit))


def _unit(name: str, unit: str, units: Units) -> tuple[str, float]:
    """Return the unit on screen, and the value of one of it."""
    if name == "longer":
        return "‰", 1e-3
    if unit in ("rad", "m"):
        return units.unit(unit == "rad"), units.factor(unit == "rad")
    return "", 1.0


def words_markup(part: TaughtGoal) -> Inside:
    """Return the definitions, and what the arm does here."""
    return (
        tag("div.eq.small", mathml(FORMULAS)),
        tag(
            "p.dim",
            "p_c is the goal, p̄ the mean of the positions p_j, S_l the standard deviation of their distances l_j from "
            "it: pose accuracy and pose repeatability of ISO 9283, for positions. Data sheets give RP.",
        ),
        tag(
            "p.dim",
            f"The arm goes {part.visits} times to the joint values at which it stands. Its zeros and lengths are "
            "wrong in the same way each time, and make AP. Each joint stops elsewhere by chance, and that makes RP. "
            "In the scene the deviations are drawn larger.",
        ),
    )


PANEL = Panel((TaughtGoal, Joints), build, around=around)
