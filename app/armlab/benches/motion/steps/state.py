"""Which of the five planning steps is shown."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.session.state import Command, Json, Part, PartType, State

KNOTS, PATH, SAMPLING, INVERSE, JOINTS = STEPS = (1, 2, 3, 4, 5)


@dataclass(frozen=True)
class PlanSteps(Part):
    """The step that is shown, with those before it.

    Attributes
    ----------
    shown : int
        1 to 5.
    """

    key: ClassVar[str] = "plan_steps"
    kept_by_undo: ClassVar[bool] = True

    shown: int = KNOTS

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the first step."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep the step: another arm is asked the same."""
        return self

    def to_json(self) -> Json:
        """Write the number of the step."""
        return self.shown

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; `InputError` when there is no such step."""
        return cls(_checked(data))


PART = PartType(PlanSteps, order=99)


@dataclass(frozen=True)
class ShowStep(Command):
    """Show a planning step, 1 to 5, and those before it."""

    step: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the step shown."""
        changed = PlanSteps(_checked(self.step))
        return state if changed == state[PlanSteps] else state.replace(changed)


def _checked(step: Json) -> int:
    if isinstance(step, bool) or step not in STEPS:
        raise InputError(f"planning step: expected {STEPS[0]} to {STEPS[-1]}, got {str(step)[:20]}")
    return int(step)
