"""The page Compare designs: supposed changes of the arm, and their effect on the workspace."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from armlab.benches.workspace.what_if.arm import LIMITS, TOOL, Change, altered, fields_of, value_of
from armlab.benches.workspace.what_if.found import Compared
from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.session.edits import SetCell, SetEnd, SetLimits
from armlab.session.sizes import LENGTHS
from armlab.session.state import Command, Json, Part, PartType, State

SAME = 1e-12
"""Difference, metres or radians, below which a change is none."""


@dataclass(frozen=True, eq=False)
class WhatIf(Part):
    """Supposed changes of the arm.

    Attributes
    ----------
    arm, other : Arm
        As it is, and with the changes; the same object without any.
    row, field : int, str
        The selected number; see `Change`.
    changes : tuple of Change
        In the order in which they were made, one for each quantity.
    found : Compared or None
        Both workspaces as far as they are known; not saved.
    taken : Arm and tuple of Change, or None
        The arm before the last changes were made real, and these: undo gives them back. Not saved.
    """

    key: ClassVar[str] = "what_if"
    kept_by_undo: ClassVar[bool] = True

    arm: Arm
    other: Arm
    row: int
    field: str
    changes: tuple[Change, ...] = ()
    found: Compared | None = None
    taken: tuple[Arm, tuple[Change, ...]] | None = None

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return no changes, with the longest link length selected, or the longest offset of an arm without lengths."""
        arm = robot.arm
        lengths = [(f == "a", abs(value_of(arm, i, f)), -i, f) for i in range(arm.n) for f in _lengths(arm, i)]
        _, _, i, field = max([each for each in lengths if each[1] > 0.0] or lengths)
        return cls(arm, arm, -i, field)

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the selected number if it is still there, and the changes if the arm is that before `TakeOver`."""
        row = robot.arm.n if self.row == self.arm.n else origin.index(self.row) if self.row in origin else -1
        there = row >= 0 and self.field in fields_of(robot.arm, row)
        if not there:
            return self.initial(robot)
        part = type(self)(robot.arm, robot.arm, row, self.field, taken=self.taken)
        return part.changed(self.taken[1]) if self.taken is not None and self.taken[0] is robot.arm else part

    def to_json(self) -> Json:
        """Write the changes and the selected number."""
        return {"row": self.row, "field": self.field, "changes": [[c.row, c.field, c.value] for c in self.changes]}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read them back; raises if they cannot be used with this arm."""
        row, field = int(data["row"]), str(data["field"])
        value_of(robot.arm, row, field)
        part = cls(robot.arm, robot.arm, row, field)
        return part.changed(tuple(Change(int(i), str(name), float(value)) for i, name, value in data["changes"]))

    def changed(self, changes: tuple[Change, ...]) -> Self:
        """Return the part with these changes; `InputError` if an arm cannot have them."""
        real = tuple(c for c in changes if not abs(c.value - value_of(self.arm, c.row, c.field)) <= SAME)
        if real == self.changes:
            return self
        return replace(self, changes=real, other=altered(self.arm, real) if real else self.arm)


PART = PartType(WhatIf, order=121)


@dataclass(frozen=True)
class ChooseQuantity(Command):
    """Select another number; for another joint the same kind of number, if it has one."""

    row: int
    field: str = ""
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the number selected."""
        part = state[WhatIf]
        known = fields_of(part.arm, self.row)
        field = self.field or (part.field if part.field in known else known[0])
        value_of(part.arm, self.row, field)
        return state.replace(replace(part, row=self.row, field=field))


@dataclass(frozen=True)
class Suppose(Command):
    """Suppose another value of a number, metres or radians, by a slider; its real value removes the change."""

    row: int
    field: str
    value: float
    snapshot: ClassVar[bool] = True
    undoable: ClassVar[bool] = False

    @property
    def channel(self) -> object:
        """Keep the sliders of different numbers from replacing each other."""
        return type(self), self.row, self.field

    def apply(self, state: State) -> State:
        """Return the state with the change."""
        part, change = state[WhatIf], Change(self.row, self.field, self.value)
        value_of(part.arm, self.row, self.field)
        known = [(c.row, c.field) for c in part.changes]
        if (self.row, self.field) in known:
            at = known.index((self.row, self.field))
            changes = (*part.changes[:at], change, *part.changes[at + 1 :])
        else:
            changes = (*part.changes, change)
        changed = part.changed(changes)
        return state if changed is part else state.replace(changed)


@dataclass(frozen=True)
class ForgetChanges(Command):
    """Remove all supposed changes."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state without changes."""
        part = state[WhatIf]
        return state if not part.changes else state.replace(part.changed(()))


@dataclass(frozen=True)
class TakeOver(Command):
    """Make the changes real: the table, the limits and the tool are edited in one step."""

    label: ClassVar[str] = "what if"

    def apply(self, state: State) -> State:
        """Return the state with the edited arm; `InputError` if nothing was changed."""
        part = state[WhatIf]
        if not part.changes:
            raise InputError("there are no changes to apply: move the slider first")
        for command in edits_of(part):
            state = command.apply(state)
        return state.replace(replace(state[WhatIf], taken=(part.arm, part.changes)))


def edits_of(part: WhatIf) -> tuple[Command, ...]:
    """Return the commands that edit the arm into the supposed one."""
    cells = [SetCell(c.row, c.field, c.value) for c in part.changes if c.field not in LIMITS + TOOL]
    rows = sorted({c.row for c in part.changes if c.field in LIMITS})
    limits = [SetLimits(i, *part.other.limits[i].tolist()) for i in rows]
    tool = [SetEnd("tool", np.array(part.other.tool))] if any(c.field in TOOL for c in part.changes) else []
    return (*cells, *limits, *tool)


def is_present(state: State) -> bool:
    """Return whether the results belong to the present arm and the present changes."""
    part = state[WhatIf]
    found = part.found
    return found is not None and found.before is part.arm and found.after is part.other


def _lengths(arm: Arm, row: int) -> tuple[str, ...]:
    return tuple(field for field in LENGTHS if field in fields_of(arm, row))
