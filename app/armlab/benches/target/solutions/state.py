"""All solutions for the present target: the results, the chosen one, and commands to go to them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.benches.target.solutions.found import Found, Row
from armlab.benches.target.solutions.motion import Motion
from armlab.benches.target.solutions.proof import Proof
from armlab.benches.target.solutions.question import question
from armlab.errors import InputError
from armlab.kin import ik
from armlab.registry import known_name
from armlab.session.examples import on_arm
from armlab.session.fields import FieldPart
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target, jumped_to, target_pose
from armlab.session.state import Command, PartType, State
from armlab.session.way_to_solution import HERE, gap

PRESETS: dict[str, tuple[str, str, str]] = {
    "2R": ("planar_2r", "home", "2 solutions: elbow up and down"),
    "2R, centre": ("planar_2r", "folded", "infinitely many: the tool is on axis 1, and the links have equal lengths"),
    "polar": ("polar_rrp", "home", "4 solutions, most of them with a slide of negative length"),
    "elbow": ("elbow_3r", "home", "4 solutions: front and back, elbow up and down"),
    "UR10": ("ur10_notes", "eight", "8 solutions⟦, figure 4.8⟧"),
    "Manseur–Doty": ("manseur_doty", "sixteen", "16 solutions, as many as six joints can have"),
    "PUMA, q₅ = 0": ("puma560", "zero", "infinitely many: axes 4 and 6 coincide"),
}
"""Robot, pose and a sentence for each example of section 4.3 of the notes, by name."""


@dataclass(frozen=True, eq=False)
class Solutions(FieldPart):
    """Results on all solutions, which are not saved but found again.

    Attributes
    ----------
    found : Found or None
        The newest list; it may belong to a target that has moved on since.
    chosen : int
        Slot of the solution whose ghost is drawn as a body; -1 for none.
    proof : Proof or None
        The proof that was asked for, as far as it has come.
    """

    key: ClassVar[str] = "solutions"
    kept_by_undo: ClassVar[bool] = True

    found: Found | None = None
    chosen: int = -1
    proof: Proof | None = None


PART = PartType(Solutions, order=30)


def fresh(state: State) -> Found | None:
    """Return the list if it belongs to the present target, or None."""
    found = state[Solutions].found
    return found if found is not None and found.question.is_same(state.derived(question)) else None


def present_row(state: State) -> Row | None:
    """Return the row of the list at which the arm is."""
    found = state[Solutions].found
    return None if found is None else found.present(state[Joints].q, state.derived(fresh) is not None)


def motion_of(state: State) -> Motion | None:
    """Return the self-motion on which the arm is, if it has been traced."""
    found = state.derived(fresh)
    if found is None or found.motion is None:
        return None
    return found.motion if found.motion.is_on(found.question.arm, state[Joints].q) else None


def whole_turns(state: State) -> NDArray[np.float64]:
    """Return the present solution with all whole turns inside the limits, shape (k, n); none if the arm is at none."""
    row, found = state.derived(present_row), state.derived(fresh)
    if row is None or found is None:
        return np.empty((0, state[Joints].arm.n))
    return found.solutions.equivalents(row.index)


def shown_proof(state: State) -> Proof | None:
    """Return the proof for the present target, if one was requested."""
    proof = state[Solutions].proof
    return proof if proof is not None and proof.question.is_same(state.derived(question)) else None


@dataclass(frozen=True)
class GoToSolution(Command):
    """Move the arm to a solution of the list; the target stays where it is.

    Parameters
    ----------
    slot : int
    """

    slot: int
    label: ClassVar[str] = "jump to a solution"

    def apply(self, state: State) -> State:
        """Return the state at the solution; one of an old list is solved again, starting there.

        Raises
        ------
        InputError
            It is not there, out of limits, or a held joint would have to move.
        """
        found = state[Solutions].found
        row = None if found is None else found.row(self.slot)
        if found is None or row is None or found.question.arm is not state[Joints].arm:
            raise InputError("This solution no longer exists: the target has moved.")
        if state.derived(fresh) is not None and row is state.derived(present_row):
            return state
        q = _inside(found, row)
        if state.derived(fresh) is None:
            q = _solved_again(state, row)
        return jumped_to(state, q)


@dataclass(frozen=True)
class TurnTo(Command):
    """Go to the same solution with other whole turns.

    Parameters
    ----------
    k : int
        Row of `whole_turns`.
    """

    k: int
    label: ClassVar[str] = "whole turns"

    def apply(self, state: State) -> State:
        """Return the state with these turns."""
        turns = state.derived(whole_turns)
        if not 0 <= self.k < len(turns):
            raise InputError("These whole turns no longer exist: the target has moved.")
        _check_held(state, turns[self.k], "with these turns")
        return jumped_to(state, turns[self.k])


@dataclass(frozen=True)
class LookAtSolution(Command):
    """Draw the ghost of a solution as a body, or stop drawing it."""

    slot: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        part = state[Solutions]
        return state.replace(replace(part, chosen=-1 if self.slot == part.chosen else self.slot))


@dataclass(frozen=True)
class MoveAlong(Command):
    """Move the arm along its self-motion; sent by a slider in motion.

    Parameters
    ----------
    part : float
        0 to 1.
    """

    part: float
    snapshot: ClassVar[bool] = True
    rests: ClassVar[bool] = True
    label: ClassVar[str] = "self-motion"

    def apply(self, state: State) -> State:
        """Return the state with the arm at this part of the curve, and the tool unmoved."""
        if not math.isfinite(self.part):
            raise InputError(f"self-motion: expected a number from 0 to 1, got {self.part}")
        found, motion = state.derived(fresh), state.derived(motion_of)
        if found is None or motion is None:
            return state
        q = motion.at(found.question, min(max(self.part, 0.0), 1.0))
        if q is None:
            raise InputError("The self-motion cannot be followed here.")
        moved = jumped_to(state, q, jumps=0)
        return state if moved[Joints] is state[Joints] else moved


@dataclass(frozen=True)
class Prove(Command):
    """Begin the search from thousands of random starts, or stop it."""

    on: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the search begun or stopped."""
        part, found = state[Solutions], state.derived(fresh)
        if not self.on:
            return state if part.proof is None else state.replace(replace(part, proof=None))
        if found is None:
            raise InputError("The list is still being computed: try again in a moment.")
        if len(found.question.held) == found.question.arm.n:
            raise InputError("All joints are held: there is nothing to search for.")
        return state.replace(replace(part, proof=Proof(found.question, found.solutions)))


@dataclass(frozen=True)
class TakePreset(Command):
    """Load an example."""

    name: str
    label: ClassVar[str] = "example"

    def apply(self, state: State) -> State:
        """Return the state with the arm of the example in its pose."""
        key, pose, _ = PRESETS[known_name("example", self.name, PRESETS)]
        state = on_arm(state, key)
        return state.replace(state[Joints].freed_at(state[RobotPart].robot.poses[pose]), state[Target].on_tool())


def _inside(found: Found, row: Row) -> NDArray[np.float64]:
    """Return the joint values of a row; `InputError` if it is not inside the limits."""
    if not row.within:
        raise InputError(f"{_named(row)} is out of limits: {found.solutions.how_far_out[row.index]} its limit.")
    return row.q


def _named(row: Row) -> str:
    return row.name.capitalize()


def _solved_again(state: State, row: Row) -> NDArray[np.float64]:
    """Return the solution for the present target that is found from an old one."""
    joints = state[Joints]
    start = np.where(joints.locked, joints.q, joints.arm.clip(row.q))
    result = ik.solve(joints.arm, target_pose(state), start, locked=joints.locked, searches=1, complete=False)
    if result.success and float(np.abs(gap(joints.arm, result.q, start)).max()) < 1.0:
        return np.asarray(result.q, dtype=np.float64)
    _check_held(state, row.q, "there")
    raise InputError(f"{_named(row)} belongs to an outdated list: wait for the new one.")


def _check_held(state: State, q: NDArray[np.float64], where: str) -> None:
    joints = state[Joints]
    apart = np.abs(gap(joints.arm, q, joints.q)) > HERE
    held = [i + 1 for i, locked in enumerate(joints.locked) if locked and (apart[i] or abs(q[i] - joints.q[i]) > HERE)]
    if held:
        raise InputError(f"The arm cannot go {where}: joint {held[0]} is held.")
