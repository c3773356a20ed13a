"""Facts of joint drives that lessons can check: resolutions, and what they leave open at the tool."""

from __future__ import annotations

import numpy as np

from armlab.benches.drive.joint.errors import Compared, ToolErrors, compared, errors_of
from armlab.benches.drive.joint.state import Drives
from armlab.benches.velocity.api import Statics, Velocity, balance, speeds_of
from armlab.session.facts import Fact, Facts
from armlab.session.parts.joints import Joints
from armlab.session.state import State


def _errors(state: State) -> ToolErrors:
    return state.derived(errors_of)


def _compared(state: State) -> Compared:
    return state.derived(compared)


FACTS = Facts(
    __name__,
    (Drives, Joints, Velocity, Statics),
    {
        "counts": Fact(
            "one count of each encoder at its joint, rad or m", lambda s: s[Drives].drives.count, kind="numbers"
        ),
        "half_widths": Fact(
            "by how much each joint may be off to either side, rad or m", lambda s: _errors(s).half, kind="numbers"
        ),
        "backlash": Fact("the backlash of each joint, rad or m", lambda s: s[Drives].backlash, kind="numbers"),
        "worst_position": Fact("the largest error of the tool's position", lambda s: _errors(s).position.size, "m"),
        "worst_orientation": Fact(
            "the largest error of the tool's orientation", lambda s: _errors(s).orientation.size, "rad"
        ),
        "direction": Fact(
            "the largest error of the position as a vector, in world axes",
            lambda s: _errors(s).position.vector,
            "m",
            "numbers",
        ),
        "shares": Fact(
            "the error of the position that each joint causes by itself",
            lambda s: _errors(s).position_shares,
            "m",
            "numbers",
        ),
        "largest_joint": Fact(
            "the joint that contributes most to the position",
            lambda s: int(np.argmax(_errors(s).position_shares)) + 1,
            kind="count",
        ),
        "sampled_position": Fact(
            "the largest error of the position found by forward kinematics",
            lambda s: _compared(s).largest_position,
            "m",
        ),
        "position_apart": Fact(
            "the largest difference of the position by J and by forward kinematics",
            lambda s: _compared(s).position_apart,
            "m",
        ),
        "motor_speeds": Fact(
            "the speeds of the motors at the present joint speeds",
            lambda s: s[Drives].drives.motor_speeds(s.derived(speeds_of)),
            "rad/s",
            "numbers",
        ),
        "motor_torques": Fact(
            "the torques of the motors for the present wrench",
            lambda s: s[Drives].drives.motor_torques(s.derived(balance).torques),
            "N m",
            "numbers",
        ),
    },
)
