"""The step that is drawn, the branches that were chosen, and the derivation that they lead to."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from armlab.errors import InputError
from armlab.kin.ik.branches import branch_names
from armlab.kin.ik.by_hand import Derivation, Step, every_derivation, method_of
from armlab.session.fields import FieldPart, flag, own, whole
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import jumped_to, target_pose
from armlab.session.state import Command, PartType, State
from armlab.session.way_to_solution import HERE, gap, nearest_copy

MOST_STEPS = 40

Choices = tuple[tuple[str, int], ...]


def _read(data: Any) -> Choices:
    """Return choices as pairs of the key of a step and its branch."""
    pairs = [(key, branch) for key, branch in data]
    if len(pairs) > MOST_STEPS or not all(isinstance(key, str) and branch in (0, 1) for key, branch in pairs):
        raise ValueError
    return tuple((key[:20], int(branch)) for key, branch in pairs)


@dataclass(frozen=True)
class ByHand(FieldPart):
    """The choices on the page.

    Attributes
    ----------
    shown : int
        The step, from 1, that is unfolded and drawn.
    unfolded : bool
        Whether all steps are unfolded.
    choices : tuple of (str, int)
        Branches by the key of their step; at other steps the one nearest to the arm is taken.
    """

    key: ClassVar[str] = "by_hand"
    kept_by_undo: ClassVar[bool] = True
    looks: ClassVar[tuple[str, ...]] = ("shown", "unfolded")

    shown: int = whole("step that is drawn", 1, 1, MOST_STEPS, kept="")
    unfolded: bool = flag("whether all steps are unfolded", False)
    choices: Choices = own("branches", (), _read, kept="")


PART = PartType(ByHand, order=31)


@dataclass(frozen=True, eq=False)
class Sheet:
    """The derivation at the present target.

    Attributes
    ----------
    derivation : Derivation
        With the branches chosen by hand, and at other steps with those nearest to the arm.
    others : tuple of Derivation
        With all branches.
    name : str
        Of the solution it ends in; empty without one.
    """

    derivation: Derivation
    others: tuple[Derivation, ...]
    name: str

    @property
    def count(self) -> int:
        """The number of sets of joint values that the branches lead to."""
        return sum(one.q is not None for one in self.others)

    def leads_on(self, step: Step, branch: int) -> bool:
        """Return whether some solution takes a branch of a step, the branches before it as they are."""
        wanted: dict[str, int] = {}
        for key, taken in self.derivation.choices.items():
            wanted[key] = branch if key == step.key else taken
            if key == step.key:
                break
        return any(one.q is not None and _agrees(one, wanted) for one in self.others)


def _agrees(one: Derivation, wanted: Mapping[str, int]) -> bool:
    return all(one.choices.get(key, branch) == branch for key, branch in wanted.items())


def sheet(state: State) -> Sheet | None:
    """Return the derivation at the present target; None for an arm that is not solved by hand."""
    joints = state[Joints]
    arm, q = joints.arm, joints.q
    if method_of(arm) is None:
        return None
    others = tuple(every_derivation(arm, target_pose(state), q))
    allowed = [one for one in others if _agrees(one, dict(state[ByHand].choices))] or list(others)
    whole = [one for one in allowed if one.q is not None]
    best = min(whole, key=lambda one: _far(state, one)) if whole else max(allowed, key=lambda one: len(one.steps))
    name = "" if best.q is None else branch_names(arm, best.q[None])[0]
    return Sheet(best, others, "" if name.startswith("solution ") else name)


def _far(state: State, one: Derivation) -> float:
    joints = state[Joints]
    assert one.q is not None
    return float(np.linalg.norm(gap(joints.arm, one.q, joints.q)))


def is_there(state: State, found: Sheet) -> bool:
    """Return whether the arm is where the derivation ends."""
    q = found.derivation.q
    joints = state[Joints]
    return q is not None and float(np.abs(gap(joints.arm, q, joints.q)).max()) < HERE


@dataclass(frozen=True)
class ChooseBranch(Command):
    """Choose a branch of a step of the derivation by hand; the steps after it choose anew.

    Parameters
    ----------
    step : str
        The key of the step, such as ``"q3"``.
    branch : int
        0 for the first, 1 for the second.
    """

    step: str
    branch: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the branch chosen.

        Raises
        ------
        InputError
            The derivation has no such step now, or the step no such branch.
        """
        found = state.derived(sheet)
        steps = () if found is None else found.derivation.steps
        open_steps = {step.key: step for step in steps if len(step.branches) > 1}
        step = open_steps.get(self.step)
        if found is None or step is None:
            known = ", ".join(open_steps) or "none"
            raise InputError(f"step: expected one with two branches now ({known}), got {self.step[:20]!r}")
        if self.branch not in (0, 1):
            raise InputError(f"branch: expected 0 or 1, got {self.branch}")
        kept = _before(found.derivation.choices, self.step)
        choices = (*kept, (self.step, self.branch))
        shown = 1 + steps.index(step)
        return state.replace(replace(state[ByHand], choices=choices, shown=shown))


def _before(choices: Mapping[str, int], step: str) -> Iterable[tuple[str, int]]:
    """Yield the choices at the steps before one."""
    for key, branch in choices.items():
        if key == step:
            return
        yield key, branch


@dataclass(frozen=True)
class FollowArm(Command):
    """Forget the branches chosen by hand: those nearest to the arm are taken again."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state without choices."""
        part = state[ByHand]
        return state if not part.choices else state.replace(replace(part, choices=()))


@dataclass(frozen=True)
class GoByHand(Command):
    """Move the arm to the joint values that the derivation ends in; the target stays where it is."""

    label: ClassVar[str] = "go to the solution by hand"

    def apply(self, state: State) -> State:
        """Return the state with the arm there.

        Raises
        ------
        InputError
            The derivation has no end, or it is out of limits, or a held joint would have to move.
        """
        found, joints = state.derived(sheet), state[Joints]
        q = None if found is None else found.derivation.q
        if q is None:
            raise InputError("The derivation gives no joint values at this target.")
        there = nearest_copy(joints.arm, q, joints.q)
        if there is None:
            raise InputError("These joint values are outside the joint limits.")
        apart = np.abs(gap(joints.arm, there, joints.q))
        held = [i + 1 for i, locked in enumerate(joints.locked) if locked and apart[i] > HERE]
        if held:
            raise InputError(f"The arm cannot go there: joint {held[0]} is held.")
        return jumped_to(state, there)
