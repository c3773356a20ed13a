"""Undo and redo: two lists of states."""

from __future__ import annotations

from dataclasses import dataclass, field

from armlab.session.state import Command, State

DEPTH = 200
"""Steps that are kept. States share their unchanged parts, so a step costs some hundred bytes."""

PAUSE = 1.0
"""Seconds of rest after which moving the same slider again is a new step."""


@dataclass
class History:
    """The steps of one student."""

    past: list[tuple[State, str]] = field(default_factory=list)
    future: list[tuple[State, str]] = field(default_factory=list)
    _stroke: object = None
    _at: float = 0.0

    def note(self, before: State, command: Command, at: float) -> None:
        """Note that a command is about to replace a state; commands of one stroke are one step."""
        goes_on = command.stroke is not None and command.stroke == self._stroke
        if not goes_on or (command.rests and at - self._at > PAUSE):
            self.past.append((before, command.label))
            del self.past[:-DEPTH]
        self.future.clear()
        self._stroke, self._at = command.stroke, at

    def undo(self, present: State) -> State:
        """Return the state one step back, or the present one."""
        return self._step(present, self.past, self.future)

    def redo(self, present: State) -> State:
        """Return the state one step forward, or the present one."""
        return self._step(present, self.future, self.past)

    def _step(self, present: State, source: list[tuple[State, str]], other: list[tuple[State, str]]) -> State:
        if not source:
            return present
        state, label = source.pop()
        other.append((present, label))
        self._stroke = None
        return state

    def only(self, label: str) -> bool:
        """Return whether every step there is bears this label."""
        return all(each == label for _, each in self.past)

    @property
    def undo_label(self) -> str | None:
        """What an undo would take back."""
        return self.past[-1][1] if self.past else None

    @property
    def redo_label(self) -> str | None:
        """What a redo would bring back."""
        return self.future[-1][1] if self.future else None
