"""Commands of the singularity microscope."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.microscope.looked import known_places, looked
from armlab.benches.velocity.microscope.state import DAMPING, ROUNDING, Microscope
from armlab.errors import InputError
from armlab.kin.control.singular_poses import SingularPose
from armlab.registry import known_name
from armlab.session.counted import refuse_beyond
from armlab.session.fields import setting
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State


@dataclass(frozen=True)
class AimAlong(Command):
    """Ask for a velocity along one component of the task (0-based), with the same size as before."""

    component: int
    label: ClassVar[str] = "velocity of the tool"

    def apply(self, state: State) -> State:
        """Return the state with the velocity."""
        part = state[Microscope]
        refuse_beyond(self.component, part.arm.task.m, "component")
        own = np.zeros(part.arm.task.m)
        own[self.component] = part.size / part.task.row_units[self.component]
        return setting(state, Microscope, {"aim": "own", "own": own, "speed": part.size})


@dataclass(frozen=True)
class SetComponent(Command):
    """Set one component (0-based) of the velocity, m/s or rad/s; the others stay as they are shown."""

    component: int
    value: float
    label: ClassVar[str] = "velocity of the tool"

    def apply(self, state: State) -> State:
        """Return the state with the component."""
        look = state.derived(looked)
        own = look.natural(look.wish)
        refuse_beyond(self.component, len(own), "component")
        own[self.component] = self.value
        aimed = state[Microscope].with_values({"own": own})
        return setting(state, Microscope, {"aim": "own", "own": own, "speed": aimed.sized(aimed.own)})


@dataclass(frozen=True)
class SetSpeed(Command):
    """Set the scaled size of the velocity; its direction stays."""

    speed: float
    label: ClassVar[str] = "speed of the tool"

    def apply(self, state: State) -> State:
        """Return the state with the speed."""
        part = state[Microscope]
        speed = part.with_values({"speed": self.speed}).speed
        factor = speed / part.size if part.aim == "own" else 1.0
        return setting(state, Microscope, {"speed": speed, "own": [factor * value for value in part.own]})


@dataclass(frozen=True)
class SetDamping(Command):
    """Set an option of the damped methods, by its key in `DAMPING`."""

    name: str
    value: Any
    label: ClassVar[str] = "damping"

    def apply(self, state: State) -> State:
        """Return the state with the option."""
        known_name("damping", self.name, DAMPING)
        return setting(state, Microscope, {"damping": {**dict(state[Microscope].damping), self.name: self.value}})


@dataclass(frozen=True)
class BringNear(Command):
    """Move the arm near to one of its known singular configurations (0-based)."""

    place: int
    label: ClassVar[str] = "move near a singularity"

    def apply(self, state: State) -> State:
        """Return the state with the arm near the singularity, on the side that the limits allow."""
        found, part, joints = known_places(state), state[Microscope], state[Joints]
        if not 0 <= self.place < len(found):
            raise InputError(f"singularity: expected 1 to {len(found)}, got {self.place + 1}")
        pose = found[self.place].pose
        q, k = pose.q.copy(), pose.place
        q[k] += _step(pose, part.distance * float(part.task.joint_units[k]), joints.arm.limits[k])
        held = np.flatnonzero(np.array(joints.locked) & ~np.isclose(q, joints.q, rtol=0.0, atol=ROUNDING))
        if len(held):
            raise InputError(f"joint {held[0] + 1} is held and would have to move: release it on the page Joints")
        moved = joints.moved_to(q)
        return state if moved is joints else state.replace(moved)


def _step(pose: SingularPose, distance: float, limits: NDArray[np.float64]) -> float:
    """Return the step of the joint from its singular value: back towards where one comes from, if there is room.

    Without enough on either side it is towards the larger room.
    """
    value, back = float(pose.q[pose.place]), 1 if pose.away <= 0.0 else -1
    room = {1: float(limits[1]) - value, -1: value - float(limits[0])}
    return distance * (back if room[back] >= min(distance, room[-back]) else -back)
