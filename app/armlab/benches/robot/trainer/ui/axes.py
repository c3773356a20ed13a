"""The first stage of the trainer: the directions of z and x of each frame."""

from __future__ import annotations

from functools import partial

from armlab.benches.robot.trainer.commands import ENOUGH_MISSES, CheckAxes, ChooseDirection, ShowAxes
from armlab.benches.robot.trainer.exercise import DIRECTIONS
from armlab.benches.robot.trainer.state import Trainer
from armlab.benches.robot.trainer.ui.words import AXES_RULE, indexed, mark, parallel_line, pose_line
from armlab.ui.form import Form
from armlab.ui.format import MINUS, escaped, subscript
from armlab.ui.markup import options
from armlab.ui.units import Units


def axes_stage(form: Form, trainer: Trainer, units: Units) -> str:
    """Return the markup of the stage."""
    rows = "".join(_row(form, trainer, i) for i in range(trainer.exercise.n + 1))
    hint = "Mark the frames whose z and x are chosen"
    check = form.button("trainer-check", "Check axes", CheckAxes(), "main", hint)
    told = (AXES_RULE, pose_line(trainer, units), parallel_line(trainer))
    remarks = "".join(f'<p class="dim">{line}</p>' for line in told if line)
    return f'{remarks}<div class="tr-axes">{rows}</div><div class="bar">{check}{_count(trainer)}</div>'


def shown_direction(direction: str) -> str:
    """Return a direction with a true minus sign."""
    return direction.replace("-", MINUS)


def _row(form: Form, trainer: Trainer, i: int) -> str:
    verdict = trainer.frame_marks[i]
    row = f"<b>{{{i}}}</b>{_choice(form, trainer, i, 0)}{_choice(form, trainer, i, 1)}"
    if verdict is None:
        return f"<div>{row}<i></i></div>"
    row += mark(verdict.ok, indexed(verdict.text))
    if verdict.ok:
        return f"<div>{row}</div>"
    show = ""
    if trainer.answers.axes_misses[i] >= ENOUGH_MISSES:
        show = form.chip(f"trainer-show-{i}", "Show solution", ShowAxes(i), f"Put legal axes into frame {i}")
    return f'<div>{row}<p class="no">{escaped(indexed(verdict.text))}. {show}</p></div>'


def _choice(form: Form, trainer: Trainer, i: int, which: int) -> str:
    axis, chosen = "zx"[which], trainer.answers.axes[i][which]
    ways = options({key: shown_direction(key) or "–" for key in ("", *DIRECTIONS)}, chosen)
    name = subscript(axis, i)
    # Not `Form.select`: also that there is none can be chosen.
    bound = form.bound(f"trainer-{axis}-{i}", partial(ChooseDirection, i, axis))
    choice = f'<select {bound} aria-label="{escaped(f"direction of {name}")}">{ways}</select>'
    return f'<label><span class="axis-{axis}">{name}</span>{choice}</label>'


def _count(trainer: Trainer) -> str:
    chosen = sum(all(pair) for pair in trainer.answers.axes)
    right = sum(v is not None and v.ok for v in trainer.frame_marks)
    whole = len(trainer.answers.axes)
    if trainer.answers.axes_checks == 0:
        return f'<span class="dim">{chosen} of {whole} frames chosen</span>'
    return f'<span class="dim">{right} of {whole} right, check {trainer.answers.axes_checks}</span>'
