"""One branch of the inverse kinematics along a tool path, by prediction and correction with adaptive steps."""

from __future__ import annotations

from bisect import bisect_right
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.motion.task_rows import joint_scales, least_squares, scaled_error, scaled_jacobian, scaled_rates
from armlab.kin.motion.tool_path import ToolPath

Floats = NDArray[np.float64]

LARGEST, SMALLEST = 1.0 / 16.0, 1e-7
"""Largest and smallest step in s. Below the smallest the branch has ended: a joint would turn 1e5 times as fast as
usual."""

SPARE = 4.0
"""Factor by which steps are shorter with joints to spare: between nodes the way is interpolated, and the motion of the
spare joints there is not corrected."""

FAR = 0.35
"""Largest change of a joint in one step, in radians or length scales, so that no other branch is taken for this one."""

ASIDE, LITTLE = 0.25, 2e-3
"""Largest correction, as a part of the step or at least this much, for which the prediction is on the same branch."""

EASY = 0.25
"""Correction, as a part of the largest allowed, below which the next step may be twice as long (errors grow
quadratically)."""

CORRECTIONS = 7
"""Largest number of Newton steps at a node; on a branch two or three are enough."""

CORRECTED = 1e-10
"""Scaled error of a node: 0.1 nm on a 2 m arm."""

ASTRAY = 1.0
"""Scaled error at which a correction is given up, as Newton's method has jumped."""

POLISHES = 6
"""Newton steps for all samples together; the guesses between nodes are within 1e-3, so two or three are enough."""

POLISHED = 1e-11
"""Scaled error at which these stop, as only rounding is left."""

MOST_NODES, NODES_A_PIECE = 500, 20
"""Largest number of nodes of a branch, and more for each piece of the path: beyond it circles a singularity and
ends."""


class Node(NamedTuple):
    """A place on the branch: s, joint values (n,), dq/ds towards larger s (n,)."""

    s: float
    q: Floats
    slope: Floats


class Branch:
    """A branch followed from a start.

    Parameters
    ----------
    arm : Arm
    tool_path : ToolPath
    """

    def __init__(self, arm: Arm, tool_path: ToolPath) -> None:
        self.arm, self.tool_path = arm, tool_path
        self.scales = joint_scales(arm)
        self.largest = LARGEST if arm.n <= arm.task.m else LARGEST / SPARE
        self._halts = [*tool_path.corners.tolist(), 1.0]
        self._most = MOST_NODES + NODES_A_PIECE * len(tool_path.pieces)

    def corrected(self, q: Floats, s: float) -> Floats | None:
        """Return the configuration (n,) on the path near a guess; None when Newton's method does not get there."""
        wanted = self.tool_path.pose(s)[None]
        for _ in range(CORRECTIONS):
            tool = np.asarray(self.arm.fk(q), dtype=np.float64)[None]
            error = scaled_error(self.arm, tool, wanted)
            size = float(np.abs(error).max())
            if size <= CORRECTED:
                return q
            if not size <= ASTRAY:
                return None
            q = q + least_squares(scaled_jacobian(self.arm, q[None], tool), error)[0] * self.scales
        return None

    def slope(self, q: Floats, s: float) -> Floats:
        """Return dq/ds, (n,)."""
        tool = np.asarray(self.arm.fk(q), dtype=np.float64)[None]
        J, rates = scaled_jacobian(self.arm, q[None], tool), scaled_rates(self.arm, self.tool_path.twist(s)[None], tool)
        return np.asarray(least_squares(J, rates)[0] * self.scales)

    def from_here(self, q: Floats, s: float) -> list[Node]:
        """Return nodes as far as the branch and the joint limits go; the last is at 1 or where it ends.

        Parameters
        ----------
        q : ndarray, shape (n,)
            Configuration on the path at s.
        s : float
        """
        nodes = [Node(s, q, self.slope(q, s))]
        step = self.largest
        while nodes[-1].s < 1.0 and len(nodes) < self._most:
            last = nodes[-1]
            halt = self._halts[bisect_right(self._halts, last.s)]
            end = halt if last.s + 1.5 * step >= halt else last.s + step
            found = self._step(last, end)
            if found is None:
                step = 0.5 * (end - last.s)
                if step < SMALLEST:
                    break
                continue
            there, easy = found
            nodes.append(Node(end, there, self.slope(there, end)))
            if not self.arm.within_limits(there):
                break
            step = min(2.0 * step, self.largest) if easy else end - last.s
        return nodes

    def _step(self, last: Node, end: float) -> tuple[Floats, bool] | None:
        """Return the configuration at the end of a step, and whether a longer one may do as well.

        None when it is not surely of the same branch.
        """
        way = (end - last.s) * last.slope
        length = float(np.abs(way / self.scales).max())
        if not length <= FAR:
            return None
        found = self.corrected(last.q + way, end)
        if found is None:
            return None
        aside = float(np.abs((found - last.q - way) / self.scales).max())
        most = max(ASIDE * length, LITTLE)
        return (found, aside < EASY * most and length < 0.5 * FAR) if aside <= most else None

    def between(self, nodes: list[Node], s: Floats) -> tuple[Floats, Floats, Floats]:
        """Return joint values at many s between the nodes, dq/ds, and the scaled error left, all polished together.

        Returns
        -------
        q, slope : ndarray, shape (N, n)
        error : ndarray, shape (N,)
        """
        poses, twists = self.tool_path.pose(s), self.tool_path.twist(s)
        q = self._guessed(nodes, s)
        for _ in range(POLISHES):
            tool = np.asarray(self.arm.fk(q), dtype=np.float64)
            error = scaled_error(self.arm, tool, poses)
            J = scaled_jacobian(self.arm, q, tool)
            if float(np.abs(error).max()) <= POLISHED:
                break
            q = q + least_squares(J, error) * self.scales
        rates = least_squares(J, scaled_rates(self.arm, twists, tool)) * self.scales
        return q, rates, np.abs(error).max(axis=1)

    def _guessed(self, nodes: list[Node], s: Floats) -> Floats:
        """Return values by cubic Hermite interpolation between nodes."""
        places = np.array([node.s for node in nodes])
        q, slopes = np.array([node.q for node in nodes]), np.array([node.slope for node in nodes])
        if len(nodes) == 1:
            return np.repeat(q, len(s), axis=0)
        ends = slopes[1:].copy()
        for halt in self.tool_path.corners:
            # The slope of a node at a corner is that after it; before it the path comes from elsewhere.
            k = int(np.searchsorted(places, halt))
            if 0 < k < len(places) and places[k] == halt:
                ends[k - 1] = self.slope(q[k], halt - SMALLEST)
        i = np.clip(np.searchsorted(places, s, side="right") - 1, 0, len(places) - 2)
        h = (places[i + 1] - places[i])[:, None]
        u = (s[:, None] - places[i][:, None]) / h
        left = q[i] * (1.0 + 2.0 * u) + h * u * slopes[i]
        right = q[i + 1] * (3.0 - 2.0 * u) - h * (1.0 - u) * ends[i]
        return np.asarray((1.0 - u) ** 2 * left + u**2 * right)
