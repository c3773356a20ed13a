"""Inverse kinematics step by step: start, target, task vector, runs, their iterates in numbers and curves."""

from __future__ import annotations

from functools import partial

from armlab.benches.iterate.runs.clip import place_of
from armlab.benches.iterate.runs.commands import AimAt, ChooseTask, SetStart
from armlab.benches.iterate.runs.examples import EXAMPLES, ChooseExample
from armlab.benches.iterate.runs.state import CLIP_KEY, Iterations, arms_found, vector_of
from armlab.benches.iterate.runs.ui.plots import Plots
from armlab.benches.iterate.runs.ui.runs import runs_markup
from armlab.benches.iterate.runs.ui.table import Table
from armlab.benches.iterate.runs.ui.words import choices, chosen, made, vector_text
from armlab.session.fields import Set, fields_of
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import so_many
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import fold
from armlab.ui.option_text import option_value
from armlab.ui.playing import play_button
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

LIMITS = {"clamp": "Kept", "none": "Not kept"}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the fields of the problem, the runs, the table and the plots."""
    problem, runs = gui.form(post), gui.form(post)
    table, plots = Table(gui.form(post)), Plots(gui, state)

    def show(state: State) -> None:
        problem.show(problem_markup(problem, state))
        runs.show(runs_markup(runs, state))
        table.show(state)
        plots.show(state)

    return show


def _start(state: State, i: int, text: str) -> SetStart:
    q = list(state[Iterations].start)
    q[i] = units_of(state).read(text, bool(state[Joints].arm.revolute[i]), f"start of joint {i + 1}")
    return SetStart(tuple(q))


def _task(state: State, key: str) -> ChooseTask:
    arm = state[Joints].arm
    i = int(key[1:]) - 1 if key[:1] == "q" else 0
    return ChooseTask(made(arm, key, state[Iterations].start[i]))


def _wanted(state: State, text: str) -> ChooseTask:
    arm, joint = state[Joints].arm, vector_of(state).joints[0][0]
    value = units_of(state).read(text, bool(arm.revolute[joint - 1]), f"wanted value of joint {joint}")
    return ChooseTask(made(arm, f"q{joint}", value))


# -- the markup ------------------------------------------------------------------------------------------------------


def problem_markup(form: Form, state: State) -> Markup:
    """Return example, start, target, task vector and limits."""
    part = state[Iterations]
    play = play_button(form, state, CLIP_KEY, "steps")
    return joined(
        examples(form, EXAMPLES, part.example, ChooseExample, said=units_of(state).said),
        tag("div.bar", play, tag("span.dim", _present(state))),
        _start_markup(form, state),
        _target_markup(form, state),
        _task_markup(form, state),
    )


def _bounds(form: Form, part: Iterations) -> Markup:
    """Return the choice of limits, and the largest number of steps."""
    hint = "Whether each step is stopped at the joint limits"
    kept = form.chips("limits", LIMITS, part.limits, hint, lambda key: Set(Iterations, "limits", key))
    most = form.field("most", str(part.most), "Largest number of steps", _most)
    steps = tag("label.it-most", "at most ", most, tag("i", "steps"))
    return tag("div.kit-numbers", tag("span.dim", "Limits"), kept, steps)


def _most(text: str) -> Command:
    return Set(Iterations, "most", option_value(fields_of(Iterations)["most"], text, needed=True))


def _present(state: State) -> str:
    """Return the present place in the film."""
    film = state[Iterations].film
    if film is None:
        return "…"
    i, _ = place_of(state)
    if film.t is not None:
        return f"t = {film.t[i]:.2f} of {film.t[-1]:.2f} s"
    return f"iterate {i} of {film.last}"


def _start_markup(form: Form, state: State) -> Inside:
    part, joints, units = state[Iterations], state[Joints], units_of(state)
    arm = joints.arm
    cells = []
    for i, value in enumerate(part.start):
        revolute = bool(arm.revolute[i])
        name = units.variable(i, revolute)
        held = joints.locked[i]
        shown = float(joints.q[i]) if held else value
        label = f"Start of {name} in {units.unit(revolute)}"
        cell = form.field(f"start {i}", units.text(shown, revolute), label, partial(_start, state, i), off=held)
        cells.append(tag("label", tag("span", name), cell, tag("i", units.unit(revolute))))
    poses = state[RobotPart].robot.poses
    named = {"": "named pose …", **{name: name for name in poses}}
    take = form.chip("here", "Present configuration", SetStart(), "Start from the present configuration")
    hint = "Start from a named pose of the robot"
    pose = form.select("pose", "Named pose", named, "", lambda name: SetStart(tuple(poses[name].tolist())), hint)
    return tag("h3", "Start", tag("span.copies", take, pose)), tag("div.kit-numbers", cells)


def _target_markup(form: Form, state: State) -> Markup:
    part, units = state[Iterations], units_of(state)
    place = ", ".join(units.text(float(value), False) for value in part.target[:3, 3])
    hint = "Use the target of the lab; dragging it updates this one as well"
    take = form.chip("aim", "Use the lab's target", AimAt(), hint)
    return tag("h3", "Target ", tag("small", f"({place}) {units.length_unit}"), tag("span.copies", take))


def _task_markup(form: Form, state: State) -> Markup:
    """Return the task vector and the limits of the steps, which are open where the vector is not the arm's own."""
    arm, part = state[Joints].arm, state[Iterations]
    vector, found = vector_of(state), choices(arm)
    head, choice = ("Task vector and limits ", tag("small", vector_text(vector))), None
    if len(found) > 1:
        choice = form.select("task", "Task vector", found, chosen(arm, part.task), partial(_task, state))
    wanted = _wanted_markup(form, state) if vector.joints else None
    inside = tag("div.kit-head", choice) if choice else None, wanted, _bounds(form, part)
    return fold(head, *inside, opened=bool(vector.joints), key="Task vector")


def _wanted_markup(form: Form, state: State) -> Inside:
    """Return the field of the joint value that is a part of the task vector, and how many arms were found for it."""
    arm, units = state[Joints].arm, units_of(state)
    joint, value = vector_of(state).joints[0]
    revolute = bool(arm.revolute[joint - 1])
    name = units.variable(joint - 1, revolute)
    field = form.field("wanted", units.text(value, revolute), f"Wanted value of {name}", partial(_wanted, state))
    many = len(arms_found(state))
    arms = f"{so_many(many, 'arm')} found, drawn pale" if many else ""
    wanted = tag("label", tag("span", f"{name} wanted"), field, tag("i", units.unit(revolute)))
    return tag("div.kit-numbers", wanted), tag("p.dim", arms)


def _in_the_way(state: State) -> tuple[str, ...]:
    """Return the layers that the film hides: the handle would cover the tool while the film moves the arm."""
    return ("gizmo", "gap") if state[Timeline].clip == CLIP_KEY else ()


PANEL = Panel((Iterations, Joints, Timeline, Target, Notation, RobotPart), build, hides_then=_in_the_way)
