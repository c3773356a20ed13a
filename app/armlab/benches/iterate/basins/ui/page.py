"""Basins of attraction: which solution a method reaches from where, as a map whose every point begins a film."""

from __future__ import annotations

import math

from armlab.benches.iterate.basins.maps import Map
from armlab.benches.iterate.basins.state import (
    POINTS,
    STEPS,
    Basins,
    CancelBasins,
    DrawBasins,
    MapJoints,
    MapLike,
    MapMethod,
    MapRest,
    StartInMap,
    TakeJoint,
    refusal,
)
from armlab.benches.iterate.basins.ui.map import here, legend, map_markup, places, save_link, standing, target_text
from armlab.benches.iterate.runs.commands import AimAt, ChooseTask
from armlab.benches.iterate.runs.state import Iterations, vector_of
from armlab.benches.iterate.runs.ui.words import (
    choices,
    chosen,
    lowered_index,
    made,
    parameter_unit,
    sigma_unit,
    vector_text,
)
from armlab.errors import InputError
from armlab.kin.ik.iterate import iteration_methods
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.session import Refuse
from armlab.session.state import Command, Post, State
from armlab.ui.fields import Fields
from armlab.ui.format import capitalised, escaped, trimmed
from armlab.ui.markup import button, chip, chips, options, row, select
from armlab.ui.plugin import Panel, Show
from armlab.ui.tried import plain_number
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

LIMITS = {"none": "Not kept", "clamp": "Kept"}
WHAT_TO_DO = "Choose a task vector with a joint in it, or lock joints on the page Joints."


class BasinsPage:
    """The page."""

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        self._gui, self._state, self._post, self._units = gui, state, post, units_of(state)
        self._choices = gui.fields(lambda cell, text: self._typed(cell, text))
        self._picture = gui.fields(lambda cell, text: self._picked(text))
        self._live = gui.html()
        self._below = gui.html()
        self._drawn: tuple[Map | None, bool] | None = None

    # -- what a person does --------------------------------------------------------------------------------------

    def _typed(self, cell: str, text: str) -> None:
        """Try what was typed or pressed; where it is refused, say why beside it."""
        try:
            command = command_of(self._state, cell, text, self._units)
            if command is not None:
                command.apply(self._state)
        except InputError as why:
            self._choices.refuse(cell, text, str(why))
            self._post(Refuse(str(why)))
            self._show_choices()
        else:
            if command is not None:
                self._post(command)

    def _picked(self, text: str) -> None:
        """Begin the film where the map was clicked; the page says where from its upper left corner."""
        try:
            x, y = (float(part) for part in text.split(","))
        except ValueError:
            return
        if math.isfinite(x + y):
            self._post(StartInMap(min(max(x, 0.0), 1.0), min(max(1.0 - y, 0.0), 1.0)))
            self._gui.open_panel("iterations")

    # -- showing -------------------------------------------------------------------------------------------------

    def show(self, state: State) -> None:
        """Show a state; the picture is sent only when it is another one."""
        self._state = state
        self._show_choices()
        found = state[Basins].map
        drawn = (found, state[Basins].drawing is not None)
        if drawn != self._drawn or self._picture.stale:
            self._drawn = drawn
            self._show_map(state, found)
        self._live.show(f'{places(state)}<p class="dim">{here(state)}</p>' if found is not None else "")

    def _show_choices(self) -> None:
        self._choices.show(choices_markup(self._choices, self._state, self._units))

    def _show_map(self, state: State, found: Map | None) -> None:
        if found is None:
            self._picture.show("")
            self._below.show("")
            return
        self._picture.show(map_markup(self._picture, found, self._units))
        save = "" if state[Basins].drawing is not None else save_link(found, state[RobotPart].robot.name)
        self._below.show(legend(found, self._units) + save)


def command_of(state: State, cell: str, text: str, units: Units) -> Command | None:
    """Return what a person asked for; None when no cell has this name.

    Raises
    ------
    InputError
        What was typed is no number, or none of the choices.
    """
    part, arm = state[Basins], state[Joints].arm
    name, _, rest = cell.partition("-")
    if name == "draw":
        return DrawBasins()
    if name == "cancel":
        return CancelBasins()
    if name == "aim":
        return AimAt()
    if name == "stand":
        return MapRest()
    if name == "method":
        return MapMethod(text)
    if name == "parameter":
        return MapMethod(part.run.method, rest, plain_number(text))
    if name in ("points", "most") and rest.isdecimal():
        return MapLike(points=int(rest)) if name == "points" else MapLike(most=int(rest))
    if name == "limits":
        return MapLike(limits=rest)
    if name in ("across", "up") and text.isdecimal():
        joint = int(text)
        across, up = part.joints
        if name == "across":
            return MapJoints(joint, across if joint == up else up)
        return MapJoints(up if joint == across else across, joint)
    if name == "rest" and rest.isdecimal() and int(rest) < arm.n:
        i = int(rest)
        revolute = bool(arm.revolute[i])
        return MapRest(i, units.read(text, revolute, f"start of {units.variable(i, revolute)}"))
    return _task_command(state, name, text, units)


def _task_command(state: State, name: str, text: str, units: Units) -> Command | None:
    arm, vector = state[Joints].arm, vector_of(state)
    if name == "task":
        if text not in choices(arm):
            raise InputError(f"task vector: expected one of the list, got {text[:40]!r}")
        return TakeJoint(int(text[1:])) if text[:1] == "q" else ChooseTask(made(arm, text, 0.0))
    if name == "wanted" and vector.joints:
        joint = vector.joints[0][0]
        revolute = bool(arm.revolute[joint - 1])
        value = units.read(text, revolute, f"wanted value of joint {joint}")
        return ChooseTask(made(arm, f"q{joint}", value))
    return None


# -- the choices -----------------------------------------------------------------------------------------------------


def choices_markup(fields: Fields, state: State, units: Units) -> str:
    """Return all that can be chosen, and the button that draws or cancels."""
    part, channel = state[Basins], fields.channel_id
    titles = {key: capitalised(method.title) for key, method in iteration_methods().items()}
    method = select(channel, "method", "Method", options(titles, part.run.method))
    return (
        f'<div class="ba-choices">{row("Method", method)}{_parameters(fields, state)}'
        + _task(fields, state, units)
        + _joints(channel, state, units)
        + _rest(fields, state, units)
        + row("Starts", chips(channel, {f"points-{n}": f"{n} × {n}" for n in POINTS}, f"points-{part.points}", ""))
        + row("At most", chips(channel, {f"most-{n}": f"{n}" for n in STEPS}, f"most-{part.most}", "") + "<i>steps</i>")
        + row(
            "Limits",
            chips(
                channel,
                {f"limits-{key}": text for key, text in LIMITS.items()},
                f"limits-{part.limits}",
                "Whether each step ends at the joint limits",
            ),
        )
        + f"</div>{_action(channel, state)}{standing(state)}"
    )


def _parameters(fields: Fields, state: State) -> str:
    run, vector = state[Basins].run, vector_of(state)
    cells = []
    for each in run.kind.parameters:
        unit = parameter_unit(each, sigma_unit(state), vector.m)
        hint = f"{capitalised(each.title)}: {each.low:g} to {each.high:g}{f' {unit}' if unit else ''}"
        cell = fields.field(f"parameter-{each.key}", trimmed(run.values[each.key], 6), each.title)
        cells.append(
            f'<label title="{escaped(hint)}"><span>{lowered_index(each.symbol)}</span>{cell}<i>{unit}</i></label>'
        )
    return row("", f'<div class="kit-numbers">{"".join(cells)}</div>') if cells else ""


def _task(fields: Fields, state: State, units: Units) -> str:
    """Return target and task vector, which are those of the film."""
    arm, part, channel = state[Joints].arm, state[Iterations], fields.channel_id
    vector, found = vector_of(state), choices(arm)
    place = target_text(arm, part.target, units)
    hint = "Take the target of the lab; when dragged, it is taken by itself"
    line = row("Target", f"<span>{place}</span>{chip(channel, 'aim', 'From the handle', hint)}")
    if len(found) == 1:
        line += row("Task", f"<span>{vector_text(vector)}</span>")
    else:
        line += row("Task", select(channel, "task", "Task vector", options(found, chosen(arm, part.task))))
    if vector.joints:
        joint, value = vector.joints[0]
        revolute = bool(arm.revolute[joint - 1])
        name = units.variable(joint - 1, revolute)
        cell = fields.field("wanted", units.text(value, revolute), f"Wanted value of {name}")
        wanted = f"<label><span>{name} wanted</span>{cell}<i>{units.unit(revolute)}</i></label>"
        line += row("", f'<div class="kit-numbers">{wanted}</div>')
    return line


def _joints(channel: str, state: State, units: Units) -> str:
    arm, (across, up) = state[Joints].arm, state[Basins].joints
    if arm.n < 3:
        return ""
    names = {str(i): units.variable(i, bool(arm.revolute[i])) for i in range(arm.n)}
    return row(
        "Axes",
        "<i>across</i>"
        + select(channel, "across", "Joint across", options(names, str(across)))
        + "<i>up</i>"
        + select(channel, "up", "Joint up", options(names, str(up))),
    )


def _rest(fields: Fields, state: State, units: Units) -> str:
    """Return the start values of the joints that do not vary."""
    part, joints = state[Basins], state[Joints]
    cells = []
    for i, value in enumerate(part.rest):
        if i in part.joints:
            continue
        revolute, held = bool(joints.arm.revolute[i]), joints.locked[i]
        name = units.variable(i, revolute)
        shown = units.text(float(joints.q[i]) if held else value, revolute)
        cell = fields.field(f"rest-{i}", shown, f"Start of {name} in {units.unit(revolute)}", held)
        cells.append(f"<label><span>{name}</span>{cell}<i>{units.unit(revolute)}</i></label>")
    if not cells:
        return ""
    take = chip(fields.channel_id, "stand", "As the arm stands", "Take the joint values of the arm")
    return row("Others", f'<div class="kit-numbers">{"".join(cells)}</div>{take}')


def _action(channel: str, state: State) -> str:
    part = state[Basins]
    if part.drawing is not None:
        done = part.map.done if part.map is not None and part.map.question is part.drawing else 0.0
        bar = f'<div class="progress" style="--part:{100.0 * done:.0f}%"></div>'
        press = button(channel, "cancel", "Cancel", "chip", "Stop drawing; what there is stays")
        return f'<div class="bar">{press}<span class="dim">Drawing: {100.0 * done:.0f} %</span></div>{bar}'
    why = refusal(state)
    press = button(channel, "draw", "Draw", "main", off=bool(why))
    if why:
        return (
            f'<div class="verdict no"><b>✕ No map</b>{escaped(capitalised(why))}. {WHAT_TO_DO}</div>'
            f'<div class="bar">{press}</div>'
        )
    return f'<div class="bar">{press}<span class="dim">Click the map: a film begins.</span></div>'


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the choices and the map."""
    return BasinsPage(gui, state, post).show


PANEL = Panel((Basins, Iterations, Joints, RobotPart, Notation), build)
