"""Sentences of the trainer: the rule of each cell, the pose of the exercise, the end."""

from __future__ import annotations

import re
from collections.abc import Sequence

from armlab.benches.robot.trainer.answers import FIELDS
from armlab.benches.robot.trainer.state import Trainer
from armlab.benches.robot.trainer.table import along_first, parallel_runs
from armlab.kin.dh import Row
from armlab.ui.format import so_many, subscript
from armlab.ui.html import Markup, tag
from armlab.ui.units import Units

AXES_RULE = (
    "z of frame i lies along the axis of joint i+1, in either direction; x is perpendicular to this z and the one "
    "before, along the common normal where the axes do not meet. The axis of a prismatic joint is taken where it is "
    "drawn. The last z and the first x are free. Directions are those of the world frame; more than one choice is "
    "correct."
)


def symbol(units: Units, field: str, i: int) -> str:
    """Return the name of a cell of row i (0-based), such as α₂."""
    return units.symbol(field, i + 1)


def rule(trainer: Trainer, i: int, field: str, units: Units) -> str:
    """Return the rule of a cell of row i (0-based), without its value."""
    name = symbol(units, field, i)
    z0, z1, x0, x1 = subscript("z", i), subscript("z", i + 1), subscript("x", i), subscript("x", i + 1)
    o0, o1 = subscript("O", i), subscript("O", i + 1)
    if field == "a":
        return (
            f"{name} is the distance from the axis {z0} to {o1} along {x1}; it is negative in the opposite direction."
        )
    if field == "alpha":
        return f"{name} is the angle from {z0} to {z1} about {x1}, by the right-hand rule."
    if field == "theta":
        text = f"{name} is the angle from {x0} to {x1} about {z0}, by the right-hand rule."
    else:
        text = f"{name} is the distance from {o0} to {o1} along {z0}; it is negative in the opposite direction."
        run = _run_of(trainer, i)
        if run is not None:
            text += (
                f" Axes {run[0] + 1} to {run[-1] + 1} are parallel: any values of d with the right sum"
                f"{_along(_rows(trainer), run)} are correct."
            )
    row = _rows(trainer)[i]
    if field == ("theta" if row.revolute else "d"):
        text += f" This is the joint variable: the cell takes what remains without {told_joint(trainer, i, units)}."
    return text


def told_joint(trainer: Trainer, i: int, units: Units) -> str:
    """Return the value of joint i in the pose of the exercise, in the sense of the student's own z."""
    assert trainer.assignment is not None
    revolute = trainer.exercise.robot.arm.rows[i].revolute
    value = float(trainer.assignment.signs[i] * trainer.exercise.pose[i])
    return f"{units.variable(i, revolute)} = {units.angle(value) if revolute else units.length(value)}"


def pose_line(trainer: Trainer, units: Units) -> str:
    """Return the joint values of the pose of the exercise."""
    arm, q = trainer.exercise.robot.arm, trainer.exercise.pose
    told = [
        f"{units.variable(i, row.revolute)} = {units.angle(value) if row.revolute else units.length(value)}"
        for i, (row, value) in enumerate(zip(arm.rows, q.tolist(), strict=True))
        if value != 0.0
    ]
    if not told:
        return "Drawn with all joints at 0."
    rest = {0: "", 1: ", the other at 0"}.get(arm.n - len(told), ", the others at 0")
    return f"Drawn at {', '.join(told)}{rest}."


def reversed_line(trainer: Trainer, units: Units) -> str:
    """Return which joints count in the other sense with the student's axes, or nothing if none does."""
    assert trainer.assignment is not None
    turned = trainer.assignment.reversed
    if not turned:
        return ""
    senses = ", ".join(told_joint(trainer, joint - 1, units) for joint in turned)
    names = ", ".join(subscript("z", joint - 1) for joint in turned)
    verb = "points" if len(turned) == 1 else "point"
    return (
        f"{names} {verb} against the positive direction of the joint, whose variable therefore changes sign: here "
        f"{senses}."
    )


def parallel_line(trainer: Trainer) -> str:
    """Return where origins may be shifted along parallel axes, or nothing if all d are zero."""
    rows = (trainer.assignment or trainer.exercise.solved).rows
    runs = [run for run in parallel_runs(rows) if any(rows[i].d != 0.0 for i in run)]
    return " ".join(
        f"Axes {run[0] + 1} to {run[-1] + 1} are parallel: an origin may lie anywhere on its axis. They are drawn "
        "so that d is 0 where possible, and so not always on the arm; any values of d with the right sum"
        f"{_along(rows, run)} are correct too."
        for run in runs
    )


def open_line(trainer: Trainer, i: int, field: str, units: Units) -> str:
    """Return why the last check gave a filled cell no mark, or nothing if it did or the cell has changed since."""
    answers, k = trainer.answers, FIELDS.index(field)
    value, run = answers.cells[i][k], _run_of(trainer, i)
    if answers.checked_cells is None or value is None or value != answers.checked_cells[i][k]:
        return ""
    if run is None or field != "d" or field in trainer.cell_marks[i]:
        return ""
    total = f"the sum of d over rows {run[0] + 1} to {run[-1] + 1}{_along(_rows(trainer), run)}"
    return f"{symbol(units, field, i)}: only {total} counts, and a value of d is still missing."


def indexed(text: str) -> str:
    """Return a sentence with z1 and x2 in it as z₁ and x₂."""
    return re.sub(r"\b([zx])(\d+)\b", lambda found: subscript(found[1], int(found[2])), text)


def end_line(trainer: Trainer) -> str:
    """Return in words the number of checks of the finished exercise."""
    answers = trainer.answers
    text = f"{so_many(answers.axes_checks, 'check')} of the axes, {answers.table_checks} of the table"
    return text + (f", {so_many(answers.shown, 'solution')} shown." if answers.shown else ", no solution shown.")


def mark(ok: bool, text: str) -> Markup:
    """Return ✓ or ✕ with its sentence as a hint."""
    return tag("i.ok" if ok else "i.no", "✓" if ok else "✕", title=text)


def _along(rows: Sequence[Row], run: range) -> str:
    """Return the direction in which d is counted where axes of a run point against each other."""
    return f", taken along {subscript('z', run[0])}," if along_first(rows, run) else ""


def _run_of(trainer: Trainer, i: int) -> range | None:
    """Return the run of parallel axes to which row i (0-based) belongs."""
    return next((run for run in parallel_runs(_rows(trainer)) if i in run), None)


def _rows(trainer: Trainer) -> tuple[Row, ...]:
    assert trainer.assignment is not None
    return trainer.assignment.rows
