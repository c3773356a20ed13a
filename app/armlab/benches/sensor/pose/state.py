"""An arm that is sent to the present pose again and again: errors of its joints, and the poses that it attains."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.control.encoder import MOST_COUNTS, SHAFTS, encoder
from armlab.kin.sensors.pose_accuracy import APPROACHES, MOST_TIMES, STANDARD, JointErrors, PoseFigures, attained
from armlab.session.fields import FieldPart, choice, number, text, whole
from armlab.session.parts.joints import Joints
from armlab.session.state import PartType, State

Floats = NDArray[np.float64]

LARGEST = math.radians(5.0)
"""Largest error of a turning joint, radians."""

FARTHEST = 0.05
"""Largest error of a sliding joint, metres."""

ZERO = 7
"""Seed beside the number of an arm, from which the errors of its zeros come."""


@dataclass(frozen=True)
class Repeats(FieldPart):
    """Errors of the joints, the same for all of a kind, and how often the arm is sent to its pose.

    Attributes
    ----------
    counts : int
        Of an encoder, in a turn.
    shaft : str
        Some of `SHAFTS`.
    ratio : float
        Turns of the motor for one of the joint, or of the spindle of a sliding joint.
    backlash, play : float
        Backlash of turning and of sliding joints, rad and m.
    zero, zero_slide : float
        Standard deviation of the errors of the zeros of turning and of sliding joints, rad and m.
    approach : str
        Some of `APPROACHES`.
    specimen : int
        Number of the arm among those of its make, whose zeros are its own.
    times, seed : int
        How often it is sent there, and the seed of these attempts.
    example : str
        Key of the example it still is; empty when something has been changed.
    """

    key: ClassVar[str] = "pose_accuracy"

    counts: int = whole("encoder counts in a turn", 4096, 4, MOST_COUNTS)
    shaft: str = choice("encoder on the", "motor", SHAFTS)
    ratio: float = number("n", "gear ratio", 100.0, 0.0, 1e5, above=True)
    backlash: float = number("", "backlash of turning joints", math.radians(0.02), 0.0, LARGEST, "rad")
    play: float = number("", "play of sliding joints", 2e-5, 0.0, FARTHEST, "m")
    zero: float = number("", "error of the zeros of turning joints", math.radians(0.05), 0.0, LARGEST, "rad")
    zero_slide: float = number("", "error of the zeros of sliding joints", 1e-4, 0.0, FARTHEST, "m")
    specimen: int = whole("zeros of arm number", 1, 1, 1_000_000)
    approach: str = choice("approach", "either", APPROACHES)
    times: int = whole("times", STANDARD, 2, MOST_TIMES)
    seed: int = whole("seed", 1, 0, 1_000_000)
    example: str = text("example", "usual")

    def errors(self, arm: Arm) -> JointErrors:
        """Return the errors of the joints of an arm, with the backlash that the encoder does not see."""
        # An encoder on the link stands behind the gears: the controller goes on until their play is used up.
        unseen = 0.0 if self.shaft == "link" else 1.0
        counts = encoder(self.counts, self.shaft, self.ratio).resolution(arm.revolute)
        zeros = np.random.default_rng([self.specimen, ZERO]).standard_normal(arm.n)
        return JointErrors(
            counts,
            unseen * np.where(arm.revolute, self.backlash, self.play),
            zeros * np.where(arm.revolute, self.zero, self.zero_slide),
        )


@dataclass(frozen=True, eq=False)
class Attained:
    """The poses that the arm attains, and their figures.

    Attributes
    ----------
    errors : JointErrors
    q : ndarray, shape (times, n)
    figures : PoseFigures
    """

    errors: JointErrors
    q: Floats
    figures: PoseFigures


def found(state: State) -> Attained:
    """Return what the present arm attains that is sent to the present pose."""
    part, arm, q = state[Repeats], state[Joints].arm, state[Joints].q
    errors = part.errors(arm)
    stops, _ = attained(q, errors, part.times, part.approach, part.seed)
    return Attained(errors, stops, PoseFigures(np.asarray(arm.fk(q)), np.asarray(arm.fk(stops))))


PART = PartType(Repeats, order=145)
