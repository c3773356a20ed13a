"""What a person does to the limits, the time and the samples of a plan."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Literal

from armlab.session.parts.joints import Joints
from armlab.session.parts.plan import (
    Plan,
    checked_duration,
    checked_limits,
    checked_samples,
    checked_shares,
    optional_positive,
)
from armlab.session.plan_commands import PlanCommand
from armlab.session.state import Command, State


@dataclass(frozen=True)
class LimitMotion(PlanCommand):
    """Change what the motion is limited by; None leaves as it is, 0 takes a limit of tool speed or jerk away.

    Parameters
    ----------
    velocity, acceleration : float, optional
        Share of the limits of the joints, more than 0 and at most 1.
    tool_speed : float, optional
        m/s.
    jerk_time : float, optional
        Seconds.
    """

    velocity: float | None = None
    acceleration: float | None = None
    tool_speed: float | None = None
    jerk_time: float | None = None
    label: ClassVar[str] = "limit of the motion"

    def apply(self, state: State) -> State:
        """Return the state with the limits."""
        part = state[Plan]
        v, a = part.shares
        shares = checked_shares(
            (v if self.velocity is None else self.velocity, a if self.acceleration is None else self.acceleration)
        )
        speed = part.tool_speed if self.tool_speed is None else optional_positive(self.tool_speed or None, "tool speed")
        jerk = part.jerk_time if self.jerk_time is None else optional_positive(self.jerk_time or None, "jerk time")
        return state.replace(replace(part, shares=shares, tool_speed=speed, jerk_time=jerk))


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
        values[self.joint] = self.value
        checked = checked_limits(state[Joints].arm, self.of, values)
        return state.replace(
            replace(part, velocity=checked) if self.of == "velocity" else replace(part, acceleration=checked)
        )


@dataclass(frozen=True)
class LastFor(PlanCommand):
    """Give the whole motion a duration in seconds; None: as fast as allowed."""

    duration: float | None
    label: ClassVar[str] = "duration"

    def apply(self, state: State) -> State:
        """Return the state with the duration."""
        return state.replace(replace(state[Plan], duration=checked_duration(self.duration)))


@dataclass(frozen=True)
class SampleBy(PlanCommand):
    """Choose for how many poses along a Cartesian stretch the inverse kinematics is solved."""

    samples: float
    label: ClassVar[str] = "number of samples"

    def apply(self, state: State) -> State:
        """Return the state with the number."""
        return state.replace(replace(state[Plan], samples=checked_samples(self.samples)))


@dataclass(frozen=True)
class CompareMoves(Command):
    """Plan the same waypoints also with the other kind of moves, or no longer."""

    on: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        part = state[Plan]
        return state if part.compared == self.on else state.replace(replace(part, compared=self.on))
