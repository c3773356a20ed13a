"""Commands for the problem and the runs of the film of iterations."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.benches.iterate.runs.state import (
    Iterations,
    fitted,
    on_film,
    vector_of,
)
from armlab.benches.iterate.runs.worked import Run, fitting, free_colour
from armlab.errors import InputError
from armlab.kin.ik.iterate import TaskVector
from armlab.session.counted import refuse_beyond
from armlab.session.fields import setting
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import target_pose
from armlab.session.state import Command, State


@dataclass(frozen=True)
class SetStart(Command):
    """Let all runs begin at a configuration; None is the present one."""

    q: tuple[float, ...] | None = None
    label: ClassVar[str] = "start of the iterations"

    def apply(self, state: State) -> State:
        """Return the state with the start set."""
        q = state[Joints].q if self.q is None else self.q
        return changed(state, start=q)


@dataclass(frozen=True, eq=False)
class AimAt(Command):
    """Give all runs another target; None is the target of the lab, or the tool if there is none."""

    pose: NDArray[np.floating] | None = None
    label: ClassVar[str] = "target of the iterations"

    def apply(self, state: State) -> State:
        """Return the state with the target set."""
        pose = target_pose(state) if self.pose is None else self.pose
        return changed(state, target=pose)


@dataclass(frozen=True)
class ChooseTask(Command):
    """Choose the task vector; None is the arm's own task."""

    task: TaskVector | None
    label: ClassVar[str] = "task vector"

    def apply(self, state: State) -> State:
        """Return the state with the task vector chosen."""
        return changed(state, task=None if self.task is None else fitted(state[Joints].arm, self.task))


@dataclass(frozen=True)
class AddRun(Command):
    """Add a run of a method, or a copy of run ``like``, and select it."""

    method: str = "newton"
    like: int | None = None
    label: ClassVar[str] = "run"

    def apply(self, state: State) -> State:
        """Return the state with one more run."""
        part = state[Iterations]
        colour = free_colour(part.runs)
        if self.like is None:
            run = fitting(self.method, state[Joints].arm, vector_of(state), colour)
        else:
            run = replace(part.runs[checked_run(part, self.like)], colour=colour)
        return changed(state, runs=(*part.runs, run), selected=len(part.runs))


@dataclass(frozen=True)
class RemoveRun(Command):
    """Remove a run."""

    run: int
    label: ClassVar[str] = "run"

    def apply(self, state: State) -> State:
        """Return the state with one run less."""
        part = state[Iterations]
        gone = checked_run(part, self.run)
        if len(part.runs) == 1:
            raise InputError("at least one run is needed: choose another method for it")
        runs = tuple(run for i, run in enumerate(part.runs) if i != gone)
        selected = part.selected - (part.selected > gone)
        return changed(state, runs=runs, selected=min(selected, len(runs) - 1))


@dataclass(frozen=True)
class ChooseMethod(Command):
    """Give a run another method, with its parameters at their defaults."""

    run: int
    method: str
    label: ClassVar[str] = "method of a run"

    def apply(self, state: State) -> State:
        """Return the state with the method chosen."""
        part = state[Iterations]
        i = checked_run(part, self.run)
        if part.runs[i].method == self.method:
            return state
        run = fitting(self.method, state[Joints].arm, vector_of(state), part.runs[i].colour)
        return _with_run(state, i, run)


@dataclass(frozen=True)
class SetParameter(Command):
    """Set one parameter of a run."""

    run: int
    key: str
    value: float
    label: ClassVar[str] = "parameter of a run"

    def apply(self, state: State) -> State:
        """Return the state with the parameter set."""
        i = checked_run(state[Iterations], self.run)
        return _with_run(state, i, state[Iterations].runs[i].with_parameter(self.key, self.value))


@dataclass(frozen=True)
class SelectRun(Command):
    """Choose the run that is played and shown in the table; the film stays at its time."""

    run: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the run selected."""
        part = state[Iterations]
        i = checked_run(part, self.run)
        return state if i == part.selected else on_film(state.replace(replace(part, selected=i)))


def checked_run(part: Iterations, run: int) -> int:
    """Return the index of a run, from 0; `InputError` if there is none."""
    refuse_beyond(run, len(part.runs), "run")
    return run


def changed(state: State, **fields: object) -> State:
    """Return the state with another problem, which is no longer an example, or the same state."""
    return setting(state, Iterations, fields)


def _with_run(state: State, i: int, run: Run) -> State:
    runs = state[Iterations].runs
    return changed(state, runs=(*runs[:i], run, *runs[i + 1 :]))
