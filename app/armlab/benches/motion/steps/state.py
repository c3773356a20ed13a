"""The choice of one of the five planning steps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.session.fields import FieldPart, whole
from armlab.session.state import PartType

KNOTS, PATH, SAMPLING, INVERSE, JOINTS = STEPS = (1, 2, 3, 4, 5)


@dataclass(frozen=True)
class PlanSteps(FieldPart):
    """The chosen step, which is shown with those before it.

    Attributes
    ----------
    shown : int
        1 to 5.
    """

    key: ClassVar[str] = "plan_steps"
    kept_by_undo: ClassVar[bool] = True
    bare: ClassVar[bool] = True

    shown: int = whole("planning step", KNOTS, STEPS[0], STEPS[-1])


PART = PartType(PlanSteps, order=99)
