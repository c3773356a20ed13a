"""Commands of "Spot the error"."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.lessons.errata.state import Choose, Errata
from armlab.content.errata_task import with_tasks
from armlab.session.state import Command, State
from armlab.teaching.parts.errata_practice import Practice


def task_key(state: State) -> str:
    """Return the id of the task that is shown: of the chosen erratum, or of the first one after it that has a task."""
    return _from(state[Errata].chosen, state, 0)


def _from(key: str, state: State, step: int) -> str:
    """Return the id of the task a step after the one at an erratum or next to it; after the last comes the first."""
    keys = with_tasks()
    if key in keys:
        return keys[(keys.index(key) + step) % len(keys)]
    from armlab.content.errata import errata

    order = list(errata())
    after = [each for each in keys if order.index(each) > order.index(key)]
    return (after or list(keys))[0]


@dataclass(frozen=True)
class PointAt(Command):
    """Point at a part of what is printed, in the task that is shown.

    Parameters
    ----------
    place : tuple of int
        Number of the part from 1, or row and column of a matrix.
    """

    place: tuple[int, ...]
    label: ClassVar[str] = "part of a formula"
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the part pointed at; `InputError` when there is no such part."""
        return state.replace(state[Practice].pointing(task_key(state), self.place))


@dataclass(frozen=True)
class Correct(Command):
    """Give the correct form of what is printed, in the task that is shown."""

    typed: str
    label: ClassVar[str] = "correction"
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the correction, which is judged."""
        return state.replace(state[Practice].answering(task_key(state), self.typed))


@dataclass(frozen=True)
class TryAgain(Command):
    """Begin the task that is shown anew."""

    label: ClassVar[str] = "task begun anew"
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state without the answers to the task."""
        return state.replace(state[Practice].without(task_key(state)))


@dataclass(frozen=True)
class NextTask(Command):
    """Go on to another task.

    Parameters
    ----------
    step : int
        1 for the next, -1 for the one before, 0 for the next one that is not done.
    """

    step: int = 0
    label: ClassVar[str] = "next task"
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state at the other task; the same task when all are done."""
        here, done = task_key(state), state[Practice].done
        key = _from(here, state, self.step or 1)
        while self.step == 0 and key in done and key != here:
            key = _from(key, state, 1)
        return Choose(key).apply(state)
