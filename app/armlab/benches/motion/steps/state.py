"""Which of the five planning steps is shown."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.session.fields import FieldPart, whole
from armlab.session.state import Json, PartType

KNOTS, PATH, SAMPLING, INVERSE, JOINTS = STEPS = (1, 2, 3, 4, 5)


@dataclass(frozen=True)
class PlanSteps(FieldPart):
    """The step that is shown, with those before it.

    Attributes
    ----------
    shown : int
        1 to 5.
    """

    key: ClassVar[str] = "plan_steps"
    kept_by_undo: ClassVar[bool] = True

    shown: int = whole("planning step", KNOTS, STEPS[0], STEPS[-1])

    def to_json(self) -> Json:
        """Write the number of the step."""
        return self.shown

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; `InputError` when there is no such step."""
        return cls().with_values({"shown": data})


PART = PartType(PlanSteps, order=99)
