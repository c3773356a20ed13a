"""Undo and redo: two lists of states."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, State
from armlab.session.weight import forget_derived, weight

DEPTH = 200
"""Largest number of steps that are kept. States share unchanged parts, so that a step takes about a kilobyte."""

HEAVIEST = 12 << 20
"""Largest size of all steps, bytes: recorded and planned motions are large. The oldest steps are dropped first."""

PAUSE = 1.0
"""Pause, seconds, after which moving the same slider again is a new step."""


class Step(NamedTuple):
    """A state that undo or redo can restore.

    Attributes
    ----------
    state : State
    label : str
        Name of the change that is taken back or restored.
    held : int
        Bytes that this step alone holds: of the parts that were replaced.
    """

    state: State
    label: str
    held: int


@dataclass
class History:
    """The steps of undo of one student."""

    past: list[Step] = field(default_factory=list)
    future: list[Step] = field(default_factory=list)
    _stroke: object = None
    _at: float = 0.0

    def note(self, before: State, after: State, command: Command, at: float) -> None:
        """Record that a command has replaced a state; commands of one stroke are one step."""
        goes_on = command.stroke is not None and command.stroke == self._stroke
        if not goes_on or (command.rests and at - self._at > PAUSE):
            self.past.append(Step(before, command.label, _lightened(before, after)))
            del self.past[:-DEPTH]
            while len(self.past) > 1 and self.held > HEAVIEST:
                del self.past[0]
        self.future.clear()
        self._stroke, self._at = command.stroke, at

    @property
    def held(self) -> int:
        """Approximate size of all steps, bytes."""
        return sum(step.held for step in (*self.past, *self.future))

    def forget_half(self) -> None:
        """Forget the older half of the steps back, and all steps forward."""
        self.future.clear()
        del self.past[: (len(self.past) + 1) // 2]

    def undo(self, present: State) -> State:
        """Return the state one step back, or the present one."""
        return self._step(present, self.past, self.future)

    def redo(self, present: State) -> State:
        """Return the state one step forward, or the present one."""
        return self._step(present, self.future, self.past)

    def _step(self, present: State, source: list[Step], other: list[Step]) -> State:
        try:
            step = source.pop()
        except IndexError:  # none left, or just forgotten by another thread
            return present
        other.append(Step(present, step.label, _lightened(present, step.state)))
        self._stroke = None
        return step.state

    def only(self, label: str) -> bool:
        """Return whether all steps have this label."""
        return all(step.label == label for step in self.past)

    @property
    def undone(self) -> State | None:
        """The state that an undo would bring, or None."""
        return next((step.state for step in self.past[-1:]), None)

    @property
    def redone(self) -> State | None:
        """The state that a redo would bring, or None."""
        return next((step.state for step in self.future[-1:]), None)

    @property
    def undo_label(self) -> str | None:
        """The label of the step that an undo would take back."""
        return self.past[-1].label if self.past else None

    @property
    def redo_label(self) -> str | None:
        """The label of the step that a redo would bring back."""
        return self.future[-1].label if self.future else None


def _lightened(kept: State, shown: State) -> int:
    """Drop what can be computed again from a kept state; return the bytes that it alone occupies."""
    kept.forget_derived()
    replaced = [part for part in kept if shown[type(part)] is not part]
    for part in replaced:
        forget_derived(part)
    return weight(replaced, (shown[RobotPart].robot.arm, shown[RobotPart].robot))
