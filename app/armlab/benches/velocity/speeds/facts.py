"""Facts of the tool's velocity that lessons can check."""

from __future__ import annotations

import numpy as np

from armlab.benches.velocity.speeds.motion import moving_of, speeds_of, time_left, two_points_of
from armlab.benches.velocity.speeds.state import Velocity
from armlab.session.facts import Fact, Facts
from armlab.session.parts.joints import Joints
from armlab.session.state import State


def _twist(state: State) -> np.ndarray:
    return np.asarray(state.derived(moving_of).twist)


FACTS = Facts(
    __name__,
    (Velocity, Joints),
    {
        "qdot": Fact("the joint speeds, in rad/s and m/s", lambda s: s.derived(speeds_of), kind="numbers"),
        "velocity": Fact("the velocity of the tool, in world axes", lambda s: _twist(s)[:3], "m/s", "numbers"),
        "speed": Fact("the speed of the tool", lambda s: np.linalg.norm(_twist(s)[:3]), "m/s"),
        "angular_velocity": Fact(
            "the angular velocity of the tool, in world axes", lambda s: _twist(s)[3:], "rad/s", "numbers"
        ),
        "turning_speed": Fact("the angular speed of the tool", lambda s: np.linalg.norm(_twist(s)[3:]), "rad/s"),
        "first_point": Fact(
            "the velocity of the first point of the link", lambda s: s.derived(two_points_of).v1, "m/s", "numbers"
        ),
        "second_point": Fact(
            "the velocity of the second point of the link", lambda s: s.derived(two_points_of).v2, "m/s", "numbers"
        ),
        "time_left": Fact("the time until a joint is at its limit", time_left, "s"),
    },
)
