"""What can be said against a list of solutions, by one who knows joint values of the pose and can search for others."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from armlab.kin.ik.solutions import IkSolutions
from judging.cases import Case
from judging.curves import CURVE, error_along, is_family, is_on
from judging.probe import Probe
from judging.search import ROUNDING, distances, distinct, is_same, path_error, polished, searched

REACHED = 1e-6
"""Metres and radians: what the lab calls reached."""

OF_REACH = 1e-5
"""Part of an arm's reach that a solution's error in metres may be at most, on tiny arms."""

SURELY = 0.5
"""Part of what counts as reached within which a pose is reachable beyond doubt."""

NEARLY = 1e-5
"""Error along a curve of solutions, as a part of what counts as reached, that is looked for no further."""

CLOSE = 1e-2
"""Radians or length scales: a missing solution nearer than this to a listed one is counted as close to it."""

BESIDE = (1e-5, 1e-4, 1e-3, 1e-2, 3e-2)
"""How far beside nearly singular solutions others are looked for, and how singular they are for that."""
NEARLY_SINGULAR = 0.05

KINDS = (
    "false none",
    "missing",
    "close one missing",
    "family missed",
    "false infinite",
    "q missing",
    "q not found",
    "twice",
    "not reached",
    "limits",
)
"""In the order of the table. "q missing" is said of lists that claim to be complete or to have all families, "q not
found" of those that say "at least", which is no error."""


class Charge(NamedTuple):
    """One thing that is wrong, with what proves it."""

    kind: str
    proof: str


def charges(case: Case, found: IkSolutions, starts: int, rng: np.random.Generator) -> list[Charge]:
    """Return what is wrong with a list of solutions.

    Parameters
    ----------
    case : Case
    found : IkSolutions
        The answer for the case's arm and pose.
    starts : int
        Of the search for solutions that a list which claims to be complete does not have.
    rng : Generator
    """
    return _Trial(case, found).charges(starts, rng)


class _Trial:
    def __init__(self, case: Case, found: IkSolutions) -> None:
        self.case, self.found, self.said = case, found, found.completeness
        self.probe = Probe(case.arm)
        self.G = self.probe.target(case.T)
        self.rows = np.asarray(found.q, dtype=float).reshape(-1, self.probe.n)
        self.exact = bool(self.probe.size(case.q[None], self.G)[0] <= ROUNDING)
        place, turn = (float(error[0]) for error in self.probe.errors(case.q[None], self.G))
        self.reachable = place <= SURELY * min(REACHED, OF_REACH * case.arm.reach) and turn <= SURELY * REACHED
        self.off = f"q is {place:.1e} m and {turn:.1e} rad from the pose"

    def charges(self, starts: int, rng: np.random.Generator) -> list[Charge]:
        against = [*self._not_reached(), *self._twice(), *self._limits()]
        if not len(self.rows) and self.said != "at least":
            return against + self._none(starts, rng)
        if self.said == "infinite":
            return against + self._infinite()
        if self.said == "complete":
            return against + self._complete(starts, rng)
        if self.exact and not self._lists(self.case.q):
            against.append(self._without_q("q not found"))
        return against

    def _none(self, starts: int, rng: np.random.Generator) -> list[Charge]:
        if self.reachable:
            return [Charge("false none", self.off)]
        other = searched(self.probe, self.G, starts, rng)
        return [Charge("false none", f"{other[0].tolist()} is a solution")] if len(other) else []

    def _complete(self, starts: int, rng: np.random.Generator) -> list[Charge]:
        """Return what such a list does not have: a family, the joint values the pose was made from, other solutions."""
        known = [self.case.q, *self.rows] if self.exact else list(self.rows)
        for row in known:
            if is_family(self.probe, row, self.G):
                return [Charge("family missed", f"through {row.tolist()}")]
        against = []
        if (self.exact and not self._lists(self.case.q)) or (not self.exact and self.reachable and not self._covers()):
            against.append(self._without_q("q missing"))
        guesses = [*known, *(beside for row in known for beside in self._beside(row))]
        if self.case.beside is not None:
            guesses.append(self.case.beside)
        truth = searched(self.probe, self.G, starts, rng, np.array(guesses))
        for k in self._unlisted(truth):
            if is_family(self.probe, truth[k], self.G):
                return [Charge("family missed", f"through {truth[k].tolist()}")]
            far = float(distances(self.probe, self.rows, truth[k]).min())
            kind = "close one missing" if far <= CLOSE else "missing"
            proof = f"{truth[k].tolist()}, singular value {self.probe.least(truth[k]):.0e}, {far:.0e} from a listed one"
            against.append(Charge(kind, f"{proof}; {len(self.rows)} listed, {len(truth)} found"))
        return against

    def _infinite(self) -> list[Charge]:
        """Return whether there is no family, nearly none either, or q is neither on one nor listed."""
        against = []
        error = self._best_curve()
        if error > 1.0:
            how = f"the least error along one is {error:.1f} of that" if np.isfinite(error) else "there is no curve"
            against.append(Charge("false infinite", how))
        if not self.exact or self._has_spare_joints() or self._lists(self.case.q):
            return against
        error = error_along(self.probe, self.case.q, self.G, size=self._of_reached)
        if error > 1.0:
            against.append(self._without_q("q missing", " and on no family"))
        elif (
            error_along(self.probe, self.case.q, self.G) <= CURVE
            and self._is_one_curve()
            and not is_on(self.probe, self.found.families, self.case.q)
        ):
            against.append(self._without_q("q missing", " and its family not traced"))
        return against

    def _has_spare_joints(self) -> bool:
        """Return whether every pose has families, of which nobody lists all: those outside the limits are left out.

        So have arms whose joints move the tool in fewer ways than there are joints, wherever they are.
        """
        rng = np.random.default_rng(0)
        return self.probe.n > self.probe.m or all(
            self.probe.least(rng.uniform(-1.0, 1.0, self.probe.n)) < ROUNDING for _ in range(4)
        )

    def _is_one_curve(self) -> bool:
        """Return whether families were traced and q is on one of a single dimension."""
        lost = int((self.probe.singular(self.case.q)[0] < ROUNDING).sum())
        return len(self.found.families) > 0 and lost == 1

    def _best_curve(self) -> float:
        """Return the least error along a traced curve or one through a solution, as part of what counts as reached."""
        for curve in map(np.asarray, self.found.families):
            if len(curve) > 2 and np.abs(self.probe.apart(curve, curve[0])).max() > CLOSE:
                worst = float(self._of_reached(curve).max())
                if worst <= NEARLY:
                    return worst
        best = np.inf
        for row in [*self.rows, *([self.case.q] if self.exact else [])]:
            best = min(best, error_along(self.probe, row, self.G, size=self._of_reached))
            if best <= NEARLY:
                break
        return best

    def _of_reached(self, q: np.ndarray) -> np.ndarray:
        """Return the larger of both errors of configurations (k, n), as parts of what counts as reached."""
        place, turn = self.probe.errors(q, self.G)
        return np.maximum(place / (min(REACHED, OF_REACH * self.case.arm.reach) or REACHED), turn / REACHED)

    def _not_reached(self) -> Iterator[Charge]:
        if len(self.rows):
            place, turn = self.probe.errors(self.rows, self.G)
            bad = (place > min(REACHED, OF_REACH * self.case.arm.reach)) | (turn > REACHED)
            for k in np.flatnonzero(bad):
                yield Charge("not reached", f"{place[k]:.1e} m and {turn[k]:.1e} rad off at {self.rows[k].tolist()}")

    def _twice(self) -> Iterator[Charge]:
        """Yield pairs that polish to one, with no error between them that theirs does not explain."""
        for k, row in enumerate(self.rows):
            gaps = distances(self.probe, self.rows[k + 1 :], row)
            # Representatives of a family may be as near to one another as they like, but not be one.
            for j in np.flatnonzero(gaps < (1e-7 if self.said == "infinite" else CLOSE)):
                pair = polished(self.probe, np.stack([row, self.rows[k + 1 + j]]), self.G)
                own = float(self.probe.size(pair, self.G).max())
                if path_error(self.probe, *pair, self.G, 3.0 * own + CURVE) <= 3.0 * own + CURVE:
                    yield Charge("twice", f"{gaps[j]:.0e} apart: {row.tolist()}")

    def _limits(self) -> Iterator[Charge]:
        """Yield what is wrong in what is said of the limits; a millionth on either side is left to the solver."""
        low, high = self.case.arm.limits.T
        for row, said in zip(self.rows, self.found.within_limits, strict=True):
            surely, perhaps = self._inside(row, -1e-6), self._inside(row, 1e-6)
            if (surely and not said) or (said and not perhaps):
                yield Charge("limits", f"{row.tolist()} is said to be {'in' if said else 'out'}side")
        inside = bool(((self.case.q >= low) & (self.case.q <= high)).all())
        none = len(self.rows) > 0 and not np.any(self.found.within_limits)
        if self.exact and inside and none:
            yield Charge("limits", f"q is inside, and said was {self.found.sentence!r}")

    def _inside(self, q: np.ndarray, room: float) -> bool:
        """Return whether whole turns bring joint values inside the limits, these widened by some room."""
        low, high = self.case.arm.limits.T
        turned = q + 2 * np.pi * np.ceil((low - room - q) / (2 * np.pi))
        values = np.where(self.case.arm.revolute, turned, q)
        return bool(((values >= low - room) & (values <= high + room)).all())

    def _beside(self, row: np.ndarray) -> Iterator[np.ndarray]:
        """Yield guesses on both sides of a nearly singular solution, where another may be."""
        s, V = self.probe.singular(row)
        if s[min(self.probe.n, self.probe.m) - 1] < NEARLY_SINGULAR:
            for far in BESIDE:
                yield row + far * V[-1] * self.probe.scales
                yield row - far * V[-1] * self.probe.scales

    def _resolved(self) -> np.ndarray:
        """Return the listed rows and where they are polished to, without those that this moves too far."""
        exact = polished(self.probe, self.rows, self.G)
        moved = np.abs(self.probe.apart(exact, self.rows)).max(axis=1, initial=0.0)
        return np.where((moved <= CLOSE)[:, None], exact, self.rows)

    def _lists(self, q: np.ndarray) -> bool:
        """Return whether a listed row is a solution, up to what its error or rounding explains."""
        return any(self._is(row, q) for rows in (self.rows, self._resolved()) for row in rows)

    def _is(self, row: np.ndarray, q: np.ndarray) -> bool:
        far = float(np.abs(self.probe.apart(row, q)).max())
        return far < 0.5 and is_same(self.probe, row, q, self.G)

    def _covers(self) -> bool:
        """Return whether q, which reaches the pose nearly, is joined to a listed row by others that do."""
        most = 2.0 * REACHED * max(1.0, 1.0 / self.probe.length)
        return any(path_error(self.probe, row, self.case.q, self.G, most) <= most for row in self.rows)

    def _unlisted(self, truth: np.ndarray) -> list[int]:
        """Return which true solutions are not listed: each listed one can stand for one of those told apart."""
        rows = distinct(self.probe, self._resolved(), self.G)
        options = [[k for k in np.argsort(distances(self.probe, rows, q)) if self._is(rows[k], q)] for q in truth]
        taken: dict[int, int] = {}

        def settle(i: int, seen: set[int]) -> bool:
            for k in options[i]:
                if k not in seen:
                    seen.add(k)
                    if k not in taken or settle(taken[k], seen):
                        taken[k] = i
                        return True
            return False

        return [i for i in range(len(truth)) if not settle(i, set())]

    def _without_q(self, kind: str, more: str = "") -> Charge:
        far = distances(self.probe, self.rows, self.case.q)
        where = f"{far.min():.0e} from the nearest listed one" if len(far) else "not listed"
        return Charge(kind, f"q is {where}{more}; singular value there {self.probe.least(self.case.q):.0e}")
