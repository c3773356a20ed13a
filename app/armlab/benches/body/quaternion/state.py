"""The page of quaternions: the second factor of a product."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.body.forms.state import MOST, Four
from armlab.errors import InputError
from armlab.session.counted import refuse_beyond
from armlab.session.fields import FieldPart, Set, vector
from armlab.session.state import Command, PartType, State

CLIP_KEY = "quaternion"


@dataclass(frozen=True)
class Quaternions(FieldPart):
    """Choices of the page; the axis is that of the body.

    Attributes
    ----------
    p : (float, float, float, float)
        A second rotation, scalar first, of any length but zero.
    """

    key: ClassVar[str] = "quaternions"

    p: Four = vector("p", "second quaternion", (1.0, 1.0, 0.0, 0.0), -MOST, MOST)

    def check(self) -> None:
        """Refuse a quaternion that is zero."""
        if math.hypot(*self.p) == 0.0:
            raise InputError("p: expected a quaternion that is not zero: zero is no rotation")


PART = PartType(Quaternions, order=34)


@dataclass(frozen=True)
class SetSecond(Command):
    """Set one component of the second quaternion, 0-based, scalar first; its length does not matter."""

    index: int
    value: float
    label: ClassVar[str] = "second quaternion"

    def apply(self, state: State) -> State:
        """Return the state with this component."""
        refuse_beyond(self.index, 4, "p")
        values = [self.value if k == self.index else each for k, each in enumerate(state[Quaternions].p)]
        return Set(Quaternions, "p", values).apply(state)
