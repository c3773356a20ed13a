"""The first stage of the trainer: the directions of z and x of each frame."""

from __future__ import annotations

from functools import partial

from armlab.benches.robot.trainer.commands import ENOUGH_MISSES, CheckAxes, ChooseDirection, ShowAxes
from armlab.benches.robot.trainer.exercise import DIRECTIONS
from armlab.benches.robot.trainer.state import Trainer
from armlab.benches.robot.trainer.ui.words import AXES_RULE, indexed, mark, parallel_line, pose_line
from armlab.ui.form import Form
from armlab.ui.format import MINUS, subscript
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import options
from armlab.ui.units import Units


def axes_stage(form: Form, trainer: Trainer, units: Units) -> Inside:
    """Return the whole stage."""
    rows = [_row(form, trainer, i) for i in range(trainer.exercise.n + 1)]
    hint = "Check the frames whose z and x are chosen"
    check = form.button("trainer-check", "Check axes", CheckAxes(), "main", hint)
    told = (AXES_RULE, pose_line(trainer, units), parallel_line(trainer))
    remarks = [tag("p.dim", line) for line in told if line]
    return remarks, tag("div.tr-axes", rows), tag("div.bar", check, _count(trainer))


def shown_direction(direction: str) -> str:
    """Return a direction with a true minus sign."""
    return direction.replace("-", MINUS)


def _row(form: Form, trainer: Trainer, i: int) -> Markup:
    verdict = trainer.frame_marks[i]
    row = tag("b", f"{{{i}}}"), _choice(form, trainer, i, 0), _choice(form, trainer, i, 1)
    if verdict is None:
        return tag("div", row, tag("i"))
    marked = mark(verdict.ok, indexed(verdict.text))
    if verdict.ok:
        return tag("div", row, marked)
    show = None
    if trainer.answers.axes_misses[i] >= ENOUGH_MISSES:
        show = form.chip(f"trainer-show-{i}", "Show solution", ShowAxes(i), f"Choose correct axes for frame {i}")
    return tag("div", row, marked, tag("p.no", f"{indexed(verdict.text)}. ", show))


def _choice(form: Form, trainer: Trainer, i: int, which: int) -> Markup:
    axis, chosen = "zx"[which], trainer.answers.axes[i][which]
    ways = options({key: shown_direction(key) or "–" for key in ("", *DIRECTIONS)}, chosen)
    name = subscript(axis, i)
    # Not `Form.select`: also that there is none can be chosen.
    bound = form.bound(f"trainer-{axis}-{i}", partial(ChooseDirection, i, axis))
    choice = tag("select", ways, aria_label=f"direction of {name}", **bound)
    return tag("label", tag(f"span.axis-{axis}", name), choice)


def _count(trainer: Trainer) -> Markup:
    chosen = sum(all(pair) for pair in trainer.answers.axes)
    right = sum(v is not None and v.ok for v in trainer.frame_marks)
    whole = len(trainer.answers.axes)
    if trainer.answers.axes_checks == 0:
        return tag("span.dim", f"{chosen} of {whole} frames chosen")
    return tag("span.dim", f"Check {trainer.answers.axes_checks}: {right} of {whole} right")
