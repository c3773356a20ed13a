"""Examples of joint drives, which give every joint of the present arm the same; each says what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from armlab.benches.drive.joint.state import USUAL, Drives, with_drives
from armlab.kin.arm import Arm
from armlab.kin.drive.joint_drives import LEAD
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, State


@dataclass(frozen=True)
class DriveExample:
    """One drive for every joint.

    Attributes
    ----------
    key, title, says : str
    ratio, counts : float
    side : "motor" or "joint"
    backlash, play : float
        Of joints that turn, rad, and of those that slide, m.
    """

    key: str
    title: str
    says: str
    ratio: float
    counts: float
    side: str = "motor"
    backlash: float = 0.0
    play: float = 0.0

    def part(self, arm: Arm) -> Drives:
        """Return the drives of an arm."""
        n = arm.n
        play = np.where(arm.revolute, self.backlash, self.play).tolist()
        return Drives(
            arm, (self.ratio,) * n, (self.counts,) * n, (self.side,) * n, tuple(play), (LEAD,) * n, example=self.key
        )


EXAMPLES = Registry(
    "example",
    (
        DriveExample(
            USUAL,
            "Gear of 100, 4000 counts at the motor",
            "The gear divides every count by 100: a joint that turns is known to a thousandth of a degree, and the "
            "tool behind such joints to some hundredths of a millimetre.",
            100.0,
            4000.0,
        ),
        DriveExample(
            "play",
            "The same with backlash",
            "An encoder at the motor sees nothing of the backlash behind it: where joints turn, 0.05° of play are 55 "
            "counts, and the tool may be some thirty times as far off.",
            100.0,
            4000.0,
            backlash=math.radians(0.05),
            play=2e-4,
        ),
        DriveExample(
            "at_joint",
            "The same encoder at the joint",
            "Now the encoder sees the backlash, but the gear no longer divides its counts: 0.09° each "
            "where a joint turns.",
            100.0,
            4000.0,
            "joint",
            math.radians(0.05),
            2e-4,
        ),
        DriveExample(
            "fine",
            "19 bits at the joint",
            "2¹⁹ = 524 288 counts in a turn of the joint itself: fine without a gear, and it sees all backlash. Good "
            "robots have such an encoder.",
            100.0,
            524_288.0,
            "joint",
            math.radians(0.05),
            2e-4,
        ),
        DriveExample(
            "coarse",
            "90 counts, no gear: J is not enough",
            "Where joints turn, four degrees a count: the cloud is bent, and forward kinematics leaves the body that J "
            "predicts. What is missing grows with the square of the count. Where all joints slide, nothing is missing.",
            1.0,
            90.0,
        ),
    ),
)
"""Examples by key, in the order of the list."""


@dataclass(frozen=True)
class ChooseDriveExample(Command):
    """Give every joint of the present arm the drive of an example."""

    key: str
    label: ClassVar[str] = "example of joint drives"

    def apply(self, state: State) -> State:
        """Return the state with these drives."""
        return with_drives(state, EXAMPLES[self.key].part(state[RobotPart].robot.arm))


BENCH = Bench("joint_drive", 88, EXAMPLES, ChooseDriveExample)
