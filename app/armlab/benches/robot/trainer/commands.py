"""The commands of the assignment trainer."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from armlab.benches.robot.trainer.answers import FIELDS, LARGEST, Answers, Cells
from armlab.benches.robot.trainer.exercise import DIRECTIONS, Axes
from armlab.benches.robot.trainer.state import Trainer
from armlab.errors import InputError, UnknownName
from armlab.kin.assignment import CELLS
from armlab.registry import known_name
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State

ENOUGH_MISSES = 2
"""Number of checks that a frame or a cell must have failed before its solution is shown."""


def at_reference(state: State) -> bool:
    """Return whether the arm is in the pose in which the frames are placed."""
    q = state[Trainer].exercise.q
    return q is not None and bool(np.array_equal(q, state[Joints].q))


@dataclass(frozen=True)
class StartTrainer(Command):
    """Begin, or begin again, without answers, and with the arm in the pose of the exercise."""

    label: ClassVar[str] = "start of the exercise"

    def apply(self, state: State) -> State:
        """Return the state at the beginning of the exercise."""
        exercise = state[Trainer].exercise
        if not exercise.usable:
            raise InputError(
                "trainer: this arm has no known configuration in which all joint axes lie along x, y or z of the "
                "world frame"
            )
        before = state[Trainer].before if state[Trainer].started else state[Joints].q
        return _posed(state).replace(Trainer(exercise, Answers.empty(exercise.n), True, before))


@dataclass(frozen=True)
class EndTrainer(Command):
    """End the exercise, done or given up; the arm goes back to its earlier pose, unless the student has moved it."""

    label: ClassVar[str] = "end of the exercise"

    def apply(self, state: State) -> State:
        """Return the state without the exercise and its answers."""
        trainer, joints = _started(state), state[Joints]
        ended = state.replace(Trainer(trainer.exercise, Answers.empty(trainer.exercise.n)))
        if trainer.before is None or not at_reference(state):
            return ended
        moved = joints.moved_to(trainer.before)
        return ended if moved is joints else ended.replace(moved)


@dataclass(frozen=True)
class TakeTrainerPose(Command):
    """Move the arm back into the pose of the exercise."""

    label: ClassVar[str] = "pose of the exercise"

    def apply(self, state: State) -> State:
        """Return the state with the arm in the pose."""
        _started(state)
        return _posed(state)


@dataclass(frozen=True)
class ChooseDirection(Command):
    """Choose the direction of an axis of a frame.

    Parameters
    ----------
    frame : int
        0 to n.
    axis : "z" or "x"
    direction : str
        One of `DIRECTIONS`; empty for none.
    """

    frame: int
    axis: str
    direction: str
    label: ClassVar[str] = "axis of a frame"

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        answers = _started(state).answers
        if answers.placed:
            raise InputError("trainer: all axes are placed; press “change” to choose them again")
        if not 0 <= self.frame < len(answers.axes):
            raise InputError(f"frame: expected 0 to {len(answers.axes) - 1}, got {self.frame}")
        if self.axis not in ("z", "x"):
            raise UnknownName("axis", self.axis, ("z", "x"))
        if self.direction and self.direction not in DIRECTIONS:
            raise UnknownName("direction", self.direction, DIRECTIONS)
        z, x = answers.axes[self.frame]
        chosen = (self.direction, x) if self.axis == "z" else (z, self.direction)
        return _answered(state, replace(answers, axes=_put(answers.axes, self.frame, chosen)))


@dataclass(frozen=True)
class CheckAxes(Command):
    """Mark the frames whose axes are chosen; when all are right, go on to the table."""

    label: ClassVar[str] = "check of the axes"

    def apply(self, state: State) -> State:
        """Return the state with the marks."""
        trainer = _started(state)
        answers = trainer.answers
        if answers.placed:
            return state
        if not any(all(pair) for pair in answers.axes):
            raise InputError("trainer: choose z and x of at least one frame first")
        verdicts = trainer.judged(answers.axes)
        wrong = [all(pair) and not v.ok for pair, v in zip(answers.axes, verdicts, strict=True)]
        return _answered(
            state,
            replace(
                answers,
                checked_axes=answers.axes,
                axes_checks=answers.axes_checks + 1,
                axes_misses=tuple(k + w for k, w in zip(answers.axes_misses, wrong, strict=True)),
                placed=trainer.all_legal,
            ),
        )


@dataclass(frozen=True)
class ReviseAxes(Command):
    """Go back from the table to the axes; the typed values stay, their marks do not."""

    label: ClassVar[str] = "return to the axes"

    def apply(self, state: State) -> State:
        """Return the state at the axes."""
        answers = _started(state).answers
        return _answered(state, replace(answers, placed=False, checked_cells=None)) if answers.placed else state


@dataclass(frozen=True)
class SetAnswer(Command):
    """Fill a cell of the table.

    Parameters
    ----------
    row : int
        0-based.
    field : "a", "alpha", "d" or "theta"
    value : float or None
        Metres or radians; None empties the cell. In the cell of the joint variable it is the offset.
    """

    row: int
    field: str
    value: float | None
    label: ClassVar[str] = "cell of the exercise"

    def apply(self, state: State) -> State:
        """Return the state with the cell filled."""
        answers = _placed(state).answers
        i, k = _cell(answers, self.row, self.field)
        if self.value is not None and not abs(self.value) <= LARGEST:
            quantity, unit = ("a length", "m") if CELLS[self.field] == "length" else ("an angle", "rad")
            raise InputError(
                f"row {i + 1}, {self.field}: expected {quantity} between -{LARGEST:g} and {LARGEST:g} {unit}, got "
                f"{self.value:g} {unit}"
            )
        return _answered(state, _filled(answers, i, k, self.value))


@dataclass(frozen=True)
class CheckTable(Command):
    """Mark the cells that are filled."""

    label: ClassVar[str] = "check of the table"

    def apply(self, state: State) -> State:
        """Return the state with the marks."""
        trainer = _placed(state)
        answers = trainer.answers
        if all(value is None for row in answers.cells for value in row):
            raise InputError("trainer: fill in at least one cell first")
        checked = replace(answers, checked_cells=answers.cells, table_checks=answers.table_checks + 1)
        marks = replace(trainer, answers=checked).cell_marks
        misses = tuple(
            tuple(count + (name in found and not found[name].ok) for count, name in zip(row, FIELDS, strict=True))
            for row, found in zip(answers.cell_misses, marks, strict=True)
        )
        return _answered(state, replace(checked, cell_misses=misses))


@dataclass(frozen=True)
class ShowAxes(Command):
    """Set correct axes in a frame that was wrong in several checks."""

    frame: int
    label: ClassVar[str] = "solution of a frame"

    def apply(self, state: State) -> State:
        """Return the state with the axes of this frame."""
        trainer = _started(state)
        answers = trainer.answers
        if not 0 <= self.frame < len(answers.axes):
            raise InputError(f"frame: expected 0 to {len(answers.axes) - 1}, got {self.frame}")
        if answers.placed or answers.axes_misses[self.frame] < ENOUGH_MISSES:
            raise InputError(f"trainer: the solution is shown after {ENOUGH_MISSES} wrong checks")
        axes = _put(answers.axes, self.frame, trainer.exercise.solution[self.frame])
        return _answered(state, replace(answers, axes=axes, shown=answers.shown + 1))


@dataclass(frozen=True)
class ShowCell(Command):
    """Set the right value in a cell that was wrong in several checks."""

    row: int
    field: str
    label: ClassVar[str] = "solution of a cell"

    def apply(self, state: State) -> State:
        """Return the state with the value."""
        trainer = _placed(state)
        answers = trainer.answers
        i, k = _cell(answers, self.row, self.field)
        if answers.cell_misses[i][k] < ENOUGH_MISSES:
            raise InputError(f"trainer: the solution is shown after {ENOUGH_MISSES} wrong checks")
        assert trainer.assignment is not None
        value = float(getattr(trainer.assignment.rows[i], self.field))
        return _answered(state, replace(_filled(answers, i, k, value), shown=answers.shown + 1))


def _started(state: State) -> Trainer:
    trainer = state[Trainer]
    if not trainer.started:
        raise InputError("trainer: start the exercise first")
    return trainer


def _placed(state: State) -> Trainer:
    trainer = _started(state)
    if not trainer.answers.placed:
        raise InputError("trainer: the table comes when all axes are right")
    return trainer


def _posed(state: State) -> State:
    joints, q = state[Joints], state[Trainer].exercise.pose
    moved = joints.moved_to(q)
    for i, held in enumerate(joints.locked):
        if held and moved.q[i] != q[i]:
            raise InputError(f"trainer: joint {i + 1} is held and cannot move to the configuration of the exercise")
    return state if moved is joints else state.replace(moved)


def _answered(state: State, answers: Answers) -> State:
    trainer = state[Trainer]
    return state if answers == trainer.answers else state.replace(replace(trainer, answers=answers))


def _put(axes: tuple[Axes, ...], i: int, pair: Axes) -> tuple[Axes, ...]:
    return (*axes[:i], pair, *axes[i + 1 :])


def _cell(answers: Answers, row: int, field: str) -> tuple[int, int]:
    if not 0 <= row < len(answers.cells):
        raise InputError(f"row: expected 1 to {len(answers.cells)}, got {row + 1}")
    known_name("cell", field, FIELDS)
    return row, FIELDS.index(field)


def _filled(answers: Answers, i: int, k: int, value: float | None) -> Answers:
    row: Cells = (*answers.cells[i][:k], value, *answers.cells[i][k + 1 :])
    return replace(answers, cells=(*answers.cells[:i], row, *answers.cells[i + 1 :]))
