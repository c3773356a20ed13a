"""Commands for the runs of kinematic control; all but those that choose a run change the selected one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.benches.control.follow.chosen import (
    Setup,
    checked_name,
    checked_pushes,
    free_colour,
    joint_values,
)
from armlab.benches.control.follow.clip import ARM, time_of
from armlab.benches.control.follow.state import CLIP_KEY, Control, checked_push, here
from armlab.errors import InputError
from armlab.session.counted import refuse_beyond
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import target_pose
from armlab.session.parts.timeline import Timeline
from armlab.session.run_targets import checked_target
from armlab.session.state import Command, State

STILL = 1e-6
"""Speed, m/s, below which a reference has no direction for a push across it."""


@dataclass(frozen=True)
class AddRun(Command):
    """Add a copy of the selected run and select it; the original stays for comparison."""

    label: ClassVar[str] = "run"

    def apply(self, state: State) -> State:
        """Return the state with one more run."""
        part = state[Control]
        run = replace(part.run, colour=free_colour(part.runs), name="")
        return _changed(state, runs=(*part.runs, run), selected=len(part.runs))


@dataclass(frozen=True)
class RemoveRun(Command):
    """Remove a run."""

    run: int
    label: ClassVar[str] = "run"

    def apply(self, state: State) -> State:
        """Return the state with one run less."""
        part = state[Control]
        gone = _checked_run(part, self.run)
        if len(part.runs) == 1:
            raise InputError("at least one run is needed: change this one instead")
        runs = tuple(run for i, run in enumerate(part.runs) if i != gone)
        selected = part.selected - (part.selected > gone)
        return ARM.shown(_changed(state, runs=runs, selected=min(selected, len(runs) - 1)))


@dataclass(frozen=True)
class SelectRun(Command):
    """Choose the run that is edited and played; the timeline stays at its time."""

    run: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the run selected."""
        part = state[Control]
        i = _checked_run(part, self.run)
        return state if i == part.selected else ARM.shown(state.replace(replace(part, selected=i)))


@dataclass(frozen=True)
class NameRun(Command):
    """Name the selected run; an empty name is replaced by law and inverse."""

    name: str
    label: ClassVar[str] = "name of a run"

    def apply(self, state: State) -> State:
        """Return the state with the name given."""
        return _with(state, replace(state[Control].run, name=checked_name(self.name)))


@dataclass(frozen=True)
class ChooseReference(Command):
    """Choose the reference."""

    reference: str
    label: ClassVar[str] = "reference"

    def apply(self, state: State) -> State:
        """Return the state with the reference chosen."""
        return _with(state, state[Control].run.with_reference(self.reference))


@dataclass(frozen=True)
class ChooseLaw(Command):
    """Choose the control law."""

    law: str
    label: ClassVar[str] = "control law"

    def apply(self, state: State) -> State:
        """Return the state with the law chosen, at its defaults."""
        run = state[Control].run
        changed = run.with_law(self.law)
        return state if run.law == changed.law else _with(state, changed)


@dataclass(frozen=True)
class ChooseInverse(Command):
    """Choose the inverse of the differential kinematics."""

    inverse: str
    label: ClassVar[str] = "method"

    def apply(self, state: State) -> State:
        """Return the state with the method chosen, at its defaults."""
        run = state[Control].run
        changed = run.with_inverse(self.inverse)
        return state if run.inverse == changed.inverse else _with(state, changed)


@dataclass(frozen=True, eq=False)
class SetValue(Command):
    """Set a value of the selected run; see `armlab.benches.control.follow.chosen.FIELDS`. None restores its default."""

    key: str
    value: Any
    label: ClassVar[str] = "value of a run"

    def apply(self, state: State) -> State:
        """Return the state with the value set."""
        changed = state[Control].run.with_value(self.key, self.value)
        if changed.link > len(changed.start):
            raise InputError(f"link: expected 1 to {len(changed.start)}, or 0 for all, got {changed.link}")
        return _with(state, changed)


@dataclass(frozen=True, eq=False)
class SetOption(Command):
    """Set one option of the ``"law"`` or the ``"inverse"`` of the selected run; None restores its default."""

    of: str
    key: str
    value: Any
    label: ClassVar[str] = "option of a run"

    def apply(self, state: State) -> State:
        """Return the state with the option set."""
        if not isinstance(self.of, str) or self.of not in ("law", "inverse"):
            raise InputError(f"option of a run: expected that of its law or its inverse, got {self.of!r}")
        return _with(state, state[Control].run.with_option(self.of, self.key, self.value))


@dataclass(frozen=True)
class SetStart(Command):
    """Let the reference begin at a configuration; None is the present one."""

    q: tuple[float, ...] | None = None
    label: ClassVar[str] = "start of a run"

    def apply(self, state: State) -> State:
        """Return the state with the start set."""
        q = joint_values(state[RobotPart].robot.arm, here(state) if self.q is None else self.q, "start")
        return _with(state, replace(state[Control].run, start=q))


@dataclass(frozen=True)
class SetOffset(Command):
    """Set the initial offset of the joints: those of the arm minus those of the start, -e(0) where it tracks."""

    offset: tuple[float, ...]
    label: ClassVar[str] = "initial offset"

    def apply(self, state: State) -> State:
        """Return the state with the initial offset set."""
        offset = joint_values(state[RobotPart].robot.arm, self.offset, "initial offset")
        return _with(state, replace(state[Control].run, offset=offset))


@dataclass(frozen=True, eq=False)
class AimAt(Command):
    """Give the runs that regulate another target; None is the target of the lab, or the tool if there is none."""

    pose: NDArray[np.floating] | None = None
    label: ClassVar[str] = "target of the control"

    def apply(self, state: State) -> State:
        """Return the state with the target set."""
        pose = checked_target(state[RobotPart].robot, target_pose(state) if self.pose is None else self.pose)
        return state if np.array_equal(pose, state[Control].target) else _changed(state, target=pose)


@dataclass(frozen=True)
class SizePush(Command):
    """Set the distance by which the button pushes the tool, metres."""

    size: float
    label: ClassVar[str] = "size of a push"

    def apply(self, state: State) -> State:
        """Return the state with the size set."""
        return state.replace(replace(state[Control], push=checked_push(self.size)))


@dataclass(frozen=True)
class PushNow(Command):
    """Push the tool of the selected run aside, across its reference, at the present time, and run it again from 0.

    While no run is on, it is pushed half way.
    """

    label: ClassVar[str] = "push"

    def apply(self, state: State) -> State:
        """Return the state with one more push."""
        part = state[Control]
        outcome = part.outcome
        if outcome is None or outcome.run is None:
            raise InputError("push: there is no run yet")
        on = state[Timeline].clip == CLIP_KEY
        time = round(time_of(state) if on else 0.5 * outcome.run.duration, 3)
        by = part.push * _across(state, time)
        pushes = checked_pushes((*part.run.pushes, (time, *by.tolist())))
        return _with(state, replace(part.run, pushes=tuple(sorted(pushes))))


@dataclass(frozen=True)
class DropPushes(Command):
    """Remove all pushes of the selected run."""

    label: ClassVar[str] = "pushes"

    def apply(self, state: State) -> State:
        """Return the state without pushes."""
        return _with(state, replace(state[Control].run, pushes=()))


def _across(state: State, time: float) -> NDArray[np.float64]:
    """Return a unit vector (3,) in the plane of frame 0, across the reference at a time; along x at a standstill."""
    outcome, base = state[Control].outcome, state[RobotPart].robot.arm.base
    assert outcome is not None
    assert outcome.run is not None
    run = outcome.run
    k = min(max(run.index(time), 1), run.steps)
    way = run.p_wanted[k] - run.p_wanted[k - 1] if run.steps else np.zeros(3)
    side = np.cross(base[:3, 2], way)
    length = float(np.linalg.norm(side))
    lasting = float(run.t[k] - run.t[k - 1]) if run.steps else 1.0
    return np.asarray(side / length if length > STILL * lasting else base[:3, 0])


def _checked_run(part: Control, run: int) -> int:
    """Return the index of a run, from 0; `InputError` if there is none."""
    refuse_beyond(run, len(part.runs), "run")
    return run


def _with(state: State, run: Setup) -> State:
    """Return the state with the selected run changed, or the same state."""
    part = state[Control]
    if run == part.run:
        return state
    runs = (*part.runs[: part.selected], run, *part.runs[part.selected + 1 :])
    return _changed(state, runs=runs)


def _changed(state: State, **fields: Any) -> State:
    """Return the state with fields of its part changed, which is no longer an example."""
    return state.replace(replace(state[Control], **{"example": "", **fields}))
