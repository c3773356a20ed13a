"""The five planning steps of a stretch of the plan: knots, path, samples, inverse kinematics, joint path."""

from __future__ import annotations

from armlab.benches.motion.plan.limits import SampleBy
from armlab.benches.motion.plan.points import SelectWaypoint
from armlab.benches.motion.plan.state import Plan, planned_now
from armlab.benches.motion.plan.ui.around import way_around
from armlab.benches.motion.steps.state import INVERSE, KNOTS, PATH, SAMPLING, STEPS, PlanSteps
from armlab.benches.motion.steps.ui import words
from armlab.benches.motion.steps.ui.plots import Plots
from armlab.benches.motion.steps.ui.scene import RESULT, WANTED
from armlab.benches.motion.steps.worked import Steps, kept, steps
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Post, State
from armlab.ui.colours import css
from armlab.ui.form import Form
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import row
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import plain_number, units_of
from armlab.ui.widgets import Gui

MOST_CHIPS = 6
"""Largest number of stretches that are chosen by chips; more are chosen by a list."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choice of stretch and step, the explanation of the step, and its plots."""
    looked = steps(state)
    form, plots = gui.form(post), Plots(gui, state)

    def show(state: State) -> None:
        nonlocal looked
        looked = kept(state.derived(steps), looked)
        form.show(steps_markup(form, state, looked))
        plots.show(looked, state)

    return show


def steps_markup(form: Form, state: State, found: Steps | None) -> Markup:
    """Return the choice of stretch and step, and the explanation of the step; None means that it is being computed."""
    part = state[Plan]
    if part.recorded is not None:
        return tag(
            "p",
            "The motion was read from a file: its samples are joined by a spline, which is step 5. The steps "
            "before it were taken elsewhere.",
        )
    if not part.moves:
        return tag("p", "A motion needs two waypoints. Add another on the page Plan.")
    head = joined(_stretches(form, part), _steps(form, state, found))
    if found is None:
        return joined(head, tag("p.dim", "The motion is being planned …"))
    busy = None if planned_now(state) is not None else tag("p.dim", "The motion is being planned again …")
    return joined(head, _step(form, state, found), busy)


def _stretches(form: Form, part: Plan) -> Markup | None:
    """Return the choice among the stretches, or nothing if there is only one."""
    titles = {str(each.last): each.title for each in part.parts}
    chosen = str(part.stretch.last) if part.stretch is not None else ""
    if len(titles) < 2:
        return None
    if len(titles) > MOST_CHIPS:
        return row("Stretch", form.select("stretch", "Stretch", titles, chosen, _selecting))
    return row("Stretch", form.chips("stretch", titles, chosen, "Waypoints that are one path", _selecting))


def _selecting(waypoint: str) -> SelectWaypoint:
    return SelectWaypoint(int(waypoint))


def _steps(form: Form, state: State, found: Steps | None) -> Markup:
    """Return a chip for each step; those that a joint move leaves out are grey."""
    made = []
    for k in STEPS:
        skipped = found is not None and not found.in_space and k in words.SKIPPED
        hint = "A joint move leaves this out" if skipped else f"Step {k} of 5"
        show, on = Set(PlanSteps, "shown", k), k == state[PlanSteps].shown
        chip = form.chip(f"step {k}", f"{k} {words.TITLES[k]}", show, hint, on)
        made.append(tag("span.ms-skipped", chip) if skipped else chip)
    return tag("div.bar.ms-steps", made)


def _step(form: Form, state: State, found: Steps) -> Markup:
    step, units = state[PlanSteps].shown, units_of(state)
    if step == KNOTS:
        said = words.knots(found, units)
    elif step == PATH:
        said = words.path(found, units)
    elif step == SAMPLING:
        count, name = str(state[Plan].samples), "Number of samples"
        typed = form.field("samples", count, name, lambda text: SampleBy(plain_number(text, "samples")))
        field = tag("div.kit-numbers", tag("label", tag("span", "samples"), typed))
        said = words.sampling(found, field, units)
    elif step == INVERSE:
        said = words.inverse(found, units)
    else:
        said = words.joints(found, units, (css(WANTED), css(RESULT)))
    return joined(words.head_of(step, found), said)


PANEL = Panel((Plan, PlanSteps, RobotPart, Notation), build, hides=("gizmo", "gap"), around=way_around)
