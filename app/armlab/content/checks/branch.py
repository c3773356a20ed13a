"""The arm is in a branch of its inverse kinematics: elbow, shoulder, wrist."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from armlab.content.check import PLAIN, CheckType, Words
from armlab.content.checks._branches import Branches, Side
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot

Tell = Callable[[Branches, NDArray[np.float64]], Side]


@dataclass(frozen=True)
class Feature:
    """A feature of a configuration that has two branches.

    Attributes
    ----------
    field, words : str, tuple of str
        The field of the file and its two words, "first" and "second" of `Branches`.
    has : callable
        Whether an arm has it.
    tell : callable
    needs : str
        Sentence on the arms that have this feature.
    neither : str
        Sentence for an arm that is in neither branch.
    """

    field: str
    words: tuple[str, str]
    has: Callable[[Branches], bool]
    tell: Tell
    needs: str
    neither: str


FEATURES = (
    Feature(
        "elbow",
        ("up", "down"),
        lambda arm: arm.planar or arm.turning,
        Branches.elbow,
        "a planar arm of two or three revolute joints, or one whose axis 1 turns the plane of a shoulder and an elbow",
        "stretched, folded, or straight above its shoulder",
    ),
    Feature(
        "shoulder",
        ("front", "back"),
        lambda arm: arm.turning,
        Branches.front,
        "an arm whose axis 1 turns the plane of a shoulder and an elbow",
        "with its wrist above the axis of joint 1",
    ),
    Feature(
        "shoulder",
        ("left", "right"),
        lambda arm: arm.sided,
        Branches.side,
        "an arm like the PUMA, which stands beside the axis of joint 1",
        "with its wrist above the axis of joint 1",
    ),
    Feature(
        "wrist",
        ("positive", "negative"),
        lambda arm: arm.wrist,
        Branches.hand,
        "an arm of six joints whose last three axes meet at right angles",
        "with a straight wrist, axes 4 and 6 in one line",
    ),
)


@dataclass(frozen=True, eq=False)
class Branch:
    """The required branches: feature and "first" or "second"."""

    asked: tuple[tuple[Feature, Side], ...] = field(default=())

    def is_met(self, observation: Observation) -> bool:
        """Return whether the arm is in all of these branches; on a border between two it is in neither."""
        return self._first_wrong(observation) is None

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on the first branch that differs."""
        found = self._first_wrong(observation)
        if found is None:
            return "The arm is on the branch that is asked for."
        feature, asked, is_now = found
        wanted = f"the branch asked for is {feature.field} {_word(feature, asked)}"
        if is_now == "neither":
            return f"The arm is {feature.neither}, between two branches; {wanted}."
        return f"This is {feature.field} {_word(feature, is_now)}, the mirror branch; {wanted}."

    def _first_wrong(self, observation: Observation) -> tuple[Feature, Side, Side] | None:
        branches = Branches(observation.arm)
        for feature, asked in self.asked:
            # A table that was edited may have lost the branch.
            is_now: Side = feature.tell(branches, observation.q) if feature.has(branches) else "neither"
            if is_now != asked:
                return feature, asked, is_now
        return None


def _word(feature: Feature, side: Side) -> str:
    return feature.words[0 if side == "first" else 1]


def read(table: Table, robot: Robot) -> Branch:
    """Read ``elbow`` (up, down), ``shoulder`` (front, back; left, right) and ``wrist`` (positive, negative).

    At least one; the sign of the wrist is that of q5, counted from straight.

    Branches that the robot does not have are refused.
    """
    branches = Branches(robot.arm)
    names = tuple(dict.fromkeys(feature.field for feature in FEATURES))
    asked: list[tuple[Feature, Side]] = []
    for name in names:
        if not table.has(name):
            continue
        known = [feature for feature in FEATURES if feature.field == name]
        word = table.choice(name, [word for feature in known for word in feature.words])
        feature = next(feature for feature in known if word in feature.words)
        if not feature.has(branches):
            raise table.fail(name, f"{robot.name} has no such branch; {word!r} is for {feature.needs}")
        asked.append((feature, "first" if word == feature.words[0] else "second"))
    if not asked:
        raise table.fail(names[0], f"missing; expected one of {', '.join(names)}")
    return Branch(tuple(asked))


CHECK = CheckType("branch", 90, read)
