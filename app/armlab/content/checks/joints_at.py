"""All joints have given values: one configuration."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from armlab.content.check import PLAIN, CheckType, Words, angle_tolerance, configuration, length_tolerance, with_edge
from armlab.content.checks._joint import joint_mistake
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot

Vector = NDArray[np.float64]

SAME_POINT = 0.02
"""Distance of two tool points, relative to the reach, below which they coincide when another branch is recognised."""

ANOTHER_BRANCH = 0.2
"""Least difference of a joint in another branch, radians or metres; with less the joint has not arrived yet."""


@dataclass(frozen=True, eq=False)
class JointsAt:
    """The configuration ``q``, shape (n,), with a tolerance for each joint, rad or m; ``turns``: whole turns count."""

    q: Vector
    within: Vector
    revolute: NDArray[np.bool_]
    turns: bool = False

    def is_met(self, observation: Observation) -> bool:
        """Return whether every joint is within its tolerance."""
        return self._is_at(observation.q)

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return the mistake that explains the configuration, or a sentence on the first joint that deviates."""
        if self.is_met(observation):
            return "All joints are where they should be."
        if observation.q.shape != self.q.shape:
            return f"The arm has {len(observation.q)} joints; it should have {len(self.q)}."
        return self._mistake(observation) or self._first_off(observation.q, words)

    def _is_at(self, q: Vector) -> bool:
        return q.shape == self.q.shape and not self._off(q).any()

    def _off(self, q: Vector) -> NDArray[np.bool_]:
        return np.asarray(self._missing(q) > with_edge(self.within))

    def _missing(self, q: Vector) -> Vector:
        return np.asarray(np.abs(self.q - q)) if self.turns else self._up_to_turns(q)

    def _up_to_turns(self, q: Vector) -> Vector:
        missing = self.q - q
        turned = np.abs((missing + np.pi) % (2.0 * np.pi) - np.pi)
        return np.asarray(np.where(self.revolute, turned, np.abs(missing)))

    def _mistake(self, observation: Observation) -> str:
        q = observation.q
        if not (self._up_to_turns(q) > with_edge(self.within)).any():
            return "The pose is the right one, but a joint is a whole turn away."
        if self._is_at(-q):
            return "All joint values have the right size and the wrong sign."
        if self._is_at(q[::-1]) and len(q) > 2:
            return "The values are right, but in reverse order."
        for i, k in combinations(range(len(q)), 2):
            exchanged = q.copy()
            exchanged[[i, k]] = q[[k, i]]
            if self.revolute[i] == self.revolute[k] and self._is_at(exchanged):
                return f"The values of joints {i + 1} and {k + 1} are exchanged."
        if self._missing(q).max() > ANOTHER_BRANCH and self._is_another_branch(observation):
            return "The tool is in the right place, but in another configuration of the arm: this is another branch."
        return ""

    def _is_another_branch(self, observation: Observation) -> bool:
        """Return whether the tool is in place in another branch, and not only turned in place by these joints."""
        arm, q = observation.arm, observation.q
        way = arm.position(np.array([q, 0.75 * q + 0.25 * self.q, 0.5 * (q + self.q), 0.25 * q + 0.75 * self.q]))
        off = np.linalg.norm(way - arm.position(self.q), axis=-1) > SAME_POINT * arm.reach
        return bool(not off[0] and off[1:].any())

    def _first_off(self, q: Vector, words: Words) -> str:
        off = np.flatnonzero(self._off(q))
        i = int(off[0])
        revolute, now, asked = bool(self.revolute[i]), float(q[i]), float(self.q[i])
        written = words.angle if revolute else words.length
        more = f" {len(off) - 1} more {'joint is' if len(off) == 2 else 'joints are'} not there yet." * (len(off) > 1)
        mistake = joint_mistake(now, asked, float(self.within[i]), revolute)
        return f"Joint {i + 1} is at {written(now)} and should be at {written(asked)}.{mistake}{more}"


def read(table: Table, robot: Robot) -> JointsAt:
    """Read ``q_deg``, ``q_m`` or ``q_deg_m``, ``tolerance_deg`` and ``tolerance_m`` for such joints, and ``turns``."""
    q, revolute = configuration(table, robot), robot.arm.revolute
    within = np.zeros(robot.arm.n)
    if revolute.any():
        within[revolute] = angle_tolerance(table)
    if not revolute.all():
        within[~revolute] = length_tolerance(table, robot)
    return JointsAt(q, within, revolute, table.boolean("turns", False))


CHECK = CheckType("joints_at", 25, read)
