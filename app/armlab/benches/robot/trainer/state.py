"""The assignment trainer: the student places the frames of the arm and fills its table, and both are marked.

Its commands are in `armlab.benches.robot.trainer.commands`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from armlab.benches.robot.trainer.answers import FIELDS, Answers
from armlab.benches.robot.trainer.exercise import Axes, Exercise, choices_of
from armlab.benches.robot.trainer.table import judge_table
from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.assignment import (
    Assignment,
    CellVerdict,
    FrameVerdict,
    expected_table,
    judge_frames,
    length_tolerance,
)
from armlab.kin.checks import finite_floats
from armlab.kin.dh import Row
from armlab.session.state import Json, Part, PartType

FARTHEST = 20.0
"""Length in a wrong table beyond which it is not drawn, in reaches of the arm."""


@dataclass(frozen=True, eq=False)
class Trainer(Part):
    """The progress of one exercise.

    Attributes
    ----------
    exercise : Exercise
        Of the arm on the table.
    started : bool
    answers : Answers
        What was chosen, typed and marked.
    before : ndarray, shape (n,), or None
        Joint values the arm had when the exercise began; None of one that has not begun.
    """

    key: ClassVar[str] = "trainer"

    exercise: Exercise
    answers: Answers
    started: bool = False
    before: NDArray[np.float64] | None = None

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return an exercise that has not begun."""
        return cls(Exercise(robot), Answers.empty(robot.arm.n))

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the answers if the exercise is the same, such as after a change of limits."""
        exercise = Exercise(robot)
        return replace(self, exercise=exercise) if self.exercise.same_as(exercise) else self.for_robot(robot)

    def to_json(self) -> Json:
        """Write the answers."""
        before = None if self.before is None else self.before.tolist()
        return {"started": self.started, "before": before, **self.answers.to_json()}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read the answers back; raises if they cannot be used with this arm."""
        started, n = bool(data["started"]), robot.arm.n
        before = None if data.get("before") is None else finite_floats(data["before"], "before", (n,), f"{n} numbers")
        part = cls(Exercise(robot), Answers.from_json(data, n), started, before)
        if not part.started and part.answers != Answers.empty(robot.arm.n):
            raise InputError("trainer: answers to an exercise that has not begun")
        if part.before is not None and not part.started:
            raise InputError("trainer: joint values from before an exercise that has not begun")
        if part.started and not part.exercise.usable:
            raise InputError("trainer: this arm has no exercise")
        if part.answers.placed and not (part.started and part.all_legal):
            raise InputError("trainer: a table without legal frames")
        return part

    # -- what follows --------------------------------------------------------------------------------------------

    @cached_property
    def assignment(self) -> Assignment | None:
        """The table for the chosen axes, when all of them are right and the student has gone on to the table."""
        if not self.answers.placed:
            return None
        return expected_table(self._arm, self.exercise.pose, choices_of(self.answers.axes))

    @cached_property
    def frame_marks(self) -> tuple[FrameVerdict | None, ...]:
        """The verdicts of the last check on frames that have not been changed since."""
        checked = self.answers.checked_axes
        if checked is None:
            return (None,) * (self.exercise.n + 1)
        verdicts = self.judged(checked)
        rows = zip(verdicts, self.answers.axes, checked, strict=True)
        return tuple(verdict if all(now) and now == then else None for verdict, now, then in rows)

    @cached_property
    def cell_marks(self) -> tuple[dict[str, CellVerdict], ...]:
        """The verdicts of the last check, by row and name, on cells that are filled and not changed since."""
        table, checked = self.answers.cells, self.answers.checked_cells
        if checked is None or self.assignment is None:
            return ({},) * self.exercise.n
        typed = [dict(zip(FIELDS, row, strict=True)) for row in checked]
        verdicts = judge_table(self.assignment.rows, typed, length_tolerance(self._arm))
        return tuple(
            {
                name: marks[name]
                for k, name in enumerate(FIELDS)
                if name in marks and table[i][k] is not None and table[i][k] == checked[i][k]
            }
            for i, marks in enumerate(verdicts)
        )

    @property
    def done(self) -> bool:
        """Whether every cell has been marked right."""
        return self.answers.placed and all(
            name in marks and marks[name].ok for marks in self.cell_marks for name in FIELDS
        )

    @cached_property
    def complete_rows(self) -> tuple[Row, ...]:
        """The rows of the student's table up to the first with an empty cell, as long as they can be drawn."""
        rows: list[Row] = []
        most = FARTHEST * self._arm.reach
        for of_arm, cells in zip(self._arm.rows, self.answers.cells, strict=True):
            filled = [value for value in cells if value is not None]
            if len(filled) < len(FIELDS) or max(abs(filled[0]), abs(filled[2])) > most:
                break
            a, alpha, d, theta = filled
            # A table takes no angle beyond a full turn, and a student may type one: 450°, or degrees for radians.
            rows.append(Row(of_arm.kind, a, math.remainder(alpha, math.tau), d, math.remainder(theta, math.tau)))
        return tuple(rows)

    @cached_property
    def student_arm(self) -> Arm | None:
        """The arm of the complete rows on the student's own frame 0; None if there is none.

        Its joint values are those of the arm times `Assignment.signs`.
        """
        if self.assignment is None or not self.complete_rows:
            return None
        whole = len(self.complete_rows) == self.exercise.n
        return Arm.from_dh(
            self.complete_rows, base=self.assignment.base, tool=self.assignment.tool if whole else np.eye(4)
        )

    @property
    def _arm(self) -> Arm:
        return self.exercise.robot.arm

    @property
    def all_legal(self) -> bool:
        """Whether all axes are chosen and obey the rules."""
        axes = self.answers.axes
        return all(z and x for z, x in axes) and all(v.ok for v in self.judged(axes))

    def judged(self, axes: tuple[Axes, ...]) -> tuple[FrameVerdict, ...]:
        """Judge the frames; incomplete ones are replaced by the solution's, and callers must ignore their verdicts."""
        filled = tuple(own if all(own) else known for own, known in zip(axes, self.exercise.solution, strict=True))
        return judge_frames(self._arm, self.exercise.pose, choices_of(filled))


PART = PartType(Trainer, order=85)
