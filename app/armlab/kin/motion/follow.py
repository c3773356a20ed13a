"""Inverse kinematics along a tool path: joint samples on one branch, and the places and reasons where it ends."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats, finite_floats, whole_number
from armlab.kin.ik.branches import branch_names
from armlab.kin.ik.solve import IkResult, solve
from armlab.kin.motion.branch import SMALLEST, Branch, Node
from armlab.kin.motion.followed import Followed, Kind, Stop
from armlab.kin.motion.task_rows import scaled_jacobian
from armlab.kin.motion.tool_path import ToolPath

Floats = NDArray[np.float64]

SEARCHES = 30
"""Random starts when another branch is sought; 99.9 % of reachable poses need fewer."""

AHEAD = 1e-3
"""Distance in s behind the end of a branch at which another one is sought."""

HALVINGS = 50
"""Number of halvings of the step in which a limit is passed."""

LEFT = 1e-9
"""Scaled error up to which a sample counts as on the path."""

BEYOND = 1e-8
"""Excess of a sample over a joint limit, rad or m, that may be rounding beside a singularity."""

BESIDE = 0.01
"""Ratio of smallest to largest singular value below which a configuration is beside a singularity."""

ALIKE = 0.1
"""Largest difference, in rad or length scales, of two configurations that are alike up to whole turns."""

MOST_STOPS = 50
"""Largest number of parts when the path is carried on after stops."""

RESTARTS = 50
"""Number of places at which the path is tried again after a stop."""


def follow(
    arm: Arm,
    tool_path: ToolPath,
    q0: ArrayLike | None = None,
    s: Any = 1000,
    *,
    seed: int = 0,
    carry_on: bool = False,
) -> Followed:
    """Solve the inverse kinematics along a path, staying on the branch of the start.

    Parameters
    ----------
    arm : Arm
        Only what its task controls is followed.
    tool_path : ToolPath
    q0 : array_like, shape (n,), optional
        The branch: the solution at s = 0 nearest to it is the start. Found by a search when left out.
    s : int or array_like, shape (N,)
        Number of even samples, those nearest to corners moved there; or increasing places from 0 to 1.
    seed : int
        Seed of the searches; the same call gives the same answer.
    carry_on : bool
        Whether to go on with another branch after a stop, for a picture of what is feasible; the parts are then not one
        motion.

    Raises
    ------
    InputError
        Wrong joint values or samples. A path that cannot be followed is a result.

    Notes
    -----
    A predictor along J# times the twist and Newton's method as corrector, with steps halved until the correction is
    small against the step: on a branch a shorter step makes it so, across branches none does. The samples between are
    polished all together from cubic Hermite guesses.

    References
    ----------
    Notes, the planning steps before section 6.1; Allgower and Georg, *Introduction to Numerical Continuation Methods*,
    2003, chapter 2.
    """
    places = _places(s, tool_path.corners)
    start = None if q0 is None else finite_floats(q0, "q0", (arm.n,), f"{arm.n} finite numbers")
    seed = whole_number(seed, "seed", 0)
    run = _Run(arm, tool_path, places, seed)
    run.go(start, carry_on)
    return run.result()


def _places(s: Any, corners: Floats) -> Floats:
    if isinstance(s, (int, np.integer)) and not isinstance(s, bool):
        count = whole_number(s, "s", 2)
        even = np.linspace(0.0, 1.0, count)
        inner = np.setdiff1d(np.arange(1, count - 1), np.rint(corners * (count - 1)))
        return np.concatenate([[0.0], np.union1d(even[inner], corners), [1.0]])
    places = as_floats(s, "s", "increasing numbers from 0 to 1")
    if (
        places.ndim != 1
        or len(places) < 2
        or not (places[0] == 0.0 and places[-1] == 1.0 and (np.diff(places) > 0).all())
    ):
        raise InputError("s: expected increasing numbers, the first 0 and the last 1")
    return places


class _Run:
    """State of `follow` while it runs."""

    def __init__(self, arm: Arm, tool_path: ToolPath, s: Floats, seed: int) -> None:
        self.arm, self.tool_path, self.s, self.seed = arm, tool_path, s, seed
        self.branch = Branch(arm, tool_path)
        self.q, self.slope = (np.full((len(s), arm.n), np.nan) for _ in range(2))
        self.stops: list[Stop] = []
        self.parts: list[tuple[int, int]] = []

    def go(self, start: Floats | None, carry_on: bool) -> None:
        """Follow the path, once or until its end."""
        found = self._solve(0.0, start)
        if not found.success:
            self.stops.append(self._unreachable(0.0, found))
        at, q = 0.0, found.q if found.success else None
        while True:
            if q is not None:
                nodes, stop = self._filled(*self._limited(self.branch.from_here(q, at)))
                if stop is None and nodes[-1].s < 1.0:
                    stop = self._ended(nodes[-1])
                if stop is None:
                    return
                self.stops.append(stop)
            if not carry_on or len(self.stops) >= MOST_STOPS:
                return
            at, q = self._restart(self.stops[-1])
            if q is None:
                return

    def _solve(self, s: float, near: Floats | None, searches: int = SEARCHES, complete: bool = True) -> IkResult:
        return solve(self.arm, self.tool_path.pose(s), near, seed=self.seed, searches=searches, complete=complete)

    def _filled(self, nodes: list[Node], stop: Stop | None) -> tuple[list[Node], Stop | None]:
        """Solve for all samples between the first and the last node, or up to one at which a joint passes its limit.

        Returns
        -------
        nodes, stop
            As given, or up to that place.
        """
        first, q, slope = self._between(nodes)
        k = self._first_outside(first, q, nodes[0].s)
        if k is not None:
            nodes, stop = self._limited(_up_to(nodes, self.s[first : first + k + 1], q[: k + 1], slope[: k + 1]))
            first, q, slope = self._between(nodes)
        last = first + len(q)
        if last > first:
            self.q[first:last], self.slope[first:last] = q, np.where(np.isnan(q), np.nan, slope)
            self.parts.append((first, last))
        return nodes, stop

    def _between(self, nodes: list[Node]) -> tuple[int, Floats, Floats]:
        """Return the first sample between the first and the last node, and joint values and slopes there, (k, n)."""
        first = int(np.searchsorted(self.s, nodes[0].s - SMALLEST))
        last = int(np.searchsorted(self.s, nodes[-1].s + 1e-12, side="right"))
        if last <= first:
            return first, np.zeros((0, self.arm.n)), np.zeros((0, self.arm.n))
        q, slope, error = self.branch.between(nodes, self.s[first:last])
        for k in np.flatnonzero(~(error <= LEFT)):
            again = self.branch.corrected(q[k], float(self.s[first + k]))
            q[k] = np.nan if again is None else again
        return first, q, slope

    def _first_outside(self, first: int, q: Floats, start: float) -> int | None:
        """Return the index in q of the first sample behind the start at which a joint is outside its limits, or None.

        Between two nodes inside the limits the way may turn outside of them. The start itself counts as inside: it was
        found within the tolerance of a solution, and a sample there is on the path more exactly, beyond a limit or not.

        Parameters
        ----------
        first : int
            Index of the first sample in q.
        q : ndarray, shape (k, n)
        start : float
            Place s of the first node.
        """
        low, high = self.arm.limits.T
        behind = self.s[first : first + len(q)] > start
        outside = np.flatnonzero(behind & ((q < low - BEYOND) | (q > high + BEYOND)).any(axis=1))
        return int(outside[0]) if len(outside) else None

    def _limited(self, nodes: list[Node]) -> tuple[list[Node], Stop | None]:
        """Return the nodes up to the place where a joint passes its limit, and the stop there, if any."""
        if self.arm.within_limits(nodes[-1].q):
            return nodes, None
        before, after = nodes[-2], nodes[-1]
        low, high = before, after
        for _ in range(HALVINGS):
            s = 0.5 * (low.s + high.s)
            share = (s - low.s) / (high.s - low.s)
            q = self.branch.corrected(low.q + share * (high.q - low.q), s)
            if q is None or s in (low.s, high.s):
                break
            low, high = (Node(s, q, low.slope), high) if self.arm.within_limits(q) else (low, Node(s, q, low.slope))
        over = np.maximum(self.arm.limits[:, 0] - high.q, high.q - self.arm.limits[:, 1])
        joint = int(np.argmax(over)) + 1
        kept = nodes[:-1] if low is before else [*nodes[:-1], Node(low.s, low.q, self.branch.slope(low.q, low.s))]
        J = scaled_jacobian(self.arm, low.q[None], np.asarray(self.arm.fk(low.q), dtype=np.float64)[None])
        fast = ", beside a singularity, where joints turn fast" if _conditioning(J)[0] < BESIDE else ""
        at = f"Joint {joint} is at its limit at s = {low.s:.4f}{fast}"
        other = self._other(low)
        return kept, self._stop("limit", low, joint, other, at)

    def _ended(self, node: Node) -> Stop:
        """Return why a branch ends at a node."""
        ahead = min(node.s + AHEAD, 1.0)
        near = self._solve(ahead, node.q, 1, False)
        found = near if near.success else self._solve(ahead, node.q)
        if not found.success:
            return self._unreachable(node.s, found, node)
        kind: Kind = "singularity" if near.success else "branch"
        at = f"The arm becomes singular at s = {node.s:.4f}, and this branch ends there"
        return self._stop(kind, node, 0, found.q, at)

    def _other(self, node: Node) -> Floats | None:
        """Return a configuration inside the limits just behind a limit, or None."""
        found = self._solve(min(node.s + AHEAD, 1.0), node.q)
        return found.q if found.success else None

    def _turned_back(self, node: Node, other: Floats) -> str:
        """Return a sentence on joints whole turns apart in two configurations that otherwise agree, or ""."""
        turn = 2.0 * np.pi
        change = other - node.q
        turns = np.where(self.arm.revolute, np.round(change / turn), 0.0)
        if not turns.any() or np.abs((change - turn * turns) / self.branch.scales).max() > ALIKE:
            return ""
        return " and ".join(str(i + 1) for i in np.flatnonzero(turns))

    def _stop(self, kind: Kind, node: Node, joint: int, other: Floats | None, at: str) -> Stop:
        point = self.arm.position(node.q)
        if other is None:
            rest = "no other branch was found that goes on."
        else:
            names = branch_names(self.arm, np.stack([node.q, other]))
            words = "" if names[0].startswith("solution") else f" ({names[1]})"
            turn = "a turn on the spot or a change of branch" if kind == "singularity" else "a change of branch"
            back = self._turned_back(node, other)
            need = f"a whole turn back of joint {back}" if back else f"{turn}{words}"
            rest = f"going on needs {need}."
        return Stop(kind, node.s, np.asarray(point, dtype=np.float64), node.q, joint, other, f"{at}; {rest}")

    def _unreachable(self, s: float, found: IkResult, node: Node | None = None) -> Stop:
        """Return the stop at a place where the path is out of reach."""
        joints = found.verdict.limits
        q = found.q if node is None else node.q
        why = f" ({found.reason})" if found.verdict.status in ("limit", "beyond") else ""
        sentence = f"Beyond s = {s:.4f} the path is out of reach{why}: no configuration inside the limits was found."
        if node is None:
            sentence = f"The path cannot be begun at s = {s:.4f}: it is out of reach{why}."
        point = np.asarray(self.tool_path.pose(s)[:3, 3], dtype=np.float64)
        return Stop("reach", s, point, q, joints[0] + 1 if joints and node is None else 0, None, sentence)

    def _restart(self, stop: Stop) -> tuple[float, Floats | None]:
        """Return the next place behind a stop that the arm can reach, and its configuration there."""
        behind = stop.s + AHEAD
        candidates = [behind, *np.linspace(0.0, 1.0, RESTARTS + 1)]
        for s in candidates:
            if behind <= s < 1.0:
                found = self._solve(float(s), stop.q, SEARCHES if s == behind else 3, complete=False)
                if found.success:
                    return float(s), found.q
        return 1.0, None

    def result(self) -> Followed:
        """Return the result."""
        reached = np.isfinite(self.q).all(axis=1)
        ratio = np.full(len(self.s), np.nan)
        if reached.any():
            q = self.q[reached]
            J = scaled_jacobian(self.arm, q, np.asarray(self.arm.fk(q), dtype=np.float64))
            ratio[reached] = _conditioning(J)
        corners = np.flatnonzero(np.isin(self.s, self.tool_path.corners)).tolist()
        arriving = np.array([self._arriving(k) for k in corners]).reshape(-1, self.arm.n)
        followed = reached, tuple(self.stops), tuple(self.parts), ratio, tuple(corners), arriving
        return Followed(self.arm, self.s, self.q, self.slope, *followed)

    def _arriving(self, k: int) -> Floats:
        """Return dq/ds just before a sample, (n,); nan where the path is not followed."""
        if not np.isfinite(self.q[k]).all():
            return np.full(self.arm.n, np.nan)
        return self.branch.slope(self.q[k], float(np.nextafter(self.s[k], 0.0)))


def _up_to(nodes: list[Node], s: Floats, q: Floats, slope: Floats) -> list[Node]:
    """Return the nodes before the last of the samples at s (k,), and as nodes the sample before it, and itself."""
    found = [node for node in nodes if node.s < s[-1]] or nodes[:1]
    if len(s) > 1 and s[-2] > found[-1].s and np.isfinite(q[-2]).all():
        found.append(Node(float(s[-2]), q[-2], slope[-2]))
    return [*found, Node(float(s[-1]), q[-1], slope[-1])]


def _conditioning(J: Floats) -> Floats:
    """Return the ratio of smallest to largest singular value, (N,) from (N, m, n)."""
    sigma = np.linalg.svd(J, compute_uv=False)
    return np.asarray(sigma[:, -1] / np.where(sigma[:, 0] > 0.0, sigma[:, 0], 1.0))
