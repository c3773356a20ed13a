"""Jogging: the joints, or the tool along and about an axis, by steps of a chosen size, as with a teach pendant."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar, Literal, Self

import numpy as np

from armlab.errors import InputError
from armlab.kin.checks import finite_floats
from armlab.kin.ik.jog import directions, jogged
from armlab.session.fields import FieldPart, choice
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, PartType, State

MODES = {"": "off", "joints": "Joints", "base": "Base", "tool": "Tool"}
"""Choices of what is jogged: nothing, the joints, or the tool along and about the axes of frame 0 or its own."""

TURNS = {"0.1": math.radians(0.1), "1": math.radians(1.0), "5": math.radians(5.0)}
LENGTHS = {"1": 1e-3, "10": 1e-2, "50": 5e-2}
"""Steps of an angle and of a length, rad and m, by their degrees and millimetres."""

ROUNDING = 1e-9
"""Part of a step, rad or m, by which a limit may be passed in rounding."""

Why = Literal["limit", "held", "singular", "reach"]


@dataclass(frozen=True)
class Ended:
    """The end of a jog.

    Attributes
    ----------
    jog : int
        Its number.
    why : str
        ``"limit"`` of joints, joints that are ``"held"``, ``"singular"``: joints would have to move too far, or out of
        ``"reach"``.
    joints : tuple of int
        Which joints, from 0.
    """

    jog: int
    why: Why
    joints: tuple[int, ...] = ()


@dataclass(frozen=True, eq=False)
class Jog(FieldPart):
    """The choice of what is jogged and by which steps, and why the last jog ended.

    Attributes
    ----------
    mode : str
        One of `MODES`.
    turn, length : str
        Keys of `TURNS` and `LENGTHS`.
    ended : Ended or None
        None while the last jog could go on, and when the arm has been moved by something else since.
    """

    key: ClassVar[str] = "jog"
    kept_by_undo: ClassVar[bool] = True
    saved: ClassVar[bool] = False

    mode: str = choice("what is jogged", "", MODES)
    turn: str = choice("step of angles, degrees", "1", tuple(TURNS))
    length: str = choice("step of lengths, mm", "10", tuple(LENGTHS))
    ended: Ended | None = None

    def after(self, before: State, now: State) -> Self:
        """Return the part without the end of the last jog once something else has moved the arm."""
        by_others = self is before[Jog] and now[Joints].q is not before[Joints].q
        return replace(self, ended=None) if by_others and self.ended is not None else self


PART = PartType(Jog, order=25)


def jog_steps(state: State) -> tuple[float, ...]:
    """Return the size of a whole step of each coordinate that is jogged, rad or m."""
    part = state[Jog]
    turn, length = TURNS[part.turn], LENGTHS[part.length]
    if part.mode == "joints":
        return tuple(turn if revolute else length for revolute in state[Joints].arm.revolute)
    return (length,) * 3 + (turn,) * 3


def jog_offers(state: State) -> tuple[bool, ...]:
    """Return which coordinates can be jogged: joints that are not held, or what the task of the arm controls."""
    joints, mode = state[Joints], state[Jog].mode
    if mode == "joints":
        return tuple(not held for held in joints.locked)
    return directions(joints.arm, joints.tool_pose, mode == "tool")


@dataclass(frozen=True)
class JogBy(Command):
    """Jog by one step: the joints or the tool, whichever is chosen.

    A joint stops at its limit; a step of the tool is taken as a whole or not at all.

    Parameters
    ----------
    parts : tuple of float
        For each joint, or for x, y, z and the turns about them, the part of a step, from -1 to 1.
    drag : int
        Number of the jog: from a press to the release is one step of undo.
    """

    parts: tuple[float, ...]
    drag: int
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "jog"

    @property
    def channel(self) -> object:
        """The jog: of its steps that wait only the newest counts, but every press does."""
        return type(self), self.drag

    @property
    def stroke(self) -> object:
        """The jog, which is one step of undo."""
        return type(self), self.drag

    def apply(self, state: State) -> State:
        """Return the state with the arm one step on, or with the reason why it cannot go on.

        Raises
        ------
        InputError
            Nothing is chosen to be jogged, or the parts are no numbers from -1 to 1, one for each coordinate.
        """
        if not state[Jog].mode:
            raise InputError("jog: choose joints, base or tool first")
        steps = np.array(jog_steps(state))
        expected = f"{len(steps)} numbers from -1 to 1"
        parts = finite_floats(self.parts, "jog", steps.shape, expected)
        if np.any(np.abs(parts) > 1.0):
            raise InputError(f"jog: expected {expected}, got {self.parts}")
        by = parts * steps
        if state[Jog].mode == "joints":
            return self._joints(state, by)
        return self._tool(state, np.where(jog_offers(state), by, 0.0))

    def _joints(self, state: State, by: np.ndarray) -> State:
        joints = state[Joints]
        wanted = joints.q + by
        low, high = joints.arm.limits.T
        beyond = (wanted < low - ROUNDING) | (wanted > high + ROUNDING)
        ended = None
        ends: tuple[tuple[Why, np.ndarray], ...] = ("held", np.array(joints.locked)), ("limit", beyond)
        for why, which in ends:
            stopped = np.flatnonzero(which & (by != 0.0))
            if ended is None and len(stopped):
                ended = Ended(self.drag, why, tuple(stopped.tolist()))
        return _jogged(state, joints.moved_to(wanted), ended)

    def _tool(self, state: State, by: np.ndarray) -> State:
        joints = state[Joints]
        found = jogged(joints.arm, joints.q, by, state[Jog].mode == "tool", joints.locked)
        ended = Ended(self.drag, found.why, found.joints) if found.why else None
        return _jogged(state, joints.moved_to(found.q), ended)


def _jogged(state: State, joints: Joints, ended: Ended | None) -> State:
    part = state[Jog]
    if joints is state[Joints] and ended == part.ended:
        return state
    # A part of its own, even with the same end: it was the jog that moved the arm.
    return state.replace(joints, replace(part, ended=ended))
