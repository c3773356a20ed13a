"""Commands for the limits, the time and the samples of a plan."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Literal

from armlab.benches.motion.plan.commands import PlanCommand
from armlab.benches.motion.plan.moves import checked_joint
from armlab.benches.motion.plan.state import (
    Plan,
    checked_duration,
    checked_limits,
    checked_samples,
    checked_shares,
    optional_positive,
)
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State


@dataclass(frozen=True)
class UseShare(PlanCommand):
    """Use only a share of the limits of the joints, more than 0 and at most 1; None leaves a share unchanged."""

    velocity: float | None = None
    acceleration: float | None = None
    label: ClassVar[str] = "share of the limits"

    def apply(self, state: State) -> State:
        """Return the state with the shares."""
        part = state[Plan]
        v, a = part.shares
        wanted = (v if self.velocity is None else self.velocity, a if self.acceleration is None else self.acceleration)
        return state.replace(replace(part, shares=checked_shares(wanted)))


@dataclass(frozen=True)
class LimitTool(PlanCommand):
    """Limit the speed of the tool point, m/s; None removes the limit."""

    speed: float | None
    label: ClassVar[str] = "limit of tool speed"

    def apply(self, state: State) -> State:
        """Return the state with the limit."""
        return state.replace(replace(state[Plan], tool_speed=optional_positive(self.speed, "tool speed")))


@dataclass(frozen=True)
class LimitJerk(PlanCommand):
    """Limit the jerk by the seconds in which the full acceleration is built up; None removes the limit."""

    time: float | None
    label: ClassVar[str] = "limit of jerk"

    def apply(self, state: State) -> State:
        """Return the state with the limit."""
        return state.replace(replace(state[Plan], jerk_time=optional_positive(self.time, "jerk time")))


@dataclass(frozen=True)
class LimitJoint(PlanCommand):
    """Set the limit of one joint, rad/s or m/s, rad/s² or m/s²."""

    joint: int
    of: Literal["velocity", "acceleration"]
    value: float
    label: ClassVar[str] = "limit of a joint"

    def apply(self, state: State) -> State:
        """Return the state with the limit."""
        part = state[Plan]
        values = list(getattr(part, self.of))
        checked_joint(state[Joints].arm, self.joint)
        values[self.joint] = self.value
        checked = checked_limits(state[Joints].arm, self.of, values)
        return state.replace(
            replace(part, velocity=checked) if self.of == "velocity" else replace(part, acceleration=checked)
        )


@dataclass(frozen=True)
class LastFor(PlanCommand):
    """Give the whole motion a duration in seconds; None is as fast as allowed."""

    duration: float | None
    label: ClassVar[str] = "duration"

    def apply(self, state: State) -> State:
        """Return the state with the duration."""
        return state.replace(replace(state[Plan], duration=checked_duration(self.duration)))


@dataclass(frozen=True)
class SampleBy(PlanCommand):
    """Set the number of poses along a Cartesian stretch for which the inverse kinematics is solved."""

    samples: float
    label: ClassVar[str] = "number of samples"

    def apply(self, state: State) -> State:
        """Return the state with the number."""
        return state.replace(replace(state[Plan], samples=checked_samples(self.samples)))


@dataclass(frozen=True)
class CompareMoves(Command):
    """Choose whether the same waypoints are also planned with the other kind of moves."""

    on: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        part = state[Plan]
        return state if part.compared == self.on else state.replace(replace(part, compared=self.on))
