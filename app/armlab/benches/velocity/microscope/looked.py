"""The view of the microscope in a state."""

from __future__ import annotations

from armlab.benches.velocity.microscope.look import Look, Near, Place, look_at, near_at, places
from armlab.benches.velocity.microscope.state import Microscope
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State


def looked(state: State) -> Look:
    """Return the view of the microscope at the present configuration."""
    return look_at(state[Microscope], state[Joints].q)


def near(state: State) -> Near | None:
    """Return the singularity that is near, or None."""
    return near_at(state[Microscope], state[Joints].q)


def known_places(state: State) -> tuple[Place, ...]:
    """Return the singular configurations to which the arm can be brought near."""
    robot = state[RobotPart].robot
    return places(robot.arm, tuple(float(value) for value in robot.home))
