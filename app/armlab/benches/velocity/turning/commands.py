"""Commands of the page of turning."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from armlab.benches.velocity.turning.motion import turned_of
from armlab.benches.velocity.turning.state import MOST, Triple, Turning
from armlab.errors import UnknownName
from armlab.kin.euler import SEQUENCES, SINGULAR_SINE, euler_angles
from armlab.kin.velocity.rates import angle_rates, rate_determinant
from armlab.registry import known_name
from armlab.session.counted import refuse_beyond
from armlab.session.fields import Set, put
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State


@dataclass(frozen=True)
class WriteAngles(Command):
    """Write the same orientation, and the same omega if possible, in the angles of another sequence."""

    axes: str | None = None
    fixed: bool | None = None
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the new angles and rates; rates that do not exist, or are too large, stay unchanged."""
        part = state[Turning]
        axes = part.axes if self.axes is None else self.axes
        fixed = part.fixed if self.fixed is None else self.fixed
        known_name("axes", axes, SEQUENCES)
        if (axes, fixed) == (part.axes, part.fixed):
            return state
        now = turned_of(put(state, part))  # with the film at its beginning, as below
        angles = euler_angles(now.R, axes, fixed=fixed).solutions[0]
        regular = abs(float(rate_determinant(angles, axes, fixed))) >= 10.0 * SINGULAR_SINE
        rates = _triple(angle_rates(now.omega, angles, axes, fixed)) if regular else part.rates
        if max(map(abs, rates)) > MOST:
            rates = part.rates
        found = {"axes": axes, "fixed": fixed, "angles": _triple(angles), "rates": rates}
        return put(state, part.with_values(found))


@dataclass(frozen=True)
class SetTurning(Command):
    """Set one of the three angles (rad) or of their rates (rad/s), 0-based."""

    what: str
    index: int
    value: float
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the value, and the film at its start."""
        if self.what not in ("angles", "rates"):
            raise UnknownName("field", self.what, ("angles", "rates"))
        refuse_beyond(self.index, 3, self.what)
        part = state[Turning]
        values = list(getattr(part, self.what))
        values[self.index] = self.value
        return Set(Turning, self.what, values).apply(state)


@dataclass(frozen=True)
class TakeToolAngles(Command):
    """Take the angles of the tool in the world."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the tool's orientation."""
        part = state[Turning]
        R = state[Joints].tool_pose[:3, :3]
        angles = euler_angles(R, part.axes, fixed=part.fixed).solutions[0]
        return Set(Turning, "angles", _triple(angles)).apply(state)


def _triple(values: np.ndarray) -> Triple:
    x, y, z = (float(value) for value in values)
    return x, y, z
