"""Basins of attraction: the solution that a method reaches from each start, as a map; a click begins a film."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from armlab.benches.iterate.basins.maps import Map
from armlab.benches.iterate.basins.state import (
    POINTS,
    STEPS,
    Basins,
    CancelBasins,
    DrawBasins,
    MapJoints,
    MapMethod,
    MapRest,
    StartInMap,
    TakeJoint,
    has_joints_to_spare,
    refusal,
    start_in_map,
)
from armlab.benches.iterate.basins.ui.map import here, legend, map_markup, places, save_link, standing, target_text
from armlab.benches.iterate.runs.commands import AimAt, ChooseTask
from armlab.benches.iterate.runs.state import Iterations, vector_of
from armlab.benches.iterate.runs.ui.words import (
    choices,
    chosen,
    made,
    parameter_unit,
    sigma_unit,
    vector_text,
)
from armlab.benches.iterate.runs.worked import Run
from armlab.kin.arm import Arm
from armlab.kin.ik.iterate import iteration_methods
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, Post, State
from armlab.ui.form import Form
from armlab.ui.format import capitalised, trimmed
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import progress_bar, row, verdict_box
from armlab.ui.plugin import Panel, Show
from armlab.ui.symbols import with_indices
from armlab.ui.units import Units, plain_number, units_of
from armlab.ui.widgets import Gui

LIMITS = {"none": "Not kept", "clamp": "Kept"}
KEPT = "Whether each step is stopped at the joint limits"
MAP = (
    "Each point of the map is a start, with the values of the two joints on its axes. Its colour tells to which "
    "solution the method converges from there, and in how many steps."
)
CLICK = "Click a point of the map to see its iterations as a film."
WHAT_TO_DO = "Choose a task vector that contains a joint, or hold joints on the page Joints."


class BasinsPage:
    """The page."""

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        self._gui, self._state, self._units = gui, state, units_of(state)
        self._choices, self._picture = gui.form(post), gui.form(post)
        self._live = gui.html()
        self._below = gui.html()
        self._drawn: tuple[Map | None, bool] | None = None

    def show(self, state: State) -> None:
        """Show a state; the picture is sent only when it has changed."""
        self._state = state
        self._choices.show(choices_markup(self._choices, state, self._units))
        found = state[Basins].map
        drawn = (found, state[Basins].drawing is not None)
        if drawn != self._drawn or self._picture.stale:
            self._drawn = drawn
            self._show_map(state, found)
        self._live.show((places(state), tag("p.dim", here(state))) if found is not None else None)

    def _show_map(self, state: State, found: Map | None) -> None:
        if found is None:
            self._picture.show()
            self._below.show()
            return
        self._picture.show(map_markup(self._picture, found, self._units, self._begin))
        save = None if state[Basins].drawing is not None else save_link(found, state[RobotPart].robot.name)
        self._below.show(legend(found, self._units), save)

    def _begin(self, x: float, y: float, _drag: int) -> StartInMap:
        """Begin the film at the clicked place; a refusal is shown here, and the film's page stays closed."""
        place = min(max(x, 0.0), 1.0), min(max(1.0 - y, 0.0), 1.0)
        start_in_map(self._state, *place)
        self._gui.open_panel("iterations")
        return StartInMap(*place)


# -- the choices -----------------------------------------------------------------------------------------------------


def choices_markup(form: Form, state: State, units: Units) -> Inside:
    """Return all choices, and the button that draws or cancels."""
    part = state[Basins]
    titles = {key: capitalised(method.title) for key, method in iteration_methods().items()}
    method = form.select("method", "Method", titles, part.run.method, MapMethod)
    points = {str(n): f"{n} × {n}" for n in POINTS}
    most = form.chips(
        "most", {str(n): str(n) for n in STEPS}, str(part.most), "", lambda n: Set(Basins, "most", int(n))
    )
    choices = tag(
        "div.ba-choices",
        row("Method", method),
        _parameters(form, state),
        _task(form, state, units),
        _joints(form, state, units),
        _rest(form, state, units),
        row("Starts", form.chips("points", points, str(part.points), "", lambda n: Set(Basins, "points", int(n)))),
        row("At most", (most, tag("i", "steps"))),
        row("Limits", form.chips("limits", LIMITS, part.limits, KEPT, lambda key: Set(Basins, "limits", key))),
    )
    return choices, _action(form, state), standing(state)


def _parameters(form: Form, state: State) -> Markup | None:
    run, vector = state[Basins].run, vector_of(state)
    cells = []
    for each in run.kind.parameters:
        unit = parameter_unit(each, sigma_unit(state), vector.m)
        hint = f"{capitalised(each.title)}: {each.low:g} to {each.high:g}{f' {unit}' if unit else ''}"
        cell = form.field(
            f"parameter-{each.key}", trimmed(run.values[each.key], 6), each.title, partial(_parameter, run, each.key)
        )
        cells.append(tag("label", tag("span", with_indices(each.symbol)), cell, tag("i", unit), title=hint))
    return row(None, tag("div.kit-numbers", cells)) if cells else None


def _parameter(run: Run, key: str, text: str) -> MapMethod:
    parameter = next(each for each in run.kind.parameters if each.key == key)
    return MapMethod(run.method, key, plain_number(text, f"{parameter.title} {parameter.symbol}"))


def _task(form: Form, state: State, units: Units) -> list[Markup]:
    """Return target and task vector, the same as those of the film."""
    arm, part = state[Joints].arm, state[Iterations]
    vector, found = vector_of(state), choices(arm)
    place = target_text(arm, part.target, units)
    hint = "Use the target of the lab; dragging it updates this one as well"
    lines = [row("Target", (tag("span", place), form.chip("aim", "Use the lab's target", AimAt(), hint)))]
    if len(found) == 1:
        lines.append(row("Task", tag("span", vector_text(vector))))
    else:
        taken = form.select("task", "Task vector", found, chosen(arm, part.task), partial(_take_task, arm))
        lines.append(row("Task", taken))
    if vector.joints:
        joint, value = vector.joints[0]
        revolute = bool(arm.revolute[joint - 1])
        name = units.variable(joint - 1, revolute)
        label = f"Wanted value of {name}"
        cell = form.field("wanted", units.text(value, revolute), label, partial(_wanted, arm, joint, units))
        wanted = tag("label", tag("span", f"{name} wanted"), cell, tag("i", units.unit(revolute)))
        lines.append(row(None, tag("div.kit-numbers", wanted)))
    return lines


def _take_task(arm: Arm, key: str) -> Command:
    return TakeJoint(int(key[1:])) if key[:1] == "q" else ChooseTask(made(arm, key, 0.0))


def _wanted(arm: Arm, joint: int, units: Units, text: str) -> ChooseTask:
    value = units.read(text, bool(arm.revolute[joint - 1]), f"wanted value of joint {joint}")
    return ChooseTask(made(arm, f"q{joint}", value))


def _joints(form: Form, state: State, units: Units) -> Markup | None:
    arm, (across, up) = state[Joints].arm, state[Basins].joints
    if arm.n < 3:
        return None
    names = {str(i): units.variable(i, bool(arm.revolute[i])) for i in range(arm.n)}

    def chooser(cell: str, chosen: int, action: Callable[[int], MapJoints]) -> Markup:
        return form.select(cell, f"Joint {cell}", names, str(chosen), lambda key: action(int(key)))

    sideways = chooser("across", across, lambda joint: MapJoints(joint, across if joint == up else up))
    upwards = chooser("up", up, lambda joint: MapJoints(up if joint == across else across, joint))
    return row("Axes", (tag("i", "across"), sideways, tag("i", "up"), upwards))


def _rest(form: Form, state: State, units: Units) -> Markup | None:
    """Return the start values of the joints that do not vary."""
    part, joints = state[Basins], state[Joints]
    cells = []
    for i, value in enumerate(part.rest):
        if i in part.joints:
            continue
        revolute, held = bool(joints.arm.revolute[i]), joints.locked[i]
        name = units.variable(i, revolute)
        shown = units.text(float(joints.q[i]) if held else value, revolute)
        label = f"Start of {name} in {units.unit(revolute)}"
        cell = form.field(f"rest-{i}", shown, label, partial(_typed_rest, i, revolute, units), off=held)
        cells.append(tag("label", tag("span", name), cell, tag("i", units.unit(revolute))))
    if not cells:
        return None
    take = form.chip("stand", "Present configuration", MapRest(), "Use the present joint values of the arm")
    return row("Others", (tag("div.kit-numbers", cells), take))


def _typed_rest(i: int, revolute: bool, units: Units, text: str) -> MapRest:
    return MapRest(i, units.read(text, revolute, f"start of {units.variable(i, revolute)}"))


def _action(form: Form, state: State) -> Inside:
    part = state[Basins]
    if part.drawing is not None:
        done = part.map.done if part.map is not None and part.map.question is part.drawing else 0.0
        press = form.chip("cancel", "Cancel", CancelBasins(), "Stop drawing; what has been drawn stays")
        return tag("div.bar", press, tag("span.dim", f"Drawing: {100.0 * done:.0f} %")), progress_bar(done)
    why = refusal(state)
    press = form.button("draw", "Draw", DrawBasins(), "main", off=bool(why))
    if why:
        advice = f" {WHAT_TO_DO}" if has_joints_to_spare(state) else ""
        return verdict_box("no", "No map", f"{capitalised(why)}.{advice}"), tag("div.bar", press)
    if part.map is None:
        return tag("p.dim", MAP), tag("div.bar", press)
    return tag("div.bar", press, tag("span.dim", CLICK))


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choices and the map."""
    return BasinsPage(gui, state, post).show


PANEL = Panel((Basins, Iterations, Joints, RobotPart, Notation), build)
