"""The first stage of the trainer: the directions of z and x of each frame."""

from __future__ import annotations

from armlab.benches.robot.trainer.commands import ENOUGH_MISSES, CheckAxes, ChooseDirection, ShowAxes
from armlab.benches.robot.trainer.exercise import DIRECTIONS
from armlab.benches.robot.trainer.state import Trainer
from armlab.benches.robot.trainer.ui.words import AXES_RULE, indexed, mark, parallel_line, pose_line
from armlab.session.state import Command
from armlab.ui.format import MINUS, escaped, subscript
from armlab.ui.markup import button, chip, options, select
from armlab.ui.units import Units


def axes_stage(trainer: Trainer, channel: str, units: Units) -> str:
    """Return the markup of the stage."""
    rows = "".join(_row(trainer, i, channel) for i in range(trainer.exercise.n + 1))
    check = button(channel, "trainer-check", "Check axes", "main", "Mark the frames whose z and x are chosen")
    told = (AXES_RULE, pose_line(trainer, units), parallel_line(trainer))
    remarks = "".join(f'<p class="dim">{line}</p>' for line in told if line)
    return f'{remarks}<div class="tr-axes">{rows}</div><div class="bar">{check}{_count(trainer)}</div>'


def axes_typed(cell: str, text: str) -> Command | None:
    """Return the command of a choice or a button of this stage."""
    name, _, frame = cell.removeprefix("trainer-").partition("-")
    if name in ("z", "x"):
        return ChooseDirection(int(frame), name, text)
    if name == "show":
        return ShowAxes(int(frame))
    return CheckAxes() if name == "check" else None


def shown_direction(direction: str) -> str:
    """Return a direction with a true minus sign."""
    return direction.replace("-", MINUS)


def _row(trainer: Trainer, i: int, channel: str) -> str:
    verdict = trainer.frame_marks[i]
    row = f"<b>{{{i}}}</b>{_choice(trainer, i, 0, channel)}{_choice(trainer, i, 1, channel)}"
    if verdict is None:
        return f"<div>{row}<i></i></div>"
    row += mark(verdict.ok, indexed(verdict.text))
    if verdict.ok:
        return f"<div>{row}</div>"
    show = ""
    if trainer.answers.axes_misses[i] >= ENOUGH_MISSES:
        show = chip(channel, f"trainer-show-{i}", "Show solution", f"Put legal axes into frame {i}")
    return f'<div>{row}<p class="no">{escaped(indexed(verdict.text))}. {show}</p></div>'


def _choice(trainer: Trainer, i: int, which: int, channel: str) -> str:
    axis, chosen = "zx"[which], trainer.answers.axes[i][which]
    ways = options({key: shown_direction(key) or "–" for key in ("", *DIRECTIONS)}, chosen)
    name = subscript(axis, i)
    choice = select(channel, f"trainer-{axis}-{i}", f"direction of {name}", ways)
    return f'<label><span class="axis-{axis}">{name}</span>{choice}</label>'


def _count(trainer: Trainer) -> str:
    chosen = sum(all(pair) for pair in trainer.answers.axes)
    right = sum(v is not None and v.ok for v in trainer.frame_marks)
    whole = len(trainer.answers.axes)
    if trainer.answers.axes_checks == 0:
        return f'<span class="dim">{chosen} of {whole} frames chosen</span>'
    return f'<span class="dim">{right} of {whole} right, check {trainer.answers.axes_checks}</span>'
