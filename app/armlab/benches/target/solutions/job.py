"""The search for all solutions of the present target, while they are seen."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from armlab.benches.target.solutions.found import Found, families_of, listed
from armlab.benches.target.solutions.motion import Motion, motion_through
from armlab.benches.target.solutions.question import Question, question
from armlab.benches.target.solutions.state import Solutions
from armlab.kin.ik.solutions import IkSolutions
from armlab.kin.ik.verdict import judge
from armlab.session.job import Job, Wanted
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.state import State

PANELS = frozenset({"solutions", "by_hand"})
SWITCH = "ghosts"
"""Keys of the panels, and name of the switch; any of them shows the solutions."""


@dataclass(frozen=True, eq=False)
class Asked:
    """Request of the search.

    Attributes
    ----------
    question : Question
    q : ndarray, shape (n,)
        Where the arm is: a self-motion is traced from here.
    known : Found or None
        The list, where only the self-motion is still to be traced.
    """

    question: Question
    q: NDArray[np.float64]
    known: Found | None


@dataclass(frozen=True, eq=False)
class Listing:
    """Result of the search.

    Attributes
    ----------
    solutions : IkSolutions
    families : list of int
        See `families_of`.
    motion : Motion or None
        The self-motion through the arm.
    traced : ndarray or None
        Where the arm was, once the self-motion was looked for.
    """

    solutions: IkSolutions
    families: list[int]
    motion: Motion | None = None
    traced: NDArray[np.float64] | None = None


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return the present question while the solutions are seen."""
    if panels.isdisjoint(PANELS) and not state[Display].switches.get(SWITCH, False):
        return None
    found, asked, q = state[Solutions].found, state.derived(question), state[Joints].q
    if found is None or not found.question.is_same(asked):
        return Wanted(asked.key, Asked(asked, q, None))
    if _has_motion(found, q):
        return Wanted(found.question.key, Asked(found.question, q, found))
    return Wanted((found.question.key, q.tobytes()), Asked(found.question, q, found))


def _has_motion(found: Found, q: NDArray[np.float64]) -> bool:
    """Return whether the self-motion through the arm is known, if there is one."""
    if found.solutions.completeness != "infinite":
        return True
    arm = found.question.arm
    if found.motion is not None and found.motion.is_on(arm, q):
        return True
    return found.traced is not None and np.array_equal(found.traced, q)


def run(asked: Asked) -> Iterator[Listing]:
    """Yield the solutions, then with them the self-motion through the arm if there are infinitely many."""
    arm = asked.question.arm
    if asked.known is not None:
        solutions, families = asked.known.solutions, asked.known.families
        if _has_motion(asked.known, asked.q):
            return
    else:
        solutions = asked.question.solve()
        families = families_of(arm, solutions)
        yield Listing(solutions, families)
    if solutions.completeness == "infinite":
        yield Listing(solutions, families, _motion(asked), asked.q)


def _motion(asked: Asked) -> Motion | None:
    arm, held = asked.question.arm, asked.question.held
    if not judge(arm, asked.question.pose, asked.q, [i + 1 in held for i in range(arm.n)]).reached:
        return None
    return motion_through(asked.question, asked.q)


def delivered(state: State, asked: Asked, found: Listing) -> State:
    """Return the state with the results, if they belong to the present arm."""
    part = state[Solutions]
    if asked.question.arm is not state[Joints].arm:
        return state
    before = part.found
    now = before
    if before is None or before.solutions is not found.solutions:
        now = listed(asked.question, found.solutions, found.families, before)
    if now is not None and found.traced is not None:
        now = replace(now, motion=found.motion or now.motion, traced=found.traced)
    return state.replace(replace(part, found=now))


JOB = Job("solutions", "The search for all solutions", wanted, run, delivered, interval=0.1)
