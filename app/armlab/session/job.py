"""Long work beside the commands: what is wanted of it follows from the state, what it finds comes back as commands.

A job is declared, not started: when what it wants has changed, the work under way is given up and begun anew, and when
it wants nothing any more, the work is cancelled. So a command stays pure, and an undo or another arm cancels by itself.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any, ClassVar, NamedTuple

from armlab.plugins import discover_in_benches
from armlab.session.state import Command, State


class Wanted(NamedTuple):
    """The input of a job.

    Attributes
    ----------
    key : hashable
        Work on equal keys is the same work and is not done twice in a row.
    inputs : object
        All that it needs; immutable.
    """

    key: Hashable
    inputs: Any


@dataclass(frozen=True)
class Job:
    """The constant ``JOB`` of ``job.py`` of a bench.

    Parameters
    ----------
    key : str
    title : str
        Name of the work in a message on its failure, such as ``"The search for all solutions"``.
    wanted : callable
        ``wanted(state, panels) -> Wanted | None``, cheap: what to work on, None for nothing. ``panels`` are the keys of
        the panels that are open in some window of the student.
    run : callable
        ``run(inputs)`` yields what it has found so far, again and again; None where there is nothing new. Between two
        of them lie some 30 ms of work at most: all students share one thread.
    delivered : callable
        ``delivered(state, inputs, found) -> State``: the state with what was found. Pure; it may be called with what
        belongs to a state that has passed, and then returns the present state as it is.
    interval : float
        Seconds between the beginnings of two pieces of work for one student, at least.
    """

    key: str
    title: str
    wanted: Callable[[State, frozenset[str]], Wanted | None]
    run: Callable[[Any], Iterator[Any]]
    delivered: Callable[[State, Any, Any], State]
    interval: float = 0.0


@cache
def jobs() -> dict[str, Job]:
    """Return all jobs by key."""
    return discover_in_benches("job", "JOB", Job)


@dataclass(frozen=True, eq=False)
class Deliver(Command):
    """Hand in the present result of a job; of several waiting only the newest is used."""

    job: Job
    inputs: Any
    found: Any
    snapshot: ClassVar[bool] = True
    undoable: ClassVar[bool] = False

    @property
    def channel(self) -> object:
        """The job: its newest result replaces waiting ones."""
        return Deliver, self.job.key

    def apply(self, state: State) -> State:
        """Return the state with the result."""
        return self.job.delivered(state, self.inputs, self.found)
