"""Inverse kinematics step by step: start, target, task vector, runs, their iterates in numbers and curves."""

from __future__ import annotations

from collections.abc import Callable

from armlab.benches.iterate.runs.clip import each, place_of
from armlab.benches.iterate.runs.commands import AimAt, ChooseTask, KeepLimits, SetStart, StepsAtMost
from armlab.benches.iterate.runs.examples import EXAMPLES, ChooseExample
from armlab.benches.iterate.runs.state import CLIP_KEY, Iterations, arms_found, vector_of
from armlab.benches.iterate.runs.ui.plots import Plots
from armlab.benches.iterate.runs.ui.runs import run_command, runs_markup
from armlab.benches.iterate.runs.ui.table import Table
from armlab.benches.iterate.runs.ui.words import choices, chosen, made, vector_text
from armlab.errors import InputError
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import OpenClip, Play, Seek, Timeline
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples_markup
from armlab.ui.fields import Fields
from armlab.ui.markup import button, chips, options, select
from armlab.ui.plugin import Panel, Show
from armlab.ui.tried import plain_number, tried
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

LIMITS = {"clamp": "Kept", "none": "Not kept"}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the fields of the problem, the runs, the table and the plots."""
    present = state

    def typed(fields: Fields, cell: str, text: str) -> None:
        if not tried(fields, cell, text, lambda: _commands(present, cell, text), present, post):
            show(present)

    problem = gui.fields(lambda cell, text: typed(problem, cell, text))
    runs = gui.fields(lambda cell, text: typed(runs, cell, text))
    numbers = gui.fields(lambda cell, text: typed(numbers, cell, text))
    table, plots = Table(numbers), Plots(gui, state)

    def show(state: State) -> None:
        nonlocal present
        present = state
        problem.show(_problem(problem, state))
        runs.show(runs_markup(runs, state))
        table.show(state)
        plots.show(state)

    return show


def _commands(state: State, cell: str, text: str) -> tuple[Command, ...]:
    """Return what a person asked for."""
    if (command := run_command(cell, text)) is not None:
        return (command,)
    name, _, rest = cell.partition(" ")
    if name == "row" and rest.isdecimal():
        return _to_iterate(state, int(rest))
    simple: dict[str, Callable[[], Command]] = {
        "example": lambda: ChooseExample(text),
        "here": lambda: SetStart(),
        "pose": lambda: SetStart(tuple(state[RobotPart].robot.poses[text].tolist())),
        "aim": lambda: AimAt(),
        "limits": lambda: KeepLimits(rest),
        "most": lambda: StepsAtMost(plain_number(text)),
        "play-steps": lambda: OpenClip(CLIP_KEY, play=True),
        "pause-steps": lambda: Play(False),
        "task": lambda: _task(state, text),
        "wanted": lambda: _wanted(state, text),
        "start": lambda: _start(state, int(rest), text),
    }
    if (cell == "example" and not text) or (cell == "pose" and text not in state[RobotPart].robot.poses):
        return ()
    return (simple[name](),) if name in simple else ()


def _to_iterate(state: State, k: int) -> tuple[Command, ...]:
    """Return what shows an iterate: the film is put on where it is not."""
    film = state[Iterations].film
    if film is None:
        return ()
    on = () if state[Timeline].clip == CLIP_KEY else (OpenClip(CLIP_KEY),)
    return (*on, Seek(k * each(film)))


def _start(state: State, i: int, text: str) -> Command:
    q = list(state[Iterations].start)
    q[i] = units_of(state).read(text, bool(state[Joints].arm.revolute[i]), f"start of joint {i + 1}")
    return SetStart(tuple(q))


def _task(state: State, key: str) -> Command:
    arm = state[Joints].arm
    if key not in choices(arm):
        raise InputError(f"task vector: expected one of the list, got {key[:40]!r}")
    i = int(key[1:]) - 1 if key[:1] == "q" else 0
    return ChooseTask(made(arm, key, state[Iterations].start[i]))


def _wanted(state: State, text: str) -> Command:
    arm, vector = state[Joints].arm, vector_of(state)
    if not vector.joints:
        raise InputError("task vector: no joint is a component of it")
    joint = vector.joints[0][0]
    value = units_of(state).read(text, bool(arm.revolute[joint - 1]), f"wanted value of joint {joint}")
    return ChooseTask(made(arm, f"q{joint}", value))


# -- the markup ------------------------------------------------------------------------------------------------------


def _problem(fields: Fields, state: State) -> str:
    part, channel = state[Iterations], fields.channel_id
    playing = state[Timeline].clip == CLIP_KEY and state[Timeline].playing
    play = (
        button(channel, "pause-steps", "❚❚ Pause", "main")
        if playing
        else button(channel, "play-steps", "▶ Play", "main")
    )
    return (
        examples_markup(channel, EXAMPLES, part.example)
        + f'<div class="bar">{play}<span class="dim">{_present(state)}</span></div>'
        + _start_markup(fields, state)
        + _target_markup(channel, state)
        + _task_markup(fields, state)
        + _bounds(fields, part)
    )


def _bounds(fields: Fields, part: Iterations) -> str:
    """Return the choice of limits, and the largest number of steps."""
    kept = chips(
        fields.channel_id,
        {f"limits {key}": text for key, text in LIMITS.items()},
        f"limits {part.limits}",
        "Whether each step ends at the joint limits",
    )
    most = fields.field("most", str(part.most), "Largest number of steps")
    steps = f'<label class="it-most">at most {most}<i>steps</i></label>'
    return f'<div class="kit-numbers"><span class="dim">Limits</span>{kept}{steps}</div>'


def _present(state: State) -> str:
    """Return where the film stands."""
    film = state[Iterations].film
    if film is None:
        return "…"
    i, _ = place_of(state)
    if film.t is not None:
        return f"t = {film.t[i]:.2f} of {film.t[-1]:.2f} s"
    return f"iterate {i} of {film.last}"


def _start_markup(fields: Fields, state: State) -> str:
    part, joints, units = state[Iterations], state[Joints], units_of(state)
    arm, channel = joints.arm, fields.channel_id
    cells = []
    for i, value in enumerate(part.start):
        revolute = bool(arm.revolute[i])
        name = units.variable(i, revolute)
        held = joints.locked[i]
        shown = float(joints.q[i]) if held else value
        cell = fields.field(
            f"start {i}", units.text(shown, revolute), f"Start of {name} in {units.unit(revolute)}", held
        )
        cells.append(f"<label><span>{name}</span>{cell}<i>{units.unit(revolute)}</i></label>")
    poses = {"": "named pose …", **{name: name for name in state[RobotPart].robot.poses}}
    take = button(channel, "here", "Present pose", "chip", "Begin where the arm stands")
    take += select(channel, "pose", "Named pose", options(poses, ""), "Begin at a pose of the robot file")
    return f'<h3>Start<span class="copies">{take}</span></h3><div class="kit-numbers">{"".join(cells)}</div>'


def _target_markup(channel: str, state: State) -> str:
    part, units = state[Iterations], units_of(state)
    place = ", ".join(units.text(float(value), False) for value in part.target[:3, 3])
    take = button(
        channel, "aim", "From the handle", "chip", "Take the target of the lab; when dragged, it is taken by itself"
    )
    return f'<h3>Target <small>({place}) {units.length_unit}</small><span class="copies">{take}</span></h3>'


def _task_markup(fields: Fields, state: State) -> str:
    arm, part, units = state[Joints].arm, state[Iterations], units_of(state)
    vector, found = vector_of(state), choices(arm)
    head = f"<h3>Task vector <small>{vector_text(vector)}</small></h3>"
    if len(found) == 1:
        return head
    chooser = select(fields.channel_id, "task", "Task vector", options(found, chosen(arm, part.task)))
    if not vector.joints:
        return f'{head}<div class="kit-head">{chooser}</div>'
    joint, value = vector.joints[0]
    revolute = bool(arm.revolute[joint - 1])
    name = units.variable(joint - 1, revolute)
    field = fields.field("wanted", units.text(value, revolute), f"Wanted value of {name}")
    many = len(arms_found(state))
    arms = f"{many} arm{'s' if many != 1 else ''} found, drawn pale" if many else ""
    wanted = f"<label><span>{name} wanted</span>{field}<i>{units.unit(revolute)}</i></label>"
    return (
        f'{head}<div class="kit-head">{chooser}</div><div class="kit-numbers">{wanted}</div><p class="dim">{arms}</p>'
    )


def _in_the_way(state: State) -> tuple[str, ...]:
    """Return the layers the film hides: the handle sits on the tool while the film moves the arm."""
    return ("gizmo", "gap") if state[Timeline].clip == CLIP_KEY else ()


PANEL = Panel((Iterations, Joints, Timeline, Target, Notation, RobotPart), build, hides_then=_in_the_way)
