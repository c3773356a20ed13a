"""The self-motion of the arm for a slider and a film: the tool keeps the components of the task."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.benches.target.api import Motion, Question, motion_through
from armlab.benches.velocity.solve.state import Solve, arm_asked
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State

Array = NDArray[np.float64]

Key = tuple[Arm, bytes, tuple[bool, ...]]
"""Arguments of a self-motion: the arm, the configuration where it began, and the joints that are held."""


def key_of(state: State) -> Key:
    """Return the arguments of the self-motion of the arm: the one that was begun, or the one from here."""
    part, joints = state[Solve], state[Joints]
    arm = arm_asked(state)
    if part.start is not None:
        begun = arm, np.array(part.start).tobytes(), joints.locked
        way = way_of(begun)
        if way is not None and way[1].is_on(arm, joints.q):
            return begun
    return arm, joints.q.tobytes(), joints.locked


@lru_cache(maxsize=64)
def way_of(key: Key) -> tuple[Question, Motion] | None:
    """Return the self-motion through a configuration, or None if no joint can move."""
    arm, values, locked = key
    q = np.frombuffer(values)
    held = {i + 1: float(q[i]) for i, on in enumerate(locked) if on}
    question = Question(arm, np.asarray(arm.fk(q)), held)
    motion = motion_through(question, q)
    return None if motion is None else (question, motion)


def begun(state: State) -> tuple[Question, Motion] | None:
    """Return the self-motion that has begun, if the arm is still on it; this is quick while there is none."""
    part = state[Solve]
    if part.start is None:
        return None
    found = way_of((arm_asked(state), np.array(part.start).tobytes(), state[Joints].locked))
    return found if found is not None and found[1].is_on(found[0].arm, state[Joints].q) else None


def looked_for(state: State) -> bool:
    """Return whether the self-motion from the present configuration has been looked for."""
    return state[Solve].start == tuple(state[Joints].q.tolist())


def part_of(state: State) -> float | None:
    """Return the place of the arm along its self-motion, 0 to 1, or None if none has begun."""
    found = begun(state)
    return None if found is None else found[1].part(found[0].arm, state[Joints].q)


@dataclass(frozen=True)
class SlideAlong(Command):
    """Move the arm along its self-motion; sent by a slider in motion.

    Parameters
    ----------
    part : float
        0 to 1, from one end to the other, or once around.
    """

    part: float
    snapshot: ClassVar[bool] = True
    rests: ClassVar[bool] = True
    label: ClassVar[str] = "self-motion"

    def apply(self, state: State) -> State:
        """Return the state with the arm at that part of the self-motion."""
        if not math.isfinite(self.part):
            raise InputError(f"self-motion: expected a number from 0 to 1, got {self.part}")
        return at_part(state, min(max(self.part, 0.0), 1.0))


def at_part(state: State, part: float) -> State:
    """Return the state with the arm at a part of its self-motion.

    Raises
    ------
    InputError
        Nothing can move while the tool stays.
    """
    key = key_of(state)
    way = way_of(key)
    if way is None:
        raise InputError(
            "self-motion: no motion of the joints leaves the tool where it is; ask for the position alone, free held "
            "joints, or take an arm with more joints than task components"
        )
    question, motion = way
    q = motion.at(question, part)
    if q is None:
        raise InputError("self-motion: it cannot be followed here")
    joints = state[Joints].moved_to(q)
    start = tuple(np.frombuffer(key[1]).tolist())
    solve = state[Solve]
    if solve.start != start:
        state = state.replace(replace(solve, start=start))
    return state if joints is state[Joints] else state.replace(joints)


@dataclass(frozen=True)
class BeginAlong(Command):
    """Find the place of the arm on its self-motion for the slider, or that there is no self-motion here."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the self-motion searched from here, unless the arm is already on one."""
        if begun(state) is not None or looked_for(state):
            return state
        return state.replace(replace(state[Solve], start=tuple(state[Joints].q.tolist())))
